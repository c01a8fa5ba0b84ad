"""The watch over one joint step: the facts that it needs, and the hazards that must not be met."""

from __future__ import annotations

from collections.abc import Collection

from .elements import FactKey
from .guards import Safeguards
from .hazards import met, met_words, tell
from .joint import Action
from .live import NOTHING, LiveRun


class StepWatch:
    """Watches a step while it is carried out.

    ``lost`` has sentences about needed facts that were lost and hazards that were met. They stay: a
    step that has lost a fact commits nothing any more. ``met`` are the names of these hazards.
    """

    def __init__(self, run: LiveRun) -> None:
        self.lost: list[str] = []
        self.met: list[str] = []
        self._run = run
        self._rests = Safeguards(run)

    def begin(self, action: Action) -> bool:
        """Return whether an action may not begin."""
        if not self.notice():
            self.lost = self._rests.begin(action)
        return bool(self.lost)

    def end(self, action: Action) -> None:
        """Note that the check of an action was true."""
        self._rests.end(action)

    def notice(self, asked: Collection[FactKey] = NOTHING) -> bool:
        """Return whether the step has just lost a needed fact, or a hazard is met just now."""
        hazards = [one for one in met(self._run) if one.name not in self._run.told_hazards]
        if hazards:
            tell(self._run, hazards)
            self.met += [one.name for one in hazards]
            self.lost += met_words(hazards)
        if self.lost:
            return bool(hazards)
        self.lost = self._rests.lost(asked)
        return bool(self.lost)

    def refused_by(self, hazard: str) -> None:
        """Note that a hazard refuses the next function."""
        self.met = [hazard]
