"""From a run's status and story to what the widgets show: pure functions, no widget."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, Reading, state_check
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.execution.status import DispatchStatus, Possible
from smsl_studio.host.protocol import SensorInfo
from smsl_studio.runlog.history import Story
from smsl_studio.studio.base.paint.marks import Marks
from smsl_studio.studio.running.facts_table import FactRow
from smsl_studio.studio.running.freshness import age_of_nothing, limit_of, slow_words
from smsl_studio.studio.running.guard_view import held_back, standings
from smsl_studio.studio.running.possible_list import PossibleRow

CHOOSABLE = ("ready", "paused", "fault_hold", "no_route")
"""The phases in which a person may have an operation carried out by hand."""
LOST = "process gone"
Choices = list[tuple[str, str]]


def choices(blueprint: Blueprint) -> tuple[Choices, Choices]:
    """What can be chosen as start and as goal, as (words, address); the default stands first."""
    roots = [blueprint[name] for name in blueprint.roots if blueprint[name].table]
    subs = [branch for branch in blueprint if branch not in roots]
    if len(roots) == 1:
        (root,) = roots
        states = _states(root, several=len(blueprint) > 1)
        starts = _first(states, str(Address(root.name, root.initial)))
        goals = _first(states, str(Address(root.name, root.activating)))
    else:
        states = [pair for root in roots for pair in _states(root, several=True)]
        starts, goals = [("each INITIAL", ""), *states], [("each ACTIVATING", ""), *states]
    return starts, [*goals, *(pair for sub in subs for pair in _states(sub, several=True))]


def _states(branch: StateBranch, several: bool) -> Choices:
    prefix = f"{branch.name}/" if several else ""
    return [
        (prefix + short_name(branch, state), str(Address(branch.name, state)))
        for state in branch.table
    ]


def _first(states: Choices, default: str) -> Choices:
    return sorted(states, key=lambda pair: pair[1] != default)


def fact_rows(
    blueprint: Blueprint, status: DispatchStatus, lost: bool = False
) -> tuple[FactRow, ...]:
    """Every fact of every SB; with several SBs a line names each first.

    ``lost``: the world is gone, and what was sensed last is no knowledge of now.
    """
    rows: list[FactRow] = []
    expected = _expected(blueprint, status)
    for branch in blueprint:
        state = status.configuration.get(branch.name)
        if state is None:
            continue
        if len(blueprint) > 1:
            rows.append(FactRow(branch.name, state, "", None, "group", "", group=True))
        for digit, believed in enumerate(branch.facts(state)):
            name = branch.fact_name(digit)
            if digit in branch.subs:
                sub = branch.subs[digit]
                words = f"follows {sub}, {status.configuration.get(sub, '')}"
                rows.append(FactRow(name, believed, "", None, "believed", words))
                continue
            reading = status.scene.get(branch.name, digit)
            if lost and reading is not None:
                rows.append(FactRow(name, believed, None, None, "unknown", LOST))
                continue
            key = (branch.name, digit)
            limit = None
            if reading is not None:
                limit = limit_of(status.sources, key, reading.value, reading.age)
            rows.append(_fact_row(name, believed, reading, expected.get(key), limit))
    return tuple(rows)


def possible_rows(blueprint: Blueprint, status: DispatchStatus) -> tuple[PossibleRow, ...]:
    """What may be done now: permitted first, every other one with its reason; then what follows."""
    rows = [_possible_row(blueprint, status, item) for item in status.possible]
    order = {"running": 0, "route": 1, "possible": 2, "waits": 3, "pruned": 4, "refused": 5}
    groups = list(dict.fromkeys(row.group for row in rows))
    rows.sort(key=lambda row: (groups.index(row.group), order[row.kind]))
    return (*rows, *_predicted(blueprint, status))


def marks(blueprint: Blueprint, branch: str, status: DispatchStatus, story: Story) -> Marks:
    """What glows, trails and is planned on the canvas of one SB."""
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
        running_words=_running_words(blueprint, status, story) if running else "",
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
        dimmed=True,
    )


def expected_duration(blueprint: Blueprint, status: DispatchStatus, story: Story) -> float | None:
    """How long the running operation should take: declared, or as it took before; else None."""
    running = status.running
    if running is None or status.running_since is None:
        return None
    note = blueprint[running.branch].operation_note(running.state, running.operation)
    return note.duration or story.expected(str(running))


def progress(blueprint: Blueprint, status: DispatchStatus, story: Story) -> float | None:
    """The share of its expected time that the running operation has taken."""
    whole = expected_duration(blueprint, status, story)
    if not whole or status.running_since is None:
        return None
    return min((status.time - status.running_since) / whole, 1.0)


def last_check(blueprint: Blueprint, status: DispatchStatus, lost: bool) -> CheckResult | None:
    """How the state check stood where a run ended: of its first goal's SB, else of the first."""
    branch = next((goal.branch for goal in status.goals), next(iter(status.configuration), ""))
    state = status.configuration.get(branch)
    if state is None or lost or not status.scene.readings:
        return None
    return state_check(blueprint, branch, state, status.scene, status.configuration)


