"""The bundles of a collapsed drawing: their lines and chips, in the background and lit."""

from __future__ import annotations

from collections.abc import Iterable

from PySide6.QtGui import QPainter

from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.paint.bundle_paint import bundle_colour, paint_bundle, paint_count
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
        count, back = picture.bundles.count(first), picture.leads_back(first)
        paint_bundle(painter, geometry.shape(first), count, back, colour, ink)


def paint_counts(
    painter: QPainter, sheet: Sheet, bundles: Iterable[int], chosen: bool = False
) -> None:
    """Paint the chips of bundles (mark pixels). A chip without a place stands in the middle."""
    geometry, unit = sheet.geometry, sheet.unit
    for first in bundles:
        left, top, right, bottom = geometry.label(first) or geometry.fallback(first)
        at = (left + right) / 2 / unit, (top + bottom) / 2 / unit
        paint_count(painter, at, sheet.picture.bundles.count(first), sheet.ink, chosen)
