"""What a run cannot give although its levels ask for it: told before it begins, not in the
middle."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.levels import Levels, careful
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.person_names import same_name

NAMED = 3
"""So many operations are named; the others are counted."""
EFFECTS = {
    "show": "none is told",
    "ask": "a person decides before each of them",
    "hold": "the run holds before each of them",
}
"""What a level of forecasts does where there is none."""


@dataclass(frozen=True)
class RunMeans:
    """What a run has. ``tried`` says that its world can be tried beforehand, in a second one.
    ``roles`` are those of the people at hand, one for each; None if nobody is there. ``forecast``
    is the level that the run itself asks for."""

    world: str
    tried: bool
    roles: tuple[str, ...] | None = ()
    forecast: str = ""


def lacking(blueprint: Blueprint, levels: Levels, means: RunMeans) -> tuple[str, ...]:
    """Return what the run will lack, each in one sentence that says what happens then."""
    return (*_forecasts(blueprint, levels, means), *_people(blueprint, levels, means))


def _edges(blueprint: Blueprint) -> Iterable[Address]:
    for branch in blueprint:
        for state, edges in branch.table.items():
            for operation in edges:
                yield Address(branch.name, state, operation)


def _forecasts(blueprint: Blueprint, levels: Levels, means: RunMeans) -> Iterable[str]:
    if not levels.forecasts and not means.forecast:
        return
    asked: dict[str, list[Address]] = {}
    by_people = []
    for edge in _edges(blueprint):
        level = careful(levels.forecast(edge), means.forecast)
        if level and levels.operation(edge) == HUMAN:
            by_people += [edge] if level in ("ask", "hold") else []
        elif level:
            asked.setdefault(level, []).append(edge)
    for level in EFFECTS if not means.tried else ():
        if level in asked:
            what = _named(asked[level], "asks", "ask")
            yield (
                f"{what} for a forecast ({level}), and the world {means.world} cannot be tried "
                f"beforehand: {EFFECTS[level]}."
            )
    if by_people:
        what = _named(by_people, "is", "are")
        yield (
            f"{what} carried out by people and cannot be forecast. The level of forecasts does "
            "not stop what people do."
        )


def _people(blueprint: Blueprint, levels: Levels, means: RunMeans) -> Iterable[str]:
    asked: dict[tuple[str, ...], list[Address]] = {}
    for edge in _edges(blueprint):
        wanted = _roles(blueprint, levels, edge)
        if wanted:
            asked.setdefault(wanted, []).append(edge)
    if means.roles is None:
        edges = [edge for some in asked.values() for edge in some]
        if edges:
            what = _named(edges, "asks", "ask")
            yield f"{what} for people, and nobody is there: the run holds before each of them."
        facts = [
            f"{branch.name} {branch.fact_name(digit)}"
            for branch in blueprint
            for digit in range(len(branch.alphabet))
            if digit not in branch.subs and levels.fact(branch.name, digit) == HUMAN
        ]
        if facts:
            yield (
                f"People tell {counted(len(facts))} ({', '.join(facts[:NAMED])}), and nobody is "
                "there: what is not told stays unknown."
            )
        return
    here = [same_name(role) for role in means.roles]
    missing: dict[str, list[Address]] = {}
    few: list[Address] = []
    for wanted, edges in asked.items():
        lost = [role for role in wanted if role and same_name(role) not in here]
        for role in lost:
            missing.setdefault(role, []).extend(edges)
        if not lost and len(wanted) > max(len(here), 1):
            few += edges
    if missing:
        what = _named([edge for edges in missing.values() for edge in edges], "asks", "ask")
        roles = " and ".join(missing)
        yield f"{what} for {roles}, and nobody with this role is entered: Run > Persons."
    if few:
        what = _named(few, "asks", "ask")
        yield f"{what} for more people than are entered: Run > Persons."


def _roles(blueprint: Blueprint, levels: Levels, edge: Address) -> tuple[str, ...]:
    """Return the roles that an operation asks for, empty for none. An empty role is anybody."""
    branch = blueprint[edge.branch]
    note = branch.operation_note(edge.state, edge.operation)
    level = levels.operation(edge)
    if level == HUMAN:
        own = note.roles or ("",)
    else:
        own = note.confirm or (("",) if level == "shared" else ())
    # Whom it escalates to may answer in the place of others.
    return () if note.escalates_to else own


def counted(facts: int) -> str:
    """Return a number of facts in words."""
    return "one fact" if facts == 1 else f"{facts} facts"


def _named(edges: Sequence[Address], one: str, several: str) -> str:
    """Return the names of operations with a verb: ``Op_a and Op_b ask``."""
    names = list(dict.fromkeys(edge.operation for edge in edges))
    told = names[:NAMED]
    more = len(names) - len(told)
    if more:
        return f"{', '.join(told)} and {more} more {several}"
    words = " and ".join(filter(None, (", ".join(told[:-1]), told[-1])))
    return f"{words} {one if len(told) == 1 else several}"
