"""Previews against what happens: every edge of a procedure is previewed in physics, and run alone.

A preview agrees if the facts afterwards are those that the blueprint declares; an edge passes if it
is committed. Both must say the same. Without ``--all`` only Hanoi with two disks is looked at.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row
from smsl_studio.front.inputs import read
from smsl_studio.front.previews import preview
from smsl_studio.front.sweeps import sweep
from smsl_studio.runlog.events import EdgeSwept
from smsl_studio.shipped import plugins_dir, samples_dir


def rows() -> Iterator[Row]:
    """Preview a small procedure."""
    return _rows(((samples_dir() / "hanoi-2.json", "hanoi"),))


def all_rows() -> Iterator[Row]:
    """Preview every edge of Hanoi, river, chess and registration."""
    return _rows(
        (
            (samples_dir() / "hanoi-corrected.json", "hanoi"),
            (samples_dir() / "hanoi.json", "hanoi"),
            (plugins_dir() / "river" / "river.json", "river"),
            (plugins_dir() / "chess" / "chess.json", "chess"),
            (samples_dir() / "registration.json", "registration"),
            (samples_dir() / "registration-digitization.json", "registration"),
        )
    )


def _rows(files: tuple[tuple[Path, str], ...]) -> Iterator[Row]:
    for file, world in files:
        blueprint = read(file)
        start = time.process_time()
        swept = [one for one in sweep(blueprint, world) if isinstance(one, EdgeSwept)]
        apart = [
            one.address
            for one in swept
            if preview(blueprint, one.address, world).agrees != one.passed
        ]
        passed = sum(one.passed for one in swept)
        words = f"{file.name}: previews that differ from the outcome, of {len(swept)}"
        yield Row(f"{words} ({passed} pass)", len(apart), "edges", bound="0")
        yield Row(f"{file.name}: all previews and runs", time.process_time() - start, "CPU s")
