"""Blueprints that are generated and not drawn. They say how they were made (``_origin``)."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rule_file import read_rules
from smsl_studio.generate.rule_states import ruled_branch
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.files import read_content
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
Name = str | os.PathLike[str]


@dataclass(frozen=True)
class Generated:
    """A generated blueprint, its numbers of states and operations, and whether its goal can be
    reached."""

    blueprint: Blueprint
    states: int
    operations: int
    goal_reached: bool


def generate_rules(file: Name) -> Generated:
    """Return the blueprint of a file of rules (TOML).

    ReadError, with its line, for rules that cannot be read. UsageError for rules without an end.

    >>> _ = Path("light.toml").write_text('''
    ... sb = "LIGHT"
    ... facts = [{name = "light", values = ["0", "1"]}]
    ... start = ["0"]
    ... goal = ["1"]
    ... [[rule]]
    ... operation = "switch"
    ... cases = [{when = "light = 0", set = {light = "1"}}, {set = {light = "0"}}]
    ... ''')
    >>> made = generate_rules("light.toml")
    >>> made.states, made.operations, made.goal_reached
    (2, 2, True)
    """
    raw = read_content(file).raw
    name = Path(file).name
    made = ruled_branch(read_rules(raw, os.fspath(file)))
    origin = {"how": "rules", "from": name, "digest": sha256_hex(raw)}
    values: dict[str, Json] = {**made.values, "_origin": origin}
    blueprint = read_blueprint(parse_json(write_json(values), f"{Path(name).stem}.json"))
    return Generated(blueprint, made.states, made.operations, made.goal_reached)
