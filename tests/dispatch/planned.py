"""Random questions to the planner, and its answers with and without its quick paths.

Without them it walks over joint configurations one by one, as it did before. So the walk is the
oracle: the legs must be equal, with all their steps.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any
from unittest.mock import patch

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.joint import JointStep
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.search import PlanSearch
from smsl_studio.blueprint.terms import Terms
from smsl_studio.dispatch.route import decomposition, planner
from smsl_studio.dispatch.route.decomposition import Decompositions
from smsl_studio.dispatch.route.planner import Leg, Planner
from smsl_studio.errors import PlanningError, RunRefused
from tests.dispatch.generated import blueprint_values
from tests.dispatch.runs import blueprint

TREES: tuple[dict[str, dict[str, int]], ...] = (
    {"A": {"B": 0}, "B": {}},
    {"A": {"B": 1}, "B": {}},
    {"A": {"B": 0, "C": 1}, "B": {}, "C": {}},
    {"A": {"B": 0}, "B": {"C": 1}, "C": {}},
    {"A": {"B": 0}, "B": {"C": 0, "D": 1}, "C": {}, "D": {}},
    {"A": {"B": 0, "C": 2}, "B": {"D": 1}, "C": {}, "D": {}},
    {"A": {"B": 1}, "B": {"C": 0}, "C": {"D": 0}, "D": {}},
    {"A": {"B": 0, "C": 1, "D": 2}, "B": {}, "C": {}, "D": {}},
    {"A": {"B": 0, "C": 1}, "B": {"D": 0, "E": 1}, "C": {}, "D": {}, "E": {}},
    {"R": {}, "A": {"B": 0}, "B": {"C": 0}, "C": {}},
)
"""Trees in which each sub-SB has one base."""


@dataclass(frozen=True)
class Question:
    """One question to the planner."""

    blueprint: Blueprint
    terms: Terms
    start: Mapping[str, str]
    goals: tuple[Address, ...]


def tree_values(seed: int) -> dict[str, Any]:
    """A blueprint of one tree whose ACTIVATING states have all sub-SBs on mostly.

    A tour through the states changes one digit at a time, so that sub-SBs must rise and fall. Other
    operations stand beside it, and some are the same by facts: a letter is no fact.
    """
    dice = random.Random(seed)
    subs = TREES[seed % len(TREES)]
    requires = dice.random() < 0.25
    values: dict[str, Any] = {}
    for sb, own in subs.items():
        count = dice.randint(max([1, *(digit + 1 for digit in own.values())]), 3)
        letters = dice.choice(("a", "a", "ab"))
        states = [f"{one}_{''.join(d)}" for d in product("01", repeat=count) for one in letters]
        ons = [s for s in states if all(s[2 + digit] == "1" for digit in own.values())]
        ons = ons if dice.random() < 0.8 else states
        initial = states[0] if dice.random() < 0.8 else dice.choice(states)
        activating = dice.choice([s for s in ons if s != initial] or [ons[-1]])
        table: dict[str, dict[str, str]] = {state: {} for state in states}
        names = dice.choice((5, 8, 16))
        likely = dice.choice((0.02, 0.1, 0.3, 0.8))
        for here, there in product(states, states):
            if dice.random() < (likely, likely, likely / 3, likely / 5)[_apart(here, there)]:
                table[here][f"o{dice.randrange(names):02}"] = there
        here = initial
        left = [state for state in states if state != here]
        undo = dice.random()
        while left:
            near = [state for state in left if _apart(here, state) < 2] or left
            there = dice.choice(near)
            table[here][f"o{dice.randrange(names):02}"] = there
            if dice.random() < undo:
                table[there][f"o{dice.randrange(names):02}"] = here
            left.remove(there)
            here = there
        notes: dict[str, Any] = {}
        for at in range(names):
            note: dict[str, Any] = {}
            if dice.random() < 0.4:
                note["cost"] = dice.choice((0, 0.1, 0.5, 1, 2, 3, 7))
            if requires and dice.random() < 0.2:
                other = dice.choice(list(subs))
                note["requires"] = {f"{other}/0": dice.choice("01")}
            if note:
                notes[f"o{at:02}"] = note
        header = {
            "INITIAL": initial,
            "ACTIVATING": activating,
            "NUM_FACTS": count,
            "SUB_SBS": own,
        }
        values[sb] = {"HEADER": header, "_operations": notes, **table}
    return values


def _apart(here: str, there: str) -> int:
    """How many digits differ."""
    return sum(a != b for a, b in zip(here[2:], there[2:], strict=True))


def questions(seed: int, count: int) -> Iterator[Question]:
    """Random questions about one random blueprint: edges avoided and pruned, costs that changed,
    functions bound, starts anywhere, goals on roots mostly.
    """
    dice = random.Random(seed)
    values = tree_values(seed) if seed % 4 else blueprint_values(seed // 4)
    made = blueprint(values)
    hierarchy = Hierarchy(made)
    edges = [edge.address for one in made for edge in one.edges()]
    for _ in range(count):
        shut = dice.sample(edges, min(dice.choice((0, 0, 1, 3)), len(edges)))
        exact = dice.sample(edges, dice.choice((0, 0, len(edges) // 6)))
        dear = dice.sample(edges, dice.choice((0, len(edges) // 3)))
        unbound = set(dice.sample(edges, dice.choice((0, 0, 1))))
        terms = Terms(
            shut=dict.fromkeys(shut, "avoided"),
            bound=[edge for edge in edges if edge not in unbound] if unbound else None,
            exact=frozenset(exact),
            costs={edge: dice.choice((0, 0.25, 1.7, 4)) for edge in dear},
        )
        given = {root: dice.choice(list(made[root].table)) for root in hierarchy.roots}
        try:
            start = start_configuration(hierarchy, given if dice.random() < 0.7 else {})
        except RunRefused:
            continue
        here = wandered(Planner(hierarchy, terms), start, dice)
        number = min(len(made.branches), dice.choice((1, 1, 1, 1, 2)))
        names = dice.sample(list(made.branches), number)
        if dice.random() < 0.7:
            names = [dice.choice(hierarchy.roots)]
        goals = []
        for name in hierarchy.order:
            if name in names:
                own = made[name]
                fixed = own.activating if dice.random() < 0.7 else dice.choice(list(own.table))
                goals.append(Address(name, fixed))
        if any(here[goal.branch] != goal.state for goal in goals):
            yield Question(made, terms, here, tuple(goals))


def wandered(own: Planner, start: Mapping[str, str], dice: random.Random) -> dict[str, str]:
    """A configuration that some random operations lead to, so that sub-SBs stand anywhere."""
    here, stepper = dict(start), own.stepper
    for _ in range(dice.choice((0, 0, 3, 12))):
        name = dice.choice(list(here))
        out = stepper.edges.out(name, here[name])
        if out:
            step = stepper.step(here, dice.choice(out))
            if isinstance(step, JointStep):
                here.update(step.after)
    return here


def answer(question: Question) -> tuple[Leg, ...] | str | None:
    """The legs, or the sentence of a refusal."""
    try:
        return Planner(Hierarchy(question.blueprint), question.terms).legs(
            question.start, question.goals
        )
    except PlanningError as error:
        return error.sentence


def walked(question: Question) -> tuple[Leg, ...] | str | None:
    """The same by the walk over joint configurations alone."""
    with patch.multiple(Decompositions, ranks=lambda *_: None, bound=lambda *_: None):
        return answer(question)


def unwalked(question: Question) -> bool:
    """Whether the question is answered without a walk over joint configurations."""
    made: list[object] = []

    def noted(*about: Any) -> PlanSearch[Any]:
        """Make the walk and note it."""
        made.append(about)
        return PlanSearch(*about)

    with patch.object(planner, "PlanSearch", noted):
        answer(question)
    return not made


def decomposed(question: Question) -> bool:
    """Whether a decomposition is valid for the one leg of the question."""
    seen: list[bool] = []
    valid = decomposition.is_decomposed

    def noted(*about: Any) -> bool:
        """Note what the planner is told."""
        seen.append(valid(*about))
        return seen[-1]

    with patch.object(decomposition, "is_decomposed", noted):
        answer(question)
    return seen == [True] and len(question.goals) == 1


def lines(legs: Sequence[Leg] | str | None) -> list[str]:
    """The operations of all legs, for a person who compares two answers."""
    if legs is None or isinstance(legs, str):
        return [str(legs)]
    return [f"{leg.cost} " + " ".join(map(str, leg.operations)) for leg in legs]
