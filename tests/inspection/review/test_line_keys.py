"""The key of a line stays while the line means the same, and changes with its meaning."""

from __future__ import annotations

import copy
import json
from collections import Counter
from random import Random
from typing import Any

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.readings import reading
from smsl_studio.inspection.reading.line_keys import keyed
from smsl_studio.inspection.reading.sections import BlueprintReading, ReadingLine, ReadingSection
from smsl_studio.smsl.json_form import parse_json
from tests.inspection.reading.judged_reading import values_of
from tests.inspection.review.plain_meaning import plain_meanings

SOME = 25


def told_of(values: dict[str, Any]) -> BlueprintReading:
    return reading(read_blueprint(parse_json(json.dumps(values), "any.json")))


def changed(values: dict[str, Any], chance: Random) -> dict[str, Any]:
    """The same blueprint with one random change of one operation."""
    other = copy.deepcopy(values)
    names = [name for name in other if not name.startswith("_")]
    own = other[chance.choice(names)]
    edges = [(state, op) for state in own if state[0] == "S" for op in own[state]]
    if not edges:
        return other
    state, op = chance.choice(edges)
    note = own["_operations"].setdefault(op, {})
    match chance.randrange(5):
        case 0:
            del own[state][op]
        case 1:
            own[state][op] = chance.choice([one for one in own if one[0] == "S"])
        case 2:
            note["title"] = f"Another {op}"
        case 3:
            note["cost"] = chance.choice([1, 2, 3])
        case _:
            own["_operations"][f"{state}/{op}"] = {"risk": "high"}
    return other


def test_answers_stay_exactly_with_the_lines_that_mean_the_same() -> None:
    met: Counter[bool] = Counter()
    for number in range(SOME):
        values = values_of(number)
        other = changed(values, Random(number))
        before, after = (plain_meanings(told_of(one), one) for one in (values, other))
        for key, meaning in before.items():
            if "-" in key:
                continue  # one of several lines that mean the same
            same = meaning in after.values()
            assert (key in after) == same, (number, meaning)
            if same:
                assert after[key] == meaning
            met[same] += 1
    assert met[True] > SOME
    assert met[False] > SOME


def line_of(number_of_steps: int, first: int) -> dict[str, Any]:
    """Steps one after the other; the states have no names of facts, the steps have titles. The
    last step can be replaced by another one.
    """
    states = [f"P{at}" for at in range(first, number_of_steps + 1)]
    table: dict[str, Any] = {
        f"P{at}": {f"go{at}": f"P{at + 1}"} for at in range(first, number_of_steps)
    }
    table[f"P{number_of_steps}"] = {}
    table[f"P{number_of_steps - 1}"]["otherwise"] = f"P{number_of_steps}"
    titles = {f"go{at}": {"title": f"Step of {at}"} for at in range(first, number_of_steps)}
    titles["otherwise"] = {"title": "Do it otherwise"}
    header = {"INITIAL": states[0], "ACTIVATING": states[-1], "NUM_FACTS": 0, "SUB_SBS": {}}
    return {"A": {"HEADER": header, "_operations": titles, **table}}


def test_a_step_with_another_number_keeps_its_key() -> None:
    three, four = told_of(line_of(4, 1)), told_of(line_of(4, 0))
    steps = [next(one for one in told.sections if one.key == "procedure") for told in (three, four)]
    short, long = ([(line.mark, line.heading, line.key) for line in one.lines] for one in steps)
    assert [one[0] for one in short] == ["1", "2", "3", "or"]
    assert [one[0] for one in long] == ["1", "2", "3", "4", "or"]
    assert short[-1][1].endswith("instead of step 3")
    assert long[-1][1].endswith("instead of step 4")
    assert [one[2] for one in short] == [one[2] for one in long[1:]]


def test_a_step_with_the_same_words_that_calls_another_function_has_another_key() -> None:
    values = line_of(4, 1)
    before = {line.key for _, line in told_of(values).lines()}
    values["A"]["_operations"]["go2"]["binding"] = {"function": "drill", "arguments": {"deep": 1}}
    told = told_of(values)
    new = [line for _, line in told.lines() if line.key not in before]
    assert [line.heading for line in new] == ["Step of 2"]


def test_no_two_lines_of_a_reading_have_one_key() -> None:
    blueprint = read_blueprint(parse_json(json.dumps(line_of(2, 1)), "any.json"))
    line = ReadingLine("The same words")
    (section,) = keyed(blueprint, [ReadingSection("wrong", "Wrong", (line, line, line))])
    first, *more = (one.key for one in section.lines)
    assert more == [f"{first}-2", f"{first}-3"]
