"""What panels and windows of their own are made of: a column of parts, a button with a key."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QAbstractScrollArea, QToolButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import key_words
from smsl_studio.studio.base.tips import tip_text


def panel(*parts: QWidget) -> QWidget:
    """Parts below each other on the background of a panel. What scrolls takes the free room."""
    made = QWidget()
    made.setProperty("role", "panel")
    made.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
    column = QVBoxLayout(made)
    column.setContentsMargins(0, 0, 0, 0)
    column.setSpacing(0)
    for part in parts:
        column.addWidget(part, 1 if isinstance(part, QAbstractScrollArea) else 0)
    column.addStretch(0)
    return made


def keyed_tool(window: QWidget, words: str, keys: str, call: Callable[[], object]) -> QToolButton:
    """A button of a window, with a key that does the same anywhere in that window."""
    made = QToolButton()
    made.setToolTip(tip_text(f"{words} ({key_words(keys)})"))
    made.setAccessibleName(plain_text(words))
    made.clicked.connect(lambda: call())
    QShortcut(QKeySequence(keys), window).activated.connect(lambda: call())
    return made
