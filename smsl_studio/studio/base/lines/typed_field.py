"""What is still being typed into a field: taken over, with the caret left where it was."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit, QWidget
from shiboken6 import isValid

from smsl_studio.studio.base.lines.box import TextBox


def take_over(field: QWidget | None) -> None:
    """Leaving a field is what takes its text over; so it is left, and gone back to.

    A name that is edited in place has no field once it is taken over. The keys then go to what the
    name stands in, because without a field or anything else that has them they would do nothing.
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
    """Where the caret of a field is, and which part of its text is selected."""

    def __init__(self, field: QLineEdit) -> None:
        self._field, self._at = field, field.cursorPosition()
        self._first, self._length = field.selectionStart(), field.selectionLength()

    def put_back(self) -> None:
        """Put caret and selection back to where they were."""
        self._field.setCursorPosition(self._at)
        if self._length:
            self._field.setSelection(self._first, self._length)


def _what_it_stands_in(field: QWidget) -> QWidget | None:
    """The nearest widget around a field that takes keys itself: a canvas, a tree."""
    around = field.parentWidget()
    while around is not None and around.focusPolicy() is Qt.FocusPolicy.NoFocus:
        around = around.parentWidget()
    return around
