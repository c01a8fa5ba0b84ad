"""The window of the map. It can be scrolled. A click on a card shows the SB in the drawing."""

from __future__ import annotations

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtWidgets import QDialog, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.picture.branch_map import branch_map
from smsl_studio.studio.base.controls import Elided
from smsl_studio.studio.base.screens import open_at, place_over
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.branch_map.map_view import MapView

SIZE = 900, 640


class MapWindow(QDialog):
    """A window above ``parent``. Both can be used. It closes with Esc and when an SB is chosen."""

    branch_wanted = Signal(str)
    """The name of an SB: show it."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowFlags(Qt.WindowType.Window)
        self.setWindowTitle("Map of branches")
        self._session = session
        self._words = Elided()
        self._words.setContentsMargins(14, 10, 14, 10)
        self.view = MapView(tokens)
        self.view.chosen.connect(self._choose)
        self.area = QScrollArea()
        self.area.setWidget(self.view)
        self.area.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.view.focused.connect(self.area.ensureWidgetVisible)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._words)
        column.addWidget(self.area, 1)
        session.blueprint_changed.connect(lambda *_: self._follow())
        session.opened.connect(self._follow)
        session.branch_changed.connect(self.view.show_current)
        self.set_tokens(tokens)
        open_at(self, *SIZE)
        place_over(self, parent.window())

    def open(self) -> None:
        """Show the map of the blueprint that is open now, with the SB that is drawn in view."""
        self._show_map()
        self.show()
        self.raise_()
        self.activateWindow()
        self.view.enter(self._session.branch)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.area.viewport().setStyleSheet(f"background: {tokens.canvas.name()};")
        self.view.set_tokens(tokens)

    def _follow(self) -> None:
        """Show the map after an edit or for another file. The scroll bars stay where they are."""
        if self.isVisible():
            bars = self.area.horizontalScrollBar(), self.area.verticalScrollBar()
            place = QPoint(*(bar.value() for bar in bars))
            self._show_map()
            bars[0].setValue(place.x())
            bars[1].setValue(place.y())

    def _show_map(self) -> None:
        blueprint = self._session.blueprint
        self.view.show_map(blueprint, branch_map(blueprint), self._session.branch)
        self._words.setText(
            f"{counted(len(blueprint.branches), 'State Branch', 'State Branches')}. "
            "A line leads from a fact to the sub-SB that expands it. A click goes in."
        )

    def _choose(self, branch: str) -> None:
        self.accept()
        self.branch_wanted.emit(branch)
