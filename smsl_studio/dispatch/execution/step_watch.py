"""The watch over one joint step: the facts that it needs, and the hazards that must not be met."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.joint import JointAction, JointStep
from smsl_studio.dispatch.execution.hazard_guard import met_words, newly_met, tell
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.safeguards import Safeguards
from smsl_studio.dispatch.people.board import Question


class StepWatch:
    """Watches a step while it is carried out.

    ``lost`` has sentences about needed facts that were false or unknown, and about hazards that
    were met. They stay, because a step that has lost a fact commits nothing any more. ``met`` are
    the names of the hazards that were met, or that refused the next function.
    """

    def __init__(self, run: LiveRun, step: JointStep) -> None:
        self.lost: tuple[str, ...] = ()
        self.met: tuple[str, ...] = ()
        self._run = run
        self._rests = Safeguards(run, step)

    def begin(self, action: JointAction) -> bool:
        """Return whether an action may not begin, because a hazard is met or a fact is lost. From
        now on the facts that the action changes are left out.
        """
        if not (self._run.hazards and self.notice()):
            self.lost = self._rests.begin(action)
        return bool(self.lost)

    def end(self, action: JointAction) -> None:
        """Note that the state check of an action was true."""
        self._rests.end(action)

    def notice(self, wants: Sequence[Question] = ()) -> bool:
        """Return whether the step has just lost a needed fact, or a hazard is met just now. Facts
        that people are asked for (``wants``) are left out.
        """
        hazards = newly_met(self._run)
        if hazards:
            tell(self._run, hazards)
            self.met += tuple(one.name for one in hazards)
            self.lost += met_words(hazards)
        if self.lost:
            return bool(hazards)
        asked = (split_fact(one.address) for one in wants if one.kind == "fact")
        self.lost = self._rests.lost([fact for fact in asked if fact is not None])
        return bool(self.lost)

    def refused_by(self, hazard: str) -> None:
        """Note that a hazard refuses the next function. Nothing else was met."""
        self.met = (hazard,)
