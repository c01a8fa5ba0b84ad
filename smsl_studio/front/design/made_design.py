"""The generative stages of a design cycle: text, states, State Branches, the whole blueprint."""

from __future__ import annotations

from smsl_studio.front.design import found
from smsl_studio.front.design.makers import designer, newest
from smsl_studio.front.design.matter import CLOSURE, STATES, SUBS, TEXTS, DesignMatter
from smsl_studio.front.design.stages import (
    BAD,
    BRANCHES,
    FSM,
    GOOD,
    HFSM,
    PERSON,
    TEXT,
    UNKNOWN,
    WARNING,
    DesignStage,
    StageMaker,
    StageVerdict,
)
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.inspection.rules.sources import cited_parts, uncited
from smsl_studio.inspection.rules.words import counted
from smsl_studio.seal.digest import digest_of


def text_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 1: the texts of people who know the procedure, and the lists of hardware."""
    texts = (*matter.texts, *matter.hardware_texts)
    if not texts:
        return DesignStage(TEXT)
    lacks = next((one.lacks for one in texts if one.lacks), "")
    lines = sum(len(one.text.lines) for one in texts if one.text is not None)
    words = f"{counted(len(texts), 'text')}, {counted(lines, 'line')}"
    return DesignStage(
        TEXT,
        StageMaker(PERSON, "Written by people"),
        digest_of([one.text.digest if one.text is not None else "" for one in texts]),
        newest(one.path for one in texts),
        StageVerdict(words, UNKNOWN if lacks else GOOD),
        lacks=lacks,
    )


def states_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 2: states and operations, each with the words from which it was made."""
    blueprint, origin, note = matter.blueprint, matter.origin, matter.note(FSM)
    if not blueprint.state_count:
        return DesignStage(FSM)
    how = origin.get("how")
    of = {TEXTS: str(origin.get("digest", ""))} if how in ("text", "rules") else {}
    looked = note is not None and not matter.changed(note.of)
    return DesignStage(
        FSM,
        designer(matter),
        matter.digests[STATES],
        newest([matter.path]),
        _states_verdict(matter),
        () if looked else matter.changed(of),
        is_generated=matter.is_generated,
    )


def _states_verdict(matter: DesignMatter) -> StageVerdict:
    blueprint = matter.blueprint
    failing = [one for one in found.kept_verdicts(matter.folder) if one.verdict != HOLDS]
    if failing:
        fails = any(one.verdict == FAILS for one in failing)
        told = f"{counted(len(failing), 'requirement')} not met"
        return StageVerdict(told, BAD if fails else UNKNOWN)
    bare = sum(1 for _ in uncited(blueprint))
    if bare or matter.origin.get("how") == "text":
        every = sum(1 for _ in cited_parts(blueprint))
        return StageVerdict(f"{every - bare} of {every} have a source", WARNING if bare else GOOD)
    states = counted(blueprint.state_count, "state")
    return StageVerdict(f"{states}, {counted(blueprint.operation_count, 'operation')}")


def branches_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 3: which states are a State Branch of their own."""
    subs = {sub for one in matter.blueprint for sub in one.subs.values()}
    note = matter.note(BRANCHES)
    if not matter.blueprint.state_count or not (subs or note):
        return DesignStage(BRANCHES)
    digest, words = matter.digests[SUBS], counted(len(subs), "sub-SB")
    if note is None:
        return DesignStage(
            BRANCHES, designer(matter), digest, newest([matter.path]), StageVerdict(words),
            is_generated=matter.is_generated,
        )  # fmt: skip
    maker = designer(matter) if subs else StageMaker(note.kind, note.who)
    return DesignStage(
        BRANCHES, maker, digest, note.time,
        StageVerdict(f"{words}, {note.words}", GOOD if note.good else WARNING),
        matter.changed(note.of), is_generated=bool(subs) and matter.is_generated,
    )  # fmt: skip


def whole_stage(matter: DesignMatter) -> DesignStage:
    """Return stage 4: the whole blueprint, as it is signed."""
    if not matter.blueprint.state_count:
        return DesignStage(HFSM)
    errors = len(matter.check.of(Severity.ERROR))
    warnings = len(matter.check.of(Severity.WARNING))
    words = f"{counted(errors, 'error')}, {counted(warnings, 'warning')}"
    return DesignStage(
        HFSM, designer(matter), matter.digests[CLOSURE], newest([matter.path]),
        StageVerdict(words, BAD if errors else WARNING if warnings else GOOD),
        lacks=counted(errors, "error") if errors else "", is_generated=matter.is_generated,
    )  # fmt: skip
