"""The body of Replay mode: canvas, facts, events and timeline of a recorded run."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.recordings import ANOTHER, Recording
from smsl_studio.front.views.fact_rows import as_they_were, fact_rows, last_check
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.front.views.timeline_lanes import present_blocks
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.panels import panel
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import capital, counted
from smsl_studio.studio.document.places import Places
from smsl_studio.studio.features.replay.event_table import EventTable
from smsl_studio.studio.features.replay.recorded_plot import RecordedPlot
from smsl_studio.studio.features.replay.replay import Replay
from smsl_studio.studio.running.facts_table import COLUMNS, FactsTable
from smsl_studio.studio.running.frames import head, split
from smsl_studio.studio.running.run_canvas import TROUBLE, RunCanvas
from smsl_studio.studio.running.state_check import StateCheckView
from smsl_studio.studio.running.status_words import Words
from smsl_studio.studio.running.timeline import Timeline

HIGH = 800
"""In a page lower than this the plot takes the place of the state check (pixels)."""
FACTS = 260
"""The least width of the facts (pixels)."""


class ReplayCanvas(RunCanvas):
    """The canvas of a recorded run. Its banner gives no advice, because nothing can be done."""

    def _trouble(self) -> str:
        run = self._run
        if run.phase not in TROUBLE:
            return ""
        return f"{phase_words(run.phase)[0]}, in the recording: {capital(run.sentence)}"


class _Held:
    """Stands for the drawing of a replay, which is the recorded blueprint itself."""

    def __init__(self, replay: Replay, nothing: Blueprint) -> None:
        self._replay, self._nothing = replay, nothing
        self.places = Places()

    @property
    def blueprint(self) -> Blueprint:
        """The blueprint of the recording; an empty one without a recording."""
        return self._replay.blueprint or self._nothing


class ReplayPane(QWidget):
    """Shows the recording and the moment of ``replay``."""

    said = Signal()
    """The result of ``words`` changed."""

    def __init__(
        self, replay: Replay, nothing: Blueprint, tokens: Tokens, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._replay, self._tokens = replay, tokens
        self.note = Label()
        self.note.setProperty("role", "replay")
        self.note.setWordWrap(True)
        self.canvas = ReplayCanvas(_Held(replay, nothing), replay, tokens)
        self.canvas.canvas.collapse.join(SharedCollapse(self))
        self.facts, self.check = FactsTable(tokens), StateCheckView(tokens)
        self.facts.setColumnHidden(COLUMNS.index("Age"), True)
        self.plot = RecordedPlot(replay, tokens)
        self.facts.chosen.connect(self.plot.choose)
        self.plot.changed.connect(self._fit_plot)
        self.events = EventTable()
        self.timeline = Timeline(tokens)
        self._build()
        replay.opened.connect(self._show_run)
        replay.changed.connect(self._show_moment)
        self.events.index_wanted.connect(replay.to_index)
        self.timeline.time_wanted.connect(replay.to_time)

    def hasHeightForWidth(self) -> bool:
        """False: the note above has several lines, but the page is as high as its window.

        Else the scroll area around it would give it the height that all its parts wish for.
        """
        return False

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for part in (self.canvas, self.facts, self.check, self.timeline, self.plot):
            part.set_tokens(tokens)
        self._show_moment()

    def _build(self) -> None:
        self._count = label("", "small")
        events = panel(head("Events", None, self._count), self.events)
        facts = panel(head("Facts, as they were sensed"), self.facts)
        facts.setMinimumWidth(FACTS)
        below = split(
            Qt.Orientation.Horizontal, (facts, panel(self.check, self.plot)), (428, 383), (1, 1)
        )
        right = split(Qt.Orientation.Vertical, (events, below), (300, 250), (1, 0))
        above = split(Qt.Orientation.Horizontal, (self.canvas, right), (628, 811), (44, 56))
        whole = split(Qt.Orientation.Vertical, (above, self.timeline), (626, 160), (1, 0))
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.note)
        column.addWidget(whole, 1)

    def _fit_plot(self) -> None:
        """Leave the state check out in a low page while the plot needs its room."""
        self.check.setHidden(self.plot.fact is not None and self.height() < HIGH)

    def _show_run(self) -> None:
        recording = self._replay.recording
        if recording is None:
            return
        self.note.setText(note_words(recording))
        good = not recording.doubt and not recording.differs
        self.note.setProperty("kind", "good" if good else "bad")
        self.note.style().unpolish(self.note)
        self.note.style().polish(self.note)
        events = recording.playback.events
        self.events.show_events(events, recording.causes, recording.blueprint)

    def _show_moment(self) -> None:
        replay, status, blueprint = self._replay, self._replay.status, self._replay.blueprint
        if status is None or blueprint is None or replay.recording is None:
            return
        self.canvas.refresh()
        # A log says when a reading changed, but not how old it was.
        self.facts.show_rows(as_they_were(fact_rows(blueprint, status)))
        check = status.check or last_check(blueprint, status, lost=False)
        self.plot.refresh()
        self.check.show_check(blueprint, check, waiting=status.running is not None)
        self.events.show_index(replay.index)
        self._count.setText(f"{replay.index:,} of {replay.count:,}")
        rows = replay.recording.lanes
        present = present_blocks(blueprint, rows, replay.story.moment)
        self.timeline.show_lanes(rows, replay.time, present)
        self.said.emit()

    @property
    def words(self) -> Words:
        """The texts of the status line, for the left and the right side."""
        replay, recording = self._replay, self._replay.recording
        if recording is None:
            return (), ()
        world, seed = recording.asked("world"), recording.asked("seed")
        moment = f"Simulated {replay.time:.1f} s", f"Event {replay.index:,} of {replay.count:,}"
        left = ("REPLAY", f"World {world}", f"Seed {seed}", *moment, capital(replay.sentence))
        trust = "Not verified" if recording.doubt else "Verified"
        return left, (trust, "Recorded, nothing can be commanded")


def note_words(recording: Recording) -> str:
    """The note above a replay: what is shown, and whether the log could be verified."""
    when = str(recording.asked("wall_time") or "")[:19].replace("T", " ")
    said = [f"REPLAY of {recording.path.name}"]
    if when:
        said.append(f"recorded {when} UTC")
    file = Path(str(recording.asked("file") or "")).name
    if file:
        said.append(f"a run of {file}")
    who = recording.asked("supervisor")
    if isinstance(who, str) and who:
        said.append(f"supervised by {who}")
    words = ", ".join(said) + ". "
    if recording.doubt:
        doubt = recording.run.doubt
        line = f"line {doubt.place.line}: " if doubt else ""
        words += f"NOT VERIFIED, {line}{recording.doubt}."
    else:
        events = counted(len(recording.playback), "event")
        words += f"Verified: {events}, chain and head hold."
    return f"{words} {ANOTHER}." if recording.differs else words
