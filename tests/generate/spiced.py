"""Random blueprints with everything that a run heeds, and random scripts for them."""

from __future__ import annotations

import json
from random import Random
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.forms import form_named
from tests.dispatch.generated import blueprint_values
from tests.front.any_run import _acts, _moment

Json = Any


def spiced(number: int) -> Blueprint:
    """One to four SBs with critical facts, failures, people, stop modes, costs and hazards."""
    random = Random(number * 7 + 1)
    values = blueprint_values(number)
    for own in values.values():
        facts = _facts(random, own)
        if facts:
            own["_facts"] = facts
        for name in [f"o{n}" for n in range(6)]:
            note = {**own["_operations"].get(name, {}), **_note(random)}
            if note:
                own["_operations"][name] = note
        if random.random() < 0.2:
            state = random.choice([key for key in own if key.startswith("S")])
            edge = f"{state}/{random.choice(list(own[state]))}"
            own["_operations"][edge] = {"cost": random.randint(0, 4)}
    if random.random() < 0.25:
        values["_hazards"] = [{"name": "h", "facts": dict(_hazard(random, values))}]
    text = json.dumps(values, indent=1)
    return read_blueprint(form_named("json").parse(text, f"spiced-{number}.json"))


def spiced_script(number: int, blueprint: Blueprint) -> bytes:
    """People who mostly answer, and up to five acts of any kind at any moment."""
    random = Random(number)
    edges = [str(edge.address) for branch in blueprint for edge in branch.edges()]
    states = [f"{branch.name}/{state}" for branch in blueprint for state in branch.table]
    facts = [f"{b.name}/{d}" for b in blueprint for d in range(b.num_facts) if d not in b.subs]
    lines: list[Json] = []
    usual = {"operation": "done", "confirm": "confirm", "supervise": "go_on", "start": "start"}
    for kind, option in usual.items():
        if random.random() < 0.85:
            wait = random.choice([0, 0.3])
            lines.append({"do": "answer", "kind": kind, "option": option, "after": wait,
                          "times": "every"})  # fmt: skip
    if random.random() < 0.7:
        said = {"option": random.choice("01"), "times": "every"}
        lines.append({"do": "answer", "kind": "fact", **said})
    for _ in range(random.randrange(6)):
        edge, state, fact = random.choice(edges), random.choice(states), random.choice(facts)
        act = random.choice(_acts(random, edge, state))
        act.update({key: fact for key in ("target", "fact") if key in act})
        who = random.choice(("Ada", "Bo", "script"))
        lines.append({**_moment(random, edge, state), **act, "by": who})
    if random.random() < 0.1:
        of = random.choice(["supervision", "inspection"])
        level = random.choice(["human", "shared", "automatic"])
        lines.append({"do": "level", "of": of, "level": level})
    if random.random() < 0.1:
        level = random.choice(["human", "shared"])
        lines.append({"do": "level", "of": random.choice(facts), "level": level})
    return "\n".join(map(json.dumps, lines)).encode()


def asked_of(number: int, blueprint: Blueprint) -> dict[str, Any]:
    """Goals, a start and operations to avoid, as ``run`` takes them."""
    random = Random(number)
    states = [f"{branch.name}/{state}" for branch in blueprint for state in branch.table]
    edges = [str(edge.address) for branch in blueprint for edge in branch.edges()]
    found: dict[str, Any] = {"seed": number, "on_mismatch": random.choice(["hold", "adopt"])}
    if random.random() < 0.6:
        some = random.sample(states, min(len(states), random.choice([1, 1, 2])))
        found["goal"] = list({state.split("/")[0]: state for state in some}.values())
    if random.random() < 0.3:
        found["start"] = [random.choice([state for state in states if state.startswith("A/")])]
    if random.random() < 0.4:
        found["avoid"] = random.sample(edges, min(len(edges), 2))
    return found


def _facts(random: Random, own: Json) -> dict[str, Json]:
    found: dict[str, Json] = {}
    subs = own["HEADER"]["SUB_SBS"].values()
    for digit in range(own["HEADER"]["NUM_FACTS"]):
        note: dict[str, Json] = {}
        if random.random() < 0.15:
            note["critical"] = True
        if random.random() < 0.08:
            note["aggregation"] = "human"
        if random.random() < 0.06:
            note["failure"] = [random.choice("01")]
        if note and digit not in subs:
            found[str(digit)] = note
    return found


def _note(random: Random) -> dict[str, Json]:
    note: dict[str, Json] = {}
    if random.random() < 0.1:
        note["actor"] = random.choice(["human", "shared"])
    if random.random() < 0.1:
        note["stop"] = random.choice(["abort", "hold", "finish"])
    if random.random() < 0.1:
        note["timeout"] = random.choice([0.2, 1.5])
    if random.random() < 0.05:
        note["confirm"] = ["surgeon", "nurse"]
    if random.random() < 0.1:
        note["risk"] = random.choice(["low", "high"])
    if random.random() < 0.05:
        note["touches"] = [0]
    return note


def _hazard(random: Random, values: Json) -> list[tuple[str, str]]:
    found = []
    for _ in range(2):
        branch = random.choice([key for key in values if not key.startswith("_")])
        digit = random.randrange(values[branch]["HEADER"]["NUM_FACTS"])
        found.append((f"{branch}/{digit}", random.choice("01")))
    return found
