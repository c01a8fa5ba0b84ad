"""A graph has the same places, lines and labels in every process and on every machine.

``printed_layouts`` looks at even graphs, where equal places are chosen among, and at the sums by
which they are chosen, with all their digits.
"""

from __future__ import annotations

import importlib
import os
import platform
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from tests.graph.printed_layouts import lines

ROOT = Path(__file__).parents[2]
SEEDS = {"Nehalem": "4", "Prescott": "11"}
"""Old processors that OpenBLAS knows, and for each another order of sets."""


def another_machine(processor: str) -> dict[str, str]:
    """Return an environment in which sets have another order, and numpy and its BLAS compute as on
    a machine with an old processor: without its vector instructions, in other blocks.

    OpenBLAS ignores a processor that it was not built for.
    """
    machine = importlib.import_module("numpy._core._multiarray_umath")
    known = [one for one in machine.__cpu_dispatch__ if machine.__cpu_features__.get(one)]
    alone = processor == "Nehalem"
    found = {
        "PYTHONHASHSEED": SEEDS[processor],
        "OPENBLAS_NUM_THREADS": "1" if alone else "3",
        "OMP_NUM_THREADS": "1" if alone else "3",
    }
    if known and alone:
        found["NPY_DISABLE_CPU_FEATURES"] = " ".join(known)
    if platform.machine() in ("x86_64", "AMD64"):
        found["OPENBLAS_CORETYPE"] = processor
    return found


@cache
def lines_here() -> list[str]:
    return list(lines())


@pytest.mark.parametrize("processor", list(SEEDS))
def test_layouts_and_pictures_are_the_same_bytes_on_another_machine(processor: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.graph.printed_layouts"],
        env={**os.environ, **another_machine(processor)},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == lines_here()


def test_hardly_two_of_the_lines_are_alike() -> None:
    """A small even graph may be laid out in the same way for two reasons. Others are not."""
    found = [line.split()[-1] for line in lines_here()]
    assert len(set(found)) > 0.7 * len(found)
