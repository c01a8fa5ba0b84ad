"""Edits: what one costs in a large file, and whether any history of them leads exactly back.

1,000 histories, or with ``--all`` 10,000, over all cores.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
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
    """What edits cost, and a tenth of all histories."""
    yield from _costs()
    yield _histories(SHARE)


def all_rows() -> Iterator[Row]:
    """What edits cost, and every history that is promised."""
    yield from _costs()
    yield _histories(ALL)


def _costs() -> Iterator[Row]:
    """Edits of Hanoi 8 (6,561 states) in both lossless forms."""
    values = values_of(hanoi(8))
    for form in ("json", "smsl"):
        text = form_named(form).write(values)

        def read(form: str = form, text: str = text) -> Blueprint:
            return read_blueprint(form_named(form).parse(text, f"bench.{form}"))

        blueprint = read()
        whole = ("read the file anew", median_ms(read))
        for words, change in _edits(blueprint).items():
            yield Row(f"{words}, {form}", median_ms(change), "ms", (whole,))


def _histories(count: int) -> Row:
    """Histories of edits, undo and redo in texts of every layout: those that do not come back."""
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        parts = list(pool.map(_part, range(0, count, PART)))
    edits, wrong = (sum(column) for column in zip(*parts, strict=True))
    return Row(f"{count:,} histories ({edits:,} edits), not exact", wrong, "histories", bound="0")


def _part(first: int) -> tuple[int, int]:
    """How many edits the histories from one seed on have, and how many histories are wrong."""
    edits = wrong = 0
    for seed in range(first, first + PART):
        try:
            edits += history(seed).edits
        except AssertionError:
            wrong += 1
    return edits, wrong


def _edits(blueprint: Blueprint) -> dict[str, Callable[[], Blueprint]]:
    branch = next(iter(blueprint))
    state = list(branch.table)[len(branch.table) // 2]
    operation = next(iter(branch.table[state]))
    edge = Address(branch.name, state, operation)
    return {
        "rename an operation": lambda: edit.rename(blueprint, edge, "New"),
        "rename a state": lambda: edit.rename(blueprint, Address(branch.name, state), "New"),
        "move a box": lambda: edit.set_layout(blueprint, branch.name, {state: (1.0, 2.0)}),
        "duplicate a state": lambda: edit.duplicate(blueprint, [Address(branch.name, state)])[0],
    }
