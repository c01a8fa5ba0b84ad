"""The story of the chosen run of a campaign: a small timeline, and its events."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.front.recordings import Recording
from smsl_studio.front.run_story import StoryLine, few_lanes, story_lines
from smsl_studio.front.views.event_marks import COMMIT, FAULT, HELD, PERSON
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.timeline import AXIS, PITCH, Timeline

FACTS = 3
"""The largest number of facts in the timeline."""
LANES = 6
"""So many lanes are seen at once; the others are scrolled to."""
ICONS = {FAULT: "warning", HELD: "pause", COMMIT: "check", PERSON: "person"}


class RunStory(QWidget):
    """Shows one recorded run in short, or says why there is none to show."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.title, self.seen = label("", "heading"), Elided()
        self.words = label("", "small")
        self.words.setWordWrap(True)
        self.words.setAlignment(Qt.AlignmentFlag.AlignTop | Qt.AlignmentFlag.AlignLeft)
        self.timeline = Timeline(tokens)
        self.events = RowsView(tokens, margin=4)
        self.events.setFrameShape(RowsView.Shape.NoFrame)
        self.events.setAccessibleName("Events of the chosen run")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(6)
        top = row(self.title, self.seen, spacing=10)
        top.setStretch(1, 1)
        column.addLayout(top)
        column.addWidget(self.words)
        column.addWidget(self.timeline)
        column.addWidget(self.events, 1)
        self.events.setMinimumHeight(72)

    def show_words(self, words: str) -> None:
        """Say why no run is shown; empty says nothing."""
        self.words.setText(words)
        self.words.setVisible(bool(words))
        for one in (self.title, self.seen, self.timeline, self.events):
            one.hide()

    def show_recording(self, recording: Recording, seed: int, seen: str) -> None:
        """Show a run. ``seen`` says how it ended."""
        self.words.hide()
        for one in (self.title, self.seen, self.timeline, self.events):
            one.show()
        self.title.setText(f"Run of seed {seed}")
        self.seen.setText(seen)
        events = recording.run.events
        lanes = few_lanes(recording, FACTS)
        self.timeline.show_lanes(lanes, events[-1].t if events else 0.0)
        self.timeline.follow()
        high = AXIS + sum(PITCH[one.kind] for one in lanes[:LANES]) + 6
        self.timeline.setFixedHeight(high)
        self.events.show_rows([_line(one) for one in story_lines(recording)])
        self.events.scrollToTop()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.timeline.set_tokens(tokens)
        self.events.set_tokens(tokens)


def _line(told: StoryLine) -> ListRow:
    time = f"{told.time:.1f} s"
    return ListRow(
        told.words, told, icon=ICONS.get(told.kind, "dot"), right=time, tip=f"{time}  {told.words}"
    )
