"""Product steps against the stepper, configuration by configuration."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from itertools import product
from random import Random
from typing import Any

import pytest

from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.graph.joint.joint_steps import JointSteps
from smsl_studio.graph.joint.products import JointMoves
from smsl_studio.graph.joint.products_of import ProductSteps
from smsl_studio.graph.joint.reach import JointReach
from smsl_studio.inspection.proof.exploration import Exploration
from smsl_studio.inspection.proof.space import Space
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import SHAPES, blueprint_values

Code = tuple[int, ...]

MORE: tuple[dict[str, dict[str, int]], ...] = (
    {"A": {"B": 0, "C": 1, "D": 2}, "B": {}, "C": {}, "D": {}},
    {"A": {"B": 0}, "B": {"C": 0, "D": 1}, "C": {}, "D": {}},
    {"A": {"B": 0}, "B": {"C": 0}, "C": {"D": 0}, "D": {}},
    {"A": {"B": 0, "C": 1}, "B": {"D": 0}, "C": {"E": 0}, "D": {}, "E": {}},
    *SHAPES,
)


def tamed(plain: dict[str, Any], chance: Random) -> dict[str, Any]:
    """The same blueprint with less in the way: many sub-SBs of it are tame."""
    for branch in plain.values():
        if chance.random() < 0.8:
            for note in branch["_operations"].values():
                note.pop("requires", None)
        if chance.random() < 0.7:
            for note in branch["_operations"].values():
                note.pop("subs", None)
        states = [name for name in branch if name.startswith("S")]
        if chance.random() < 0.7:
            full = "S" + "1" * (len(states[0]) - 1)
            if full in states and branch["HEADER"]["INITIAL"] != full:
                branch["HEADER"]["ACTIVATING"] = full
        if chance.random() < 0.5:
            for one, other in zip(states, [*states[1:], states[0]], strict=True):
                branch[one]["o9"] = other
    return plain


def drawn(seed: int) -> dict[str, Any]:
    chance = Random(seed)
    shape = chance.choice(MORE)
    values = blueprint_values(seed, SHAPES.index(shape)) if shape in SHAPES else None
    if values is None:
        values = generated(seed, shape)
    return tamed(values, chance)


def generated(seed: int, shape: dict[str, dict[str, int]]) -> dict[str, Any]:
    """A random blueprint of another shape, with few facts, from flat ones."""
    chance = Random(seed)
    values = {}
    for name, subs in shape.items():
        flat = next(iter(blueprint_values(chance.randrange(10**6), 0).values()))
        count = flat["HEADER"]["NUM_FACTS"]
        while count < len(subs) or (count > 2 and len(subs) < 3):
            flat = next(iter(blueprint_values(chance.randrange(10**6), 0).values()))
            count = flat["HEADER"]["NUM_FACTS"]
        flat["HEADER"]["SUB_SBS"] = subs
        for note in flat["_operations"].values():
            note.pop("requires", None)
            if subs and chance.random() < 0.1:
                note["subs"] = "load"
        values[name] = flat
    return values


def applied(products: Sequence[JointMoves], here: Code) -> Iterator[Code]:
    """All configurations to which products lead."""
    for moves in products:
        choices = [
            [b for a, b in moves[at] if a == state] if at in moves else [state]
            for at, state in enumerate(here)
        ]
        yield from product(*choices)


def agree(plain: dict[str, Any], limit: int = 3_000) -> bool:
    """Compare all reachable configurations; False if there is no start or there are too many."""
    blueprint = read_blueprint(parse_json(json.dumps(plain), "file.json"))
    try:
        space = Space(blueprint)
    except RunRefused:
        return False
    found = Exploration(space, limit)
    if found.bound:
        return False
    steps = ProductSteps(Hierarchy(blueprint))
    numbers, products = steps.numbers, steps.products()
    more = steps.exactly_passed()
    for key in found.keys:
        here = numbers.coded(dict(zip(space.order, key, strict=True)))
        wanted, passed = set(), set()
        for step in space.steps(key):
            wanted.add(numbers.coded(dict(zip(space.order, step.to, strict=True))))
            for one in step.passed:
                passed.add(numbers.coded(dict(zip(space.order, one.key, strict=True))))
        assert set(applied(products.steps, here)) | {here} == wanted | {here}
        exact = set(applied(products.passed, here))
        assert exact <= passed
        assert passed <= exact | set(applied(products.rough, here))
        assert passed == exact | set(applied(more, here))
    assert JointReach(JointSteps(Hierarchy(blueprint))).count == len(found)
    return True


@pytest.mark.parametrize("seed", range(share_of(60)))
def test_products_are_the_steps_of_the_stepper(seed: int) -> None:
    agree(drawn(seed))
