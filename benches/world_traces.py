"""Traces in physics: a run in each of the worlds that ship has equal events in this process, in a
child, in the window, and from its log.

The runs are under random scripts, with faults, pauses and disturbed sensors: two in each world,
with ``--all`` fifteen, which makes sixty.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from benches.row import Row
from benches.seeds import chosen
from benches.traces import compared
from tests.plugins.world_runs import WORLDS, world_run

FEW, EACH = 2, 15


def rows() -> Iterator[Row]:
    """Compare two runs in each world."""
    return _rows(FEW)


def all_rows() -> Iterator[Row]:
    """Compare fifteen runs in each world."""
    return _rows(EACH)


def _rows(each: int) -> Iterator[Row]:
    for world in WORLDS:
        numbers = chosen(f"traces in {world}", 0, each)
        yield from compared(
            f"runs in {world} under random scripts", map(partial(world_run, world), numbers)
        )
