"""The bundles of a collapsed drawing: their lines and chips, in the background and lit."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtGui import QPainter

from smsl_studio.picture.labels import Rect
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.bundle_paint import (
    bundle_colour,
    paint_bundle,
    paint_count,
    paint_lane_chip,
    paint_stub,
)
from smsl_studio.studio.base.paint.edge_paint import LineInk


def lines_alone(sheet: Sheet, edges: Iterable[int]) -> list[int]:
    """Those of the edges that are drawn by themselves."""
    first = sheet.picture.bundles.first
    return [edge for edge in edges if edge not in first] if first else list(edges)


def bundles_among(sheet: Sheet, edges: Iterable[int]) -> list[int]:
    """The first edges of the bundles that have some of these edges, each once."""
    first = sheet.picture.bundles.first
    return list(dict.fromkeys(first[e] for e in edges if e in first)) if first else []


def chosen_bundles(sheet: Sheet) -> list[int]:
    """The bundles under the pointer and of the card that is open, by their first edges."""
    looks = sheet.looks
    return bundles_among(sheet, (looks.hovered_edge, looks.shown_bundle))


def paint_bundles(
    painter: QPainter, sheet: Sheet, bundles: Iterable[int], chosen: bool = False
) -> None:
    """Paint the lines of bundles (scene units)."""
    picture, geometry = sheet.picture, sheet.geometry
    ink = LineInk(sheet.ink, sheet.unit, sheet.compact)
    colour = bundle_colour(sheet.ink.tokens, chosen, sheet.looks.plain.dimmed)
    for first in bundles:
        wide, back = picture.bundles.width(first), picture.leads_back(first)
        paint_bundle(painter, geometry.shape(first), wide, back, colour, ink)


def paint_stubs(painter: QPainter, sheet: Sheet, view: Rect) -> None:
    """Paint the marks of the states from which operations lead back to the start (scene units)."""
    stubs = sheet.picture.stubs
    if stubs:
        seen, colour = set(sheet.states_in(*view)), sheet.ink.tokens.slate
        for state in stubs:
            if state in seen:
                paint_stub(painter, sheet.geometry.box(state), colour, sheet.unit)


def paint_counts(
    painter: QPainter, sheet: Sheet, bundles: Iterable[int], chosen: bool = False
) -> None:
    """Paint the chips of bundles (mark pixels). A chip without a place stands in the middle."""
    geometry, unit = sheet.geometry, sheet.unit
    for first in bundles:
        left, top, right, bottom = geometry.label(first) or geometry.fallback(first)
        at = (left + right) / 2 / unit, (top + bottom) / 2 / unit
        count, lane = sheet.picture.bundles.count(first), first == sheet.picture.bundles.lane
        paint = paint_lane_chip if lane else paint_count
        paint(painter, at, count, sheet.ink, chosen)
