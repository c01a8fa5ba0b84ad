"""How a very small picture of a drawing is painted."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QPen

from smsl_studio.picture.miniature import Miniature
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint import batch
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens

MARGIN = 9.0
FEW = 12
"""Up to so many states are drawn as boxes, more as dots."""


def paint_miniature(
    painter: QPainter, box: QRectF, drawn: Miniature | None, tokens: Tokens
) -> None:
    """Paint a small drawing into a box; a file's icon if there is none."""
    if drawn is None:
        side = min(20.0, box.height() / 2)
        middle = box.center()
        spot = QRectF(middle.x() - side / 2, middle.y() - side / 2, side, side)
        draw(painter, "file", spot, tokens.nl, tokens.canvas)
        return
    few = len(drawn.places) <= FEW and box.height() > 60
    size = np.array([26.0, 15.0] if few else [4.0, 4.0] if len(drawn.places) <= 100 else [2.0, 2.0])
    wide, tall = box.width() - 2 * MARGIN - size[0], box.height() - 2 * MARGIN - size[1]
    at = drawn.within(wide, tall) + (box.left() + MARGIN, box.top() + MARGIN) + size / 2
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(tokens.edge, 1.0))
    batch.draw_lines(painter, np.hstack([at[drawn.lines[:, 0]], at[drawn.lines[:, 1]]]))
    painter.setPen(QPen(tokens.nl, 1.2) if few else Qt.PenStyle.NoPen)
    for number, (x, y) in enumerate(at.tolist()):
        last = number == drawn.activating
        if few:
            painter.setPen(QPen(tokens.acc if last else tokens.nl, 1.2))
            painter.setBrush(tokens.accs if last else tokens.surf)
        else:
            painter.setBrush(tokens.acc if last else tokens.slate)
        spot = QRectF(x - size[0] / 2, y - size[1] / 2, float(size[0]), float(size[1]))
        painter.drawRoundedRect(spot, RADIUS_CONTROL - 2 if few else 1, RADIUS_CONTROL - 2)
    painter.restore()
