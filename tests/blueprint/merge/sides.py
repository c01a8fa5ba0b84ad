"""Random blueprints, random edits of them, and an oracle that merges lists of facts about them.

The oracle knows nothing of trees, texts or paths: a blueprint is a map from things (a state, the
target of an operation, the title of a state, an end of an SB) to values.
"""

from __future__ import annotations

import json
from random import Random
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import (
    add_branch,
    add_operation,
    add_state,
    delete,
    rename,
    retarget,
    set_header,
    set_note,
)
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.json_form import parse_json

Thing = tuple[str, ...]
GONE = "gone"


def drawn(chance: Random) -> Blueprint:
    """A blueprint of one or two SBs with explicit ends, and some titles and costs.

    No operation of one SB is called as one of another, else a state that came from there could be
    taken for a renamed one.
    """
    values: dict[str, Any] = {}
    for branch in [f"SB{n}" for n in range(chance.randint(1, 2))]:
        states = [f"{branch}_S{n}" for n in range(chance.randint(3, 5))]
        inside: dict[str, Any] = {"HEADER": {"INITIAL": states[0], "ACTIVATING": states[-1]}}
        for at, state in enumerate(states):
            inside[state] = {
                f"{branch}_op{at}{n}": chance.choice(states) for n in range(chance.randint(1, 3))
            }
        inside["_states"] = {s: {"title": s.lower()} for s in chance.sample(states, 2)}
        edges = [(s, op) for s in states for op in inside[s]]
        inside["_operations"] = {f"{s}/{op}": {"cost": 2.0} for s, op in chance.sample(edges, 2)}
        values[branch] = inside
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


def edited(blueprint: Blueprint, chance: Random, steps: int, renames: bool) -> Blueprint:
    """The blueprint after some random edits; one that is refused is left out."""
    for _ in range(steps):
        try:
            blueprint = _edit(blueprint, chance, renames)
        except EditRefused:
            continue
    return blueprint


def _edit(blueprint: Blueprint, chance: Random, renames: bool) -> Blueprint:
    branch = chance.choice(list(blueprint))
    edges = list(branch.edges())
    states = list(branch.table)
    if not states or not edges:
        return add_state(blueprint, branch.name, f"N{chance.randint(0, 5)}")
    edge, state = chance.choice(edges), chance.choice(states)
    at = Address(branch.name, edge.source, edge.name)
    kind = chance.randrange(11 if renames else 10)
    if kind < 2:
        return retarget(blueprint, at, chance.choice(states))
    if kind == 2:
        return delete(blueprint, [at])
    if kind == 3:
        return delete(blueprint, [Address(branch.name, state)])
    if kind == 4:
        return add_operation(
            blueprint, branch.name, state, f"new{chance.randint(0, 3)}", chance.choice(states)
        )
    if kind == 5:
        name = f"N{chance.randint(0, 5)}"
        blueprint = add_state(blueprint, branch.name, name)
        return add_operation(blueprint, branch.name, state, f"to{name}", name)
    if kind == 6:
        title = {"title": f"t{chance.randint(0, 9)}"}
        return set_note(blueprint, branch.name, "_states", state, title)
    if kind == 7:
        key, cost = f"{edge.source}/{edge.name}", {"cost": float(chance.randint(3, 9))}
        return set_note(blueprint, branch.name, "_operations", key, cost)
    if kind == 8:
        if chance.random() < 0.3:
            return add_branch(blueprint, f"NEW{chance.randint(0, 2)}")
        return set_header(blueprint, branch.name, chance.choice(("INITIAL", "ACTIVATING")), state)
    if kind == 9:
        return _moved(blueprint, branch.name, state, chance)
    return rename(blueprint, Address(branch.name, state), f"R{chance.randint(0, 999)}")


def _moved(blueprint: Blueprint, branch: str, state: str, chance: Random) -> Blueprint:
    """Move a state to an SB, with the names of its operations: all lead to one state there."""
    home = chance.choice(list(blueprint))
    if home.name == branch:
        return blueprint
    names = list(blueprint[branch].table[state])
    blueprint = add_state(blueprint, home.name, state)
    target = chance.choice(list(blueprint[home.name].table))
    for name in names:
        blueprint = add_operation(blueprint, home.name, state, name, target)
    return delete(blueprint, [Address(branch, state)])


def things(blueprint: Blueprint) -> dict[Thing, str]:
    """Everything that a blueprint says, each as one value."""
    found: dict[Thing, str] = {}
    for branch in blueprint:
        found["branch", branch.name] = ""
        found["initial", branch.name] = branch.initial
        found["activating", branch.name] = branch.activating
        for state in branch.table:
            found["state", branch.name, state] = ""
            note = branch.state_note(state)
            if note and note.title:
                found["title", branch.name, state] = note.title
        for edge in branch.edges():
            found["target", branch.name, edge.source, edge.name] = edge.target
            cost = branch.operation_note(edge.source, edge.name).cost
            if cost is not None:
                found["cost", branch.name, edge.source, edge.name] = str(cost)
    return found


def merged_thing(base: str, ours: str, theirs: str) -> str | None:
    """The value of a thing after a merge, None for a conflict."""
    if theirs in (ours, base):
        return ours
    return theirs if ours == base else None


def address_of_thing(thing: Thing) -> str:
    _kind, *names = thing
    return str(Address(*names))
