"""Who made a stage of a design cycle, and when its files were written."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from smsl_studio.blueprint.digests import digests
from smsl_studio.front.design.matter import CLOSURE, DesignMatter
from smsl_studio.front.design.stages import MODEL, PERSON, PHYSICS, RULES, StageMaker

DRAWN = StageMaker(PERSON, "Drawn by hand")
BY_HAND = StageMaker(PERSON, "By hand")
_HOW = {
    "rules": StageMaker(RULES, "Rules"),
    "pddl": StageMaker(RULES, "Planning problem"),
    "explore": StageMaker(PHYSICS, "Physics"),
}
_MODELS = {"reader": StageMaker(RULES, "Reader, no model"), "by hand": BY_HAND}


def maker_of(model: str) -> StageMaker:
    """Return who a provider of answers is, by the name of its model."""
    return _MODELS.get(model) or StageMaker(MODEL, f"Model {model}"[:80])


def designer(matter: DesignMatter) -> StageMaker:
    """Return who made the blueprint. A person who changed what was generated stands behind."""
    origin = matter.origin
    if not origin:
        return DRAWN
    how = str(origin.get("how", ""))
    made = maker_of(str(origin.get("model", "?"))) if how == "text" else _HOW.get(how)
    made = made or StageMaker(RULES, how[:60] or "Computed")
    before = matter.generation
    if before is None or matter.digests[CLOSURE] == digests(before).closure:
        return made
    return StageMaker(PERSON, f"{made.words}, then by hand")


def model_of(matter: DesignMatter, stage: str) -> str:
    """Return the model that has answered for a stage of the text last."""
    answers = matter.head.answers if matter.head is not None else ()
    return next((one.model for one in reversed(answers) if one.stage == stage), "?")


def newest(paths: Iterable[Path | None]) -> float | None:
    """Return the time (s since 1970) of the file that was written last; None if there is none."""
    times = []
    for path in paths:
        if path is not None:
            try:
                times.append(path.stat().st_mtime)
            except (OSError, ValueError):
                continue
    return max(times, default=None)
