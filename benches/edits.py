"""Edits: the cost of one edit in a large file, and a check that undo restores every history
exactly.

1,000 histories, or with ``--all`` 10,000, over all cores.
"""

from __future__ import annotations

import os
import statistics
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import count
from multiprocessing import get_context

from benches.row import Row, median_ms
from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.generate.rules import hanoi
from smsl_studio.smsl.forms import form_named
from tests.blueprint.histories import history

SHARE, ALL, PART = 1_000, 10_000, 50


def rows() -> Iterator[Row]:
    """Measure the cost of edits, and check a tenth of all histories."""
    yield from _costs()
    yield _histories(SHARE)


def all_rows() -> Iterator[Row]:
    """Measure the cost of edits, and check all promised histories."""
    yield from _costs()
    yield _histories(ALL)


def _costs() -> Iterator[Row]:
    """Edit Hanoi 8 (6,561 states) in both lossless forms, each edit after the one before it."""
    values = values_of(hanoi(8))
    for form in ("json", "smsl"):
        text = form_named(form).write(values)

        def read(form: str = form, text: str = text) -> Blueprint:
            return read_blueprint(form_named(form).parse(text, f"bench.{form}"))

        blueprint = read()
        whole = ("read the file anew", median_ms(read))
        for words, change in EDITS.items():
            yield Row(
                f"{words}, {form}", median_ms(_again(blueprint, change)), "ms", (whole,), MOST
            )
        first = statistics.median(_first(read) for _ in range(5))
        yield Row(f"the first edit of a file, {form}", first, "ms", (whole,))


Change = Callable[[Blueprint, str, int], Blueprint]
"""An edit of a state of a blueprint; the number makes its names new."""


def _again(blueprint: Blueprint, change: Change) -> Callable[[], object]:
    """Repeat an edit, each time on another state."""
    states = list(next(iter(blueprint)).table)
    middle = states[len(states) // 3 :: 97]
    edited, number = blueprint, count()

    def work() -> object:
        nonlocal edited
        at = next(number)
        edited = change(edited, middle[at], at)
        return edited

    return work


def _first(read: Callable[[], Blueprint]) -> float:
    """Make the first edit after reading. It has to find the places of all elements in the text."""
    blueprint = read()
    return median_ms(_again(blueprint, _rename), runs=1, warmup=0)


def _histories(count: int) -> Row:
    """Check histories of edits, undo and redo in texts of every layout. Count those that undo does
    not restore."""
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        parts = list(pool.map(_part, range(0, count, PART)))
    edits, wrong = (sum(column) for column in zip(*parts, strict=True))
    return Row(f"{count:,} histories ({edits:,} edits), not exact", wrong, "histories", bound="0")


def _part(first: int) -> tuple[int, int]:
    """Return the number of edits in the histories of one share, and the number of wrong
    histories."""
    edits = wrong = 0
    for seed in range(first, first + PART):
        try:
            edits += history(seed).edits
        except AssertionError:
            wrong += 1
    return edits, wrong


def _rename_operation(blueprint: Blueprint, state: str, number: int) -> Blueprint:
    operation = next(iter(blueprint[SB].table[state]))
    return edit.rename(blueprint, Address(SB, state, operation), f"New{number}")


def _rename(blueprint: Blueprint, state: str, number: int) -> Blueprint:
    return edit.rename(blueprint, Address(SB, state), f"New{number}")


def _add(blueprint: Blueprint, state: str, number: int) -> Blueprint:
    return edit.add_state(blueprint, SB, f"New{number}", (1.0, 2.0))


def _delete(blueprint: Blueprint, state: str, number: int) -> Blueprint:
    return edit.delete(blueprint, [Address(SB, state)])


def _move(blueprint: Blueprint, state: str, number: int) -> Blueprint:
    return edit.set_layout(blueprint, SB, {state: (1.0, 2.0)})


def _duplicate(blueprint: Blueprint, state: str, number: int) -> Blueprint:
    return edit.duplicate(blueprint, [Address(SB, state)])[0]


SB = "SB1"
MOST = "at most 8 ms"
EDITS: dict[str, Change] = {
    "rename an operation": _rename_operation,
    "rename a state": _rename,
    "add a state": _add,
    "delete a state": _delete,
    "move a box": _move,
    "duplicate a state": _duplicate,
}
