"""Random states to cut out: of random hierarchies, of their flat forms, and planted procedures.

Each fact has a name of its own, so that it is known wherever it goes.
"""

from __future__ import annotations

import json
from itertools import pairwise
from random import Random
from typing import Any, NamedTuple

from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.front.shapes import flatten
from smsl_studio.smsl.json_form import parse_json
from tests.dispatch.generated import blueprint_values

Json = Any


class CutCase(NamedTuple):
    """A blueprint, and states of one of its SBs that are chosen.

    ``sound`` says that they surely can be cut out.
    """

    origin: Blueprint
    branch: str
    states: tuple[str, ...]
    sound: bool = False


def cut_case(number: int) -> CutCase | None:
    """The case of a number; None where the blueprint has no start."""
    chance = Random(number)
    return planted(chance) if number % 2 else picked(number, chance)


def picked(number: int, chance: Random) -> CutCase | None:
    """Some states beside each other in a random hierarchy, or in its flat form."""
    values = blueprint_values(number)
    for name, inside in values.items():
        facts = range(inside["HEADER"]["NUM_FACTS"])
        inside["_facts"] = {str(digit): {"name": f"{name}{digit}"} for digit in facts}
    origin = blueprint(values)
    try:
        start_configuration(Hierarchy(origin), {})
    except RunRefused:
        return None
    if chance.random() < 0.5:
        origin = flatten(origin)
    branch = chance.choice(list(origin))
    states = {chance.choice(list(branch.table))}
    for _ in range(chance.randint(0, 3)):
        near = {t for s in states for t in branch.table[s].values() if t not in states}
        if near:
            states.add(chance.choice(sorted(near)))
    return CutCase(origin, branch.name, tuple(sorted(states)))


def planted(chance: Random) -> CutCase:
    """A procedure of some steps between two states of an SB, now and then spoilt by an edge more.

    The first two digits are those of the rest, the others those of the procedure.
    """
    own = chance.randint(1, 2)
    steps = [f"State10{at:0{own}b}" for at in range(chance.randint(1, 2**own))]
    start = f"State00{'0' * own}"
    end = "1" * own
    done = f"State{'11' if steps[-1].endswith(end) else chance.choice(['10', '11'])}{end}"
    used = f"State01{end}"
    table: dict[str, dict[str, str]] = {name: {} for name in (start, *steps, done, used)}
    table[start]["plan"] = steps[0]
    for one, following in pairwise(steps):
        table[one]["next"] = following
        table[one][f"s{chance.randrange(3)}"] = chance.choice(steps)
    table[steps[-1]]["finish"] = done
    table[done]["use"] = used
    more = [
        (chance.choice(steps), "hurry", done),
        (steps[0], "drop", start),
        (done, "again", steps[0]),
        (start, "use", used),
        (used, "undo", start),
    ]
    for source, name, target in more:
        if chance.random() < 0.5:
            table[source][name] = target
    spoilt = chance.random() < 0.25
    if spoilt:
        source, target = (chance.choice(list(table)) for _ in range(2))
        table[source][chance.choice(["spoil", "next", "use"])] = target
    values = {
        "P": {
            "HEADER": {"INITIAL": start, "ACTIVATING": used},
            "_facts": {str(digit): {"name": f"P{digit}"} for digit in range(2 + own)},
            "_operations": {"next": {"cost": 2, "title": "Go on"}, "use": {"touches": [1]}},
            **table,
        }
    }
    return CutCase(blueprint(values), "P", tuple(steps), not spoilt)


def blueprint(values: dict[str, Json]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))
