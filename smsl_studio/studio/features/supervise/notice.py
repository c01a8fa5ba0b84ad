"""The page of Supervise mode without a run: how to start one, or how the last one ended."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QHideEvent, QResizeEvent, QShowEvent
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.phase_words import phase_words
from smsl_studio.legible import one_line, plain_text
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.running.run_session import RunSession

MOST = 6
"""The largest number of lines about who decided."""
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
        self._deciders = label("", "small")
        self.begin = QPushButton("Run   F5")
        self.begin.setProperty("role", "primary")
        self.begin.setFixedWidth(140)
        self.begin.clicked.connect(self.pressed)
        self._refusal = ""
        column = self._column = QVBoxLayout(self)
        column.setContentsMargins(*ROOMY)
        column.setSpacing(10)
        column.addStretch(1)
        for part in (self._title, self._why, self._deciders):
            part.setAlignment(Qt.AlignmentFlag.AlignCenter)
            part.setWordWrap(True)
            if part is not self._deciders:  # it has its place as soon as it says something
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
        parts = [self._title, self._why, *[self._deciders] * bool(self._deciders.text())]
        text = sum(part.heightForWidth(self.width() - 2 * side) for part in parts)
        need = text + self.begin.sizeHint().height() + 4 * self._column.spacing()
        roomy = self.height() >= need + above + below
        self._column.setContentsMargins(*(ROOMY if roomy else LOW))
        self.setMinimumHeight(need + LOW[1] + LOW[3])

    @property
    def words(self) -> str:
        """The shown title and explanation."""
        return f"{self._title.text()} {self._why.text()}"

    @property
    def decided(self) -> str:
        """Who decided what in the run that has ended, and what the next one cannot give: a line for
        each. Empty for neither."""
        return self._deciders.text()

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
        ahead = () if run.exists else run.caution()
        told = (*map(one_line, _decided(run)), *map(one_line, ahead))
        self._deciders.setText(plain_text("\n".join(told)))
        if self._deciders.text() and self._deciders.parent() is None:
            self._column.insertWidget(self._column.indexOf(self._why) + 1, self._deciders)
        self._deciders.setVisible(bool(self._deciders.text()))
        self.begin.setVisible(not run.exists)
        self._fit()


def _decided(run: RunSession) -> Iterator[str]:
    """Yield who decided what in the last run, the first ``MOST``."""
    found = run.deciders if run.over else ()
    for one in found[:MOST]:
        waited = f"; after {one.waited}" if one.waited else ""
        against = f"; against an agent {one.against} times" if one.against else ""
        who = f"{one.name}, automatic" if one.automatic else one.name
        yield f"{who}: {one.decided}{waited}{against}"
    if len(found) > MOST:
        yield f"and {len(found) - MOST} more, which the account of the run has"
