"""Painting of a node: full with name and facts, or compact with the facts alone.

Everything is drawn around (0, 0) in mark pixels, so that node items, far layer and tests can share
it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPolygonF

from smsl_studio.legible import one_line, plain_text
from smsl_studio.picture.levels import COMPACT_MAX, COMPACT_SIZE, FULL_MAX, FULL_SIZE, rest_mark
from smsl_studio.picture.node_rows import TITLED, rows_of
from smsl_studio.picture.picture import Chip, Face
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.paint.change_signs import (
    change_colours,
    change_dashes,
    conflict_colour,
    draw_change,
    draw_conflict,
)
from smsl_studio.studio.base.paint.ink import (
    NO_BRUSH,
    NO_PEN,
    Ink,
    draw_finding,
    draw_unknown,
    faded,
    pen,
)
from smsl_studio.studio.base.theme import RADIUS_CHIP, RADIUS_NODE

CHIP, GAP = 18.0, 4.0
GLOW = (4.0, 5.5, 7.0, 9.0, 11.0, 13.5, 16.0, 19.0, 22.0)
NAME_SIDES, TITLE_SIDES = 16.0, 12.0
"""What a name and a title leave free of the width of a node, on both sides together."""
BAND = 9.0
"""How far the band around the hit of a search reaches beyond the border (mark pixels)."""
MARGIN = 30.0
"""How far signs reach beyond a node's border (mark pixels): glow, ring, initial dot, finding."""


@dataclass(frozen=True)
class NodeLook:
    """The marks on one node, see ``Marks``."""

    selected: bool = False
    active: bool = False
    visited: bool = False
    next: bool = False
    dimmed: bool = False
    hovered: bool = False
    goal: bool = False
    near: bool = False
    """Whether a highlighted operation touches the state, so that it is not dimmed."""
    hit: bool = False
    """Whether the state is the hit of a search that is shown."""
    finding: str = ""
    change: str = ""
    conflict: str = ""
    """The number of an open conflict of a merge, or ``CHOSEN``."""
    """What a comparison tells: ``+``, ``-`` or ``~``."""
    facts: tuple[tuple[int, str], ...] = field(default=())
    mark_shift: float = 0.0
    """The distance of the initial state's mark below the middle of the node (mark pixels)."""

    @property
    def lit(self) -> bool:
        """Whether the node is highlighted, so that it is never smaller than compact."""
        return (
            self.selected
            or self.active
            or self.visited
            or self.next
            or self.hit
            or bool(self.finding or self.change or self.conflict)
        )


PLAIN = NodeLook()


def full_width(face: Face, ink: Ink) -> float:
    """The width of a full node: 108 to 200 mark pixels, as name and facts need."""
    chips = sum(chip_width(c, ink) + GAP for c in face.chips) - GAP
    title = min(ink.label.width(one_line(face.title)) + 16.0, TITLED) if face.title else 0.0
    wanted = max(ink.name.width(face.name) + 24.0, title, chips + 20.0, FULL_SIZE[0])
    return min(float(round(wanted)), FULL_MAX)


def compact_width(face: Face, ink: Ink) -> float:
    """The width of a compact node: at least 46 mark pixels, more if the facts need it."""
    return min(max(ink.short.width(face.short) + 18.0, COMPACT_SIZE[0]), COMPACT_MAX)


def chip_width(chip: Chip, ink: Ink) -> float:
    """The width of a chip in mark pixels, at least its height."""
    return max(CHIP, ink.chip.width(chip.text) + 8.0)


def chip_places(face: Face, ink: Ink, width: float) -> list[QRectF]:
    """The rectangles of the chips in a full node, from the first digit on.

    If not all fit, there is room behind the last for a text with the number of the others.
    """
    widths = [chip_width(chip, ink) + GAP for chip in face.chips]
    shown = len(widths)
    while shown and _row(widths, shown, ink) > width - 12.0:
        shown -= 1
    x, rows = -_row(widths, shown, ink) / 2, rows_of(face)
    places = []
    for wide in widths[:shown]:
        places.append(QRectF(x, rows.chips, wide - GAP, rows.chip))
        x += wide
    return places


def _row(widths: list[float], shown: int, ink: Ink) -> float:
    """The width of the first chips and of the text with the number of the others."""
    rest = len(widths) - shown
    mark = ink.chip.width(rest_mark(rest)) + GAP if rest else 0.0
    return sum(widths[:shown]) + mark - GAP


