"""Numbers of steps: ``2.1`` is the first part of the second step.

A text has numbers of its own, in each of its parts anew. Here each step gets one that no other step
has, and what a remedy names follows.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from smsl_studio.generate.text.steps import Caution, Remedy, TextProcedure, TextStep

Part = TypeVar("Part", TextStep, Remedy, Caution)
WORDS = frozenset(("on", "again", "start"))


def numbered(procedure: TextProcedure) -> TextProcedure:
    """Return the procedure with new numbers. A remedy that names no step does its own anew."""
    return procedure.model_copy(update={"steps": _numbered(procedure.steps, "", {})})


def unknown_numbers(procedure: TextProcedure) -> list[str]:
    """Return a sentence for each remedy that leads to a step that is not there."""
    return list(_unknown(procedure.steps, "", {}))


def without_sources(procedure: TextProcedure, file: str) -> TextProcedure:
    """Return the procedure without citations of a file that is no expert text."""

    def kept(part: Part) -> Part:
        sources = tuple(one for one in part.sources if one.file != file)
        return part.model_copy(update={"sources": sources})

    def cleaned(step: TextStep) -> TextStep:
        remedies, steps = tuple(map(kept, step.remedies)), tuple(map(cleaned, step.steps))
        return kept(step).model_copy(update={"remedies": remedies, "steps": steps})

    cautions = tuple(map(kept, procedure.cautions))
    return procedure.model_copy(
        update={"steps": tuple(map(cleaned, procedure.steps)), "cautions": cautions}
    )


def lowered(step: TextStep) -> TextStep:
    """Return a step whose remedies stand at its last part, because its own fact is a sub-SB's."""
    if not step.steps or not step.remedies:
        return step
    *others, last = step.steps
    last = lowered(last.model_copy(update={"remedies": (*last.remedies, *step.remedies)[:12]}))
    return step.model_copy(update={"remedies": (), "steps": (*others, last)})


def _unknown(steps: tuple[TextStep, ...], head: str, above: Mapping[str, str]) -> Iterator[str]:
    steps = tuple(map(lowered, steps))
    known = {**above, **{step.mark: step.mark for step in steps if step.mark}}
    for number, step in enumerate(steps, 1):
        for one in step.remedies:
            if one.back not in WORDS and one.back not in known:
                yield (
                    f"step {head}{number} ({step.do}): “{one.when}” leads back to step {one.back}, "
                    "and there is none"
                )
        yield from _unknown(step.steps, f"{head}{number}.", known)


def _numbered(
    steps: tuple[TextStep, ...], head: str, above: Mapping[str, str]
) -> tuple[TextStep, ...]:
    steps = tuple(map(lowered, steps))
    numbers = [f"{head}{number}" for number in range(1, len(steps) + 1)]
    pairs = zip(reversed(steps), reversed(numbers), strict=True)
    here = {step.mark: number for step, number in pairs if step.mark}
    known = {**above, **here}
    return tuple(
        step.model_copy(
            update={
                "mark": number,
                "remedies": tuple(_led(one, known) for one in step.remedies),
                "steps": _numbered(step.steps, f"{number}.", known),
            }
        )
        for step, number in zip(steps, numbers, strict=True)
    )


def _led(remedy: Remedy, known: Mapping[str, str]) -> Remedy:
    if remedy.back in WORDS:
        return remedy
    return remedy.model_copy(update={"back": known.get(remedy.back, "again")})
