"""From a planning problem to a State Branch: every state that can be reached, breadth first."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from smsl_studio.errors import UsageError
from smsl_studio.generate.pddl.domain import Domain
from smsl_studio.generate.pddl.formulas import Atom, Bits, Compiler, Condition, Effect
from smsl_studio.generate.pddl.ground_action import GroundAction, ground_actions
from smsl_studio.generate.pddl.problem import Problem
from smsl_studio.stop import heed

Json = Any
BRANCH = "SB1"
MOST_STATES = 200_000
"""The largest number of states that a problem may reach."""
MOST_EDGES = 2_000_000
"""The largest number of operations."""
MOST_VALUES = 20_000_000
"""The largest number of facts of all states together."""


@dataclass(frozen=True, slots=True)
class PlannedBranch:
    """A branch made of a planning problem, as plain values."""

    values: dict[str, Json]
    states: int
    operations: int
    goal_reached: bool


def planned_branch(domain: Domain, problem: Problem) -> PlannedBranch:
    """Return the branch of a problem.

    ReadError for a part that does not fit, UsageError if the problem has too many states.
    """
    compiler = Compiler(domain, problem.objects, problem.init, problem.costs)
    goal = compiler.condition(problem.goal, {})
    actions = ground_actions(compiler, domain.actions)
    start = 0
    for atom in sorted(problem.init):
        if atom[0] in compiler.fluent:
            start |= compiler.bit(atom)
    states, rows = _reached(start, actions)
    facts = _facts(compiler, list(states))
    if len(facts) * len(states) > MOST_VALUES:
        raise UsageError(
            f"the states have more than {MOST_VALUES:,} facts together",
            advice="Take a smaller problem.",
        )
    goals = [number for state, number in states.items() if _holds(goal, state)]
    return PlannedBranch(
        _values(states, rows, facts, goals, actions), len(states), sum(map(len, rows)), bool(goals)
    )


def _reached(
    start: int, actions: Sequence[GroundAction]
) -> tuple[dict[int, int], list[dict[str, int]]]:
    """Return the states with their numbers, and where each operation leads from each."""
    always = [one for one in actions if one.when is None]
    plain = [(one, one.when.on, one.when.off) for one in actions if isinstance(one.when, Bits)]
    order = {one.name: at for at, one in enumerate(actions)}
    others = [one for one in actions if one.when is not None and not isinstance(one.when, Bits)]
    mixed = bool(always or others)
    states = {start: 0}
    rows: list[dict[str, int]] = []
    queue = deque([start])
    edges = 0
    while queue:
        heed()
        state = queue.popleft()
        possible = [one for one, on, off in plain if state & on == on and not state & off]
        if mixed:
            possible += always
            possible += [one for one in others if _holds(one.when, state)]
            possible.sort(key=lambda one: order[one.name])
        row: dict[str, int] = {}
        for one in possible:
            after = _after(state, one.effects)
            number = states.get(after)
            if number is None:
                number = states[after] = len(states)
                queue.append(after)
                if len(states) > MOST_STATES:
                    raise _too_many(f"{MOST_STATES:,} states")
            row[one.name] = number
        rows.append(row)
        edges += len(row)
        if edges > MOST_EDGES:
            raise _too_many(f"{MOST_EDGES:,} operations")
    return states, rows


def _too_many(what: str) -> UsageError:
    return UsageError(f"the problem has more than {what}", advice="Take fewer objects.")


def _holds(condition: Condition | bool | None, state: int) -> bool:
    if condition is None or isinstance(condition, bool):
        return condition is not False
    return condition(state)


def _after(state: int, effects: Sequence[Effect]) -> int:
    add = delete = 0
    for one in effects:
        if one.when is None or one.when(state):
            add |= one.add
            delete |= one.delete
    return state & ~delete | add


def _facts(compiler: Compiler, states: Sequence[int]) -> dict[Atom, int]:
    """Return the atoms that change, with their bits, in the order of the predicates and objects."""
    changing = 0
    for state in states:
        changing |= state ^ states[0]
    predicates = {name: at for at, name in enumerate(compiler.domain.predicates)}
    objects = {name: at for at, name in enumerate(compiler.objects)}
    found = [atom for atom, bit in compiler.bits.items() if changing >> bit & 1]
    found.sort(key=lambda atom: (predicates[atom[0]], [objects[one] for one in atom[1:]]))
    return {atom: compiler.bits[atom] for atom in found}


def _values(
    states: Mapping[int, int],
    rows: Sequence[Mapping[str, int]],
    facts: Mapping[Atom, int],
    goals: Sequence[int],
    actions: Sequence[GroundAction],
) -> dict[str, Json]:
    header: dict[str, Json] = {"INITIAL": "State_0"}
    if goals:
        header["ACTIVATING"] = f"State_{goals[0]}"
    if facts:
        header["NUM_FACTS"] = len(facts)
    bits = list(facts.values())
    notes: dict[str, Json] = {}
    further = frozenset(goals[1:])
    for state, number in states.items():
        heed()
        note: dict[str, Json] = {"facts": ["1" if state >> bit & 1 else "0" for bit in bits]}
        if number in further:
            note["note"] = "goal"
        notes[f"State_{number}"] = note
    used = {name for row in rows for name in row}
    costs = {
        one.name: {"cost": int(one.cost) if one.cost == int(one.cost) else one.cost}
        for one in actions
        if one.cost is not None and one.name in used
    }
    annotations: dict[str, Json] = {
        "_facts": {str(at): {"name": " ".join(atom)} for at, atom in enumerate(facts)},
        "_states": notes,
    }
    if costs:
        annotations["_operations"] = costs
    table = {
        f"State_{number}": {name: f"State_{target}" for name, target in row.items()}
        for number, row in enumerate(rows)
    }
    return {BRANCH: {"HEADER": header, **annotations, **table}}