def paint_node(
    painter: QPainter, face: Face, width: float, compact: bool, look: NodeLook, ink: Ink
) -> None:
    """Paint one node around the origin."""
    height = COMPACT_SIZE[1] if compact else FULL_SIZE[1]
    rect = QRectF(-width / 2, -height / 2, width, height)
    radius = 6.0 if compact else float(RADIUS_NODE)
    dimmed = look.dimmed and not (look.lit or look.goal or look.near)
    _surroundings(painter, rect, radius, look, ink)
    if dimmed:
        painter.setPen(NO_PEN)
        painter.setBrush(ink.tokens.surf)
        painter.drawRoundedRect(rect, radius, radius)
        painter.setOpacity(0.62)
    _body(painter, rect, radius, look, ink)
    if face.activating:
        _second_outline(painter, rect, radius, compact, look, ink)
    if face.initial:
        _initial(painter, QPointF(rect.left() - 3.0, look.mark_shift), ink)
    if compact:
        _short(painter, face, width, look, ink)
    else:
        _name_and_chips(painter, face, width, look, ink)
    painter.setOpacity(1.0)
    if look.finding:
        size = 13.0 if compact else 15.0
        draw_finding(painter, rect.right() - 1, rect.top() + 1, size, look.finding, ink.tokens)
    elif len(look.change) > 1:
        # The sides of a merge stand at the left, because the number of a conflict is at the right.
        draw_change(painter, rect.left() + 10.0, rect.top(), 5.5, look.change, ink.tokens)
    elif look.change:
        draw_change(painter, rect.right() - 2, rect.top() + 2, 7.0, look.change, ink.tokens)
    if face.pinned:
        _pin(painter, QPointF(rect.left() + 1.0, rect.top() + 1.0), ink)
    if look.conflict:
        draw_conflict(painter, rect.right() + 3, rect.top() - 3, look.conflict, ink.tokens)


def paint_goal(painter: QPainter, x: float, top: float, ink: Ink) -> None:
    """Paint the word "goal" below a node, on a background, because arrows may come from below."""
    half = ink.plain.width("goal") / 2 + 3.0
    painter.setPen(NO_PEN)
    painter.setBrush(faded(ink.tokens.canvas, 0.9))
    painter.drawRoundedRect(QRectF(x - half, top + 8.0, 2 * half, 15.0), 3.0, 3.0)
    ink.plain.draw(painter, x, top + 15.0, "goal", ink.tokens.tx2)


def _surroundings(painter: QPainter, rect: QRectF, radius: float, look: NodeLook, ink: Ink) -> None:
    tokens = ink.tokens
    if look.hit:
        painter.setPen(pen(tokens.accl, 1.0))
        painter.setBrush(tokens.accs)
        out = BAND
        painter.drawRoundedRect(rect.adjusted(-out, -out, out, out), radius + out, radius + out)
    painter.setBrush(NO_BRUSH)
    if look.conflict:
        painter.setPen(pen(conflict_colour(look.conflict, tokens), 2.4))
        painter.drawRoundedRect(rect.adjusted(-4, -4, 4, 4), radius + 4, radius + 4)
    if look.active:
        # Several strokes with a low alpha make a soft edge without a blur effect, which is slow.
        painter.setBrush(NO_BRUSH)
        for reach in GLOW:
            painter.setPen(pen(faded(tokens.acc, 0.036), reach * 2))
            painter.drawRoundedRect(rect.adjusted(-2, -2, 2, 2), radius + 2, radius + 2)
        painter.setPen(pen(tokens.acc, 1.5))
        painter.setBrush(tokens.accl)
        painter.drawRoundedRect(rect.adjusted(-4.5, -4.5, 4.5, 4.5), radius + 4, radius + 4)
    if look.selected:
        out = 8.5 if look.active else 4.0
        painter.setPen(pen(tokens.acc, 2.0))
        painter.setBrush(NO_BRUSH)
        painter.drawRoundedRect(rect.adjusted(-out, -out, out, out), radius + out, radius + out)
    elif look.hovered and not look.active:
        painter.setPen(pen(tokens.accl, 2.0))
        painter.setBrush(NO_BRUSH)
        painter.drawRoundedRect(rect.adjusted(-2.5, -2.5, 2.5, 2.5), radius + 2, radius + 2)


def _body(painter: QPainter, rect: QRectF, radius: float, look: NodeLook, ink: Ink) -> None:
    tokens = ink.tokens
    if look.active:
        painter.setPen(NO_PEN)
        painter.setBrush(tokens.acc)
    elif look.change:
        line, fill = change_colours(look.change, tokens)
        painter.setPen(pen(line, 2.2, change_dashes(look.change)))
        painter.setBrush(fill)
    elif look.visited:
        painter.setPen(pen(tokens.acc, 1.6))
        painter.setBrush(tokens.accs)
    elif look.next:
        painter.setPen(pen(tokens.acc, 1.6, (4.0, 3.0)))
        painter.setBrush(tokens.surf)
    else:
        painter.setPen(pen(tokens.nl, 1.2))
        painter.setBrush(tokens.surf)
    painter.drawRoundedRect(rect, radius, radius)


def _second_outline(
    painter: QPainter, rect: QRectF, radius: float, compact: bool, look: NodeLook, ink: Ink
) -> None:
    gap = 2.8 if compact else 3.5
    colour = ink.tokens.onacc if look.active else ink.tokens.slate
    painter.setPen(pen(colour, 1.2))
    painter.setBrush(NO_BRUSH)
    inner = max(radius - gap, 1.0)
    painter.drawRoundedRect(rect.adjusted(gap, gap, -gap, -gap), inner, inner)


