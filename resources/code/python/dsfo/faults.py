"""The faults of the table world, for trials and exercises. All but ``set`` befall the next
operation, or the one whose address is given.
"""

from __future__ import annotations

from collections.abc import Mapping

from .elements import Blueprint, FactKey, fact_text, parts, split_fact
from .errors import UsageError, did_you_mean
from .hierarchy import Hierarchy
from .world import NOTHING, TableWorld

FAULTS: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "set": (("fact", "value"), ()),
    "fail": ((), ("operation",)),
    "raise": ((), ("operation",)),
    "hang": ((), ("operation",)),
    "nothing": ((), ("operation",)),
    "elsewhere": (("state",), ("operation",)),
}
"""The faults, with the parameters that each needs and may have."""


def check_fault(fault: str, given: Mapping[str, object]) -> None:
    """Raise UsageError if there is no such fault, or if its parameters do not fit."""
    if fault not in FAULTS:
        near = did_you_mean(fault, FAULTS) or f"It has {', '.join(FAULTS)}."
        raise UsageError(f"the world 'table' has no fault {fault!r}", near)
    needs, may = FAULTS[fault]
    takes = f"It takes {', '.join((*needs, *may)) or 'nothing'}."
    for name in needs:
        if name not in given:
            raise UsageError(f"the fault {fault}: {name} is missing", takes)
    for name, value in given.items():
        if name not in (*needs, *may):
            raise UsageError(f"the fault {fault}: there is no parameter {name!r}", takes)
        if not isinstance(value, str):
            raise UsageError(f"the fault {fault}: {name} is {value!r}, not a text", takes)


def inject_fault(world: object, blueprint: Blueprint, fault: str, given: Mapping[str, str]) -> None:
    """Cause a fault. UsageError if it names nothing of the blueprint."""
    check_fault(fault, given)
    if not isinstance(world, TableWorld):
        raise UsageError("only the table world has faults")
    if fault == "set":
        world.set_fact(_fact(blueprint, given["fact"]), given["value"])
        return
    at = _operation(blueprint, given.get("operation", ""))
    facts = _facts(world, blueprint, given["state"]) if fault == "elsewhere" else NOTHING
    world.spoil(fault, facts, at)


def _fact(blueprint: Blueprint, text: str) -> FactKey:
    known = list(blueprint.sensed())
    key = split_fact(text)
    if key is None or key not in known:
        near = did_you_mean(text, map(fact_text, known))
        advice = near or "Write it as SB/digit, digits counted from 0."
        raise UsageError(f"no fact called {text!r} is sensed", advice)
    return key


def _operation(blueprint: Blueprint, text: str) -> str:
    names = parts(text)
    branch = blueprint.branches.get(names[0]) if len(names) == 3 else None
    state = branch.states.get(names[1]) if branch else None
    if text and (state is None or names[2] not in state.operations):
        raise UsageError(f"there is no operation {text!r}", "Write it as SB/State/Operation.")
    return text


def _facts(world: TableWorld, blueprint: Blueprint, text: str) -> dict[FactKey, str]:
    name, _, state = text.rpartition("/")
    roots = Hierarchy(blueprint).roots
    if not name and len(roots) == 1:
        name = roots[0]
    if name not in blueprint.branches or state not in blueprint[name].states:
        known = [f"{one.name}/{state}" for one in blueprint for state in one.states]
        near = did_you_mean(text, known) or "Write it as SB/State."
        raise UsageError(f"there is no state {text!r}", near)
    return world.facts_of(name, state)
