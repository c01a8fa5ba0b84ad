"""What is highlighted on the drawing of a run: the active state, the trail and the route."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.guard_standings import held_back, standings
from smsl_studio.front.views.states import short_name
from smsl_studio.picture.marks import Marks
from smsl_studio.runlog.history import Story


def run_marks(blueprint: Blueprint, branch: str, status: DispatchStatus, story: Story) -> Marks:
    """Return the marks on the canvas of one SB."""
    active = status.configuration.get(branch)
    running = _running_in(branch, status)
    told, ended = story.moment, story.moment.finished is not None
    planned = tuple(a for a in status.route if a.branch == branch and a != running and not ended)
    shown = running or next(iter(planned), None)
    following = [blueprint[branch].table[shown.state][shown.operation]] if shown else []
    guards = standings(blueprint, branch, status)
    return Marks(
        active=active,
        running=(running, progress(blueprint, status, story)) if running else None,
        running_words=time_words(blueprint, status, story) if running else "",
        visited=story.visited(branch) - {active or ""},
        trail=story.trail(branch),
        planned=planned,
        next_states=frozenset(following) - {active},
        pruned=_shut(branch, status, told.pruned) - _at(branch, told.risky),
        risky=_at(branch, told.risky),
        held_back=held_back(guards, status),
        guards=guards,
        possible=frozenset(p.address for p in status.possible if p.address.branch == branch),
        goals=frozenset(goal.state for goal in status.goals if goal.branch == branch),
        facts=_sensed(blueprint[branch], active, status),
        changes=_generated(branch, status),
        dimmed=True,
    )


def _generated(branch: str, status: DispatchStatus) -> Mapping[Address, str]:
    """Return the signs of edges that the blueprint does not have: added, or only proposed."""
    found = {edge: "+" for edge in status.generated if edge.branch == branch}
    if status.proposed is not None and status.proposed[0].branch == branch:
        found[status.proposed[0]] = "?+"
    return found


def expected_duration(blueprint: Blueprint, status: DispatchStatus, story: Story) -> float | None:
    """Return the expected duration (s) of the running operation: the declared one, else the median
    so far, else None.
    """
    running = status.running
    if running is None or status.running_since is None:
        return None
    note = blueprint[running.branch].operation_note(running.state, running.operation)
    return note.duration or story.expected(str(running))


def progress(blueprint: Blueprint, status: DispatchStatus, story: Story) -> float | None:
    """Return the share of its expected time that the running operation has taken, None if not
    known.
    """
    whole = expected_duration(blueprint, status, story)
    if not whole or status.running_since is None:
        return None
    return min((status.time - status.running_since) / whole, 1.0)


def _running_in(branch: str, status: DispatchStatus) -> Address | None:
    """Return the operation that runs in an SB: its own, or the one that waits for its sub-SBs."""
    for address in (status.running, status.carrying):
        if address is not None and address.branch == branch:
            return address
    return None


def operation_words(blueprint: Blueprint, status: DispatchStatus) -> str:
    """Return what runs now, from where to where; else what is next on the route."""
    running = status.running
    if running is None:
        following = next(iter(status.route), None)
        return f"Next: {following.operation}" if following is not None else ""
    branch = blueprint[running.branch]
    target = branch.table[running.state][running.operation]
    return (
        f"{running.operation}, from {short_name(branch, running.state)}"
        f" to {short_name(branch, target)}"
    )


def time_words(blueprint: Blueprint, status: DispatchStatus, story: Story) -> str:
    """Return how long the operation has been running, and for how long it will, as far as known."""
    if status.running is None or status.running_since is None:
        return ""
    elapsed = f"{status.time - status.running_since:.1f}"
    whole = expected_duration(blueprint, status, story)
    return f"{elapsed} of {whole:.1f} s" if whole else f"{elapsed} s"


def _at(branch: str, written: Mapping[str, str]) -> frozenset[Address]:
    addresses = map(Address.read, written)
    return frozenset(one for one in addresses if one is not None and one.branch == branch)


def _shut(branch: str, status: DispatchStatus, pruned: Mapping[str, str]) -> frozenset[Address]:
    now = (p.address for p in status.possible if p.pruned and p.address.branch == branch)
    return _at(branch, pruned) | frozenset(now)


def _sensed(
    branch: StateBranch, active: str | None, status: DispatchStatus
) -> Mapping[tuple[str, int], str]:
    """Return the facts of the active state that are sensed and do not agree with the believed
    value.
    """
    if active is None or status.running is not None:
        return {}
    found: dict[tuple[str, int], str] = {}
    for digit, believed in enumerate(branch.facts(active)):
        reading = status.scene.get(branch.name, digit)
        if reading is not None and reading.sensed and reading.value != believed:
            found[active, digit] = "unknown" if reading.value is None else "differs"
    return found
