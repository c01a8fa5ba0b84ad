"""The line icons of the window, painted in the colours of the theme.

They are painted for the size and pixel ratio in use, so that they are sharp on every screen.
"""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPainterPath, QPen, QPixmap, QPixmapCache

from smsl_studio.studio.base.icon_drawings import ICONS, Drawing
from smsl_studio.studio.base.theme import Tokens

GRID, STROKE = 16.0, 1.5


def draw(painter: QPainter, name: str, rect: QRectF, colour: QColor, paper: QColor) -> None:
    """Paint one icon into ``rect``; ``paper`` is the colour of the parts that are cut out."""
    strokes = _strokes(name)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.translate(rect.topLeft())
    painter.scale(rect.width() / GRID, rect.height() / GRID)
    for kind, text in strokes:
        _stroke(painter, kind, _path(text), colour, paper)
    painter.restore()


def pixmap(name: str, colour: QColor, paper: QColor, size: int = 16, ratio: float = 1.0) -> QPixmap:
    """One icon as a picture of ``size`` device-independent pixels. All windows share it."""
    _strokes(name)
    key = f"{name} {colour.rgba()} {paper.rgba()} {size} {ratio}"
    picture = QPixmap()
    if QPixmapCache.find(key, picture):
        return picture
    picture = QPixmap(QSize(round(size * ratio), round(size * ratio)))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    draw(painter, name, QRectF(0, 0, size, size), colour, paper)
    painter.end()
    QPixmapCache.insert(key, picture)
    return picture


def icon(name: str, tokens: Tokens, size: int = 16, colour: QColor | None = None) -> QIcon:
    """One icon for buttons and menus, for screens of any density; paler if disabled."""
    found = QIcon()
    for ratio in (1.0, 2.0):
        plain = pixmap(name, colour or tokens.tx2, tokens.surf, size, ratio)
        pale = pixmap(name, tokens.line2, tokens.surf, size, ratio)
        found.addPixmap(plain, QIcon.Mode.Normal)
        found.addPixmap(plain, QIcon.Mode.Active)
        found.addPixmap(plain, QIcon.Mode.Selected)
        found.addPixmap(pale, QIcon.Mode.Disabled)
    return found


def severity_colour(letter: str, tokens: Tokens) -> QColor:
    """The colour of a finding's icon. The shape says the same: octagon, triangle, circle."""
    return {"E": tokens.bad, "W": tokens.risk}.get(letter, tokens.tx2)


SEVERITY_ICON = {"E": "error", "W": "warning", "I": "note"}
ACTOR_ICON = {"human": "person", "shared": "shared", "robot": "robot"}


def _strokes(name: str) -> Drawing:
    """The strokes of an icon; ``ValueError`` if there is none of this name.

    Called before a painter begins. An error in between would leave the painter open, and Qt would
    warn later, elsewhere.
    """
    if name not in ICONS:
        raise ValueError(f"there is no icon {name!r}; the names stand in icon_drawings.py")
    return ICONS[name]


def _stroke(
    painter: QPainter, kind: str, path: QPainterPath, colour: QColor, paper: QColor
) -> None:
    if kind == "f":
        painter.fillPath(path, colour)
        return
    pen = QPen(paper if kind == "k" else colour, 1.7 if kind == "k" else STROKE)
    pen.setCapStyle(Qt.PenCapStyle.RoundCap)
    pen.setJoinStyle(Qt.PenJoinStyle.RoundJoin)
    painter.strokePath(path, pen)


@lru_cache(maxsize=256)
def _path(text: str) -> QPainterPath:
    path, parts = QPainterPath(), iter(text.split())

    def number() -> float:
        """The next number of the path."""
        return float(next(parts))

    for verb in parts:
        if verb == "M":
            path.moveTo(number(), number())
        elif verb == "L":
            path.lineTo(number(), number())
        elif verb == "C":
            path.cubicTo(number(), number(), number(), number(), number(), number())
        elif verb == "O":
            centre, radius = QPointF(number(), number()), number()
            path.addEllipse(centre, radius, radius)
        elif verb == "R":
            box, radius = QRectF(number(), number(), number(), number()), number()
            path.addRoundedRect(box, radius, radius)
        else:
            path.closeSubpath()
    return path
