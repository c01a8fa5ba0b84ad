"""The line icons of the window: small drawings on a grid of 16, in the colours of the theme.

A drawing is a tuple of strokes: a kind (``s`` stroked, ``f`` filled, ``k`` knocked out in the paper
colour) and a path. Paths know ``M x y``, ``L x y``, ``C`` (six numbers), ``O x y r`` (a circle),
``R x y w h r`` (a rounded box) and ``Z``. They are painted at the size and pixel ratio that is asked
for, so that they are sharp everywhere.
"""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPainterPath, QPen, QPixmap

from smsl_studio.studio.theme import Tokens

Drawing = tuple[tuple[str, str], ...]
GRID, STROKE = 16.0, 1.5

_TRIANGLE = "M 8 1.8 L 15 14 L 1 14 Z"
_OCTAGON = "M 5 1 L 11 1 L 15 5 L 15 11 L 11 15 L 5 15 L 1 11 L 1 5 Z"
_DIAMOND = "M 8 1.5 L 14.5 8 L 8 14.5 L 1.5 8 Z"
_PERSON = "O 8 5 2.8"

ICONS: dict[str, Drawing] = {
    "logo": (("s", "R 1 1.2 6.6 5.6 1.6"), ("f", "R 7.6 9 7.6 6 2"), ("s", "M 4 7 L 4 10 C 4 11.5 4.6 12 6 12 L 8 12")),
    "undo": (("s", "M 5.2 3 L 2.4 5.8 L 5.2 8.6"), ("s", "M 2.6 5.8 L 9.5 5.8 C 12 5.8 13.4 7.4 13.4 9.4 C 13.4 11.4 12 13 9.5 13 L 7 13")),
    "redo": (("s", "M 10.8 3 L 13.6 5.8 L 10.8 8.6"), ("s", "M 13.4 5.8 L 6.5 5.8 C 4 5.8 2.6 7.4 2.6 9.4 C 2.6 11.4 4 13 6.5 13 L 9 13")),
    "plus": (("s", "M 8 2.5 L 8 13.5"), ("s", "M 2.5 8 L 13.5 8")),
    "minus": (("s", "M 2.5 8 L 13.5 8"),),
    "close": (("s", "M 4 4 L 12 12"), ("s", "M 12 4 L 4 12")),
    "check": (("s", "M 3 8.5 L 6.5 12 L 13 4.5"),),
    "arrow": (("s", "M 2.2 8 L 13.6 8"), ("s", "M 9.4 3.8 L 13.6 8 L 9.4 12.2")),
    "layers": (("s", "M 8 1.8 L 14.4 5 L 8 8.2 L 1.6 5 Z"), ("s", "M 1.6 8.2 L 8 11.4 L 14.4 8.2"), ("s", "M 1.6 11.2 L 8 14.4 L 14.4 11.2")),
    "tidy": (("s", "O 3.6 8 2"), ("s", "O 12.2 3.8 2"), ("s", "O 12.2 12.2 2"), ("s", "M 5.4 7.2 L 10.4 4.7"), ("s", "M 5.4 8.9 L 10.4 11.3")),
    "search": (("s", "O 7 7 4.6"), ("s", "M 10.5 10.5 L 14 14")),
    "play": (("f", "M 4.4 2.4 L 13.4 8 L 4.4 13.6 Z"),),
    "pause": (("f", "R 3.4 2.5 3.2 11 0.8"), ("f", "R 9.4 2.5 3.2 11 0.8")),
    "stop": (("f", _OCTAGON),),
    "step": (("f", "M 3 2.6 L 10.4 8 L 3 13.4 Z"), ("f", "R 11.2 2.6 2.2 10.8 0.6")),
    "file": (("s", "M 9.4 1.8 L 4.4 1.8 C 3.6 1.8 3.2 2.2 3.2 3 L 3.2 13 C 3.2 13.8 3.6 14.2 4.4 14.2 L 11.6 14.2 C 12.4 14.2 12.8 13.8 12.8 13 L 12.8 5.2 Z"), ("s", "M 9.2 2 L 9.2 5.4 L 12.6 5.4")),
    "folder": (("s", "M 1.8 4 C 1.8 3.3 2.2 3 2.8 3 L 6.2 3 L 7.8 4.8 L 13.2 4.8 C 13.8 4.8 14.2 5.2 14.2 5.8 L 14.2 12 C 14.2 12.7 13.8 13 13.2 13 L 2.8 13 C 2.2 13 1.8 12.7 1.8 12 Z"),),
    "save": (("s", "M 2.6 3.4 L 2.6 12.6 C 2.6 13.1 2.9 13.4 3.4 13.4 L 12.6 13.4 C 13.1 13.4 13.4 13.1 13.4 12.6 L 13.4 5.4 L 10.6 2.6 L 3.4 2.6 C 2.9 2.6 2.6 2.9 2.6 3.4 Z"), ("s", "M 5.2 13 L 5.2 9 L 10.8 9 L 10.8 13"), ("s", "M 5.2 2.8 L 5.2 5.6 L 9.4 5.6 L 9.4 2.8")),
    "person": (("s", _PERSON), ("s", "M 3 14 C 3 10.8 5 9.6 8 9.6 C 11 9.6 13 10.8 13 14")),
    "shared": (("s", "O 4.6 4.6 2"), ("s", "M 1.4 12.6 C 1.4 9.8 2.6 8.6 4.8 8.6"), ("s", "M 9 13.4 L 14.6 13.4"), ("s", "M 11.8 13.2 L 11.8 10.4 L 9.2 8 L 11.6 4.6 L 13.8 5.4"), ("f", "O 9.2 8 1.3")),
    "robot": (("s", "M 1.6 13.4 L 7.2 13.4"), ("s", "M 4.4 13.2 L 4.4 9.6 L 8.2 5 L 11.8 7.6"), ("f", "O 4.4 9.4 1.5"), ("f", "O 8.2 5 1.5"), ("s", "M 11.8 7.6 L 11.4 10"), ("s", "M 11.8 7.6 L 14.2 8.4")),
    "shield": (("s", "M 8 1.8 L 13.2 3.6 L 13.2 7.6 C 13.2 10.8 11.2 13 8 14.2 C 4.8 13 2.8 10.8 2.8 7.6 L 2.8 3.6 Z"),),
    "chevron-right": (("s", "M 6 3.6 L 10.4 8 L 6 12.4"),),
    "chevron-left": (("s", "M 10 3.6 L 5.6 8 L 10 12.4"),),
    "chevron-down": (("s", "M 3.6 6 L 8 10.4 L 12.4 6"),),
    "chevron-up": (("s", "M 3.6 10 L 8 5.6 L 12.4 10"),),
    "fit": (("s", "M 2.4 5.6 L 2.4 2.4 L 5.6 2.4"), ("s", "M 10.4 2.4 L 13.6 2.4 L 13.6 5.6"), ("s", "M 13.6 10.4 L 13.6 13.6 L 10.4 13.6"), ("s", "M 5.6 13.6 L 2.4 13.6 L 2.4 10.4")),
    "pencil": (("s", "M 2.6 13.4 L 3.2 10.4 L 10.8 2.8 L 13.2 5.2 L 5.6 12.8 Z"), ("s", "M 9.2 4.4 L 11.6 6.8")),
    "trash": (("s", "M 2.6 4.2 L 13.4 4.2"), ("s", "M 6 4 L 6 2.4 L 10 2.4 L 10 4"), ("s", "M 4 4.4 L 4.6 13.6 L 11.4 13.6 L 12 4.4"), ("s", "M 6.8 7 L 6.8 11"), ("s", "M 9.2 7 L 9.2 11")),
    "loop": (("s", "M 13 4 L 13 7 L 10 7"), ("s", "M 12.8 6.8 C 12 4.4 10.2 3 8 3 C 5.2 3 3 5.2 3 8 C 3 10.8 5.2 13 8 13 C 10.2 13 12 11.8 12.8 9.8")),
    "sidebar": (("s", "R 1.8 2.8 12.4 10.4 1.6"), ("s", "M 6 3 L 6 13")),
    "sun": (("s", "O 8 8 2.8"), ("s", "M 8 1.4 L 8 2.6"), ("s", "M 8 13.4 L 8 14.6"), ("s", "M 1.4 8 L 2.6 8"), ("s", "M 13.4 8 L 14.6 8"), ("s", "M 3.3 3.3 L 4.1 4.1"), ("s", "M 11.9 11.9 L 12.7 12.7"), ("s", "M 12.7 3.3 L 11.9 4.1"), ("s", "M 4.1 11.9 L 3.3 12.7")),
    "eye": (("s", "M 1.4 8 C 3 5 5.4 3.6 8 3.6 C 10.6 3.6 13 5 14.6 8 C 13 11 10.6 12.4 8 12.4 C 5.4 12.4 3 11 1.4 8 Z"), ("s", "O 8 8 2")),
    "camera": (("s", "R 1.4 4 8.8 8 1.6"), ("s", "M 10.4 7.4 L 14.4 5 L 14.4 11 L 10.4 8.6")),
    "clock": (("s", "O 8 8 6.2"), ("s", "M 8 4.4 L 8 8 L 10.6 9.6")),
    "barred": (("s", "O 8 8 6.2"), ("s", "M 3.7 12.3 L 12.3 3.7")),
    "info": (("s", "O 8 8 6.4"), ("s", "M 8 7.4 L 8 11.4"), ("f", "O 8 4.9 0.95")),
    "error": (("f", _OCTAGON), ("k", "M 5.4 5.4 L 10.6 10.6"), ("k", "M 10.6 5.4 L 5.4 10.6")),
    "warning": (("s", _TRIANGLE), ("f", _TRIANGLE), ("k", "M 8 6 L 8 9.6"), ("k", "M 8 11.7 L 8 11.9")),
    "note": (("s", "O 8 8 6.4"), ("s", "M 8 7.4 L 8 11.4"), ("f", "O 8 4.9 0.95")),
    "rise": (("f", "M 8 3 L 13.6 12.6 L 2.4 12.6 Z"),),
    "fall": (("f", "M 8 13 L 13.6 3.4 L 2.4 3.4 Z"),),
    "mixed": (("s", _DIAMOND), ("f", "M 1.5 8 L 8 1.5 L 14.5 8 Z")),
    "dot": (("f", "O 8 8 4"),),
}
"""Every drawing by name; unknown names are a fault of the caller (KeyError)."""  # fmt: skip