def rate_words(sensors: Sequence[SensorInfo]) -> str:
    """How often facts are sensed."""
    rates = sorted({round(1 / sensor.period) for sensor in sensors if sensor.period > 0})
    if not rates:
        return "nobody senses them"
    return f"sensed at {' to '.join(str(rate) for rate in dict.fromkeys((rates[0], rates[-1])))} Hz"


def short_name(branch: StateBranch, state: str) -> str:
    """The facts alone where a state's name is a prefix and its facts, else the name."""
    facts = "".join(branch.facts(state)) if state in branch.table else ""
    return facts if facts and state.endswith(facts) else state


def _running_in(branch: str, status: DispatchStatus) -> Address | None:
    """The operation that runs in an SB: its own, or the one that waits for its sub-SBs."""
    for address in (status.running, status.carrying):
        if address is not None and address.branch == branch:
            return address
    return None


def _running_words(blueprint: Blueprint, status: DispatchStatus, story: Story) -> str:
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
    """How each sensed fact of the active state stands against what is believed."""
    if active is None or status.running is not None:
        return {}
    found: dict[tuple[str, int], str] = {}
    for digit, believed in enumerate(branch.facts(active)):
        reading = status.scene.get(branch.name, digit)
        if reading is not None and reading.sensed and reading.value != believed:
            found[active, digit] = "unknown" if reading.value is None else "differs"
    return found


def _expected(blueprint: Blueprint, status: DispatchStatus) -> Mapping[tuple[str, int], str]:
    """The facts the running operation is about to change, with what they should become."""
    running = status.running
    if running is None:
        return {}
    branch = blueprint[running.branch]
    before = branch.facts(running.state)
    after = branch.facts(branch.table[running.state][running.operation])
    return {
        (branch.name, digit): new
        for digit, (old, new) in enumerate(zip(before, after, strict=True))
        if old != new
    }


def _fact_row(
    name: str,
    believed: str,
    reading: Reading | None,
    expected: str | None,
    limit: float | None = None,
) -> FactRow:
    if reading is None or not reading.sensed:
        return FactRow(name, believed, "", None, "believed", "believed, nobody senses it")
    if expected is not None:
        words = f"moving, expects {expected}"
        return FactRow(name, believed, reading.value, reading.age, "transit", words)
    if reading.value is None:
        words = reading.reason or "no reading"
        return FactRow(name, believed, None, age_of_nothing(reading), "unknown", words)
    quality, words = "differs", f"not {believed}"
    if reading.value == believed:
        quality = words = "agrees"
    words += slow_words(reading.age, limit)
    return FactRow(name, believed, reading.value, reading.age, quality, words, limit=limit)


def _possible_row(blueprint: Blueprint, status: DispatchStatus, item: Possible) -> PossibleRow:
    address = item.address
    kind, words = _kind(status, item)
    return PossibleRow(
        address=address,
        name=address.operation,
        target=short_name(blueprint[address.branch], item.target),
        kind=kind,
        words=words,
        cost=f"{item.cost:.1f}",
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
    """The operations out of the state that the running one leads to."""
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
            cost=f"{branch.cost(here, name):.1f}",
            group=f"Then, from {_named(blueprint, branch.name, here)}",
            note="predicted",
        )


def _named(blueprint: Blueprint, branch: str, state: str) -> str:
    return f"{branch}/{state}" if len(blueprint) > 1 else state
