"""One operation in sentences: who does it, when it may begin, and how one knows that it is done."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import FactNote, OperationNote
from smsl_studio.blueprint.continuum import HUMAN, SHARED
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.inspection.reading.plain_names import (
    PlainNames,
    duration,
    listed,
    opened,
    people,
)

SYSTEM = "The system"
_STOPS = {
    "abort": "A pause breaks it off.",
    "hold": "A pause holds it where it is.",
    "finish": "A pause lets it come to its end first.",
}


class StepWords:
    """The sentences about single operations and facts of a blueprint."""

    def __init__(self, names: PlainNames) -> None:
        self.names = names
        self.blueprint = names.blueprint
        self.levels = Levels(names.blueprint)

    def who(self, edge: Address) -> str:
        """Return who carries out an operation."""
        note, level = self.note(edge), self.levels.operation(edge)
        if level == HUMAN:
            return opened(people(note.roles))
        if level == SHARED:
            agree = note.confirm or note.roles
            return f"{SYSTEM}, after {people(agree)} agreed"
        return SYSTEM

    def sentences(self, edge: Address) -> Iterator[str]:
        """Yield what must be known of an operation before and while it is carried out."""
        note, level = self.note(edge), self.levels.operation(edge)
        if level == HUMAN and note.question:
            yield f"The request is: “{note.question}”"
        if note.requires:
            yield f"It begins only while {self.names.required(note.requires)}."
        if note.confirm:
            yield f"{opened(people(note.confirm))} must agree before it begins."
        if note.risk in ("medium", "high"):
            yield f"Its risk is {note.risk}."
        if note.timeout is not None:
            yield f"It has failed if it takes longer than {duration(note.timeout)}."
        if note.answer_within is not None and (level in (HUMAN, SHARED) or note.confirm):
            yield f"{answer_time(note)} No answer is never a yes."
        if note.stop is not None:
            yield _STOPS[note.stop]
        if note.repeatable:
            yield "It may be tried again after a failure."

    def changes(self, edge: Address, target: str) -> tuple[tuple[int, str], ...]:
        """Return the facts that an operation changes, as digits with their new values."""
        branch = self.blueprint[edge.branch]
        before, after = branch.facts(edge.state), branch.facts(target)
        pairs = enumerate(zip(before, after, strict=False))
        return tuple((digit, new) for digit, (old, new) in pairs if old != new)

    def check(self, edge: Address, target: str) -> str:
        """Return how one knows that an operation is done: the facts that it changes."""
        return self.facts(self.blueprint[edge.branch], self.changes(edge, target))

    def facts(self, branch: StateBranch, changed: Sequence[tuple[int, str]]) -> str:
        """Return the new values of facts, each with its source, as a sentence."""
        if not changed:
            return "No fact changes."
        said = [
            f"{self.names.fact_is(branch, digit, value)} ({self.source(branch, digit)})"
            for digit, value in changed
        ]
        return f"{listed(said)}."

    def one_of_each(self, branch: StateBranch | None = None) -> Iterator[Address]:
        """Yield operations of one SB, or of all: of those with equal names and equal annotations
        one.
        """
        for own in self.blueprint if branch is None else (branch,):
            if not self.levels.people_do(own.name) and "_operations" not in own.fields:
                states: dict[str, str] = {}
                for state, edges in own.table.items():
                    for name in edges:
                        states.setdefault(name, state)
                yield from (Address(own.name, state, name) for name, state in states.items())
                continue
            seen = set()
            for edge in own.edges():
                key = edge.name, repr(self.note(edge.address)), self.levels.operation(edge.address)
                if key not in seen:
                    seen.add(key)
                    yield edge.address

    def source(self, branch: StateBranch, digit: int) -> str:
        """Return where the value of a fact comes from, within a sentence."""
        sub = branch.subs.get(digit)
        if sub is not None and sub in self.blueprint.branches:
            return "shown by its sub-procedure"
        note, level = branch.fact_note(digit), self.levels.fact(branch.name, digit)
        if level == HUMAN:
            return f"said by {people(_roles(note))}"
        sensors = note.sensors if note is not None else ()
        read = f"read by {listed(sensors)}" if sensors else "no sensor is written down"
        return f"{read}, else said by {people(_roles(note))}" if level == SHARED else read

    def note(self, edge: Address) -> OperationNote:
        """Return the annotations of an operation."""
        return self.blueprint[edge.branch].operation_note(edge.state, edge.operation)


def _roles(note: FactNote | None) -> tuple[str, ...]:
    return note.roles if note is not None else ()


def answer_time(note: OperationNote | FactNote) -> str:
    """Return the time limit of the answer to a question, and who else may answer then. Empty
    without a limit.
    """
    if note.answer_within is None:
        return ""
    also = f"; after half of that time the {note.escalates_to} may answer too"
    late = f"The answer must come within {duration(note.answer_within)}"
    return f"{late}{also if note.escalates_to else ''}."
