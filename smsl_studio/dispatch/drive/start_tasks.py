"""The part of people in the start of a run: they tell facts and accept findings."""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.dispatch.drive.conduct import Conduct
from smsl_studio.dispatch.drive.start import start_events
from smsl_studio.dispatch.execution.desk import Desk, no_words
from smsl_studio.dispatch.execution.needed import in_checks
from smsl_studio.dispatch.execution.run import LiveRun
from smsl_studio.dispatch.execution.senses import SensedEvent
from smsl_studio.dispatch.execution.trouble import Hold
from smsl_studio.dispatch.people.board import ANSWERED, Closed
from smsl_studio.dispatch.people.questions import start_task
from smsl_studio.errors import RunRefused

WATCH = 3.0
"""The longest time (s) that sources elsewhere are watched before the start is decided."""


class StartTasks:
    """The tasks between an opened world and the first operation.

    First people tell the facts of the start that only they know. Then the state checks of the start
    follow. If ``findings`` is not empty, a person must then accept the findings of inspection.
    ``goals`` and ``seed`` are for the record.

    ``told`` says that the run has begun, which means that the world was checked at the start.
    ``over`` says that it may move.
    """

    def __init__(
        self,
        run: LiveRun,
        desk: Desk,
        conduct: Conduct,
        seed: int,
        goals: Sequence[Address],
        findings: str,
    ) -> None:
        self._run, self._desk, self._conduct = run, desk, conduct
        self._seed, self._goals, self._findings = seed, tuple(goals), findings
        self.told = self.over = False

    def go_on(self) -> None:
        """Go on as far as possible now. RunRefused if the world is not at the start, or if nobody
        is there to tell.
        """
        if self.told:
            self._accepted()
            return
        run = self._run
        changes = (*run.senses.look(), *self._watched())
        facts = in_checks(run, run.checks(run.configuration))
        if not facts:
            self._tell(changes)
            return
        run.emit(*changes)
        nobody = self._desk.ask(facts, self._said)
        if nobody:
            raise RunRefused(
                nobody,
                advice="Run it where somebody answers, or by a script that does, or let sensors "
                "say what it asks.",
            )

    def _watched(self) -> tuple[SensedEvent, ...]:
        """Watch sources elsewhere for a while, if the start needs that. Return what they told.

        A predicate with ``for`` or ``age`` cannot be known at the first look. Nothing moves yet.
        """
        run, elsewhere = self._run, self._run.opened.remote
        if elsewhere is None:
            return ()
        measured = {(s.branch, s.digit) for s in run.opened.sensors if s.remote and s.unit}
        until = elsewhere.clock() + WATCH
        changes: list[SensedEvent] = []
        while measured & self._unknown() and elsewhere.clock() < until:
            elsewhere.wait()
            changes += run.senses.listen()
        return tuple(changes)

    def _unknown(self) -> set[FactKey]:
        """Return the facts of the start that are unknown."""
        checks = self._run.checks(self._run.configuration)
        return {term.fact for check in checks for term in check.terms if term.truth is None}

    def _said(self, closed: tuple[Closed, ...]) -> None:
        no = no_words(closed)
        try:
            if no:
                raise RunRefused(no, advice="The start must be known before anything moves.")
            self._tell(())
        except RunRefused as refused:
            self._conduct.finish("refused", refused.words, refused.told)

    def _tell(self, changes: tuple[SensedEvent, ...]) -> None:
        self._run.emit(*start_events(self._run, self._seed, self._goals, changes))
        self.told = True
        self._accepted()

    def _accepted(self) -> None:
        """Ask whether the findings are accepted, if there are any."""
        if not self._findings:
            self.over = True
            return
        nobody = self._desk.ask([start_task(self._findings)], self._decided)
        if nobody:
            self._conduct.hold(Hold(nobody, (self._findings,)))

    def _decided(self, closed: tuple[Closed, ...]) -> None:
        if closed[0].yes:
            self._findings, self.over = "", True
        elif closed[0].outcome == ANSWERED:
            self._conduct.finish("refused", f"The findings were not accepted: {no_words(closed)}.")
        else:
            self._conduct.hold(Hold(no_words(closed), (self._findings,)))
