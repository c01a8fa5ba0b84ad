"""What a window has of runs: the run itself, its supervision, its people, and recorded ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from PySide6.QtCore import QEventLoop, QTimer
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.host.spare import Spare
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.outline import Outline
from smsl_studio.studio.features.draw.source.pane import SourcePane
from smsl_studio.studio.features.monitor.opener import MonitorOpener
from smsl_studio.studio.features.people.people import People
from smsl_studio.studio.features.replay.playback import ReplayVerbs
from smsl_studio.studio.features.run.pane import RunPane
from smsl_studio.studio.features.run.spare_world import SpareWorld, Wanted
from smsl_studio.studio.features.supervise.pane import SupervisePane
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.phases import phase_words
from smsl_studio.studio.shell.frame.mode_bar import ModeBar
from smsl_studio.studio.shell.frame.modes import Page

PATIENCE = 3000
"""Milliseconds that a run may take to stand still before its window closes all the same."""


class Runs:
    """Made and wired once for each window; the panes of three modes are among them."""

    def __init__(
        self,
        session: Session,
        settings: Settings,
        persons: Persons,
        tokens: Tokens,
        window: QWidget,
    ) -> None:
        self.pane = RunPane(session, tokens)
        self.pane.recordings = lambda: settings.wanted_recordings
        self.monitoring = MonitorOpener(self.pane.run, tokens, self.pane)
        self.pane.monitor_wanted.connect(self.monitoring.toggle)
        self.supervise = SupervisePane(session, self.pane.run, tokens)
        self.supervise.begin_wanted.connect(self.pane.play)
        self.pane.reset_wanted.connect(lambda: self.supervise.ask_for("reset"))
        persons.changed.connect(self.supervise.refresh)
        self.people = People(session, self.pane.run, self.pane.levels, persons, tokens, window)
        self.people.take_places(self.supervise.task_slot, self.supervise.add_levels)
        self.people.hear(self.supervise)
        self.replaying = ReplayVerbs(lambda: session.blueprint, settings.recordings, tokens, window)
        self.warming = SpareWorld(self._next, window)
        for changed in (session.blueprint_changed, self.pane.run.exists_changed,
                        self.pane.transport.world.currentIndexChanged,
                        self.pane.transport.seed.textChanged):  # fmt: skip
            changed.connect(lambda *_: self.warming.soon())

    def keep_warm(self, spare: Spare | None) -> None:
        """Have the next run's world stand ready while a mode is shown in which it can begin."""
        self.warming.spare = self.pane.run.spare = spare

    def _next(self) -> Wanted | None:
        shown = self.pane.isVisible() or self.supervise.isVisible()
        return self.pane.next.wanted if shown else None

    def other(self, mode: str) -> str:
        """The file that a mode shows in place of the drawing; the empty text where it is that."""
        if mode in ("run", "supervise"):
            return self.pane.other
        recording = self.replaying.replay.recording if mode == "replay" else None
        return recording.path.name if recording is not None else ""

    def may_leave(self, ask: Callable[[str], bool]) -> bool:
        """Whether the run may end with the window: there is none, or the person agrees."""
        run = self.pane.run
        if not run.exists or run.blueprint is None or run.choice is None:
            return True
        file = Path(run.blueprint.file).name
        return ask(f"The run of {file} in {run.choice.world} has not ended.")

    def end(self) -> None:
        """Stop the run, wait until it stands or ``PATIENCE`` is over, and let go of it."""
        run = self.pane.run
        if run.exists and run.phase != "stopped":
            wait = QEventLoop(self.pane)

            def look() -> None:
                if run.phase == "stopped":
                    wait.quit()

            run.changed.connect(look)
            run.exists_changed.connect(lambda _: wait.quit())
            QTimer.singleShot(PATIENCE, wait, wait.quit)
            run.stop()
            wait.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
        self.monitoring.close()
        self.pane.shut()

    def pages(self) -> dict[str, Page]:
        """The modes in which runs are shown."""
        run, supervise, replay = self.pane, self.supervise, self.replaying
        return {
            "run": Page(run, run.canvas.canvas, run.transport),
            "supervise": Page(supervise, supervise, supervise.bar),
            "replay": Page(replay.pane, replay.transport.scrubber, replay.transport),
        }

    def set_tokens(self, tokens: Tokens) -> None:
        for part in (self.pane, self.monitoring, self.supervise, self.people, self.replaying):
            part.set_tokens(tokens)

    def light(self, outline: Outline, source: SourcePane, bar: ModeBar) -> None:
        """Show in the outline, in the text and beside Stop where the run stands."""

        def lit(active: Mapping[str, str], _: str) -> None:
            there = active if self.pane.run.exists else {}
            source.set_active(Address(sb, state) for sb, state in there.items())

        self.pane.moved.connect(outline.set_run)

        def said() -> None:
            bar.show_phase(*phase_words(self.pane.run.phase), self.pane.run.sentence)

        self.pane.moved.connect(lit)
        self.pane.said.connect(said)
