"""Random pairs of blueprints, and flat ones, judged by plain steps and a plain bisimulation."""

from __future__ import annotations

import json
from copy import deepcopy
from random import Random
from typing import Any

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.front.shapes import diff_behaviour, flatten
from smsl_studio.inspection.equivalence.refinement import Refinement
from smsl_studio.smsl.json_form import parse_json
from tests.dispatch.generated import blueprint_values
from tests.inspection.equivalence.plain import System, after, bisimilar, naive_system, told_apart

Plain = dict[str, Any]


def blueprint(values: Plain) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


def changed(plain: Plain, chance: Random) -> Plain:
    """A blueprint with one operation deleted or retargeted, or as it was with other costs."""
    found = deepcopy(plain)
    sb = chance.choice(list(found))
    state = chance.choice([name for name in found[sb] if name.startswith("S")])
    if not found[sb][state]:
        return found
    name = chance.choice(list(found[sb][state]))
    kind = chance.randrange(3)
    if kind == 0:
        del found[sb][state][name]
    elif kind == 1:
        states = [one for one in found[sb] if one.startswith("S")]
        found[sb][state][name] = chance.choice(states)
    else:
        for note in found[sb]["_operations"].values():
            note["cost"] = 7
    return found


def rearranged(plain: Plain, chance: Random) -> Plain:
    """The same blueprint with its states and operations in another order."""
    found = {}
    for sb, inside in plain.items():
        states = [name for name in inside if name.startswith("S")]
        chance.shuffle(states)
        rows = {}
        for state in states:
            row = list(inside[state].items())
            chance.shuffle(row)
            rows[state] = dict(row)
        rest = {name: value for name, value in inside.items() if name not in rows}
        found[sb] = {**rest, **rows}
    return found


def judged_flat(number: int) -> tuple[str, str]:
    """How making a random hierarchy flat ended, and what is wrong."""
    plain = blueprint_values(number)
    origin = blueprint(plain)
    try:
        start = start_configuration(Hierarchy(origin), {})
    except RunRefused:
        return "no start", ""
    flat = flatten(origin)
    (branch,) = flat
    numbers = {name: at for at, name in enumerate(branch.table)}
    states = sorted(branch.table, key=lambda name: name != branch.initial)
    order = {name: at for at, name in enumerate(states)}
    keys = sorted(range(branch.num_facts), key=lambda digit: branch.fact_name(digit))
    rows = [
        [(label, order[target]) for label, target in branch.table[name].items()] for name in states
    ]
    several = len(plain) > 1
    wanted = naive_system(plain, start)
    facts = [
        tuple(
            value
            for _, value in sorted(
                (f"{sb}.{digit}" if several else str(digit), value)
                for sb, values in node
                for digit, value in enumerate(values)
            )
        )
        for node in wanted[0]
    ]
    seen = [tuple(branch.facts(name)[digit] for digit in keys) for name in states]
    assert len(numbers) == len(states)
    if not bisimilar((facts, wanted[1]), (seen, rows)):
        return "flat", "it behaves otherwise"
    said = diff_behaviour(origin, flat).equal
    return "flat", "" if said else "diff says that it behaves otherwise"


def judged_pair(number: int) -> tuple[str, str]:
    """How two blueprints compare, and what is wrong with the answer."""
    chance = Random(number)
    plain = blueprint_values(number)
    if chance.random() < 0.25:
        return _labelled_twice(chance)
    other = (rearranged if chance.random() < 0.2 else changed)(plain, chance)
    sides = blueprint(plain), blueprint(other)
    try:
        starts = [start_configuration(Hierarchy(side), {}) for side in sides]
    except RunRefused:
        return "no start", ""
    systems = naive_system(plain, starts[0]), naive_system(other, starts[1])
    found = diff_behaviour(*sides)
    return _judged(found.equal, found.path, systems, plain=True)


def _labelled_twice(chance: Random) -> tuple[str, str]:
    """Two systems in which a label leads to several states, as no label of a blueprint does."""
    sizes = chance.randint(2, 5), chance.randint(2, 5)
    systems = tuple(
        (
            [chance.choice("ab") for _ in range(size)],
            [
                sorted({(chance.choice("xy"), chance.randrange(size)) for _ in range(3)})
                for _ in range(size)
            ],
        )
        for size in sizes
    )
    one, other = systems
    moved = [[(label, at + sizes[0]) for label, at in row] for row in other[1]]
    found = Refinement([*one[0], *other[0]], [*one[1], *moved])
    equal = found.alike(0, sizes[0])
    path = () if equal else found.run(0, sizes[0])
    return _judged(equal, path, (one, other), plain=False)


def _judged(
    equal: bool | None, path: tuple[str, ...], systems: tuple[System, System], plain: bool
) -> tuple[str, str]:
    alike = bisimilar(*systems)
    end = "equal" if alike else "different"
    if equal is not alike:
        return end, f"the answer is {equal}"
    if not alike and plain and not told_apart(*systems, path):
        return end, f"the run {path} does not tell them apart"
    if not alike and not plain and not (after(systems[0], path[:-1]) or not path):
        return end, f"the run {path} cannot be carried out"
    return end, ""
