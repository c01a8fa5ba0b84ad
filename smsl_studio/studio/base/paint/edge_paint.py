"""Painting of an edge: line, arrowhead, label and signs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPolygonF

from smsl_studio.picture.shape import EdgeShape, Floats
from smsl_studio.studio.base.paint.change_signs import (
    MISSING,
    ODD,
    change_colours,
    change_dashes,
    conflict_colour,
    draw_change,
    draw_conflict,
)
from smsl_studio.studio.base.paint.guard_sign import draw_guard
from smsl_studio.studio.base.paint.ink import (
    NO_BRUSH,
    NO_PEN,
    Ink,
    draw_barred,
    draw_finding,
    draw_sub_mark,
    draw_unknown,
    draw_warning,
    faded,
    pen,
)

HEAD, LABEL_HEIGHT = 8.0, 15.0
KEPT = 2000
"""How many lines keep the polygons with which they are painted."""
BAND = 12.0
"""The width of the band under the line that is the hit of a search (mark pixels)."""
# Two labels whose lines are 16 apart must fit below each other, so a label is 15 high.
MARK_WIDTH = 13.0


@dataclass(frozen=True)
class EdgeLook:
    """The marks on one edge, see ``Marks``. An edge with a mark is lit (highlighted).

    ``running`` is the part of the time that has passed, 0 to 1; -1 if it is unknown, None if the
    operation does not run.
    """

    selected: bool = False
    out: bool = False
    """Whether the edge leaves the one selected state."""
    joined: bool = False
    """Whether the edge leaves or enters the one selected state of a collapsed drawing."""
    running: float | None = None
    trail: bool = False
    planned: bool = False
    pruned: bool = False
    held_back: bool = False
    risky: bool = False
    possible: bool = False
    hit: bool = False
    """Whether the operation is the hit of a search that is shown."""
    finding: str = ""
    change: str = ""
    conflict: str = ""
    """The number of an open conflict of a merge, or ``CHOSEN``; behind ``MISSING`` or ``ODD`` that
    of a difference to rules."""
    """The sign of a comparison: ``+``, ``-`` or ``~``; empty without a comparison."""
    hovered: bool = False
    dimmed: bool = False

    @property
    def lit(self) -> bool:
        """Whether the edge is highlighted: painted above the others, with its label, at every
        level."""
        drawn = self.selected or self.out or self.joined or self.hovered
        run = self.running is not None or self.trail or self.planned or self.possible
        held = self.pruned or self.held_back or self.risky
        told = self.finding or self.change or self.hit or self.conflict
        return bool(drawn or run or held or told)

    @property
    def stands_out(self) -> bool:
        """Whether a mark other than a note of the inspection or the pointer is on the edge."""
        plain = replace(self, hovered=False, finding="" if self.finding == "I" else self.finding)
        return plain.lit


PLAIN = EdgeLook()


@dataclass(frozen=True)
class EdgeText:
    """The label of an edge: its words and signs, and whether it is in the code font."""

    text: str
    kind: str = ""
    mono: bool = False
    sign: str = ""
    """The sign of a comparison in front of the words."""
    guard: str = ""
    """The state of the required facts (see ``guard_sign``); empty if there are none."""


def label_size(text: EdgeText, ink: Ink) -> tuple[float, float]:
    """Width and height of a label with its signs, in mark pixels."""
    type_ = ink.mono_label if text.mono else ink.label
    marks = MARK_WIDTH * (bool(text.kind) + len(text.sign) + bool(text.guard))
    width = type_.width(text.text) + marks + 8.0
    return width, LABEL_HEIGHT if not text.mono else 14.0


class LineInk(NamedTuple):
    """What a line is drawn with: ink, scene units in a mark pixel, and whether nodes are
    compact."""

    ink: Ink
    unit: float
    compact: bool = False


def paint_line(
    painter: QPainter,
    shape: EdgeShape,
    look: EdgeLook,
    with_ink: LineInk,
) -> None:
    """Paint a line and its arrowhead; the head is smaller if nodes are compact."""
    ink, unit, compact = with_ink
    tokens = ink.tokens
    if look.running is not None:
        _running(painter, shape, look.running, ink, unit)
        return
    colour, width, dashes = _stroke(look, ink, compact)
    head = HEAD + (1.0 if width > 1.6 else -1.0 if compact else 0.0)
    body, tip = polygons_of(shape, head * unit, (head - 2.0) * unit)
    painter.setBrush(NO_BRUSH)
    if look.hit:
        painter.setPen(pen(tokens.accs, BAND * unit))
        painter.drawPolyline(body)
    if look.trail:
        painter.setPen(pen(faded(tokens.acc, 0.16), 9.0 * unit))
        painter.drawPolyline(body)
    painter.setPen(pen(colour, width * unit, tuple(d * unit for d in dashes)))
    painter.drawPolyline(body)
    painter.setPen(NO_PEN)
    painter.setBrush(colour)
    painter.drawPolygon(tip)


def paint_plain(
    painter: QPainter,
    shapes: Sequence[EdgeShape],
    look: EdgeLook,
    with_ink: LineInk,
) -> None:
    """Paint edges that all look alike: first all lines, then all arrowheads."""
    ink, unit, compact = with_ink
    colour, width, dashes = _stroke(look, ink, compact)
    head = HEAD - (1.0 if compact else 0.0)
    both = [polygons_of(shape, head * unit, (head - 2.0) * unit) for shape in shapes]
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(colour, width * unit, tuple(d * unit for d in dashes)))
    for body, _ in both:
        painter.drawPolyline(body)
    painter.setPen(NO_PEN)
    painter.setBrush(colour)
    for _, tip in both:
        painter.drawPolygon(tip)


def polygons_of(shape: EdgeShape, head: float, short: float) -> tuple[QPolygonF, QPolygonF]:
    """The line, cut by ``short`` at its end, and the arrowhead of length ``head`` (scene units).

    They are kept by the points of the line, because most lines are the same again after an edit.
    """
    return _polygons(shape.points.tobytes(), head, short)


@lru_cache(KEPT)
def _polygons(points: bytes, head: float, short: float) -> tuple[QPolygonF, QPolygonF]:
    shape = EdgeShape(np.frombuffer(points).reshape(-1, 2))
    return polyline(shape.cut(0.0, shape.length - short)), head_polygon(shape, head)


def _stroke(look: EdgeLook, ink: Ink, compact: bool) -> tuple[QColor, float, tuple[float, ...]]:
    """Colour, width and dashes of a line; the most important mark decides."""
    tokens = ink.tokens
    if look.finding == "E":
        return tokens.bad, 2.4, ()
    if look.change:
        wide = 3.0 if look.selected else 2.2
        return change_colours(look.change, tokens)[0], wide, change_dashes(look.change)
    if look.conflict[:1] in (MISSING, ODD) and look.conflict:
        dashes = (4.0, 4.0) if look.conflict.startswith(MISSING) else ()
        return conflict_colour(look.conflict, tokens), 2.4, dashes
    if look.trail:
        return tokens.acc, 2.4, ()
    if look.pruned:
        return tokens.edge, 1.6, (2.0, 4.0)
    if look.held_back:
        return tokens.edge, 1.6, (6.0, 3.0)
    if look.selected or look.joined or look.out:
        return tokens.acc, 2.0, ()
    if look.planned:
        return tokens.acc, 1.6, (4.0, 4.0)
    if look.risky:
        return tokens.risk, 2.0, ()
    if look.hovered:
        return tokens.slate, 2.0, ()
    if look.dimmed and not look.possible:
        return tokens.dim, 1.3, ()
    return tokens.edge, 1.5, ()


def _running(painter: QPainter, shape: EdgeShape, share: float, ink: Ink, unit: float) -> None:
    tokens = ink.tokens
    end = shape.length - 11.0 * unit
    painter.setBrush(NO_BRUSH)
    painter.setPen(pen(tokens.accl, 5.0 * unit))
    painter.drawPolyline(polyline(shape.cut(0.0, end)))
    paint_head(painter, shape, tokens.acc, 12.0 * unit)
    if share < 0.0:
        return
    along = end * min(max(share, 0.0), 1.0)
    painter.setPen(pen(tokens.acc, 5.0 * unit))
    painter.setBrush(NO_BRUSH)
    painter.drawPolyline(polyline(shape.cut(0.0, along)))
    painter.setPen(pen(tokens.acc, 3.0 * unit))
    painter.setBrush(tokens.surf)
    painter.drawEllipse(QPointF(*shape.at(along)), 5.5 * unit, 5.5 * unit)


def paint_head(painter: QPainter, shape: EdgeShape, colour: QColor, size: float) -> None:
    """Paint a filled arrowhead at the end of a line; ``size`` is its length in scene units."""
    painter.setPen(NO_PEN)
    painter.setBrush(colour)
    painter.drawPolygon(head_polygon(shape, size))


def head_polygon(shape: EdgeShape, size: float) -> QPolygonF:
    """The arrowhead at the tip of an edge; ``size`` is its length in scene units."""
    x, y = shape.tip
    # The direction is that of the last part of the line, as long as the head, so that the head fits
    # a curve.
    bx, by = shape.at(max(shape.length - size, 0.0))
    dx, dy = x - bx, y - by
    length = (dx * dx + dy * dy) ** 0.5 or 1.0
    dx, dy = dx / length, dy / length
    bx, by, half = x - dx * size, y - dy * size, size * 0.46
    return QPolygonF(
        [
            QPointF(x, y),
            QPointF(bx - dy * half, by + dx * half),
            QPointF(bx + dy * half, by - dx * half),
        ]
    )


def polyline(points: Floats) -> QPolygonF:
    """Points, (n, 2), as a polygon of Qt."""
    return QPolygonF([QPointF(x, y) for x, y in points.tolist()])


def paint_label(
    painter: QPainter,
    text: EdgeText,
    centre: QPointF,
    look: EdgeLook,
    ink: Ink,
    ground: bool = True,
) -> None:
    """Paint a label centred on ``centre`` (mark pixels); one with a finding stands in a box."""
    tokens = ink.tokens
    if look.finding:
        _boxed(painter, text, centre, look.finding, ink)
        return
    width, height = label_size(text, ink)
    left = centre.x() - width / 2
    if ground:
        area = QRectF(left + 1.0, centre.y() - height / 2, width - 2.0, height)
        painter.fillRect(area, tokens.accs if look.hit else tokens.canvas)
    lit = (
        look.selected
        or look.joined
        or look.out
        or look.trail
        or look.planned
        or look.running is not None
    )
    colour = tokens.acc if lit else tokens.risk if look.risky else tokens.tx2
    if look.change:
        colour = change_colours(look.change, tokens)[0]
    if look.dimmed and not look.lit:
        colour = tokens.tx3
    if look.conflict:
        painter.setPen(pen(conflict_colour(look.conflict, tokens), 2.4))
        painter.setBrush(NO_BRUSH)
        around = QRectF(left - 3.0, centre.y() - height / 2 - 2.0, width + 6.0, height + 4.0)
        painter.drawRoundedRect(around, 6.0, 6.0)
        draw_conflict(painter, around.right(), around.top(), look.conflict, tokens)
    x = left + 4.0
    if text.sign:
        draw_change(painter, x + 5.0, centre.y(), 5.5, text.sign, tokens)
        x += MARK_WIDTH * len(text.sign)
    if text.kind:
        draw_sub_mark(painter, x + 4.5, centre.y(), text.kind, tokens.acc, tokens.canvas)
        x += MARK_WIDTH
    if text.guard:
        draw_guard(painter, x + 4.5, centre.y(), text.guard, tokens)
        x += MARK_WIDTH
    type_ = ink.mono_label if text.mono else ink.label
    type_.draw_from(painter, x, centre.y(), text.text, colour)


def paint_pill(painter: QPainter, name: str, words: str, left: QPointF, ink: Ink) -> None:
    """Paint the name and duration of a running operation.

    ``left`` is the middle of its left end.
    """
    tokens = ink.tokens
    rect = QRectF(left.x(), left.y() - 13.0, pill_width(name, words, ink), 26.0)
    painter.setPen(NO_PEN)
    painter.setBrush(tokens.acc)
    painter.drawRoundedRect(rect, 4.0, 4.0)
    x = rect.left() + 10.0
    ink.strong.draw_from(painter, x, left.y(), name, tokens.onacc)
    x += ink.strong.width(name) + 6.0
    ink.plain.draw_from(painter, x, left.y(), words, tokens.onacc)


def pill_width(name: str, words: str, ink: Ink) -> float:
    """The width of the pill of a running operation, in mark pixels."""
    # Room for one more digit, so that the pill keeps its width while the time runs.
    return ink.strong.width(name) + 6.0 + ink.plain.width(words) + 28.0


def boxed_width(text: EdgeText, ink: Ink) -> float:
    """The width of a label in a box, in mark pixels."""
    return ink.boxed.width(text.text) + 26.0


def _boxed(painter: QPainter, text: EdgeText, centre: QPointF, letter: str, ink: Ink) -> None:
    tokens = ink.tokens
    fill, line = {"E": (tokens.bads, tokens.bad), "W": (tokens.risks, tokens.risk)}.get(
        letter, (tokens.sunk, tokens.slate)
    )
    width = boxed_width(text, ink)
    rect = QRectF(centre.x() - width / 2, centre.y() - 9.0, width, 18.0)
    painter.setPen(pen(line, 1.3))
    painter.setBrush(fill)
    painter.drawRoundedRect(rect, 4.0, 4.0)
    draw_finding(painter, rect.left() + 11.0, centre.y(), 11.0, letter, tokens)
    ink.boxed.draw_from(painter, rect.left() + 20.0, centre.y(), text.text, line)


def paint_sign(painter: QPainter, x: float, y: float, look: EdgeLook, ink: Ink) -> bool:
    """Paint the sign on a line, centred on (x, y) in mark pixels; False if there is none."""
    if look.pruned:
        draw_barred(painter, x, y, 7.5, ink.tokens)
    elif look.held_back:
        draw_unknown(painter, x, y, 16.0, ink)
    elif look.risky:
        painter.setPen(NO_PEN)
        painter.fillRect(QRectF(x - 10.0, y - 8.0, 20.0, 16.0), ink.tokens.canvas)
        draw_warning(painter, x, y, 14.0, ink.tokens)
    else:
        return False
    return True
