"""The accessible interface of a note or group on a canvas."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QRect
from PySide6.QtGui import QAccessible, QAccessibleInterface
from shiboken6 import isValid

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.canvas.accessible_leaf import MENU, PRESS, Acts, LeafAccessible
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey


class DrawnAccessible(LeafAccessible):
    """A note, read as "Note: Ask the clinic, R. Stein, 12 Nov 2026, on State_1", or a group."""

    def __init__(
        self, parent: QAccessibleInterface, canvas: Callable[[], Canvas | None], key: DrawnKey
    ) -> None:
        """``canvas`` gives the canvas while it exists; it does now."""
        shown = canvas()
        assert shown is not None
        super().__init__(parent, shown)
        self._held, self.key = canvas, key

    @property
    def _canvas(self) -> Canvas | None:
        """The canvas, if it still shows this note or group."""
        canvas = self._held()
        if canvas is None or not isValid(canvas) or canvas.sheet is None:
            return None
        return canvas if canvas.sheet.drawn.number(self.key) >= 0 else None

    def isValid(self) -> bool:
        """Whether the canvas still shows it."""
        return self._canvas is not None

    def text(self, kind: QAccessible.Text) -> str:
        """What is read out; empty for other kinds of text."""
        canvas = self._canvas
        if kind != QAccessible.Text.Name or canvas is None or canvas.sheet is None:
            return ""
        words = canvas.sheet.drawn.words(self.key)
        return plain_text(f"{words}, selected" if self.key == canvas.drawn.chosen else words)

    def acts(self) -> Acts:
        """Choose it, and while the canvas can be edited, edit it or open its menu."""
        canvas = self._canvas
        if canvas is None or not canvas.editing:
            return {}
        return {
            PRESS: ("Select it", partial(canvas.drawn_wanted.emit, self.key)),
            "Edit": ("Edit its text", partial(canvas.drawn_edit_wanted.emit, self.key)),
            MENU: ("Open its menu", partial(self._open_menu, canvas)),
        }

    def _open_menu(self, canvas: Canvas) -> None:
        canvas.drawn_wanted.emit(self.key)
        canvas.drawn_menu_wanted.emit(self.key, self.rect().center())

    def rect(self) -> QRect:
        """Where it lies on the screen (pixels), a group with its title only; empty if it is
        gone."""
        canvas = self._canvas
        if canvas is None or canvas.sheet is None:
            return QRect()
        drawn = canvas.sheet.drawn
        rect = drawn.rect(self.key) if self.key.kind == "note" else drawn.title_rect(self.key)
        return canvas.screen_rect(rect) if rect is not None else QRect()

    def role(self) -> QAccessible.Role:
        """A note or a group."""
        return QAccessible.Role.Note if self.key.kind == "note" else QAccessible.Role.Grouping

    def state(self) -> QAccessible.State:
        """The flags: whether the note or group is selected, and whether its canvas is shown."""
        found, canvas = QAccessible.State(), self._canvas
        found.invisible = canvas is None or not canvas.isVisible()
        found.selectable = True
        found.selected = canvas is not None and canvas.drawn.chosen == self.key
        return found
