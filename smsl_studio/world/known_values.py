"""The values that facts have in a world: a blueprint with others is refused before the world is
built."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import WorldError


def refuse_others(branch: StateBranch, things: Sequence[str], values: Collection[str]) -> None:
    """Refuse a State Branch that has a thing where the world never has one.

    ``things`` has a name for each fact, and ``values`` are the values that such a fact can have. A
    value that the blueprint lists as a failure, and a fact that it measures or asks itself, are
    left alone. WorldError names the first state with another value.
    """
    for digit, (thing, found) in enumerate(zip(things, branch.alphabet, strict=False)):
        note = branch.fact_note(digit)
        if _is_own(branch, digit):
            continue
        for value in found:
            if value not in values and (note is None or value not in note.failure):
                state = min(branch.states_with(digit, value))
                raise WorldError(
                    f"{branch.name}/{state} has {thing} at {value!r}, and this world knows"
                    f" {' '.join(values)}",
                    advice="Correct the fact, or use the world table, which runs any blueprint.",
                )


def refuse_impossible(branch: StateBranch, why: Callable[[Sequence[str]], str]) -> None:
    """Refuse a State Branch that has a state which its world never shows, such as two things in one
    place.

    ``why`` gets the values of a state and returns why it cannot be, or the empty text. A state with
    a value that the blueprint lists as a failure is left alone, and so is an SB with a fact that it
    measures or asks itself. WorldError names the first such state.
    """
    if any(_is_own(branch, digit) for digit in range(branch.num_facts)):
        return
    notes = [branch.fact_note(digit) for digit in range(branch.num_facts)]
    for state in branch.table:
        values = branch.facts(state)
        pairs = zip(values, notes, strict=True)
        reason = why(values)
        if reason and not any(note and value in note.failure for value, note in pairs):
            raise WorldError(
                f"{branch.name}/{state} cannot be in this world: {reason}",
                advice="Correct the state, or use the world table, which runs any blueprint.",
            )


def _is_own(branch: StateBranch, digit: int) -> bool:
    """Whether the blueprint itself says how a fact is measured or asked."""
    note = branch.fact_note(digit)
    return note is not None and bool(note.sources or note.sensors or note.question)
