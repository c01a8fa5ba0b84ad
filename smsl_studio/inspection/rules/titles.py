"""The rule about titles that are missing (R31): a report for people could only count them."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.inspection.rules.finding import LISTED, Remark, Severity
from smsl_studio.inspection.rules.words import counted, some

ADVICE = "write it, because a report calls it “{}” and cannot tell what it is"


def r31_missing_titles(blueprint: Blueprint) -> Iterator[Remark]:
    """R31: an operation, a state or a fact without the title or the name that a report needs.

    A file in which no operation and no state has a title is passed over: nobody has begun to
    write titles. A state needs none if all its facts have names, because these tell it.
    """
    if not any(map(_begun, blueprint)):
        return
    for branch in blueprint:
        bare = untitled_operations(branch)
        if bare:
            yield _remark(branch, tuple(bare), tuple(bare.values()), "operation", "title")
        if branch.shape.opaque:
            states = [state for state in branch.table if not _title(branch, state)]
            places = tuple(Address(branch.name, state) for state in states)
            if states:
                yield _remark(branch, tuple(states), places, "state", "title")
            continue
        named = {digit for digit, note in branch.notes.facts.items() if note.name}
        facts = [digit for digit in range(branch.num_facts) if digit not in named]
        if facts and branch.table:
            names = tuple(str(digit + 1) for digit in facts)
            yield _remark(branch, names, (branch.address,), "fact", "name")


def untitled_operations(branch: StateBranch) -> dict[str, Address]:
    """Return each name of operations that has no title anywhere, with its first edge."""
    bare: dict[str, Address] = {}
    titled = set()
    for edge in branch.edges():
        if branch.operation_note(edge.source, edge.name).title:
            titled.add(edge.name)
        elif edge.name not in bare:
            bare[edge.name] = edge.address
    return {name: first for name, first in bare.items() if name not in titled}


def _begun(branch: StateBranch) -> bool:
    notes = branch.notes
    return any(one.title for one in notes.operations.values()) or any(
        one.title for one in notes.states.values()
    )


def _title(branch: StateBranch, state: str) -> str:
    note = branch.state_note(state)
    return "" if note is None else note.title


def _remark(
    branch: StateBranch, names: tuple[str, ...], at: tuple[Address, ...], noun: str, word: str
) -> Remark:
    many = len(names)
    has = "has no" if many == 1 else "have no"
    said = f"{counted(many, noun)} ({some(names)}) {has} {word}"
    shown = {"operation": "a step without a title", "state": "a state", "fact": "Fact 1"}[noun]
    return Remark(
        "R31",
        Severity.NOTE,
        at[0],
        said,
        advice=ADVICE.format(shown),
        others=at[1:LISTED],
    )
