"""Taking over what is still being typed into a field, without moving the caret."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit, QWidget
from shiboken6 import isValid

from smsl_studio.studio.base.lines.box import TextBox
from smsl_studio.studio.base.overlays.card import PassingCard


def take_over(field: QWidget | None) -> None:
    """Take the focus from a field and give it back, because a field commits its text when it is
    left. A card is asked for its text instead, because it stays open while another window has the
    focus. All saves, and all questions before something is left, call this.

    A name that is edited in place has no field after that. The focus then goes to the widget around
    it, because keys without a focus do nothing.
    """
    card = _card_around(field)
    if card is not None:
        card.settle()
        return
    if not isinstance(field, TextBox | QLineEdit):
        return
    behind = _what_it_stands_in(field)
    mark = _Mark(field) if isinstance(field, QLineEdit) else None
    if behind is not None:
        behind.setFocus()
    else:
        field.clearFocus()
    if isValid(field) and field.isVisible():
        field.setFocus()
        if mark is not None:
            mark.put_back()


class _Mark:
    """The caret position of a field and the selected part of its text."""

    def __init__(self, field: QLineEdit) -> None:
        self._field, self._at = field, field.cursorPosition()
        self._first, self._length = field.selectionStart(), field.selectionLength()

    def put_back(self) -> None:
        """Restore caret and selection."""
        self._field.setCursorPosition(self._at)
        if self._length:
            self._field.setSelection(self._first, self._length)


def _card_around(field: QWidget | None) -> PassingCard | None:
    """The card over the canvas in which a field stands."""
    while field is not None and not isinstance(field, PassingCard):
        field = field.parentWidget()
    return field


def _what_it_stands_in(field: QWidget) -> QWidget | None:
    """The nearest widget around a field that takes the keyboard focus: a canvas, a tree."""
    around = field.parentWidget()
    while around is not None and around.focusPolicy() is Qt.FocusPolicy.NoFocus:
        around = around.parentWidget()
    return around
