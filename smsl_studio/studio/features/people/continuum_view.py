"""From the levels of a blueprint to the rows of the continuum: pure functions without widgets."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.continuum import AUTOMATIC, HUMAN, SHARED
from smsl_studio.blueprint.levels import Levels, Share, Spectrum, spectrum
from smsl_studio.blueprint.model import Blueprint

PLACE = {HUMAN: 0.0, SHARED: 0.5, AUTOMATIC: 1.0}
"""The place of each level on the scale: 0 is a person alone, 1 is the automation alone."""
INSPECTS = {HUMAN: "a person accepts", SHARED: "a person, if need be", AUTOMATIC: "rules alone"}
SUPERVISES = {HUMAN: "human leads", SHARED: "human may step in", AUTOMATIC: "agent decides"}
STEPS = ((0.1, "human"), (0.4, "mostly human"), (0.6, "shared"), (0.9, "mostly automatic"))


@dataclass(frozen=True)
class ScaleView:
    """One row: the mean level and the range of levels, from 0 (human) to 1 (automatic)."""

    name: str
    position: float
    low: float
    high: float
    words: str


@dataclass(frozen=True)
class ContinuumView:
    """All rows, and the place and words of the whole procedure."""

    rows: tuple[ScaleView, ...]
    position: float
    words: str


def continuum_view(blueprint: Blueprint, levels: Levels) -> ContinuumView:
    """The rows of a blueprint with these levels."""
    found = spectrum(blueprint, levels)
    rows = (
        _row("Operations", found.operations, share_words(found.operations)),
        _row("Facts", found.facts, share_words(found.facts)),
        _row("Inspection", found.inspection, INSPECTS[levels.inspection]),
        _row("Supervision", found.supervision, SUPERVISES[levels.supervision]),
    )
    return ContinuumView(rows, found.position, whole_words(found))


def share_words(share: Share) -> str:
    """The first level that occurs, with its number: ``2 of 7 human``, ``5 automatic``, ``none``."""
    counts = ((share.human, HUMAN), (share.shared, SHARED), (share.automatic, AUTOMATIC))
    for count, level in counts:
        if count:
            return (
                f"{count} {level}" if count == share.count else f"{count} of {share.count} {level}"
            )
    return "none"


def whole_words(found: Spectrum) -> str:
    """The place of the whole procedure in one or two words."""
    return next((words for most, words in STEPS if found.position < most), "automatic")


def _row(name: str, share: Share, words: str) -> ScaleView:
    counts = ((share.human, HUMAN), (share.shared, SHARED), (share.automatic, AUTOMATIC))
    places = [PLACE[level] for count, level in counts if count] or [0.5]
    return ScaleView(name, share.position, min(places), max(places), words)
