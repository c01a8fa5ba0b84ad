"""The run of a window: its blueprint, its runner thread, its status and story.

Widgets read it and listen to ``changed``. They command it by the commands of supervision. The run
keeps the blueprint with which it was started, whatever is drawn meanwhile.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.dispatch.supervision.row import PERSON, Command
from smsl_studio.dispatch.supervision.table import COMMANDS, Commands
from smsl_studio.errors import StudioError
from smsl_studio.front.proposed_edges import keep_answers, proposer_of
from smsl_studio.front.request import RunRequest
from smsl_studio.front.script.player import ScriptPlayer
from smsl_studio.front.script.script import Act
from smsl_studio.front.script_text import script_text
from smsl_studio.host.spare import Spare
from smsl_studio.library.loaded import Loaded
from smsl_studio.runlog.decisions import DecidedBy, deciders, told_by
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.history import Story
from smsl_studio.runlog.playback import RunObserver
from smsl_studio.studio.running.forecaster import Forecaster
from smsl_studio.studio.running.operation_time import OperationTime, ShownTime
from smsl_studio.studio.running.run_blueprint import RunBlueprint
from smsl_studio.studio.running.run_choice import RunChoice
from smsl_studio.studio.running.run_opener import RunOpener
from smsl_studio.studio.running.run_world import RunWorld
from smsl_studio.studio.running.runner import Runner

PLANNING = "the route is being planned"
ENDABLE = ("stopped", "fault_hold", "no_route")
"""The run states in which a run can be ended."""
FRAME = 33
"""Milliseconds between two readings of the run's news."""


def nobody_named() -> str:
    """The name in a record if nobody gave a name."""
    return PERSON


