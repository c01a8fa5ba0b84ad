"""A PDDL problem: objects, what holds in the beginning, the goal."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.generate.pddl.domain import (
    TOTAL,
    Domain,
    check_requirements,
    declared,
    sections_of,
    unsupported,
)
from smsl_studio.generate.pddl.expressions import Expression
from smsl_studio.generate.pddl.formulas import Atom, atom_of, number_of
from smsl_studio.generate.pddl.types import name_of
from smsl_studio.stop import heed

_SECTIONS = (":domain", ":requirements", ":objects", ":init", ":goal", ":metric")


@dataclass(frozen=True)
class Problem:
    """What a problem says. ``objects`` has the constants of the domain first. ``costs`` are the
    values of functions."""

    objects: dict[str, tuple[str, ...]]
    init: frozenset[Atom]
    costs: dict[Atom, float]
    goal: Expression


def read_problem(tree: Expression, domain: Domain) -> Problem:
    """Return a problem of a domain. ReadError, with its place, if it does not fit."""
    sections = sections_of(tree, "problem", _SECTIONS)
    for name in (":domain", ":init", ":goal"):
        if not sections[name]:
            raise tree.fault(f"the section {name} is missing")
    (told,) = sections[":domain"]
    if len(told.parts) != 2 or told.parts[1].word != domain.name:
        raise told.fault(
            f"the problem is of another domain than {domain.name!r}",
            "Name the domain first and then a problem of it.",
        )
    for one in sections[":requirements"]:
        check_requirements(one)
    objects = declared(sections[":objects"], domain, domain.constants)
    init: set[Atom] = set()
    costs: dict[Atom, float] = {}
    for one in sections[":init"][0].rest:
        heed()
        if one.head == "=":
            _cost(one, domain, objects, costs)
        elif one.head == "not" and len(one.parts) == 2:
            atom_of(one.parts[1], domain, objects, {})
        elif one.head == "at" and len(one.parts) == 3 and number_of(one.parts[1]) is not None:
            raise unsupported(one, "a timed literal")
        else:
            init.add(atom_of(one, domain, objects, {}))
    (goal,) = sections[":goal"]
    if len(goal.parts) != 2:
        raise goal.fault("one goal is expected")
    for one in sections[":metric"]:
        words = [part.word or part.head for part in one.rest]
        if words != ["minimize", TOTAL]:
            raise unsupported(one, "a metric other than (minimize (total-cost))")
    return Problem(objects, frozenset(init), costs, goal.parts[1])


def _cost(
    one: Expression,
    domain: Domain,
    objects: dict[str, tuple[str, ...]],
    costs: dict[Atom, float],
) -> None:
    if len(one.parts) != 3:
        raise one.fault("(= (function ...) NUMBER) is expected")
    head, value = one.parts[1], number_of(one.parts[2])
    if value is None:
        raise one.parts[2].fault("a number from 0 with at most 12 digits is expected")
    name = name_of(head.parts[0] if head.parts else head)
    if name not in domain.functions:
        raise head.fault(f"there is no function {name!r}")
    if name == TOTAL and value:
        raise unsupported(one, "a total-cost that does not begin with 0")
    costs[atom_of(head, domain, objects, {}, functions=True)] = value
