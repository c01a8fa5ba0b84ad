"""What floats on the canvas: breadcrumb, zoom control, legends, banner, names being edited.

These widgets are children of the view, not of its viewport: a viewport scrolls its children along.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, QTimer
from PySide6.QtGui import QCursor

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.canvas.marks import Marks
from smsl_studio.studio.canvas.overlays.breadcrumb import Breadcrumb
from smsl_studio.studio.canvas.overlays.legend import Legend, RunLegend
from smsl_studio.studio.canvas.overlays.notice import Banner, EmptyHint, Word
from smsl_studio.studio.canvas.overlays.zoom_control import ZoomControl
from smsl_studio.studio.theme import Tokens

if TYPE_CHECKING:
    from smsl_studio.studio.canvas.canvas import Canvas

EDGE = 14
SPOKEN = 6000
"""How long a word at the pointer stays when nothing happens (ms)."""


class Overlays:
    """Owns and places the floating widgets of one canvas."""

    def __init__(self, canvas: Canvas, tokens: Tokens) -> None:
        self._canvas = canvas
        self.breadcrumb = Breadcrumb(canvas, tokens)
        self.zoom = ZoomControl(canvas, tokens)
        self.legend = Legend(canvas, tokens)
        self.run_legend = RunLegend(canvas, tokens)
        self.run_legend.hide()
        self.banner = Banner(canvas, tokens)
        self.word = Word(canvas, tokens)
        self.empty = EmptyHint(canvas, tokens)
        self._hush = QTimer(canvas)
        self._hush.setSingleShot(True)
        self._hush.setInterval(SPOKEN)
        self._hush.timeout.connect(self.hush)
        self.breadcrumb.clicked.connect(self._crumb)

    def set_tokens(self, tokens: Tokens) -> None:
        for widget in (self.zoom, self.banner, self.word, self.empty):
            widget.set_tokens(tokens)
        for plain in (self.breadcrumb, self.legend, self.run_legend):
            plain.tokens = tokens
            plain.update()
        self._canvas.gestures.ink = self._canvas.ink
        self._canvas.viewport().update()

    def show_branch(self, blueprint: Blueprint, branch: str) -> None:
        self.breadcrumb.show_branch(blueprint, branch)
        sheet = self._canvas.sheet
        kinds: set[str] = set()
        if sheet is not None and sheet.picture.branch.subs:
            edges = range(min(len(sheet.picture.operations), 5000))
            kinds = {sheet.picture.kind(e) for e in edges} - {""}
        if sheet is not None:
            self.legend.show_branch(sheet.picture.branch, kinds)
        self.legend.setVisible(bool(kinds))
        nothing = sheet is None or not len(sheet.picture)
        self.empty.setVisible(nothing and self._canvas.editing)
        # A run has a head and buttons of its own above the canvas.
        self.breadcrumb.setVisible(self._canvas.editing)
        self.zoom.setVisible(self._canvas.editing)
        self.place()

    def show_marks(self, marks: Marks) -> None:
        self.run_legend.setVisible(marks.dimmed)
        if not marks.dimmed and self._canvas.sheet is not None:
            self.legend.setVisible(not self.legend.empty)
        elif marks.dimmed:
            self.legend.hide()

    def show_zoom(self, zoom: float) -> None:
        self.zoom.show_zoom(zoom)

    def fitted(self) -> None:
        """Everything is in view now."""
        self._place_zoom()

    def show_banner(self, text: str) -> None:
        self.banner.show_text(text)
        self.place()

    def top_room(self) -> int:
        """The height at the top that belongs to the breadcrumb."""
        return 40 if self._canvas.editing else 0

    def say(self, text: str, at: QPoint | None = None) -> None:
        """Say something beside the pointer, or beside a point of the viewport."""
        canvas = self._canvas
        if at is None:
            at = canvas.mapFromGlobal(QCursor.pos())
            if not canvas.rect().contains(at):
                at = canvas.rect().center()
        self.word.say(text)
        x = min(max(at.x() + 16, 8), max(canvas.width() - self.word.width() - 8, 8))
        y = min(max(at.y() + 18, 8), max(canvas.height() - self.word.height() - 8, 8))
        self.word.move(x, y)
        self._hush.start()

    def hush(self) -> None:
        self.word.hide()

    def hover(self, address: Address | None) -> None:
        """The pointer is on something else now."""

    def view_moved(self) -> None:
        """The picture moved under the floating widgets."""

    def _place_zoom(self) -> None:
        """At the bottom right, or below the breadcrumb where it would cover a node of a fit."""
        canvas, zoom = self._canvas, self.zoom
        place = QPoint(canvas.width() - zoom.width() - EDGE, canvas.height() - zoom.height() - EDGE)
        sheet = canvas.sheet
        if sheet is not None and canvas.camera.fitted:
            corner = canvas.mapToScene(place - QPoint(6, 6))
            far = canvas.mapToScene(QPoint(canvas.width(), canvas.height()))
            if sheet.states_in(corner.x(), corner.y(), far.x(), far.y()):
                place = QPoint(EDGE - 2, 44)
        zoom.move(place)

    def place(self) -> None:
        """Put everything where it belongs in the view's size."""
        canvas = self._canvas
        width, height = canvas.width(), canvas.height()
        self.breadcrumb.move(EDGE, 10)
        self.breadcrumb.resize(self.breadcrumb.sizeHint())
        self.zoom.resize(self.zoom.sizeHint())
        self._place_zoom()
        self.legend.resize(self.legend.sizeHint())
        self.legend.move(EDGE + 4, height - self.legend.height() - EDGE)
        self.run_legend.move(EDGE + 2, 44 if self._canvas.editing else 8)
        self.banner.adjustSize()
        self.banner.move((width - self.banner.width()) // 2, 44)
        self.empty.resize(self.empty.sizeHint())
        self.empty.move((width - self.empty.width()) // 2, (height - self.empty.height()) // 2)

    def _crumb(self, branch: str) -> None:
        roots = self._canvas.sheet.picture.blueprint.roots if self._canvas.sheet else ()
        self._canvas.enter_wanted.emit(branch or next(iter(roots), ""))
