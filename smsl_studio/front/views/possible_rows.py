"""The operations that are possible in a run, as rows. Every operation out of the active states has
a row, with the reason if it must not be asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus, Possible
from smsl_studio.front.views.cost_words import cost_words
from smsl_studio.front.views.states import short_name

CHOOSABLE = ("ready", "paused", "fault_hold", "no_route")
"""The phases in which a person may ask for an operation."""


@dataclass(frozen=True)
class PossibleRow:
    """One operation: its name, its target, and whether it is possible.

    ``kind`` is ``running``, ``route``, ``possible``, ``waits``, ``refused`` or ``pruned``. For
    operations after the running one it is ``next`` or ``later``. ``words`` explain the kind.
    ``cost`` is empty if the
    operation only moves a sub-SB. ``note`` stands beside the heading of the group.
    """

    address: Address
    name: str
    target: str
    kind: str
    words: str
    cost: str
    group: str
    note: str = ""


def possible_rows(blueprint: Blueprint, status: DispatchStatus) -> tuple[PossibleRow, ...]:
    """Return the operations that are possible now, permitted ones first, and then those that
    follow.
    """
    rows = [_possible_row(blueprint, status, item) for item in status.possible]
    order = {"running": 0, "route": 1, "possible": 2, "waits": 3, "pruned": 4, "refused": 5}
    groups = list(dict.fromkeys(row.group for row in rows))
    rows.sort(key=lambda row: (groups.index(row.group), order[row.kind]))
    return (*rows, *_predicted(blueprint, status))


def _possible_row(blueprint: Blueprint, status: DispatchStatus, item: Possible) -> PossibleRow:
    address = item.address
    kind, words = _kind(status, item)
    return PossibleRow(
        address=address,
        name=address.operation,
        target=short_name(blueprint[address.branch], item.target),
        kind=kind,
        words=words,
        cost=cost_words(blueprint[address.branch], address, item.cost),
        group=f"From {_named(blueprint, address.branch, address.state)}",
        note="active",
    )


def _kind(status: DispatchStatus, item: Possible) -> tuple[str, str]:
    if item.address in (status.running, status.carrying):
        return "running", "running, on the route" if status.route else "running"
    if item.pruned or item.risky:
        return "pruned", "; ".join(item.reasons) or ("risky" if item.risky else "pruned")
    if status.running is not None:
        return "waits", "waits: one operation at a time"
    if any(task.address == str(item.address) for task in status.tasks):
        return "waits", "waits for an answer"
    if not item.permitted:
        return "refused", "; ".join(item.reasons)
    if item.on_route or item.address in status.route[:1]:
        return "route", "on the route"
    return "possible", "off the route" if status.route else "possible"


def _predicted(blueprint: Blueprint, status: DispatchStatus) -> Iterator[PossibleRow]:
    """Yield the operations out of the state that the running operation leads to."""
    running = status.running
    if running is None:
        return
    branch = blueprint[running.branch]
    here = branch.table[running.state][running.operation]
    if here == running.state:
        return
    ahead = status.route[:1]
    names = sorted(
        branch.table[here], key=lambda name: Address(branch.name, here, name) not in ahead
    )
    for name in names:
        address, target = Address(branch.name, here, name), branch.table[here][name]
        following = address in ahead
        if following:
            goal = next((goal for goal in status.goals if goal.branch == branch.name), None)
            to = f" to {short_name(branch, goal.state)}" if goal else ""
            kind, words = "next", f"next on the route{to}"
        elif target == running.state:
            kind, words = "later", "possible, goes back"
        else:
            kind, words = "later", "possible, off the route"
        yield PossibleRow(
            address=address,
            name=name,
            target=short_name(branch, target),
            kind=kind,
            words=words,
            cost=cost_words(branch, address, branch.cost(here, name)),
            group=f"Then, from {_named(blueprint, branch.name, here)}",
            note="predicted",
        )


def _named(blueprint: Blueprint, branch: str, state: str) -> str:
    return f"{branch}/{state}" if len(blueprint) > 1 else state
