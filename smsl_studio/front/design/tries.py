"""What the page of the design cycle does for a stage: tries, and what it remembers of them."""

from __future__ import annotations

import time
from dataclasses import replace

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.design.cycle import DesignCycle
from smsl_studio.front.design.generation import notes_or_none
from smsl_studio.front.design.matter import OF
from smsl_studio.front.design.notes import MakerKind, StageNote, write_notes
from smsl_studio.front.design.stages import (
    BRANCHES,
    PERSON,
    PHYSICS,
    RULES,
    TESTING,
)
from smsl_studio.front.shapes import identify
from smsl_studio.front.sweeps import sweep
from smsl_studio.inspection.rules.words import counted
from smsl_studio.runlog.events import SweepFinished
from smsl_studio.world.engines import TABLE


def try_cuts(blueprint: Blueprint, cycle: DesignCycle) -> StageNote:
    """Return what rules say about states that could be a sub-SB. PlanningError or RunRefused as
    ``identify``. It heeds a stop."""
    cuts = identify(blueprint).cuts
    words = f"{counted(len(cuts), 'cut')} possible" if cuts else "no cut possible"
    return _note(BRANCHES, RULES, "Rules, all cuts tried", cycle, words, not cuts)


def try_operations(blueprint: Blueprint, cycle: DesignCycle, world: str, robot: str) -> StageNote:
    """Return how a sweep of every operation ended. Errors as ``sweep``; it heeds a stop."""
    host = "local" if world == TABLE else "process"
    events = sweep(blueprint, world, robot=robot, host=host)
    done = next(one for one in events if isinstance(one, SweepFinished))
    words = f"Sweep {done.passed} of {done.edges}"
    kind: MakerKind = RULES if world == TABLE else PHYSICS
    good = done.passed == done.edges
    return _note(TESTING, kind, f"Sweep, world {world}", cycle, words, good)


def still_holds(stage: int, cycle: DesignCycle, person: str) -> StageNote:
    """Return that a person has looked at a stage and says that it holds for what is there now."""
    return _note(stage, PERSON, person or "A person", cycle, "still holds", good=True)


def keep_note(file: str, note: StageNote) -> None:
    """Write a note beside the blueprint. SaveError if that fails."""
    notes = notes_or_none(file)
    write_notes(replace(notes, done={**notes.done, note.stage: note}), file)


def _note(
    stage: int, kind: MakerKind, who: str, cycle: DesignCycle, words: str, good: bool
) -> StageNote:  # fmt: skip
    of = {name: cycle.digests[name] for name in OF[stage] if name in cycle.digests}
    return StageNote(stage=stage, kind=kind, who=who[:300], of=of, words=words[:300], good=good,
                     time=float(int(time.time())))  # fmt: skip
