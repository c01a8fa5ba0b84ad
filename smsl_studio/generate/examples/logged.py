"""Examples from logs of runs: every operation that was committed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import PlanningError
from smsl_studio.generate.examples.table import ExampleTable, Values
from smsl_studio.runlog.event import Event
from smsl_studio.runlog.events import Committed, RunStarted
from smsl_studio.stop import heed

Json = Any


def logged_examples(runs: Iterable[tuple[Mapping[str, Json], Iterable[Event]]]) -> ExampleTable:
    """Return what some runs of one State Branch did. Each has the header and the events of its log.

    The first run's start and goal are those of the examples. PlanningError if the runs are of
    several State Branches, or if one operation led to different states.
    """
    facts: dict[str, dict[str, Values]] = {}
    names: dict[Values, str] = {}
    edges: dict[str, dict[Values, Values]] = {}
    start: Values | None = None
    goal: Values | None = None
    branch = ""
    for header, events in runs:
        facts = _facts(header)
        if len(facts) != 1 or branch not in ("", *facts):
            raise PlanningError(
                "rules are learnt from runs of one State Branch, and here are several",
                advice="Flatten the blueprint first: smsl-studio flatten FILE -o FLAT.json.",
            )
        (branch,) = facts
        own = facts[branch]
        for event in events:
            heed()
            if isinstance(event, RunStarted):
                begun = _values(own, event.start.get(branch, ""))
                names.setdefault(begun, event.start[branch])
                start = start or begun
                for text in event.goals:
                    address = Address(*Address.split(text))
                    if goal is None and address.state in own:
                        goal = own[address.state]
            elif isinstance(event, Committed) and branch in event.configuration:
                target = _values(own, event.configuration[branch])
                names.setdefault(target, event.configuration[branch])
                for text in event.operations:
                    address = Address(*Address.split(text))
                    source = _values(own, address.state)
                    names.setdefault(source, address.state)
                    known = edges.setdefault(address.operation, {}).setdefault(source, target)
                    if known != target:
                        raise PlanningError(
                            f"{text} led to {names[known]} in one run and to {names[target]} in "
                            "another",
                            advice="Rules say one target: leave out the log of the failed run.",
                        )
    if start is None:
        raise PlanningError("no run begins in these logs")
    return ExampleTable(branch, names, edges, start, goal, ("",) * len(start))


def _facts(header: Mapping[str, Json]) -> dict[str, dict[str, Values]]:
    grounds = header.get("grounds")
    told = grounds.get("states") if isinstance(grounds, Mapping) else None
    if not isinstance(told, Mapping):
        raise PlanningError(
            "the log does not tell the facts of the states",
            advice="Logs of this version do; learn from the blueprint instead.",
        )
    found: dict[str, dict[str, Values]] = {}
    for branch, states in told.items():
        if isinstance(states, Mapping):
            found[branch] = {
                name: tuple(values)
                for name, values in states.items()
                if isinstance(values, list) and all(isinstance(one, str) for one in values)
            }
    return found


def _values(facts: Mapping[str, Values], state: str) -> Values:
    if state not in facts:
        raise PlanningError(f"the log does not tell the facts of the state {state!r}")
    return facts[state]
