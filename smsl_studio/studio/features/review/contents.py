"""The left column: the parts of the reading with how far each is answered, and the progress."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QProgressBar, QPushButton, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.inspection.review.reviewed import ReviewedReading
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

WIDE = 248
"""The width of the column at the usual text size (pixels)."""


class ContentsColumn(QScrollArea):
    """The contents. A click on a part shows its lines."""

    section_wanted = Signal(str)
    """str: the key of a part."""
    watch_wanted = Signal()
    print_wanted = Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.setWidgetResizable(True)
        self.setAccessibleName("Contents")
        self.buttons: dict[str, QPushButton] = {}
        self._parts = QVBoxLayout()
        self._parts.setSpacing(0)
        self.bar = QProgressBar()
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(8)
        self.bar.setAccessibleName("Your progress")
        self.said = label("", "sideText")
        self.said.setWordWrap(True)
        self.watch = QPushButton(" Watch it run")
        self.watch.setToolTip(tip_text("Play the step at hand beside the text"))
        self.watch.clicked.connect(self.watch_wanted)
        self.paper = QPushButton(" Print or save as PDF")
        self.paper.setToolTip(tip_text("Write the whole reading as PDF or HTML"))
        self.paper.clicked.connect(self.print_wanted)
        inner = QWidget()
        inner.setProperty("role", "side")
        column = QVBoxLayout(inner)
        column.setContentsMargins(0, 16, 0, 16)
        column.setSpacing(6)
        column.addWidget(_inset(label("Contents", "sideTitle")))
        column.addLayout(self._parts)
        column.addSpacing(16)
        self._progress = _inset(label("Your progress", "sideTitle"), self.bar, self.said)
        column.addWidget(self._progress)
        column.addStretch(1)
        column.addWidget(_inset(self.watch, self.paper))
        self.setWidget(inner)
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.watch.setIcon(icon("play", tokens, 14, tokens.tx))
        self.paper.setIcon(icon("file", tokens, 16, tokens.tx))

    def show_seen(self, seen: ReviewedReading | None, at: str) -> None:
        """Show how far each part is answered; ``at`` is the key of the part that is shown."""
        sections = [] if seen is None else seen.sections
        if [one.key for one in sections] != list(self.buttons):
            self._make([(one.key, one.heading) for one in sections])
        for one in sections:
            lines = seen.of_section(one.key) if seen is not None else ()
            done = sum(line.is_answered for line in lines)
            button = self.buttons[one.key]
            button.setText(f"{one.heading}   {done}/{len(lines)}")
            button.setChecked(one.key == at)
            whole = done == len(lines)
            colour = self._tokens.ok if whole else self._tokens.tx2
            button.setIcon(icon("check" if whole else "dot", self._tokens, 12, colour))
            button.setAccessibleName(
                plain_text(f"{one.heading}, {done} of {len(lines)} lines answered")
            )
        self._progress.setVisible(seen is not None)
        self.watch.setEnabled(seen is not None)
        self.paper.setEnabled(seen is not None)
        if seen is not None:
            done, many = len(seen.lines) - seen.left, len(seen.lines)
            self.bar.setMaximum(max(many, 1))
            self.bar.setValue(done)
            asked = len(seen.review.open_comments)
            comments = f"{asked} comment{'' if asked == 1 else 's'} open"
            self.said.setText(f"{done} of {many} lines approved\n{comments}")

    def _make(self, sections: list[tuple[str, str]]) -> None:
        for button in self.buttons.values():
            self._parts.removeWidget(button)
            button.deleteLater()
        self.buttons = {}
        for key, _ in sections:
            button = QPushButton()
            button.setProperty("kind", "section")
            button.setCheckable(True)
            button.clicked.connect(lambda _=False, key=key: self.section_wanted.emit(key))
            self.buttons[key] = button
            self._parts.addWidget(button)


def _inset(*widgets: QWidget) -> QWidget:
    """Widgets below each other with room at both sides."""
    made = QWidget()
    column = QVBoxLayout(made)
    column.setContentsMargins(16, 0, 16, 0)
    column.setSpacing(8)
    for widget in widgets:
        column.addWidget(widget)
    return made