def _initial(painter: QPainter, tip: QPointF, ink: Ink) -> None:
    colour, x, y = ink.tokens.slate, tip.x(), tip.y()
    painter.setPen(pen(colour, 1.4))
    painter.drawLine(QPointF(x - 14.0, y), QPointF(x - 5.0, y))
    painter.setPen(NO_PEN)
    painter.setBrush(colour)
    painter.drawEllipse(QPointF(x - 17.0, y), 5.0, 5.0)
    painter.drawPolygon(QPolygonF([tip, QPointF(x - 7, y - 3.6), QPointF(x - 7, y + 3.6)]))


def _pin(painter: QPainter, at: QPointF, ink: Ink) -> None:
    """Paint the mark of a pinned state around a point at the upper left corner."""
    tokens = ink.tokens
    painter.setPen(pen(tokens.nl, 1.0))
    painter.setBrush(tokens.surf)
    painter.drawEllipse(at, 7.0, 7.0)
    draw(painter, "pin", QRectF(at.x() - 4.5, at.y() - 4.5, 9.0, 9.0), tokens.tx2, tokens.surf)


def _short(painter: QPainter, face: Face, width: float, look: NodeLook, ink: Ink) -> None:
    tokens = ink.tokens
    colour = tokens.onacc if look.active else tokens.acc if look.visited else tokens.tx
    ink.short.draw(painter, 0.0, 0.0, ink.short.elided(face.short, width - 8.0), colour)


def _name_and_chips(painter: QPainter, face: Face, width: float, look: NodeLook, ink: Ink) -> None:
    tokens = ink.tokens
    colour = tokens.onacc if look.active else tokens.tx
    name = ink.name.elided(face.name, width - NAME_SIDES)
    painter.setFont(ink.name.font)
    painter.setPen(colour)
    rows = rows_of(face)
    painter.drawText(QPointF(-ink.name.width(name) / 2, rows.name), plain_text(name))
    if face.title:
        soft = tokens.onacc if look.active else tokens.tx2
        title = ink.label.elided(one_line(face.title), width - TITLE_SIDES)
        painter.setFont(ink.label.font)
        painter.setPen(soft)
        painter.drawText(QPointF(-ink.label.width(title) / 2, rows.title), plain_text(title))
    sensed = dict(look.facts)
    places = chip_places(face, ink, width)
    for digit, place in enumerate(places):
        paint_chip(painter, face.chips[digit], place, sensed.get(digit, ""), look.active, ink)
    if rest := len(face.chips) - len(places):
        mark = rest_mark(rest)
        across = ink.chip.width(mark)
        left = places[-1].right() + GAP if places else -across / 2
        soft = tokens.onacc if look.active else tokens.tx2
        y = rows.chips + rows.chip / 2
        ink.chip.draw(painter, left + across / 2, y, mark, soft)


def paint_chip(
    painter: QPainter, chip: Chip, place: QRectF, sensed: str, active: bool, ink: Ink
) -> None:
    """Paint a fact; ``sensed`` is agrees, differs, unknown, transit, or empty outside a run."""
    tokens = ink.tokens
    centre = place.center()
    if sensed == "unknown":
        draw_unknown(painter, centre.x(), centre.y(), place.height(), ink)
    else:
        fill, line, text = _chip_colours(chip, sensed, active, ink)
        painter.setPen(pen(line, 1.2) if line is not None else NO_PEN)
        painter.setBrush(fill if fill is not None else NO_BRUSH)
        half = 0.6 if line is not None else 0.0
        painter.drawRoundedRect(place.adjusted(half, half, -half, -half), RADIUS_CHIP, RADIUS_CHIP)
        if sensed == "differs":
            painter.setPen(NO_PEN)
            painter.setBrush(tokens.bad)
            corner = place.topRight()
            painter.drawPolygon(
                QPolygonF([corner + QPointF(-6, 0.4), corner, corner + QPointF(-0.4, 6)])
            )
        ink.chip.draw(painter, centre.x(), centre.y(), chip.text, text)
    if chip.sub:
        painter.setPen(NO_PEN)
        painter.setBrush(tokens.onacc if active else tokens.acc)
        painter.drawRoundedRect(QRectF(centre.x() - 6.5, place.bottom() + 1.5, 13.0, 2.0), 1.0, 1.0)


def _chip_colours(
    chip: Chip, sensed: str, active: bool, ink: Ink
) -> tuple[QColor | None, QColor | None, QColor]:
    """Fill, line and text of a chip."""
    tokens = ink.tokens
    if sensed == "agrees":
        return tokens.oks, tokens.ok, tokens.ok
    if sensed == "differs":
        return tokens.bads, tokens.bad, tokens.bad
    if sensed == "transit":
        return tokens.accs, tokens.acc, tokens.acc
    if active:
        on = chip.kind == "on"
        return (tokens.onacc, None, tokens.acc) if on else (None, tokens.onacc, tokens.onacc)
    if chip.kind == "on":
        return tokens.slate, None, tokens.onslate
    if chip.kind == "off":
        return tokens.surf, tokens.line2, tokens.tx2
    return tokens.sunk, None, tokens.tx
