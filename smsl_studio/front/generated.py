"""Blueprints that are generated and not drawn. They say how they were made (``_origin``)."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.generate.rule_file import read_rules
from smsl_studio.generate.rule_states import MOST_STATES, RuledBranch, ruled_branch
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.files import read_content
from smsl_studio.smsl.json_form import parse_json, write_json

Json = Any
PART: dict[str, Json] = {"whole": False}
"""What ``_origin`` says of a blueprint that lacks states, because a limit was met."""
Name = str | os.PathLike[str]


@dataclass(frozen=True)
class Generated:
    """A generated blueprint, its numbers of states and operations, and whether its goal can be
    reached. ``whole`` is false if there are further states, which are left out."""

    blueprint: Blueprint
    states: int
    operations: int
    goal_reached: bool
    whole: bool = True


def generate_rules(file: Name, limit: int = MOST_STATES) -> Generated:
    """Return the blueprint of a file of rules (TOML).

    Rules may lead to more states than ``limit``, or have no end. Then the first states are
    returned, and ``_origin`` says that they are not the whole. ReadError, with its line, for rules
    that cannot be read, or if the start is left out.

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
    made = ruled_branch(read_rules(raw, os.fspath(file)), limit)
    blueprint = ruled_blueprint(made, raw, file)
    return Generated(blueprint, made.states, made.operations, made.goal_reached, made.whole)


def ruled_blueprint(made: RuledBranch, raw: bytes, file: Name, name: Name = "") -> Blueprint:
    """Return the blueprint of an SB that rules made. ``raw`` are the bytes of the rules, ``name``
    is the file of the blueprint; without it that of the rules."""
    names = {str(digit): {"name": fact} for digit, fact in enumerate(made.facts)}
    values = {branch: {"_facts": names, **table} for branch, table in made.values.items()}
    origin = _origin("rules", [file], sha256_hex(raw))
    return _blueprint(values, origin | PART if not made.whole else origin, name or file)


def generate_pddl(domain: Name, problem: Name) -> Generated:
    """Return the blueprint of a planning problem in PDDL.

    ReadError, with its place, for what is wrong or not supported. UsageError for a problem with too
    many states or actions.

    >>> _ = Path("light.pddl").write_text('''(define (domain light) (:predicates (on))
    ...   (:action press :precondition (not (on)) :effect (on)))''')
    >>> _ = Path("dark.pddl").write_text('''(define (problem dark) (:domain light)
    ...   (:init) (:goal (on)))''')
    >>> made = generate_pddl("light.pddl", "dark.pddl")
    >>> made.states, made.operations, made.goal_reached
    (2, 1, True)
    """
    from smsl_studio.generate.pddl.domain import read_domain
    from smsl_studio.generate.pddl.expressions import read_expression
    from smsl_studio.generate.pddl.plan_states import planned_branch
    from smsl_studio.generate.pddl.problem import read_problem

    texts = [read_content(file).raw for file in (domain, problem)]
    told = read_domain(read_expression(texts[0], os.fspath(domain)))
    asked = read_problem(read_expression(texts[1], os.fspath(problem)), told)
    made = planned_branch(told, asked)
    origin = _origin("pddl", [domain, problem], sha256_hex(b"".join(texts)))
    blueprint = _blueprint(made.values, origin, problem)
    return Generated(blueprint, made.states, made.operations, made.goal_reached)


def _origin(how: str, files: Sequence[Name], digest: str) -> dict[str, Json]:
    """Return how something was made, from which files, and the SHA-256 of their bytes."""
    return {"how": how, "from": ", ".join(Path(one).name for one in files), "digest": digest}


def _blueprint(made: dict[str, Json], origin: dict[str, Json], file: Name) -> Blueprint:
    text = write_json({**made, "_origin": origin})
    return read_blueprint(parse_json(text, f"{Path(file).stem}.json"))
