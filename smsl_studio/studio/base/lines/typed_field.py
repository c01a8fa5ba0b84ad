"""Taking over what is still being typed into a field, without moving the caret."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit, QWidget
from shiboken6 import isValid

from smsl_studio.studio.base.lines.box import TextBox


def take_over(field: QWidget | None) -> None:
    """Take the focus from a field and give it back, because a field commits its text when it is
    left.

    A name that is edited in place has no field after that. The focus then goes to the widget around
    it, because keys without a focus do nothing.
    """
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


def _what_it_stands_in(field: QWidget) -> QWidget | None:
    """The nearest widget around a field that takes the keyboard focus: a canvas, a tree."""
    around = field.parentWidget()
    while around is not None and around.focusPolicy() is Qt.FocusPolicy.NoFocus:
        around = around.parentWidget()
    return around
