"""What Supervise shows of a run: the partial view, the text of the active state, and the scene."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QAction, QResizeEvent
from PySide6.QtWidgets import QMenu, QSplitter, QVBoxLayout, QWidget

from smsl_studio.front.views.fact_rows import fact_rows
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.supervise.columns import TALL
from smsl_studio.studio.features.supervise.head import HIGH
from smsl_studio.studio.features.supervise.own_window import OwnWindow
from smsl_studio.studio.features.supervise.splits import split_of
from smsl_studio.studio.features.supervise.text_panel import LEAST, TextPanel
from smsl_studio.studio.running.run_session import RunSession
from smsl_studio.studio.running.world_pane import WorldPane

GRAPH, TEXT, SCENE = "Partial view", "Text", "Scene"
NAMES = (GRAPH, TEXT, SCENE)
GRAPH_WIDTH = 436
"""The width of the partial view beside a scene: as designed, and a scroll bar (pixels)."""
LARGE_ROOM = 1000
"""From this width of the place on, the large layout has the scene beside it (pixels)."""
TEXT_HEIGHT, LOW = 198, 430
"""The designed height of the text, and the height from which on it gets more than its least
(pixels)."""
ROOM = 800, 380
"""From this width and height text and scene are shown by themselves, if the world has a picture
(pixels)."""
BOARD = 142
"""The smallest height of the board, in which a state is whole (pixels)."""
FRAME = 33
"""Milliseconds between two pictures of the world."""


class SeenParts(QWidget):
    """The three parts. Each can be hidden, but one stays.

    Until a person chooses, the partial view is alone, and text and scene come with a world that has
    a picture, where there is room. ``remember`` gets what was chosen, for the next window.
    """

    turned = Signal()
    """Other parts are shown than before."""
    large_wanted = Signal(bool)
    """bool: a person wants the large layout, or the usual one."""

    def __init__(
        self, run: RunSession, graph: QWidget, text: TextPanel, scene: WorldPane, tokens: Tokens
    ) -> None:
        super().__init__()
        self._run, self._tokens = run, tokens
        self.own: OwnWindow | None = None
        """The window of the partial view, while it has one."""
        self._parts = dict(zip(NAMES, (graph, text, scene), strict=True))
        self._chosen: tuple[str, ...] = ()
        self._large = False
        self._before: list[tuple[QSplitter, list[int]]] = []
        self._loaded: object = None
        self.remember: Callable[[str], object] = lambda _: None
        self.graph, self.text, self.scene = graph, text, scene
        # A splitter gives its parts less than a column does, and then a state would be cut.
        graph.setMinimumHeight(HIGH + BOARD)
        self._left = split_of(Qt.Orientation.Vertical, graph, text)
        self._left.setStretchFactor(0, 1)
        self._whole = split_of(Qt.Orientation.Horizontal, self._left, scene)
        self._whole.setStretchFactor(1, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._whole)
        self.menu = QMenu(self)
        self.menu.setAccessibleName("Parts of Supervise")
        self.choices: dict[str, QAction] = {}
        for name in NAMES:
            action = self.menu.addAction(name)
            action.setCheckable(True)
            action.triggered.connect(lambda on, name=name: self._choose(name, on))
            self.choices[name] = action
        self.menu.addSeparator()
        self.apart = self.menu.addAction("Partial view in its own window")
        self.apart.setCheckable(True)
        self.apart.triggered.connect(lambda on: self.tear_off() if on else self.put_back())
        self.larger = self.menu.addAction("Large, for two metres")
        self.larger.setCheckable(True)
        self.larger.triggered.connect(self.large_wanted)
        self._moved: set[str] = set()
        """The parts to which a person has given other room."""
        self._left.splitterMoved.connect(lambda *_: self._moved.add(TEXT))
        self._whole.splitterMoved.connect(lambda *_: self._moved.add(SCENE))
        self._frames = QTimer(self)
        self._frames.setInterval(FRAME)
        self._frames.timeout.connect(self._draw)
        run.opened.connect(self.refresh)
        self.fit()

    @property
    def splitter(self) -> QSplitter:
        """What parts the scene from the rest."""
        return self._whole

    @property
    def shown(self) -> tuple[str, ...]:
        """The names of the parts that are shown. In the large layout that is the scene alone, if it
        has a picture and room."""
        if self._large:
            picture = bool(self._run.shapes) and (not self._chosen or SCENE in self._chosen)
            return (SCENE,) if picture and self.width_of_place >= LARGE_ROOM else ()
        if self.own is not None:
            rest = tuple(name for name in self._chosen if name != GRAPH)
            return rest or (TEXT, SCENE)
        if self._chosen:
            return self._chosen
        wide, high = ROOM
        roomy = self.width() >= wide and self.height() >= high
        return NAMES if self._run.shapes and roomy else (GRAPH,)

    @property
    def width_of_place(self) -> int:
        """The width of the place for all parts (pixels), which the large layout shares."""
        place = self.parentWidget()
        return place.width() if place is not None else self.width()

    def set_large(self, on: bool) -> None:
        """Hide everything for the large layout, or show it again."""
        if on:
            self.put_back()
            if not self._large:
                self._before = [(one, one.sizes()) for one in (self._left, self._whole)]
        self._large = on
        self.larger.setChecked(on)
        self.apart.setEnabled(not on)
        self.fit()
        if not on:
            # The parts have their place a moment later.
            QTimer.singleShot(0, self, self._as_before)

    def _as_before(self) -> None:
        """Give the parts the room that they had before the large layout."""
        before, self._before = self._before, []
        if not self._large:
            for splitter, sizes in before:
                splitter.setSizes(sizes)

    def restore(self, text: str) -> None:
        """Show what was remembered. Anything else is left alone."""
        self._chosen = tuple(name for name in NAMES if name in text.split(","))
        self.fit()

    def fit(self) -> None:
        """Show the parts that are chosen, or that fit."""
        shown = self.shown
        changed = [name for name in NAMES if self._parts[name].isHidden() is (name in shown)]
        for name in NAMES:
            apart = name == GRAPH and self.own is not None
            self._parts[name].setVisible(apart or name in shown)
            self.choices[name].setChecked(apart or name in shown)
            self.choices[name].setEnabled(not apart and not self._large and shown != (name,))
        self._left.setVisible(GRAPH in shown or TEXT in shown)
        if self.parentWidget() is not None:
            self.setVisible(bool(shown))
        self._give_room(changed)
        if changed:
            self.turned.emit()

    def _give_room(self, parts: Sequence[str]) -> None:
        """Give these of the parts their designed room, as far as they are shown."""
        shown = self.shown
        if TEXT in parts and TEXT in shown:
            # In a low page the board keeps the height in which states stand above each other.
            text = min(LEAST + max(self.height() - LOW, 0) * 2 // 5, TEXT_HEIGHT)
            self._left.setSizes([max(self.height() - text, TALL + HIGH), text])
        if SCENE in parts and SCENE in shown:
            # On a wide screen names of operations get room, too.
            graph = max(GRAPH_WIDTH, self.width() * 36 // 100)
            self._whole.setSizes([graph, max(self.width() - graph, 240)])

    def tear_off(self) -> None:
        """Show the partial view in a window of its own, which can stand on another screen."""
        if self.own is None:
            self.own = OwnWindow(self._parts[GRAPH], self._tokens, self.window())
            self.own.stop.clicked.connect(lambda: self._run.stop())
            self.own.finished.connect(lambda _: self.put_back())
            self._show_own()
            self.own.show()
            self.fit()
            self.turned.emit()

    def put_back(self) -> None:
        """Show the partial view in its place again."""
        own, self.own = self.own, None
        if own is not None:
            self._left.insertWidget(0, self._parts[GRAPH])
            self._left.setStretchFactor(0, 1)
            own.hide()
            own.deleteLater()
            self._show_own()
            self.fit()
            self.turned.emit()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.own is not None:
            self.own.stop.set_tokens(tokens)

    def _show_own(self) -> None:
        self.apart.setChecked(self.own is not None)
        if self.own is not None:
            self.own.show_run(self._run)

    def refresh(self) -> None:
        """Show the world of the run in the scene, if that is shown."""
        run, blueprint, status = self._run, self._run.blueprint, self._run.status
        self.fit()
        self._show_own()
        seen = self.scene.isVisible()
        if not seen or status is None or blueprint is None:
            self._frames.stop()
            if not run.exists and status is None and self._loaded is not None:
                self._loaded = None
                self.scene.clear()
            return
        if self._loaded is not run.shapes:
            self._loaded = run.shapes
            self.scene.load()
        self.scene.show_facts(fact_rows(blueprint, status, run.phase == "failed"))
        if run.exists and not self._frames.isActive():
            self._frames.start()
        elif not run.exists:
            self._draw()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show what fits. What a person has not moved gets its room in the new size."""
        super().resizeEvent(event)
        self.fit()
        if event.size() != event.oldSize() and not self._large:
            self._give_room([name for name in (TEXT, SCENE) if name not in self._moved])

    def _choose(self, name: str, on: bool) -> None:
        shown = set(self.shown)
        (shown.add if on else shown.discard)(name)
        if shown:
            self._chosen = tuple(one for one in NAMES if one in shown)
            self.remember(",".join(self._chosen))
        self.fit()

    def _draw(self) -> None:
        self.scene.draw()
        if not self._run.exists or not self.scene.isVisible():
            self._frames.stop()
