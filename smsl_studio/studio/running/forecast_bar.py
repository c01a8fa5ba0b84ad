"""The bar at the foot of a scene. It plays a forecast as a ghost and moves nothing in the world."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import QFrame, QHBoxLayout, QMenu, QSlider, QToolButton

from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.running.frames import tool
from smsl_studio.studio.running.scene.ghost import SEEN, Ghost

HIGH = 24
"""Its height (pixels)."""
TICKS = 1000
"""So many places the slider has."""


class ForecastBar(QFrame):
    """Plays the ghost again, moves it with a slider, and chooses whether things are seen where they
    are, where they will be, or both. It is shown only while there is a ghost.
    """

    def __init__(self, ghost: Ghost, tokens: Tokens) -> None:
        super().__init__()
        self._ghost = ghost
        self.setProperty("role", "float")
        self.setAccessibleName("Forecast in the scene")
        self.play = tool(
            "", "play", "Show the forecast once more. Nothing moves in the world", tokens
        )
        self.play.clicked.connect(ghost.play)
        self.slider = QSlider(Qt.Orientation.Horizontal)
        self.slider.setRange(0, TICKS)
        self.slider.setPageStep(TICKS // 10)
        self.slider.setMinimumWidth(60)
        self.slider.setAccessibleName("Moment of the forecast")
        self.slider.valueChanged.connect(lambda value: ghost.seek(value * ghost.seconds / TICKS))
        self.words = label("", "small")
        self.seen = tool(ghost.seen, "eye", "What the scene shows", tokens)
        self.seen.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self.seen)
        for name in SEEN:
            menu.addAction(name, partial(self._see, name))
        self.seen.setMenu(menu)
        across = QHBoxLayout(self)
        across.setContentsMargins(4, 0, 4, 0)
        across.setSpacing(8)
        for part in (self.play, label("Forecast", "small"), self.slider, self.words, self.seen):
            across.addWidget(part, int(part is self.slider))
        # One slim line: it lies over the scene.
        for button in (self.play, self.seen):
            button.setFixedHeight(HIGH - 2)
            button.setIconSize(QSize(14, 14))
        self.slider.setFixedHeight(HIGH - 4)
        self.setFixedHeight(HIGH)
        ghost.moved.connect(self.refresh)
        self.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.play.setIcon(icon("play", tokens))
        self.seen.setIcon(icon("eye", tokens))

    def refresh(self) -> None:
        """Show where the ghost is."""
        ghost = self._ghost
        self.setVisible(ghost.seconds > 0)
        if ghost.seconds > 0:
            self.slider.blockSignals(True)
            self.slider.setValue(round(ghost.time * TICKS / ghost.seconds))
            self.slider.blockSignals(False)
            self.words.setText(f"{ghost.time:.1f} of {ghost.seconds:.1f} s")

    def minimumSizeHint(self) -> QSize:
        """Its words are never cut."""
        return QSize(self.sizeHint().width(), HIGH)

    def _see(self, name: str) -> None:
        self._ghost.seen = name
        self.seen.setText(name)
