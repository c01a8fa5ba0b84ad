"""A State Branch as the values of its generated file: flags, states, operations."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from smsl_studio.blueprint.address import note_key
from smsl_studio.blueprint.annotations import OperationNote
from smsl_studio.blueprint.check import off_value
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.generate.code.bound_functions import BoundFunctions
from smsl_studio.generate.code.python_literals import CallLiteral, Code

Json = Any


def given(called: str, /, **values: Json) -> CallLiteral:
    """Return a call with those arguments that say something."""
    said = {key: value for key, value in values.items() if value not in ("", (), {}, None, False)}
    return CallLiteral(called, tuple(said.items()))


def flags(branch: StateBranch, readers: Mapping[int, str]) -> list[CallLiteral]:
    """Return the flag of each digit. ``readers`` are the functions that sense them."""
    return [_flag(branch, digit, readers.get(digit, "")) for digit in range(branch.num_facts)]


def _flag(branch: StateBranch, digit: int, reader: str) -> CallLiteral:
    note, sub = branch.fact_note(digit), branch.subs.get(digit, "")
    on = branch.on_value(digit) if sub else "1"
    off = off_value(branch, digit) if sub else "0"
    return given(
        "Flag",
        name=note.name if note else "",
        values=branch.alphabet[digit],
        sub=sub,
        on="" if on == "1" else on,
        off="" if off == "0" else off,
        read=Code(f"sensors.{reader}") if reader else None,
        failure=note.failure if note else (),
        critical=bool(note and note.critical),
        told_by_people=bool(note and note.aggregation == "human"),
        max_age=note.max_age if note else None,
        meanings=dict(note.values) if note else {},
        unit=note.unit if note else "",
        question=note.question if note else "",
        roles=note.roles if note else (),
        answer_within=note.answer_within if note else None,
        escalates_to=note.escalates_to if note else "",
    )


def states(branch: StateBranch) -> dict[str, CallLiteral]:
    """Return every state by its name."""
    found: dict[str, CallLiteral] = {}
    for name, operations in branch.table.items():
        note = branch.state_note(name)
        arguments: list[tuple[str, Json]] = [("", branch.facts(name)), ("", dict(operations))]
        if note is not None and note.title:
            arguments.append(("title", note.title))
        found[name] = CallLiteral("State", tuple(arguments))
    return found


def operations(branch: StateBranch, bound: BoundFunctions) -> dict[str, CallLiteral]:
    """Return every operation by its name, and by ``State/Operation`` where an edge differs."""
    found: dict[str, CallLiteral] = {}
    for name in branch.operation_names:
        key = note_key(name)
        common = branch.notes.operations.get(key) or OperationNote()
        found[key] = _operation(branch, bound, common, name)
    for state, name in _single_edges(branch, bound):
        note = branch.operation_note(state, name)
        found[note_key(name, state)] = _operation(branch, bound, note, name, state)
    return found


def _single_edges(branch: StateBranch, bound: BoundFunctions) -> Iterator[tuple[str, str]]:
    for state, operations in branch.table.items():
        for name in operations:
            own = note_key(name, state) in branch.notes.operations
            if own or bound.differs(branch, name, state):
                yield state, name


def _operation(
    branch: StateBranch, bound: BoundFunctions, note: OperationNote, name: str, state: str = ""
) -> CallLiteral:
    function, arguments = bound.of(branch, name, state)
    touches = tuple(digit for digit in note.touches if digit < branch.num_facts)
    terms = given(
        "Operation",
        title=note.title,
        risk=note.risk or "",
        actor=note.actor if note.actor in ("human", "shared") else "",
        confirm=note.confirm,
        stop=note.stop if note.stop != "hold" else "",
        touches=touches,
        requires=dict(note.requires),
        load=note.subs == "load",
        question=note.question,
        roles=note.roles,
        answer_within=note.answer_within,
        escalates_to=note.escalates_to,
        arguments=dict(arguments),
    )
    more: list[tuple[str, Json]] = [("", Code(f"operations.{function.name}"))]
    if note.cost is not None and note.cost != 1.0:
        more.append(("cost", float(note.cost)))
    if note.timeout is not None:
        more.append(("timeout", float(note.timeout)))
    if note.resumes is False:
        more.append(("resumes", False))
    return CallLiteral("Operation", (more[0], *terms.arguments, *more[1:]))
