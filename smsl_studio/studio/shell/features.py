"""The table of features: each by its name, and what each is handed of its neighbours."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from PySide6.QtCore import QObject, QPoint, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.feature import Feature, Shell
from smsl_studio.studio.features.draw.feature import DrawFeature
from smsl_studio.studio.features.monitor.feature import MonitorFeature
from smsl_studio.studio.features.people.feature import PeopleFeature
from smsl_studio.studio.features.replay.feature import ReplayFeature
from smsl_studio.studio.features.replay.watched import Watched
from smsl_studio.studio.features.run.feature import RunFeature
from smsl_studio.studio.features.supervise.feature import SuperviseFeature
from smsl_studio.studio.running.status_words import Words
from smsl_studio.studio.running.window_parts import WindowParts
from smsl_studio.studio.shell.windows import Windows


class Features(QObject):
    """What one window can do. Iterating gives the features in the order of their menus."""

    said = Signal()
    """Other ``words`` tell how what is shown stands."""
    named = Signal()
    """``other`` may be another one than it was."""
    caret_moved = Signal(int, int)
    """Line and column of the caret in the source, from 1."""
    run_exists = Signal(bool)
    """Whether there is a run that can be stopped."""
    phase_shown = Signal(str, str, str)
    """Words and kind of the phase of the run, and the sentence about it."""

    def __init__(self, parts: WindowParts, shell: Shell, windows: Windows) -> None:
        super().__init__(parts.window)
        tokens = parts.tokens
        self.draw = DrawFeature(parts, shell)
        self.run = RunFeature(parts, shell, windows.spare)
        pane, run = self.run.pane, self.run.pane.run
        self.monitor = MonitorFeature(run, tokens, pane)
        self.supervise = SuperviseFeature(parts, shell, run)
        self.people = PeopleFeature(parts, shell, run, pane.levels, windows.persons)
        self.replay = ReplayFeature(parts, shell, lambda: self.draw.safety.untouched)
        self.run.asked = Watched(pane, self.replay.verbs.replay, lambda: shell.mode)
        self.run.shown_elsewhere = self.supervise.pane.isVisible
        self._introduce(windows)

    def __iter__(self) -> Iterator[Feature]:
        yield from (self.draw, self.run, self.supervise, self.people, self.monitor, self.replay)

    def _introduce(self, windows: Windows) -> None:
        pane, supervise, people = self.run.pane, self.supervise.pane, self.people.people
        pane.monitor_wanted.connect(self.monitor.opener.toggle)
        supervise.begin_wanted.connect(pane.play)
        pane.reset_wanted.connect(lambda: supervise.ask_for("reset"))
        windows.persons.changed.connect(supervise.refresh)
        people.take_places(supervise.task_slot, supervise.add_levels)
        people.hear(supervise)
        pane.moved.connect(self.draw.outline.set_run)
        pane.moved.connect(self._light_source)
        self.draw.source.caret_moved.connect(self.caret_moved)
        pane.run_exists.connect(self.run_exists)
        pane.said.connect(self.said)
        pane.said.connect(self._tell_phase)
        pane.named.connect(self.named)
        self.replay.verbs.pane.said.connect(self.said)
        self.replay.verbs.replay.opened.connect(lambda *_: self.named.emit())

    def words(self, mode: str) -> Words:
        """What the status line says: of the replay while that is shown, else of the run."""
        return self.replay.verbs.pane.words if mode == "replay" else self.run.pane.words

    def other(self, mode: str) -> str:
        """The file that a mode shows in place of the drawing; the empty text where it is that."""
        if mode in ("run", "supervise"):
            return self.run.pane.other
        return self.replay.file if mode == "replay" else ""

    def tell_caret(self) -> None:
        """Tell ``caret_moved`` again, while one works in the source."""
        self.draw.source.tell_caret()

    def below(self, top: QWidget) -> QWidget:
        """The top of the window, with the bar below it that asks about a changed file."""
        return self.draw.safety.below(top)

    def open_palette(self, corner: QPoint) -> None:
        """Find anything by typing, in a list below ``corner``."""
        self.draw.palette.open(corner)

    def mode_shown(self) -> None:
        """Another mode is shown: a run may begin in it."""
        self.run.warming.soon()

    def keep_unsaved(self) -> bool:
        """Write the journal now; whether there is unsaved work."""
        return self.draw.safety.journal.flush()

    def leave_behind(self) -> bool:
        """Keep unsaved work for the next start; whether there is any."""
        return self.draw.safety.journal.leave_behind()

    def may_leave(self, ask: Callable[[str], bool]) -> bool:
        """Whether the window may go; ``ask`` asks the person about a run that has not ended."""
        return self.run.may_leave(ask)

    def stop_run(self) -> None:
        """A controlled stop of the run."""
        self.run.pane.stop()

    def stop(self) -> None:
        """The window goes away: the run is ended first, and nothing unsaved is given up before."""
        self.end_run()
        for feature in (self.replay, self.draw):
            feature.stop()

    def end_run(self) -> None:
        """Stop the run and let go of it, with the page beside it."""
        self.monitor.stop()
        self.run.stop()

    def _light_source(self, active: Mapping[str, str], _: str) -> None:
        """Light in the text where the run stands."""
        there = active if self.run.pane.run.exists else {}
        self.draw.source.set_active(Address(sb, state) for sb, state in there.items())

    def _tell_phase(self) -> None:
        run = self.run.pane.run
        self.phase_shown.emit(*phase_words(run.phase), run.sentence)
