"""The questions to people, from the blueprint: their words, options and roles.

No option is chosen in advance. Every question can be answered with a no, or with not knowing.
"""

from __future__ import annotations

from smsl_studio.blueprint.address import Address, fact_text
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.people.board import Question
from smsl_studio.dispatch.people.task import Option

DONE = Option("done", "Done", yes=True)
COULD_NOT = Option("could_not", "Could not do it", yes=False)
CONFIRM = Option("confirm", "Confirm", yes=True)
REFUSE = Option("refuse", "Do not begin", yes=False)
GO_ON = Option("go_on", "Go on", yes=True)
SKIP = Option("veto", "Skip it once", yes=False)
PRUNE = Option("prune", "Shut it out of this run", yes=False)
PAUSE = Option("pause", "Pause the run", yes=False)
START = Option("start", "Start", yes=True)
DO_NOT_START = Option("refuse", "Do not start", yes=False)
ALLOW = Option("allow", "Allow", yes=True)
REFUSE_EDGE = Option("refuse", "Refuse", yes=False)
CANNOT_SAY = Option("cannot say", "I cannot say", yes=False)


def operation_task(blueprint: Blueprint, edge: Address) -> Question:
    """Return the question for a person who carries out an operation. The state check still
    decides.
    """
    note = blueprint[edge.branch].operation_note(edge.state, edge.operation)
    return Question(
        "operation",
        str(edge),
        note.question or f"{title_of(blueprint, edge)}: please carry it out",
        (DONE, COULD_NOT),
        note.roles or ("",),
        _leads(blueprint, edge),
        note.answer_within,
        note.escalates_to,
    )


def confirm_task(blueprint: Blueprint, edge: Address) -> Question:
    """Return the question for people who must agree before an operation begins, one for each
    role.
    """
    note = blueprint[edge.branch].operation_note(edge.state, edge.operation)
    return Question(
        "confirm",
        str(edge),
        f"{title_of(blueprint, edge)}: may it begin?",
        (CONFIRM, REFUSE),
        note.confirm or ("",),
        _leads(blueprint, edge),
        note.answer_within,
        note.escalates_to,
    )


def fact_task(blueprint: Blueprint, fact: FactKey, why: str = "") -> Question:
    """Return the question for the value of a fact. ``why`` says why it is unknown."""
    branch, digit = blueprint[fact[0]], fact[1]
    note = branch.fact_note(digit)
    name = branch.fact_name(digit)
    words = note.values if note else {}
    values = (*branch.alphabet[digit], *words, *(note.failure if note else ()))
    known = dict.fromkeys(values)
    unsure = CANNOT_SAY.value
    while unsure in known:
        unsure += "?"
    options = [Option(value, words.get(value, value), yes=True) for value in known]
    unit = f", in {note.unit}" if note and note.unit else ""
    return Question(
        "fact",
        fact_text(*fact),
        (note.question if note else "") or f"What is {name} of {branch.name}{unit}?",
        (*options, Option(unsure, CANNOT_SAY.words, yes=False)),
        (note.roles if note else ()) or ("",),
        f"{name} of {branch.name} is unknown{f': {why}' if why else ''}.",
        note.answer_within if note else None,
        note.escalates_to if note else "",
    )


def supervise_task(blueprint: Blueprint, edge: Address, why: str = "") -> Question:
    """Return the question whether the next operation may begin. ``why`` is the reason of an agent
    that asks.
    """
    detail = _leads(blueprint, edge)
    return Question(
        "supervise",
        str(edge),
        f"{title_of(blueprint, edge)}: shall it begin?",
        (GO_ON, SKIP, PRUNE, PAUSE),
        detail=f"{why} {detail}".strip(),
    )


def generate_task(edge: Address, target: str, provider: str, detail: str) -> Question:
    """Return the question whether an edge that ``provider`` proposes may count in this run.
    ``detail`` has its forecast and its findings, in words.
    """
    return Question(
        "generate",
        str(edge),
        f"{edge.operation} from {edge.state} to {target}, which the blueprint does not have, is "
        f"proposed by {provider}: may it count in this run?",
        (ALLOW, REFUSE_EDGE),
        detail=detail,
    )


def start_task(findings: str) -> Question:
    """Return the question whether the run may start despite ``findings`` of inspection, in
    words.
    """
    return Question("start", "", "Shall the run start?", (START, DO_NOT_START), detail=findings)


def title_of(blueprint: Blueprint, edge: Address) -> str:
    """Return the title of an operation, or its name."""
    return blueprint[edge.branch].operation_note(edge.state, edge.operation).title or edge.operation


def _leads(blueprint: Blueprint, edge: Address) -> str:
    """Return the source, the target and the risk of an operation in words, for the card."""
    branch = blueprint[edge.branch]
    target = branch.table[edge.state][edge.operation]
    states = []
    for state in (edge.state, target):
        note = branch.state_note(state)
        states.append(f"{state} ({note.title})" if note and note.title else state)
    risk = branch.operation_note(edge.state, edge.operation).risk
    return f"{edge.branch}: {' to '.join(states)}." + (f" Risk: {risk}." if risk else "")
