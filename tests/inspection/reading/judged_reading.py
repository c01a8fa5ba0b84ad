"""Judges the sentences about random blueprints by plain steps, which share no code with the
program.

Each kind of sentence that tells what can happen is read back from its words: steps, other ways,
other orders, situations in which something is permitted, and hazards.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import product
from random import Random
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.front.readings import reading
from smsl_studio.inspection.reading.sections import BlueprintReading, ReadingLine
from smsl_studio.smsl.json_form import parse_json
from tests.dispatch.generated import blueprint_values
from tests.dispatch.naive import Config
from tests.inspection.proof.brute import Brute

INSTEAD = re.compile(r", instead of steps? (\d+)(?: to (\d+))?$")
PERMITTED = re.compile(
    r"The blueprint permits it in (every|[\d,]+)(?: of ([\d,]+))? situations? of"
)
STEPS = re.compile(r"steps? (\d+)(?: to (\d+))?")
LOOKED = re.compile(r"All ([\d,]+) situations? that can be reached")


def values_of(number: int) -> dict[str, Any]:
    """A random blueprint with a title for each operation, and a hazard now and then."""
    chance = Random(number)
    plain = cube_values(chance) if number % 3 == 0 else blueprint_values(number)
    for sb, own in plain.items():
        names = dict.fromkeys(op for state, ops in own.items() if state[0] == "S" for op in ops)
        for name in names:
            own["_operations"].setdefault(name, {})["title"] = f"Do {name} of {sb}"
    hazards = []
    for at in range(chance.randrange(3)):
        facts = {}
        for sb in chance.sample(list(plain), min(2, len(plain))):
            digit = chance.randrange(plain[sb]["HEADER"]["NUM_FACTS"])
            facts[f"{sb}/{digit}"] = chance.choice("01")
        hazards.append({"name": f"h{at}", "facts": facts})
    return {"_hazards": hazards, **plain} if hazards else plain


def cube_values(chance: Random) -> dict[str, Any]:
    """An SB in which each fact has an operation of its own, so that steps may change places."""
    facts = chance.choice((2, 3))
    states = ["S" + "".join(bits) for bits in product("01", repeat=facts)]
    table: dict[str, dict[str, str]] = {state: {} for state in states}
    for state in states:
        for digit in range(facts):
            on = state[1 + digit] == "1"
            other = f"{state[: 1 + digit]}{'0' if on else '1'}{state[2 + digit :]}"
            if chance.random() < 0.85:
                table[state][f"o{digit}{'off' if on else 'on'}"] = other
    header = {"INITIAL": states[0], "ACTIVATING": states[-1], "NUM_FACTS": facts, "SUB_SBS": {}}
    return {"A": {"HEADER": header, "_operations": {}, **table}}


def judge(number: int) -> dict[str, int]:
    """Judge the reading of one random blueprint. Return how many sentences of each kind it had."""
    values = values_of(number)
    blueprint = read_blueprint(parse_json(json.dumps(values), "any.json"))
    told = reading(blueprint)
    sections = {section.key: section.lines for section in told.sections}
    try:
        start = start_configuration(Hierarchy(blueprint), {})
    except RunRefused:
        assert sections["start"][0].open_point
        return {"refused": 1}
    plain = {name: own for name, own in values.items() if name != "_hazards"}
    brute = Brute(plain, start)
    _judge_all_told(plain, told)
    route = list(_route(brute, sections["procedure"]))
    found = {
        "steps": _judge_end(brute, sections, route),
        "instead": _judge_instead(brute, sections["procedure"], route),
        "orders": _judge_orders(brute, sections["procedure"], route),
        "others": _judge_others(plain, sections.get("others", ())),
        "hazards": _judge_hazards(brute, values.get("_hazards", []), sections["hazards"]),
    }
    return {kind: many for kind, many in found.items() if many}


def _route(brute: Brute, lines: tuple[ReadingLine, ...]) -> Iterator[tuple[Address, Config]]:
    """Carry out the numbered steps; yield each with the configuration after it."""
    here = brute.start
    for line in lines:
        if line.mark.isdigit():
            here = _carried(brute, here, line.about[0])
            yield line.about[0], here


def _carried(brute: Brute, here: Config, edge: Address) -> Config:
    assert here[edge.branch] == edge.state, f"{edge} does not begin here"
    found = brute.naive.carry(here, edge.branch, edge.operation, {})
    assert found is not None, f"{edge} is not permitted here"
    return found[0]


def _judge_end(
    brute: Brute,
    sections: dict[str, tuple[ReadingLine, ...]],
    route: list[tuple[Address, Config]],
) -> int:
    if any(line.heading.startswith("There is no way") for line in sections["procedure"]):
        # A hazard may bar the way, and plain steps know none.
        if sections["hazards"][0].heading == "No hazard is written down":
            assert brute.reached(brute.goal) is None
        return 1
    end = route[-1][1] if route else brute.start
    assert brute.goal(end)
    said = [text for line in sections["start"] for text in line.text if "It takes" in text]
    many = len(route)
    assert said == [f"It takes {many} step{'' if many == 1 else 's'}."]
    return many


def _judge_instead(
    brute: Brute, lines: tuple[ReadingLine, ...], route: list[tuple[Address, Config]]
) -> int:
    before = [brute.start, *(after for _, after in route)]
    others = [line for line in lines if line.mark == "or"]
    for line in others:
        found = INSTEAD.search(line.heading)
        assert found is not None
        first, last = int(found[1]), int(found[2] or found[1])
        assert brute.key(_carried(brute, before[first - 1], line.about[0])) == brute.key(
            before[last]
        )
    return len(others)


def _judge_orders(
    brute: Brute, lines: tuple[ReadingLine, ...], route: list[tuple[Address, Config]]
) -> int:
    many = 0
    for line in lines:
        for text in line.text:
            if not text.startswith("It may also be done"):
                continue
            many += 1
            at = int(line.mark) - 1
            for first, last in STEPS.findall(text):
                for place in range(int(first) - 1, int(last or first)):
                    _judge_order(brute, route, at, place)
    return many


def _judge_order(brute: Brute, route: list[tuple[Address, Config]], at: int, place: int) -> None:
    order = [edge for edge, _ in route]
    order.insert(place, order.pop(at))
    here = brute.start
    for edge in order:
        moved = Address(edge.branch, here[edge.branch], edge.operation)
        here = _carried(brute, here, moved)
    assert brute.key(here) == brute.key(route[-1][1])


def _judge_all_told(plain: dict[str, Any], told: BlueprintReading) -> None:
    """No operation is left out of the reading."""
    about = {edge for _, line in told.lines() for one in (line, *line.inner) for edge in one.about}
    for sb, own in plain.items():
        for state in own:
            for op in own[state] if state[0] == "S" else ():
                assert Address(sb, state, op) in about, f"{sb}/{state}/{op} is not told"


def _judge_others(plain: dict[str, Any], lines: tuple[ReadingLine, ...]) -> int:
    for line in lines:
        edge = line.about[0]
        own = plain[edge.branch]
        states = [state for state in own if state[0] == "S"]
        where = [state for state in states if edge.operation in own[state]]
        (text,) = [one for one in line.text if one.startswith("The blueprint permits")]
        found = PERMITTED.search(text)
        assert found is not None
        if found[1] == "every":
            assert where == states
        else:
            assert (int(found[1]), int(found[2])) == (len(where), len(states))
    return len(lines)


def _judge_hazards(
    brute: Brute, hazards: list[dict[str, Any]], lines: tuple[ReadingLine, ...]
) -> int:
    shown = {line.heading: line for line in lines}
    for hazard in hazards:

        def met(one: Config, facts: dict[str, str] = hazard["facts"]) -> bool:
            pairs = ((text.split("/"), value) for text, value in facts.items())
            return all(one[sb][1 + int(digit)] == value for (sb, digit), value in pairs)

        line = shown[hazard["name"]]
        words = " ".join(line.text)
        if "Controlled." in line.text:
            assert not line.open_point
            assert brute.reached(met) is None
        else:
            assert line.open_point
        looked = LOOKED.search(words)
        if looked is not None:
            assert int(looked[1].replace(",", "")) == len(brute.configs)
    return len(hazards)