def draw(painter: QPainter, name: str, rect: QRectF, colour: QColor, paper: QColor) -> None:
    """Paint one icon into ``rect``; ``paper`` is the colour knocked out of filled marks."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.translate(rect.topLeft())
    painter.scale(rect.width() / GRID, rect.height() / GRID)
    for kind, text in ICONS[name]:
        _stroke(painter, kind, _path(text), colour, paper)
    painter.restore()


def pixmap(name: str, colour: QColor, paper: QColor, size: int = 16, ratio: float = 1.0) -> QPixmap:
    """One icon as a picture of ``size`` device-independent pixels."""
    picture = QPixmap(QSize(round(size * ratio), round(size * ratio)))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    painter = QPainter(picture)
    draw(painter, name, QRectF(0, 0, size, size), colour, paper)
    painter.end()
    return picture


def icon(name: str, tokens: Tokens, size: int = 16, colour: QColor | None = None) -> QIcon:
    """One icon for buttons and menus, pale where they are disabled, for screens of any density."""
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
    """The colour of a finding's mark; the shape says the same (octagon, triangle, circle)."""
    return {"E": tokens.bad, "W": tokens.risk}.get(letter, tokens.tx2)


SEVERITY_ICON = {"E": "error", "W": "warning", "I": "note"}
ACTOR_ICON = {"human": "person", "shared": "shared", "robot": "robot"}


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
