"""Integrity while nothing is carried out: critical facts, and asking people for what they know."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.dispatch.drive.conduct import Conduct
from smsl_studio.dispatch.execution.desk import Desk
from smsl_studio.dispatch.execution.needed import all_theirs, in_checks
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.safeguards import lost_critical, lost_terms
from smsl_studio.dispatch.execution.trouble import Trouble


class Integrity:
    """Holds a run that has begun where a critical fact is lost."""

    def __init__(self, run: LiveRun, desk: Desk, trouble: Trouble, conduct: Conduct) -> None:
        self._run, self._desk, self._trouble, self._conduct = run, desk, trouble, conduct

    def informed(self, then: Callable[[], None]) -> None:
        """Do it once people were asked for those facts of the active states that are unknown and
        theirs to say; at once where there are none, or nobody is there."""
        run = self._run
        run.look()
        facts = in_checks(run, run.checks(run.configuration))
        if not facts or self._desk.ask(facts, lambda _: then(), keep=True):
            then()

    def lost(self) -> bool:
        """Hold where a critical fact is false or unknown; whether that is so.

        It holds at once, whatever people are being asked. Only where all that is lost is theirs to
        say they are asked first, or may finish what they are asked already.
        """
        run = self._run
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
