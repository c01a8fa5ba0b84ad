"""A graph has the same places, lines and labels in every process and on every machine."""

from __future__ import annotations

import importlib
import os
import platform
import subprocess
import sys
from pathlib import Path

from tests.graph.printed_layouts import lines

ROOT = Path(__file__).parents[2]


def another_machine() -> dict[str, str]:
    """Return an environment in which sets have another order, and numpy and its BLAS compute as on
    a machine with an old processor: without its vector instructions, in other blocks, alone.
    """
    machine = importlib.import_module("numpy._core._multiarray_umath")
    known = [one for one in machine.__cpu_dispatch__ if machine.__cpu_features__.get(one)]
    found = {"PYTHONHASHSEED": "4", "OPENBLAS_NUM_THREADS": "1"}
    if known:
        found["NPY_DISABLE_CPU_FEATURES"] = " ".join(known)
    if platform.machine() in ("x86_64", "AMD64"):
        found["OPENBLAS_CORETYPE"] = "Nehalem"
    return found


def test_layouts_and_pictures_are_the_same_bytes_on_another_machine() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "tests.graph.printed_layouts"],
        env={**os.environ, **another_machine()},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    elsewhere, here = done.stdout.splitlines(), list(lines())
    assert elsewhere == here
    assert len({line.split()[-1] for line in here}) == len(here), "no two of them are alike"
