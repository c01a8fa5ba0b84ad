"""Parts of panels and of windows: a column of widgets, and a button with a key."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QAbstractScrollArea, QToolButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import key_words
from smsl_studio.studio.base.tips import tip_text

TOOL = (28, 28)
"""Least width and height of a button that has an icon alone (pixels)."""


def panel(*parts: QWidget) -> QWidget:
    """A panel with parts one below another. Those that scroll share the free room."""
    made, column = empty_panel()
    for part in parts:
        column.addWidget(part, 1 if isinstance(part, QAbstractScrollArea) else 0)
    column.addStretch(0)
    return made


def empty_panel() -> tuple[QWidget, QVBoxLayout]:
    """A widget with the background of a panel, and its column without margins."""
    made = QWidget()
    made.setProperty("role", "panel")
    made.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
    column = QVBoxLayout(made)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    return made, column


def keyed_tool(window: QWidget, words: str, keys: str, call: Callable[[], object]) -> QToolButton:
    """A button of a window, with a key that does the same anywhere in that window."""
    made = QToolButton()
    made.setToolTip(tip_text(f"{words} ({key_words(keys)})"))
    made.setAccessibleName(plain_text(words))
    made.setProperty("role", "small")
    made.setMinimumSize(*TOOL)
    made.clicked.connect(lambda: call())
    QShortcut(QKeySequence(keys), window).activated.connect(lambda: call())
    return made
