"""Where a card that asks for a name opens: beside what it names, and over no state (pixels)."""

from __future__ import annotations

from PySide6.QtCore import QPoint, QPointF, QRect

from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.features.draw.canvas.card_places import (
    is_clear,
    least_covering,
    selected_places,
)
from smsl_studio.studio.features.draw.canvas.connect_card import ROWS, ConnectCard
from smsl_studio.studio.features.draw.canvas.copy_card import CopyCard

OFF = 16
"""The distance between a card and what it names."""
OFFS = (OFF, 40, 64, 88, 112)
"""The distances between a card and its line that are tried, if states lie beside the line."""
OVER = 40
"""A place over a floating part counts as farther away by so much."""
FAR, FEWER = 220, (2, 1)
"""Farther than this from its line (pixels) a card offers fewer names: these numbers are tried."""
FIELD = 26
"""From the top of a card to the middle of its first field."""
SHARES = (0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9)
"""The places on a line at which a card is tried, best first."""
DOTS = 24
"""So many points of a line stay in sight."""


def clear_place(canvas: Canvas, card: ConnectCard | CopyCard, at: QPoint) -> QPoint:
    """The best place for a card (see ``_place``).

    If the name of an operation would be asked for far from its line, its card offers fewer names,
    so that it finds a place nearer to the line.
    """
    place = _place(canvas, card, at)
    if not isinstance(card, ConnectCard) or card.line is None or _away(canvas, card, place) <= FAR:
        return place
    for rows in FEWER:
        card.offer_at_most(rows)
        nearer = _place(canvas, card, at)
        if _away(canvas, card, nearer) <= FAR:
            return nearer
    card.offer_at_most(ROWS)
    return place


def _place(canvas: Canvas, card: ConnectCard | CopyCard, at: QPoint) -> QPoint:
    """A place where a card covers no state, no note, and nothing of the line that it names.

    It is near the middle of that line, or near a point of the view where a new state is drawn. If
    there is no such place, the card still leaves the line, the new state and the selected ones
    free. If possible it covers no floating part.
    """
    inside = canvas.rect().adjusted(6, 6, -6, -6)
    dots, about = _dots(canvas, card), _about(canvas, card)
    # The new state is drawn at the point; the card has to leave room for it.
    aside = int(54 * max(canvas.zoom, 0.5)) + 14 if card.leaves_room else OFF
    new = QRect(0, 0, 2 * aside - 8, aside)
    new.moveCenter(at)
    spared = [new] if card.leaves_room else []
    spared += [*about, *dots, *selected_places(canvas)]
    places = _beside_line(canvas, dots, card) if dots else []
    places += _beside_state(card, at, aside, inside)
    for place in places:
        area = QRect(place, card.size())
        kept = not any(one.intersects(area) for one in spared)
        if kept and inside.contains(area) and is_clear(canvas, area):
            return place
    return least_covering(canvas, card.size(), places[0], spared)


def _dots(canvas: Canvas, card: ConnectCard | CopyCard) -> list[QRect]:
    """Points of the line that a card names, from its source on."""
    line = card.line if isinstance(card, ConnectCard) else None
    if line is None:
        return []
    start, end = (QPointF(canvas.mapFromScene(point)) for point in line)
    steps = [(start + (end - start) * i / DOTS).toPoint() for i in range(DOTS + 1)]
    return [QRect(at.x() - 3, at.y() - 3, 6, 6) for at in steps]


def _about(canvas: Canvas, card: ConnectCard | CopyCard) -> list[QRect]:
    """The states at both ends of the line."""
    states = card.about if isinstance(card, ConnectCard) else ()
    rects = [canvas.rect_of(state) for state in states]
    return [canvas.mapFromScene(rect).boundingRect() for rect in rects if rect is not None]


def _beside_line(canvas: Canvas, dots: list[QRect], card: ConnectCard | CopyCard) -> list[QPoint]:
    """Places beside a line, those first where the field of the name is nearest to it.

    A place over a floating part counts as farther away.
    """
    w, h = card.width(), card.height()
    floats = canvas.overlays.floats()
    at = [dots[round(share * DOTS)].center() for share in SHARES]
    places = [
        QPoint(p.x() - across, y)
        for p in at
        for across in (w // 2, 0, w)
        for off in OFFS
        for y in (p.y() + off, p.y() - off - h)
    ]
    places += [
        QPoint(x, p.y() - FIELD) for p in at for off in OFFS for x in (p.x() + off, p.x() - off - w)
    ]

    def way(place: QPoint) -> int:
        """How far the field of the name is from the line, and more over a floating part."""
        area = QRect(place, card.size())
        return _way(dots, place, w) + OVER * any(area.intersects(part) for part in floats)

    return sorted(places, key=way)


def _away(canvas: Canvas, card: ConnectCard, place: QPoint) -> int:
    """How far the field of the name is from the line at a place of the card (pixels)."""
    return _way(_dots(canvas, card), place, card.width())


def _way(dots: list[QRect], place: QPoint, wide: int) -> int:
    field = place + QPoint(wide // 2, FIELD)
    return min((field - dot.center()).manhattanLength() for dot in dots)


def _beside_state(
    card: ConnectCard | CopyCard, at: QPoint, aside: int, inside: QRect
) -> list[QPoint]:
    """Places beside a new state whose middle is at a point."""
    w, h = card.width(), card.height()
    places = [
        QPoint(at.x() + aside, at.y() - 20),
        QPoint(at.x() - aside - w, at.y() - 20),
        QPoint(at.x() + aside, at.y() - h // 2),
        QPoint(at.x() - aside - w, at.y() - h // 2),
        QPoint(at.x() - w // 2, at.y() + 40),
        QPoint(at.x() - w // 2, at.y() - 40 - h),
        QPoint(at.x() + OFF, at.y() - OFF - h),
        QPoint(at.x() - OFF - w, at.y() - OFF - h),
    ]
    places += [QPoint(p.x(), inside.bottom() - h) for p in places[:4]]
    return places + [QPoint(p.x(), inside.top()) for p in places[:4]]
