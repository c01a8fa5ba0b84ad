"""Any run: a random blueprint of one or two SBs, under a random script with random faults."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from random import Random
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.front.script.lines import script_of
from smsl_studio.front.script.script import Script
from smsl_studio.front.script.words import WORDS
from smsl_studio.smsl.forms import form_named

Json = Any
LAST = 20.0
"""Simulated seconds after which some of the runs are stopped, wherever they are."""


@dataclass(frozen=True)
class AnyRun:
    """What is run: equal numbers give equal runs."""

    blueprint: Blueprint
    script: Script
    seed: int
    on_mismatch: str
    raw: bytes
    """The script as a file has it."""

    @property
    def asked(self) -> dict[str, Any]:
        return {"seed": self.seed, "on_mismatch": self.on_mismatch}


def any_run(number: int) -> AnyRun:
    """The run of this number."""
    random = Random(number)
    values = _blueprint(random)
    text = json.dumps(values, indent=1)
    blueprint = read_blueprint(form_named("json").parse(text, f"any-{number}.json"))
    end = [{"at": LAST, "do": "stop"}] if random.random() < 0.3 else []
    lines = [*_script(random, blueprint), *end]
    raw = "\n".join(map(json.dumps, lines)).encode()
    mismatch = random.choice(["hold", "adopt"])
    return AnyRun(blueprint, script_of(raw, "script", blueprint), number, mismatch, raw)


def _blueprint(random: Random) -> Json:
    digits = random.choice([2, 3])
    states = [f"State_{number:0{digits}b}" for number in range(2**digits)]
    operations = {
        "actor": random.choice(["robot", "robot", "shared", "human"]),
        "timeout": random.choice([0.3, 2.0]),
        "cost": random.choice([1.0, 2.5]),
    }
    base: Json = {
        "HEADER": {"INITIAL": states[0], "ACTIVATING": states[-1], "NUM_FACTS": digits},
        "_operations": {f"Op_{random.randrange(digits)}_up": operations},
    }
    with_sub = random.random() < 0.6
    for state in states:
        base[state] = dict(_edges(random, state, digits, with_sub))
    if not with_sub:
        return {"BASE": base}
    base["HEADER"]["SUB_SBS"] = {"SUB": 0}
    sub = {"State_0": {"Op_turn": "State_1"}, "State_1": {"Op_back": "State_0"}}
    return {"BASE": base, "SUB": sub}


def _edges(random: Random, state: str, digits: int, with_sub: bool) -> Iterator[tuple[str, str]]:
    """One fact changes at a time, most of the time; the way up is nearly always drawn."""
    facts = state.removeprefix("State_")
    for digit, value in enumerate(facts):
        up = value == "0"
        if random.random() < (0.9 if up else 0.5):
            other = "1" if up else "0"
            target = f"State_{facts[:digit]}{other}{facts[digit + 1 :]}"
            yield f"Op_{digit}_{'up' if up else 'down'}", target
    if random.random() < 0.2:
        yield "Op_stay", state


def _script(random: Random, blueprint: Blueprint) -> Iterator[Json]:
    edges = [str(edge.address) for branch in blueprint for edge in branch.edges()]
    states = [f"{branch.name}/{state}" for branch in blueprint for state in branch.table]
    people = ("Ada", "Bo", "script")
    for kind, option in (("operation", "done"), ("confirm", "yes")):
        yield {"do": "answer", "kind": kind, "option": option, "times": "every", "after": 0.3}
    for _ in range(random.randrange(7)):
        edge, state = random.choice(edges), random.choice(states)
        act = random.choice(_acts(random, edge, state))
        yield {**_moment(random, edge, state), **act, "by": random.choice(people)}


def _moment(random: Random, edge: str, state: str) -> Json:
    after = round(random.random() * 0.2, 2)
    return random.choice(
        [
            {"at": round(random.random() * 2, 2)},
            {"when": state, "after": after},
            {"when": state, "times": random.choice([1, 1, 2])},
            {"during": edge},
            {"during": edge, "after": after},
        ]
    )


def _acts(random: Random, edge: str, state: str) -> list[Json]:
    fact = f"BASE/{random.choice([1, 1, 0])}"
    kinds: tuple[Json, ...] = (
        {"kind": "stuck"},
        {"kind": "noise", "rate": 0.5},
        {"kind": "dropout", "rate": 0.7},
        {"kind": "delay", "seconds": 0.2},
        {"kind": "drift", "every": 0.2},
        {"kind": "none"},
    )
    plain = (word for word, one in WORDS.items() if not one.needs and word != "end")
    return [
        *({"do": word} for word in plain),
        {"do": "ask", "address": edge},
        {"do": "prune", "address": edge, "reason": "by chance"},
        {"do": "restore", "address": edge},
        {"do": "set_cost", "address": edge, "cost": round(random.random() * 9, 1)},
        *({"do": "disturb", "target": fact, **kind} for kind in random.sample(kinds, 2)),
        *({"do": "inject", "fault": fault} for fault in ("fail", "raise", "hang", "nothing")),
        {"do": "inject", "fault": "elsewhere", "state": state},
        {"do": "inject", "fault": "set", "fact": fact, "value": random.choice("01")},
    ]
