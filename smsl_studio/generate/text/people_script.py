"""A script in which people carry out and confirm what a generated blueprint asks of them: for a
trial in the table world, where nobody is there."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import HUMAN
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint

Json = Any


def people_script(blueprint: Blueprint) -> str:
    """Return the lines of the script, empty if nobody is asked. Operations behind a failure are
    left out."""
    levels = Levels(blueprint)
    lines = []
    for branch in blueprint:
        if not levels.people_do(branch.name):
            continue
        for edge in branch.edges():
            facts = branch.facts(edge.source)
            notes = [branch.fact_note(digit) for digit in range(len(facts))]
            if any(
                note and value in note.failure for note, value in zip(notes, facts, strict=True)
            ):
                continue
            lines += list(_answers(blueprint, edge.address, levels))
    return "".join(f"{json.dumps(line, ensure_ascii=False)}\n" for line in lines)


def _answers(blueprint: Blueprint, edge: Address, levels: Levels) -> Iterator[dict[str, Json]]:
    note = blueprint[edge.branch].operation_note(edge.state, edge.operation)
    for role in note.confirm:
        yield _answer("confirm", edge, "confirm", role)
    if levels.operation(edge) == HUMAN:
        for role in note.roles or ("",):
            yield _answer("operation", edge, "done", role)


def _answer(kind: str, edge: Address, option: str, role: str) -> dict[str, Json]:
    by = f"Trial {role}" if role else "Trial person"
    said = {"do": "answer", "kind": kind, "address": str(edge), "option": option, "by": by}
    return {**said, "role": role} if role else said
