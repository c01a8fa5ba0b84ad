"""Chooses what the columns of a configuration show: each SB's state, and those one step away."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.front.views.states import short_name
from smsl_studio.inspection.explorer.onward import OnwardStep

MOST_STATES, MOST_COLUMNS = 4, 24


@dataclass(frozen=True)
class ColumnState:
    """One state in a column.

    ``near`` says that a permitted step leads to it. ``hazard`` says that this step meets a hazard.
    """

    name: str
    words: str
    here: bool
    near: bool
    hazard: bool


@dataclass(frozen=True)
class BranchColumn:
    """One SB with at most ``MOST_STATES`` of its states, in file order.

    ``more`` is the number of states that are left out.
    """

    branch: str
    states: tuple[ColumnState, ...]
    more: int


def columns_of(
    blueprint: Blueprint, trail: Sequence[RunStep], steps: Iterable[OnwardStep]
) -> tuple[BranchColumn, ...]:
    """Return the columns in the order of the file.

    If there are more than ``MOST_COLUMNS`` SBs, those that have moved or can move are shown first.
    """
    here = trail[-1].configuration
    near: dict[str, dict[str, bool]] = {name: {} for name in here}
    for step in steps:
        for name, state in step.after.items() if step.permitted else ():
            if state != here[name]:
                near[name][state] = near[name].get(state, True) and bool(step.hazard)
    names = list(here)
    if len(names) > MOST_COLUMNS:
        moved = {name for step in trail for name in step.changed}
        first = sorted(names, key=lambda name: (name not in moved, not near[name]))
        chosen = set(first[:MOST_COLUMNS])
        names = [name for name in names if name in chosen]
    return tuple(_column(blueprint[name], here[name], near[name]) for name in names)


def _column(branch: StateBranch, here: str, near: dict[str, bool]) -> BranchColumn:
    table = branch.table
    wanted = list(dict.fromkeys((here, *(name for name in table if name in near))))[:MOST_STATES]
    for name in table:
        if len(wanted) >= min(MOST_STATES, len(table)):
            break
        if name not in wanted:
            wanted.append(name)
    shown = tuple(
        ColumnState(
            name, short_name(branch, name), name == here, name in near, near.get(name, False)
        )
        for name in table
        if name in wanted
    )
    return BranchColumn(branch.name, shown, len(table) - len(shown))
