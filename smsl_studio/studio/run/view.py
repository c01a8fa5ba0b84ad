"""From a run's status and story to what the widgets show: pure functions, no widget."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Reading
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.status import DispatchStatus, Possible
from smsl_studio.studio.canvas.marks import Marks
from smsl_studio.studio.run.facts_table import FactRow
from smsl_studio.studio.run.possible_list import PossibleRow
from smsl_studio.studio.run.story import Span, Story
from smsl_studio.studio.run.timeline import Lane


def fact_rows(blueprint: Blueprint, status: DispatchStatus) -> tuple[FactRow, ...]:
    """Every fact of every SB; with several SBs a line names each first."""
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
            rows.append(_fact_row(name, believed, reading, expected.get((branch.name, digit))))
    return tuple(rows)


def possible_rows(blueprint: Blueprint, status: DispatchStatus) -> tuple[PossibleRow, ...]:
    """What may be done now: permitted first, every other one with its reason."""
    rows = [_possible_row(blueprint, status, item) for item in status.possible]
    order = {"running": 0, "route": 1, "possible": 2, "pruned": 3, "refused": 4}
    groups = list(dict.fromkeys(row.group for row in rows))
    return tuple(sorted(rows, key=lambda row: (groups.index(row.group), order[row.kind])))


def lanes(blueprint: Blueprint, story: Story) -> tuple[Lane, ...]:
    """The rows of the timeline: states of each SB, operations, then facts."""
    several = len(blueprint) > 1
    found = [
        Lane(branch.name if several else "State", "state", _short(branch, story))
        for branch in blueprint
        if branch.name in story.states
    ]
    if found:
        found.append(Lane("Operation", "operation", tuple(story.operations)))
    for (name, digit), spans in sorted(story.facts.items()):
        branch = blueprint[name]
        label = branch.fact_name(digit)
        found.append(Lane(f"{name} {label}" if several else label, "fact", tuple(spans)))
    return tuple(found)


def marks(blueprint: Blueprint, branch: str, status: DispatchStatus, story: Story) -> Marks:
    """What glows, trails and is planned on the canvas of one SB."""
    active = status.configuration.get(branch)
    running = status.running if status.running and status.running.branch == branch else None
    planned = tuple(a for a in status.route if a.branch == branch and a != running)
    targets = [
        blueprint[branch].table[a.state][a.operation] for a in planned if _stands(blueprint, a)
    ]
    shut = frozenset(p.address for p in status.possible if p.pruned and p.address.branch == branch)
    risky = frozenset(
        address
        for text in story.risky
        if (address := Address(*Address.split(text))).branch == branch
    )
    return Marks(
        active=active,
        running=(running, status.progress or 0.0) if running else None,
        visited=story.visited(branch) - {active or ""},
        trail=tuple(story.trail.get(branch, ())),
        planned=planned,
        next_states=frozenset(targets[:1]),
        pruned=shut - risky,
        risky=risky,
        possible=frozenset(p.address for p in status.possible if p.permitted),
        goals=frozenset(goal.state for goal in status.goals if goal.branch == branch),
        facts=_sensed(blueprint[branch], active, status),
        running_words=_running_words(status) if running else "",
        dimmed=True,
    )


def _sensed(
    branch: StateBranch, active: str | None, status: DispatchStatus
) -> Mapping[tuple[str, int], str]:
    """How each sensed fact of the active state stands against what is believed."""
    if active is None or status.running is not None:
        return {}
    found: dict[tuple[str, int], str] = {}
    for digit, believed in enumerate(branch.facts(active)):
        reading = status.scene.get(branch.name, digit)
        if reading is not None and reading.value != believed:
            found[active, digit] = "unknown" if reading.value is None else "differs"
    return found


def _running_words(status: DispatchStatus) -> str:
    if status.running is None or status.running_since is None:
        return ""
    return f"{status.running.operation}  {status.time - status.running_since:.1f} s"


def _short(branch: StateBranch, story: Story) -> tuple[Span, ...]:
    return tuple(
        Span(span.start, short_name(branch, span.words), span.end, span.good)
        for span in story.states[branch.name]
    )


def short_name(branch: StateBranch, state: str) -> str:
    """The facts alone where a state's name is a prefix and its facts, else the name."""
    facts = "".join(branch.facts(state)) if state in branch.table else ""
    return facts if facts and state.endswith(facts) else state


def _expected(blueprint: Blueprint, status: DispatchStatus) -> Mapping[tuple[str, int], str]:
    """The facts the running operation is about to change, with what they should become."""
    running = status.running
    if running is None or not _stands(blueprint, running):
        return {}
    branch = blueprint[running.branch]
    before = branch.facts(running.state)
    after = branch.facts(branch.table[running.state][running.operation])
    return {
        (branch.name, digit): new
        for digit, (old, new) in enumerate(zip(before, after, strict=True))
        if old != new
    }


def _fact_row(name: str, believed: str, reading: Reading | None, expected: str | None) -> FactRow:
    if reading is None:
        return FactRow(name, believed, "", None, "believed", "believed, nobody senses it")
    if expected is not None:
        words = f"moving, expects {expected}"
        return FactRow(name, believed, reading.value, reading.age, "transit", words)
    if reading.value is None:
        words = reading.reason or "no reading"
        return FactRow(name, believed, None, reading.age, "unknown", words)
    if reading.value == believed:
        return FactRow(name, believed, reading.value, reading.age, "agrees", "agrees")
    return FactRow(name, believed, reading.value, reading.age, "differs", f"not {believed}")


def _possible_row(blueprint: Blueprint, status: DispatchStatus, item: Possible) -> PossibleRow:
    address = item.address
    branch = blueprint[address.branch]
    where = address.branch if len(blueprint) > 1 else ""
    group = f"From {where}{'/' if where else ''}{address.state}"
    if address == status.running:
        kind, words = "running", "running, on the route" if item.on_route else "running"
    elif item.pruned:
        kind, words = "pruned", "; ".join(item.reasons) or "pruned"
    elif not item.permitted:
        kind, words = "refused", "; ".join(item.reasons)
    elif status.running is not None:
        kind, words = "refused", "waits: one operation at a time"
    elif item.on_route:
        kind, words = "route", "possible, on the route"
    else:
        kind, words = "possible", "possible, off the route"
    return PossibleRow(
        address=address,
        name=address.operation,
        target=short_name(branch, item.target),
        kind=kind,
        words=words,
        cost=f"{item.cost:.1f}",
        group=group,
    )


def _stands(blueprint: Blueprint, address: Address) -> bool:
    branch = blueprint.branches.get(address.branch)
    return branch is not None and address.operation in branch.table.get(address.state, {})
