"""Tries one operation alone, from its source state in a world of its own, and shows the result."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.controls import Combo, label, row
from smsl_studio.studio.base.words import capital, refusal_words
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.runlog.events import EdgeSwept

TRY, CANCEL = "Try alone", "Cancel"


class TryAlone(QWidget):
    """The choice of a world, a button and the result of the try.

    Each try builds the world anew in a process of its own. It touches neither the drawing nor a
    run.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._loaded = Loaded()
        self._edge: Address | None = None
        self._cancelled: threading.Event | None = None
        self._beside = Beside(self)
        self._wanted = ""
        self.world: Combo = Combo()
        self.world.setAccessibleName("World to try the operation in")
        self.world.activated.connect(lambda *_: self._choose(self.world.currentText()))
        self.button = QPushButton(TRY)
        self.button.setToolTip("Begin in the operation's source state, carry it out once, and "
                               "check its target on sensed facts")  # fmt: skip
        self.button.clicked.connect(self._press)
        self.words = label("", "second")
        self.words.setWordWrap(True)
        self.words.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 8, 0, 0)
        across = row(self.world, self.button)
        across.setStretch(0, 1)
        column.addLayout(across)
        column.addWidget(self.words)
        session.blueprint_changed.connect(lambda *_: self._forget())

    def set_plugins(self, loaded: Loaded) -> None:
        """Take the worlds of the plugins."""
        self._loaded = loaded
        self._offer()

    def show_edges(self, edges: Sequence[Address]) -> None:
        """Offer to try an edge; hidden if several are selected."""
        edge = edges[0] if len(edges) == 1 else None
        self.setVisible(edge is not None)
        if edge != self._edge:
            self._edge = edge
            self._forget()
            self._offer()

    def _offer(self) -> None:
        names = _worlds(self._loaded, self._edge.operation if self._edge else "")
        self.world.clear()
        self.world.addItems(names)
        if self._wanted in names:
            self.world.setCurrentText(self._wanted)

    def _choose(self, world: str) -> None:
        """Remember the world that the person chose, for other operations too."""
        self._wanted = world

    def _press(self) -> None:
        if self._cancelled is not None:
            self._cancelled.set()
            self._say("Stopping")
            return
        self._session.settling.emit()
        edge, blueprint = self._edge, self._session.blueprint
        if edge is None or self._session.broken is not None:
            self._say("Repair the text first")
            return
        world = self.world.currentText()
        cancelled, loaded = threading.Event(), self._loaded
        self._cancelled = cancelled
        self.button.setText(CANCEL)
        self._say(f"{edge.operation} is being tried in the world {world}")
        self._beside.do(
            lambda: _tried(blueprint, edge, world, cancelled, loaded),
            lambda found: self._told(edge, world, found),
        )

    def _told(self, edge: Address, world: str, found: EdgeSwept | StudioError) -> None:
        self._cancelled = None
        self.button.setText(TRY)
        if edge == self._edge:
            self._say(_words(found, world))

    def _forget(self) -> None:
        if self._cancelled is None:
            self._say("")

    def _say(self, words: str) -> None:
        self.words.setText(words)
        self.words.setVisible(bool(words))


def _worlds(loaded: Loaded, operation: str) -> tuple[str, ...]:
    """The names of the worlds; first those of plugins that can carry out the operation."""
    serving = {
        name
        for plugin in loaded.plugins
        for name in plugin.library.worlds
        if any(e.pattern and e.pattern.match(operation) for e in plugin.library.operations)
    }
    return tuple(sorted(loaded.worlds, key=lambda name: name not in serving))


def _tried(
    blueprint: Blueprint, edge: Address, world: str, cancelled: threading.Event, loaded: Loaded
) -> EdgeSwept | StudioError:
    try:
        return front.try_edge(blueprint, edge, world, stop_when=cancelled.is_set, loaded=loaded)
    except StudioError as error:
        return error


def _words(found: EdgeSwept | StudioError, world: str) -> str:
    if isinstance(found, StudioError):
        return refusal_words(found)
    if found.passed:
        return f"Passed in {world} after {found.t:.1f} s: its target checks true."
    why = capital(found.sentence) or f"Its source checks {found.source}, its target {found.target}"
    return f"Did not pass in {world}: {why}"
