"""The page of Supervise mode without a run: how to start one, or how the last one ended."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.running.run_session import RunSession

ROOMY, LOW = (32, 24, 32, 72), (32, 4, 32, 4)
"""The margins, and those where the explanation would be cut otherwise (pixels)."""


class Notice(QWidget):
    """A title, an explanation, and a button that starts a run."""

    pressed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setProperty("role", "ground")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._title, self._why = label("", "title"), label("", "second")
        self.begin = QPushButton("Run   F5")
        self.begin.setProperty("role", "primary")
        self.begin.setFixedWidth(140)
        self.begin.clicked.connect(self.pressed)
        self._refusal = ""
        column = self._column = QVBoxLayout(self)
        column.setContentsMargins(*ROOMY)
        column.setSpacing(10)
        column.addStretch(1)
        for part in (self._title, self._why):
            part.setAlignment(Qt.AlignmentFlag.AlignCenter)
            part.setWordWrap(True)
            column.addWidget(part)
        column.addSpacing(6)
        column.addWidget(self.begin, 0, Qt.AlignmentFlag.AlignCenter)
        column.addStretch(1)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep small margins in a low page, so that the explanation is whole."""
        super().resizeEvent(event)
        self._fit()

    def hideEvent(self, event: QHideEvent) -> None:
        """Ask for the usual height, which the page that is shown instead gets, too."""
        super().hideEvent(event)
        self._column.setContentsMargins(*ROOMY)
        self.setMinimumHeight(0)

    def showEvent(self, event: QShowEvent) -> None:
        """Ask for the height again."""
        super().showEvent(event)
        self._fit()

    def _fit(self) -> None:
        if not self.isVisible():
            return
        side, above, _, below = ROOMY
        text = sum(p.heightForWidth(self.width() - 2 * side) for p in (self._title, self._why))
        need = text + self.begin.sizeHint().height() + 4 * self._column.spacing()
        roomy = self.height() >= need + above + below
        self._column.setContentsMargins(*(ROOMY if roomy else LOW))
        self.setMinimumHeight(need + LOW[1] + LOW[3])

    @property
    def words(self) -> str:
        """The shown title and explanation."""
        return f"{self._title.text()} {self._why.text()}"

    def say(self, why: str) -> None:
        """Show why a run could not begin."""
        self._refusal = capital(why.strip())
        self._why.setText(self._refusal)

    def show_run(self, run: RunSession, drawn: Blueprint) -> None:
        """Show the present state of the run; ``drawn`` is the blueprint of the next one."""
        if run.exists:
            self._refusal = ""
            self._title.setText("Opening the world")
            self._why.setText("")
        elif run.story.moment.finished is not None:
            self._title.setText(phase_words(run.phase, run.over)[0])
            again = (
                f"F5 runs {Path(drawn.file).name} as it is drawn now."
                if run.is_another(drawn)
                else "F5 starts another run."
            )
            self._why.setText(f"{capital(run.sentence)}\n{again}")
        else:
            self._title.setText("No run")
            self._why.setText(
                self._refusal
                or "F5 starts one, in the world that is chosen in Run mode. Its current state and "
                "the operations out of it are shown here."
            )
        self.begin.setVisible(not run.exists)
        self._fit()
