"""Comparing 59,049 states: equal files, renamed states, and a star whose centre was renamed.

Work that grows with the square of the states would take hours here. The time to read one file is
given for comparison.
"""

from __future__ import annotations

import json
import random
from collections.abc import Iterator
from typing import Any

from benches.row import Row, median_ms
from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rules import hanoi_values
from smsl_studio.smsl.json_form import parse_json

Json = Any
STATES = 3**10


def rows() -> Iterator[Row]:
    """Measure the rows of this bench."""
    values = hanoi_values(10)
    text = json.dumps(values)
    before = _read(text)
    reading = ("reading one of them", median_ms(lambda: _read(text), runs=3))
    for words, other in (
        ("the same again", _read(text)),
        ("every state renamed", _read(text.replace("State_", "Step"))),
        ("every state renamed at random, in another order", _shuffled(values)),
    ):
        took = median_ms(lambda other=other: compare(before, other), runs=3)  # type: ignore[misc]
        yield Row(f"compare 59,049 states: {words}", took, others=(reading,))
    star = json.dumps({"SB1": _star()})
    one, other = _read(star), _read(star.replace('"Hub"', '"Middle"'))
    took = median_ms(lambda: compare(one, other), runs=3)
    yield Row("compare a star of 59,048: its middle renamed", took)


def _read(text: str) -> Blueprint:
    return read_blueprint(parse_json(text, "f.json"))


def _shuffled(values: dict[str, Json]) -> Blueprint:
    chance = random.Random(1)
    states = {k: v for k, v in values["SB1"].items() if k != "HEADER"}
    numbers = list(range(len(states)))
    chance.shuffle(numbers)
    names = {name: f"n{number}" for name, number in zip(states, numbers, strict=True)}
    first, last = next(iter(states)), next(reversed(states))
    order = list(states)
    chance.shuffle(order)
    table = {names[n]: {op: names[to] for op, to in states[n].items()} for n in order}
    header = {"INITIAL": names[first], "ACTIVATING": names[last]}
    return _read(json.dumps({"SB1": {"HEADER": header, **table}}))


def _star() -> dict[str, dict[str, str]]:
    count = STATES - 1
    rays = {f"s{i}": {"abort": "Hub", "next": f"s{(i + 1) % count}"} for i in range(count)}
    return {"Hub": {}, **rays}
