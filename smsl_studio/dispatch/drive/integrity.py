"""Integrity while no step is carried out: critical facts, and questions for facts that people
know.
"""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.dispatch.drive.conduct import Conduct
from smsl_studio.dispatch.drive.hazard_watch import HazardWatch
from smsl_studio.dispatch.execution.desk import Desk
from smsl_studio.dispatch.execution.needed import all_theirs, in_checks
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.safeguards import lost_critical, lost_terms
from smsl_studio.dispatch.execution.trouble import Trouble


class Integrity:
    """Holds a run that has begun if a critical fact is lost or a hazard is met."""

    def __init__(
        self, run: LiveRun, desk: Desk, trouble: Trouble, conduct: Conduct, hazards: HazardWatch
    ) -> None:
        self._run, self._desk, self._trouble, self._conduct = run, desk, trouble, conduct
        self._hazards = hazards

    def informed(self, then: Callable[[], None]) -> None:
        """Call ``then`` after people were asked for the unknown facts of the active states that
        they may tell. Call it at once if there are no such facts, or if nobody will answer.
        """
        run = self._run
        run.look()
        facts = in_checks(run, run.checks(run.configuration))
        if not facts or self._desk.ask(facts, lambda _: then(), keep=True):
            then()

    def lost(self) -> bool:
        """Hold if a hazard is met, or a critical fact is false or unknown. Return whether this is
        so.

        The run holds at once, even while people are asked something else. Only if people may tell
        all lost facts, they are asked first, or may finish their open questions about facts.
        """
        run = self._run
        if run.hazards and self._hazards.holds():
            return True
        if not lost_critical(run):
            return False
        theirs = all_theirs(run, lost_terms(run))
        if theirs and self._desk.keeps:
            return False
        self._conduct.withdraw()
        if theirs:
            self.informed(self._hold)
        else:
            run.look()
            self._hold()
        return True

    def _hold(self) -> None:
        facts = lost_critical(self._run)
        self._conduct.hold(self._trouble.lost(facts) if facts else None)
