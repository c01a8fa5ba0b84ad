"""The values that facts have in a world: a blueprint with others is refused before the world is
built."""

from __future__ import annotations

from collections.abc import Collection, Sequence

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
        if note is not None and (note.sources or note.sensors or note.question):
            continue
        for value in found:
            if value not in values and (note is None or value not in note.failure):
                state = min(branch.states_with(digit, value))
                raise WorldError(
                    f"{branch.name}/{state} has {thing} at {value!r}, and this world knows"
                    f" {' '.join(values)}",
                    advice="Correct the fact, or use the world table, which runs any blueprint.",
                )
