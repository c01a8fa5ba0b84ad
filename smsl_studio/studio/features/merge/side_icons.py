"""The signs of the versions as icons of buttons."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QIcon, QPainter, QPixmap

from smsl_studio.studio.base.paint.change_signs import draw_side
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.merge.side_button import LETTERS


def side_icon(side: str, tokens: Tokens) -> QIcon:
    """The sign of a version, for screens of any density."""
    found = QIcon()
    for ratio in (1.0, 2.0):
        picture = QPixmap(round(16 * ratio), round(16 * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        painter = QPainter(picture)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        draw_side(painter, 8, 8, 6.0, LETTERS[side], tokens)
        painter.end()
        found.addPixmap(picture)
    return found
