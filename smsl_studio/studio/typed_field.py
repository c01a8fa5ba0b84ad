"""What is still being typed into a field: taken over, with the caret left where it was."""

from __future__ import annotations

from PySide6.QtWidgets import QLineEdit, QWidget

from smsl_studio.studio.panels.lines.box import Box


def take_over(field: QWidget | None) -> None:
    """Leaving a field is what takes its text over; so it is left, and gone back to."""
    if isinstance(field, Box):
        field.clearFocus()
        field.setFocus()
    if isinstance(field, QLineEdit):
        at, marked, length = (
            field.cursorPosition(), field.selectionStart(), field.selectionLength()
        )  # fmt: skip
        field.clearFocus()
        if field.isVisible():
            field.setFocus()
            field.setCursorPosition(at)
            if length:
                field.setSelection(marked, length)
