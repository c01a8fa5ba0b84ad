"""The section "Hazards and controls": what must never be, what must hold, and what was shown."""

from __future__ import annotations

from collections.abc import Iterator

from smsl_studio.blueprint.annotations import read_hazards
from smsl_studio.blueprint.properties.words import hazard_words, property_words
from smsl_studio.inspection.proof.claims import HAZARDS, Claim, claims_of
from smsl_studio.inspection.proof.verdict import FAILS, HAZARD, HOLDS, PropertyVerdict
from smsl_studio.inspection.reading.plain_names import counted
from smsl_studio.inspection.reading.reading_grounds import ReadingGrounds
from smsl_studio.inspection.reading.sections import (
    PROVISO,
    ReadingLine,
    ReadingSection,
    bounded,
)
from smsl_studio.inspection.reading.step_words import StepWords


def controls(words: StepWords, grounds: ReadingGrounds) -> ReadingSection:
    """Return the section. What is not shown, and a blueprint without hazards, are open points."""
    verdicts = {(one.address.path[0], one.name): one for one in grounds.verdicts}
    claims = list(claims_of(words.blueprint))
    made = (_line(words, one, verdicts.get((one.path[0], one.name))) for one in claims)
    lines = bounded(made, len(claims), "hazard or property")
    if not any(one.kind == HAZARD for one in claims):
        lines = (_NONE, *lines)
    return ReadingSection("hazards", "Hazards and controls", lines, f"{PROVISO}.")


_NONE = ReadingLine(
    "No hazard is written down",
    ("Nobody has written which facts must never be true together.",),
    open_point=True,
)


def _line(words: StepWords, claim: Claim, verdict: PropertyVerdict | None) -> ReadingLine:
    if claim.meanings is None or verdict is None:
        text = ("It cannot be read, so it controls nothing. The engineer must mend it.",)
        return ReadingLine(claim.name, text, open_point=True)
    why = (claim.written.why,) if claim.written is not None and claim.written.why else ()
    return ReadingLine(
        claim.name,
        (f"{_sentence(words, claim)}.", *why, *_verdict(words, claim, verdict)),
        open_point=verdict.verdict != HOLDS,
    )


def _sentence(words: StepWords, claim: Claim) -> str:
    one = claim.written
    if one is None:
        written = claim.document.values[HAZARDS][int(claim.path[1])]
        return hazard_words(read_hazards([written])[0][0].facts, words.blueprint)
    return property_words(one, words.blueprint)


def _verdict(words: StepWords, claim: Claim, verdict: PropertyVerdict) -> Iterator[str]:
    run = verdict.counterexample
    if verdict.verdict == HOLDS:
        many = verdict.configurations
        yield "Controlled." if claim.kind == HAZARD else "Shown to hold."
        if many is not None:
            yield f"All {counted(many, 'situation')} that can be reached were looked at."
    elif verdict.verdict == FAILS:
        yield "Open: this is not so in the blueprint as it is written."
        if run is not None and run.path:
            yield f"It happens after {words.names.path(run.path)}."
    else:
        yield f"Open: it is not shown ({verdict.bound or 'a limit was met'})."
    if claim.kind == HAZARD:
        yield "No way that the system chooses leads through it. If it comes about, the run holds."