class RunSession(RunWorld, Commands):
    """The run of this window. There is at most one; a new one ends the old one.

    It is commanded by the methods of ``Commands``. ``who`` returns the person in whose name. A
    command takes effect at the next tick. The run's events (``commanded``) tell whether it was done
    or refused.
    """

    who = staticmethod(nobody_named)

    changed = Signal()
    """The status or the story has changed."""
    progressed = Signal()
    """The result of ``shown_time`` changed."""
    events_told = Signal(object)
    """tuple[Event]: new events of the run, in order."""
    opened = Signal()
    """The world is ready, so its shapes can be drawn."""
    exists_changed = Signal(bool)
    """bool: whether there is a run that can be stopped."""
    way_wanted = Signal()
    """The person wants a provider to propose operations that lead on."""
    refused = Signal(object)
    """A StudioError: the run could not be opened, and nothing moved."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._of = RunBlueprint()
        self.status: DispatchStatus | None = None
        self._told = RunObserver()
        self._decisions: list[Event] = []
        self.caution: Callable[[], tuple[str, ...]] = tuple
        """Returns what the next run cannot give although its levels ask for it, in sentences."""
        self.choice: RunChoice | None = None
        self.foreign = False
        """Whether another file was opened since this run began."""
        self._runner: Runner | None = None
        self._exists = False
        self._shown: ShownTime | None = None
        self._asked: RunRequest | None = None
        self._loaded: Loaded | None = None
        self._steps_first = False
        self._goes_on = self._ends = False
        self.recordings: Path | None = None
        """The folder for the log of the next run; None if it is not recorded."""
        self._opening: RunOpener | None = None
        self.spare: Spare | None = None
        """A child process kept ready for the next run; None if each run starts its own."""
        self._clock = QTimer(self)
        self._clock.setInterval(FRAME)
        self._clock.timeout.connect(self._listen)

    @property
    def blueprint(self) -> Blueprint | None:
        """The blueprint of the run, with the edges that count in it alone; None without a run."""
        return self._of.shown

    @blueprint.setter
    def blueprint(self, blueprint: Blueprint | None) -> None:
        self._of.begin(blueprint)

    @property
    def record(self) -> Path | None:
        """The log of the present or last run; None if it was not recorded."""
        return self._opening.written if self._opening is not None else None

    @property
    def exists(self) -> bool:
        """Whether there is a run that has not ended."""
        return self._exists

    @property
    def shown(self) -> bool:
        """Whether there is something to show: a run, or the results of the last one."""
        return self.blueprint is not None and (self._exists or self.status is not None)

    def is_another(self, drawn: Blueprint) -> bool:
        """Whether the shown run differs from the drawing: it is of another file, or of other
        content."""
        return self.shown and (self.foreign or self._of.differs(drawn))

    @property
    def story(self) -> Story:
        """What has happened so far, folded from the events of the run."""
        return self._told.story

    @property
    def phase(self) -> str:
        """The phase of the run in one word, or why it ended; empty without a run."""
        if self._runner is None:
            return ""
        return "opening" if self.status is None else self.story.moment.phase

    @property
    def over(self) -> bool:
        """Whether a run has ended, so that ``phase`` says how."""
        return not self._exists and self.story.moment.finished is not None

    @property
    def time(self) -> float:
        """The simulated time in seconds; 0 without a run."""
        return max(self.story.moment.time, self.status.time if self.status is not None else 0.0)

    @property
    def sentence(self) -> str:
        """Why the run holds or ended; empty while it goes on."""
        if self.story.moment.finished is not None:
            return self.story.moment.sentence
        if self.status is None:
            return ""
        planning = PLANNING if self.status.planning and self.status.phase == "running" else ""
        return self.status.sentence or planning

    @property
    def latency(self) -> float | None:
        """The wall time in seconds that the world's process needs for a tick.

        None without a run.
        """
        return self._runner.latency if self._runner is not None and self._exists else None

    @property
    def shown_time(self) -> ShownTime | None:
        """The time for which the running operation is shown; None if it takes its own time."""
        return self._runner.shown_time if self._runner is not None and self._exists else None

    @property
    def script(self) -> str:
        """What people did by hand in this run, as the text of a script; empty for nothing."""
        lines, asked = self.lines, self._asked
        return script_text(asked, lines) if lines and asked is not None else ""

    @property
    def asked(self) -> tuple[RunRequest, Loaded | None] | None:
        """The request of the run, and the plugins as they were found then; None without a run."""
        return (self._asked, self._loaded) if self._asked is not None and self._exists else None

    @cached_property
    def forecaster(self) -> Forecaster:
        """What forecasts operations beside this run. Its world is kept as long as the run lives."""
        made = Forecaster(self)
        self.exists_changed.connect(lambda on: None if on else made.clear())
        self.events_told.connect(made.hear)
        return made

    @property
    def deciders(self) -> tuple[DecidedBy, ...]:
        """The people and agents that have decided something in this run, and what it was."""
        asked = self._asked
        agents = " and ".join(asked.agents) if asked is not None else ""
        return deciders(self._decisions, agents)

    @property
    def lines(self) -> tuple[Mapping[str, Any], ...]:
        """The same as the values of its lines."""
        return self._runner.lines if self._runner is not None else ()

    @property
    def pausing(self) -> bool:
        """Whether the run will pause by itself, because it was told to make one step."""
        return self._steps_first or (self.status is not None and self.status.pausing)

    def play_on(self) -> None:
        """Continue as soon as the run has paused by itself. Any other command cancels this."""
        self._goes_on = True

    def begin(
        self,
        blueprint: Blueprint,
        choice: RunChoice,
        speed: float,
        stepping: bool = False,
        loaded: Loaded | None = None,
    ) -> None:
        """Start a run of ``blueprint`` as it is now; the present run is closed first.

        ``speed`` is simulated seconds per wall second. ``stepping`` carries out one operation and
        then pauses. ``loaded`` are the plugins as they were found last; the run loads those anew
        that its world needs.
        """
        self.close()
        self.blueprint = blueprint
        self.choice, self.foreign = choice, False
        self.status, self.shapes, self.sensors = None, (), ()
        self._told, self._decisions = RunObserver(), []
        request = self._asked = choice.request(blueprint)
        self._loaded = loaded
        opening = RunOpener(request, loaded, self.recordings, self.who(), self.spare)
        self._opening = opening
        runner = Runner(
            opening.dispatcher,
            speed,
            self,
            opening.log,
            ScriptPlayer(choice.script, stays=True) if choice.script is not None else None,
            OperationTime(blueprint),
        )
        runner.refusal = opening.refusal
        runner.opened.connect(self._open)
        runner.refused.connect(self._refuse)
        runner.broke.connect(self._break)
        self._runner = runner
        self._steps_first, self._goes_on, self._ends = stepping, False, False
        self._set_exists(True)
        if choice.by_hand:
            # As a command, so that the record and a script of this run say it, too.
            runner.command(COMMANDS["set_automatic"].command(automatic=False, by=self.who()))
        if stepping:
            runner.command(COMMANDS["step"].command(by=self.who()))
        runner.start()
        self._clock.start()
        self.changed.emit()

    @property
    def lacks_way(self) -> bool:
        """Whether the run holds because no way leads to the goal."""
        return self._exists and self.phase == "no_route"

    def ask_for_a_way(self, provider: str) -> None:
        """Let a provider propose edges, and go on. It raises the errors of ``proposer_of``."""
        if self._runner is not None and self._asked is not None and self.lacks_way:
            asked = replace(self._asked.checked(), generate=provider)
            self._runner.propose_with(proposer_of(asked, self._loaded))
            self.resume()

    def set_speed(self, speed: float) -> None:
        """Set the simulated seconds per wall second; without a run it does nothing."""
        if self._runner is not None:
            self._runner.set_speed(speed)

    @property
    def planned(self) -> tuple[Act, ...]:
        """The acts that wait for their moments."""
        return self._runner.planned if self._runner is not None else ()

    def plan(self, act: Act) -> None:
        """Have an act of a script carried out the next time that its moment comes."""
        if self._runner is not None and self._exists:
            self._runner.plan(act)

    def drop_plans(self) -> None:
        """Forget the acts that wait for their moments."""
        if self._runner is not None:
            self._runner.drop_plans()

    def close(self) -> None:
        """End the run and its world, if there is one."""
        self._clock.stop()
        runner, self._runner = self._runner, None
        self._dispatcher = None
        if runner is not None:
            runner.blockSignals(True)
            runner.close()
            runner.deleteLater()
        self._set_exists(False)

    def shut(self) -> None:
        """End the run and its forecasts, because the window closes."""
        self.close()
        if "forecaster" in vars(self):  # it is made when it is first asked for
            self.forecaster.close()

    def forget(self) -> None:
        """Forget a run that has ended, as if there had been none."""
        if not self._exists and self.blueprint is not None:
            self.close()
            self.blueprint = None
            self.status, self.choice = None, None
            self._opening, self.foreign = None, False
            self.shapes, self.sensors = (), ()
            self._told = RunObserver()
            self.changed.emit()

    def finish(self) -> None:
        """End the run for good. It can only be ended while it is stopped or holds, so it is
        stopped first. Any other command cancels the end that waits for that."""
        if self.phase in ENDABLE:
            self.end()
        else:
            self.stop()
            self._ends = True

    def take(self, command: Command) -> None:
        """Send a command, in the name of ``who`` unless it already has a name."""
        self._goes_on = self._ends = False
        if self._runner is not None and self._exists:
            named = command.by not in ("", PERSON)
            self._runner.command(command if named else replace(command, by=self.who()))

    def _open(self, dispatcher: Dispatcher) -> None:
        if self.sender() is self._runner:
            self._dispatcher = dispatcher
            opened = dispatcher.opened
            self.shapes, self.sensors = (opened.shapes, opened.sensors) if opened else ((), ())
            self.faults = opened.world_faults if opened else ()
            self.opened.emit()

    def _listen(self) -> None:
        news = self._runner.take() if self._runner is not None else None
        if news is not None:
            self._tell(*news)
        shown = self.shown_time
        if shown != self._shown:
            self._shown = shown
            self.progressed.emit()

    def _tell(self, events: tuple[Event, ...], status: DispatchStatus) -> None:
        if self._of.extend(self.status, status) and self._asked and self._of.counting:
            self._asked = replace(self._asked, blueprint=self._of.counting)
        self.status = status
        if events:
            self._told.tell(events)
            self._decisions += told_by(events)
            self.events_told.emit(events)
        if self.story.moment.finished is not None:
            self._clock.stop()
            if self._dispatcher is not None:
                keep_answers(self.record, self._dispatcher)
            self._set_exists(False)
        # The first news can be older than the step with which the run was started.
        self._steps_first &= status.phase == "running" and not status.pausing
        if self._goes_on and not self.pausing and status.phase != "waiting":
            self._goes_on = False
            if status.phase in ("paused", "ready"):
                self.resume()
        if self._ends and self._exists and status.phase == "stopped":
            self.end()
        self.changed.emit()

    def _refuse(self, error: StudioError) -> None:
        if self.sender() is self._runner:
            self.close()
            self.refused.emit(error)
            self.changed.emit()

    def _break(self, error: Exception) -> None:
        """Raise an unexpected error in the window's thread, so that it is reported."""
        if self.sender() is self._runner:
            self.close()
            self.changed.emit()
            raise error

    def _set_exists(self, exists: bool) -> None:
        if exists != self._exists:
            self._exists = exists
            self.exists_changed.emit(exists)
