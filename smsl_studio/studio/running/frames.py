"""Frames for the parts of the run pane: headings, tools over a picture, splitters."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QSplitter,
    QToolButton,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import label, rule
from smsl_studio.studio.base.icons import draw, icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

HEAD = 36
MIDDLE = 22
"""Distance from the top of a picture to the middle of the words and tools over it (pixels)."""


def head(title: str, *rest: QWidget | None) -> QWidget:
    """A heading with widgets beside it; None is a stretch."""
    made = QWidget()
    made.setFixedHeight(HEAD)
    across = QHBoxLayout(made)
    across.setContentsMargins(12, 0, 12, 0)
    across.setSpacing(8)
    across.addWidget(label(title, "heading"))
    for part in rest:
        if part is None:
            across.addStretch(1)
        else:
            across.addWidget(part)
    return made


def words_over(*parts: QWidget) -> QWidget:
    """Words that lie over a picture, at its top left."""
    made = QWidget()
    made.setFixedHeight(2 * MIDDLE)
    across = QHBoxLayout(made)
    across.setContentsMargins(12, 0, 0, 0)
    across.setSpacing(8)
    for part in parts:
        across.addWidget(part)
    return made


def tools_over(*tools: QWidget) -> QWidget:
    """Tools in a box that floats over a picture, at its top right."""
    box = QFrame()
    box.setProperty("role", "float")
    across = QHBoxLayout(box)
    across.setContentsMargins(2, 0, 2, 0)
    across.setSpacing(0)
    for index, part in enumerate(tools):
        if index:
            across.addWidget(rule(vertical=True, length=16))
        across.addWidget(part)
    made = QWidget()
    outer = QHBoxLayout(made)
    outer.setContentsMargins(0, 8, 12, 0)
    outer.addWidget(box)
    return made


def laid_over(
    base: QWidget, left: QWidget, right: QWidget, below: QWidget | None = None
) -> QWidget:
    """A picture with words at its top left and tools at its top right, and perhaps a bar below."""
    made = QWidget()
    grid = QGridLayout(made)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.addWidget(base, 0, 0)
    side = Qt.AlignmentFlag
    grid.addWidget(left, 0, 0, side.AlignTop | side.AlignLeft)
    grid.addWidget(right, 0, 0, side.AlignTop | side.AlignRight)
    if below is not None:
        grid.addWidget(below, 0, 0, side.AlignBottom)
    return made


def split(
    way: Qt.Orientation, parts: Sequence[QWidget], sizes: Sequence[int], grow: Sequence[int]
) -> QSplitter:
    """Parts in a splitter with a thin line between them.

    ``sizes`` are pixels. ``grow`` are the shares in which the parts grow with the window.
    """
    made = QSplitter(way)
    made.setHandleWidth(1)
    made.setChildrenCollapsible(False)
    for index, part in enumerate(parts):
        made.addWidget(part)
        made.setStretchFactor(index, grow[index])
    made.setSizes(list(sizes))
    return made


def tool(words: str, name: str, tip: str, tokens: Tokens) -> QToolButton:
    """A button for a floating box of tools; without ``words`` it shows only its icon."""
    made = _Tool()
    made.setProperty("role", "over")
    made.setText(words)
    made.setIcon(icon(name, tokens))
    made.setIconSize(QSize(16, 16))
    style = Qt.ToolButtonStyle
    made.setToolButtonStyle(style.ToolButtonTextBesideIcon if words else style.ToolButtonIconOnly)
    made.setFixedHeight(26)
    made.setToolTip(tip_text(tip))
    made.setAccessibleName(plain_text(words or tip))
    return made


class _Tool(QToolButton):
    """A tool button with a gap between icon and words, and a chevron if it has a menu."""

    def setText(self, words: str) -> None:
        """Set the words, with a space between them and the icon."""
        super().setText(f" {words}" if words else "")

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the button, and a chevron if it has a menu."""
        super().paintEvent(event)
        if self.menu() is not None:
            painter = QPainter(self)
            ink, paper = self.palette().buttonText().color(), self.palette().base().color()
            box = QRectF(self.width() - 20, self.height() / 2 - 5.5, 12, 12)
            draw(painter, "chevron-down", box, ink, paper)
            painter.end()
