"""From rules to a State Branch: every state that can be reached from the start, breadth first."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from itertools import product
from math import prod
from typing import Any

from smsl_studio.errors import UsageError
from smsl_studio.generate.rule_conditions import Values
from smsl_studio.generate.rule_file import RuleSet
from smsl_studio.stop import heed

Json = Any
MOST_STATES = 1_000_000
"""The largest number of states that rules may reach."""


@dataclass(frozen=True, slots=True)
class RuledBranch:
    """A branch made of rules, as plain values. ``goal_reached`` says whether the goal is one of its
    states; without a goal it is true. ``whole`` is false if the search has stopped at its limit.
    ``facts`` are the names of the facts."""

    values: dict[str, Json]
    states: int
    operations: int
    goal_reached: bool
    whole: bool = True
    facts: tuple[str, ...] = ()


def ruled_branch(rules: RuleSet, limit: int = MOST_STATES, part: bool = False) -> RuledBranch:
    """Return the branch of some rules. Operations stand in the order of the rules.

    UsageError if the start is one of the states that are left out, or if there are more than
    ``limit`` states. With ``part`` the first ``limit`` states are returned then, and the operations
    between them.
    """
    never = [holds for _, holds in rules.never]
    if any(one(rules.start) for one in never):
        raise UsageError("the start is a state that 'never' leaves out")
    start = _name(rules.start)
    table: dict[str, dict[str, str]] = {start: {}}
    queue = deque([rules.start])
    edges, whole = 0, True
    while queue:
        heed()
        values = queue.popleft()
        own = table[_name(values)]
        for operation in rules.operations:
            case = next((case for case in operation.cases if case.when(values)), None)
            if case is None:
                continue
            after = case.after(values)
            if any(one(after) for one in never):
                continue
            target = _name(after)
            if target not in table:
                if len(table) >= limit and part:
                    whole = False
                    continue
                if len(table) >= limit:
                    raise UsageError(
                        f"the rules reach more than {limit:,} states",
                        advice="Leave states out with 'never', or take fewer facts.",
                    )
                table[target] = {}
                queue.append(after)
            own[operation.name] = target
            edges += 1
    goal = None if rules.goal is None else _name(rules.goal)
    header: dict[str, Json] = {"INITIAL": start}
    if goal in table:
        header["ACTIVATING"] = goal
    header |= {"NUM_FACTS": len(rules.facts), "NUM_STATES": len(table)}
    values_of = {rules.branch: {"HEADER": header, **table}}
    reached = goal is None or goal in table
    return RuledBranch(values_of, len(table), edges, reached, whole, tuple(rules.facts))


def left_out(rules: RuleSet, most: int) -> tuple[int, ...] | None:
    """Return how many combinations of values each condition of ``never`` leaves out. None if there
    are more than ``most`` combinations."""
    alphabets = list(rules.facts.values())
    if prod(map(len, alphabets)) > most:
        return None
    counts = [0] * len(rules.never)
    for values in product(*alphabets):
        heed()
        for number, (_, holds) in enumerate(rules.never):
            counts[number] += holds(values)
    return tuple(counts)


def _name(values: Values) -> str:
    return "State_" + "".join(values)
