"""The filter by fact values: ``disk 2 = b``, ``clamp != fixed``, several with commas."""

from __future__ import annotations

import re
from dataclasses import dataclass

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.studio.features.draw.find.hits import StateLines

_CONDITION = re.compile(r"\s*(?P<fact>[^=!]+?)\s*(?P<sign>!?=)\s*(?P<value>[^=!]+?)\s*")
LONGEST = 200


@dataclass(frozen=True)
class Condition:
    """A fact by name or number, and a value by itself or by its meaning, as they were typed."""

    fact: str
    value: str
    equal: bool = True


def conditions(typed: str) -> tuple[Condition, ...]:
    """The conditions in a typed text; none if it has another form."""
    if "=" not in typed or len(typed) > LONGEST:
        return ()
    found = [_CONDITION.fullmatch(part) for part in typed.split(",")]
    return tuple(
        Condition(one["fact"].casefold(), one["value"].casefold(), one["sign"] == "=")
        for one in found if one is not None
    ) if all(found) else ()  # fmt: skip


def filtered(blueprint: Blueprint, wanted: tuple[Condition, ...]) -> list[StateLines]:
    """The states that meet all conditions, by SB. Only SBs that have all the facts count."""
    found = []
    for branch in blueprint:
        told = [_meaning(branch, one) for one in wanted]
        if not branch.table or any(digit is None for digit, _ in told):
            continue
        states = [
            name for name in branch.table
            if all(_holds(branch.facts(name), digit, values, one.equal)
                   for (digit, values), one in zip(told, wanted, strict=True))
        ]  # fmt: skip
        words = ", ".join(
            f"{branch.fact_name(digit or 0)} {'is' if one.equal else 'is not'} {one.value}"
            for (digit, _), one in zip(told, wanted, strict=True)
        )
        found.append(StateLines(branch.name, tuple(states), words))
    return found


def why_nothing(blueprint: Blueprint, branch: str, wanted: tuple[Condition, ...]) -> str:
    """Why no state meets the conditions: no such fact, no such value, or only not together."""
    shown = blueprint.branches.get(branch)
    for one in wanted:
        homes = [home for home in blueprint if _digit(home, one.fact) is not None]
        if not homes:
            return f"No fact is called “{one.fact[:40]}”" + _names(shown)
        home = shown if shown in homes and shown is not None else homes[0]
        digit, values = _meaning(home, one)
        if digit is not None and one.equal and not values:
            there = ", ".join(_values(home, digit)[:8])
            return f"{home.fact_name(digit)} is never “{one.value[:40]}”. Its values: {there}"
    return "No state meets this"


def _names(branch: StateBranch | None) -> str:
    if branch is None or not branch.table:
        return ""
    names = [branch.fact_name(digit) for digit in range(min(told_facts(branch), 6))]
    return f". Facts here: {', '.join(names)}" if names else ""


def _meaning(branch: StateBranch, wanted: Condition) -> tuple[int | None, frozenset[str]]:
    """The digit and the values that a condition means in an SB; digit None for no such fact."""
    digit = _digit(branch, wanted.fact)
    if digit is None:
        return None, frozenset()
    note = branch.fact_note(digit)
    meanings = note.values if note is not None else {}
    values = _values(branch, digit)
    return digit, frozenset(
        value for value in values
        if wanted.value in (value.casefold(), meanings.get(value, "").casefold())
    )  # fmt: skip


def _digit(branch: StateBranch, fact: str) -> int | None:
    """The fact with this name, with this number, or the only one whose name begins so."""
    names = [branch.fact_name(digit).casefold() for digit in range(branch.num_facts)]
    if fact in names:
        return names.index(fact)
    if fact.isdecimal() and fact.isascii() and int(fact) < len(names):
        return int(fact)
    begun = [digit for digit, name in enumerate(names) if name.startswith(fact)]
    return begun[0] if len(begun) == 1 else None


def _values(branch: StateBranch, digit: int) -> tuple[str, ...]:
    """The values that a fact takes in the states of an SB, sorted."""
    facts = (branch.facts(name) for name in branch.table)
    return tuple(sorted({values[digit] for values in facts if digit < len(values)}))


def _holds(facts: tuple[str, ...], digit: int | None, values: frozenset[str], equal: bool) -> bool:
    return digit is not None and digit < len(facts) and (facts[digit] in values) is equal
