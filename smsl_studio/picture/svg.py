"""One State Branch as an SVG text, from positions that somebody else worked out.

The marks are those of the canvas: the initial state has a dot and an arrow, the activating one a
second outline, opposite operations bend apart, a self loop stands at a corner. Lengths are pixels.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from math import hypot
from xml.sax.saxutils import escape, quoteattr

from smsl_studio.blueprint.model import StateBranch

Point = tuple[float, float]

WIDTH, HEIGHT, MARGIN = 108.0, 54.0, 56.0
BEND, APART = 16.0, 36.0
"""How far the middle of a bend is set aside, and the next parallel one; the curve goes half way."""


@dataclass(frozen=True, slots=True)
class Inks:
    """The colours of a picture."""

    canvas: str = "#F8F9FB"
    node: str = "#FFFFFF"
    outline: str = "#8791A1"
    text: str = "#161B22"
    edge: str = "#788293"


def draw_branch(
    branch: StateBranch, positions: Mapping[str, Point], inks: Inks | None = None
) -> str:
    """The SVG of ``branch``; ``positions`` are the centres of its states, y downwards.

    States without a position, and operations that touch one, are left out.
    """
    inks = inks or Inks()
    placed = {name: positions[name] for name in branch.table if name in positions}
    left, top, width, height = _bounds(placed)
    shared = _shared_prefix(edge.name for edge in branch.edges())
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" role="img" aria-label={quoteattr(branch.name)} '
        f'viewBox="{left:g} {top:g} {width:g} {height:g}" width="{width:g}" height="{height:g}" '
        'font-family="Inter, Noto Sans, sans-serif">',
        '<defs><marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" '
        'markerHeight="8" markerUnits="userSpaceOnUse" orient="auto">'
        f'<path d="M0 0L8 4L0 8Z" fill="{inks.edge}"/></marker></defs>',
        f'<rect x="{left:g}" y="{top:g}" width="{width:g}" height="{height:g}" '
        f'fill="{inks.canvas}"/>',
    ]
    ranks: Counter[tuple[str, str]] = Counter()
    for edge in branch.edges():
        if edge.source in placed and edge.target in placed:
            ends = (placed[edge.source], placed[edge.target])
            rank = ranks[edge.source, edge.target]
            ranks[edge.source, edge.target] += 1
            lines.extend(_edge(ends, rank, edge.name.removeprefix(shared), inks))
    for name, at in placed.items():
        lines.extend(_node(branch, name, at, inks))
    return "\n".join([*lines, "</svg>", ""])


def _shared_prefix(names: Iterable[str]) -> str:
    """What all names begin with, up to their first underscore; it is noise, so it is dropped."""
    heads = {name[: name.find("_") + 1] for name in names}
    return heads.pop() if len(heads) == 1 else ""


def _bounds(placed: Mapping[str, Point]) -> tuple[float, float, float, float]:
    xs = [x for x, _ in placed.values()] or [0.0]
    ys = [y for _, y in placed.values()] or [0.0]
    left, top = min(xs) - WIDTH / 2 - MARGIN, min(ys) - HEIGHT / 2 - MARGIN
    right, bottom = max(xs) + WIDTH / 2 + MARGIN, max(ys) + HEIGHT / 2 + MARGIN
    return left, top, right - left, bottom - top


def _node(branch: StateBranch, name: str, at: Point, inks: Inks) -> Iterator[str]:
    x, y = at
    yield f"<g><title>{escape(name)}</title>"
    yield _box(x, y, 0.0, inks.node, inks)
    if name == branch.activating:
        yield _box(x, y, 3.5, "none", inks)
    if name == branch.initial:
        start = x - WIDTH / 2 - 26
        yield f'<circle cx="{start:g}" cy="{y:g}" r="5" fill="{inks.text}"/>'
        yield _path(f"M{start + 5:g} {y:g}L{x - WIDTH / 2 - 2:g} {y:g}", inks)
    yield _label((x, y - 4), name, 12, 600, inks)
    yield _label((x, y + 15), " ".join(branch.facts(name)), 12, 400, inks)
    yield "</g>"


def _box(x: float, y: float, inset: float, fill: str, inks: Inks) -> str:
    return (
        f'<rect x="{x - WIDTH / 2 + inset:g}" y="{y - HEIGHT / 2 + inset:g}" '
        f'width="{WIDTH - 2 * inset:g}" height="{HEIGHT - 2 * inset:g}" rx="{8 - inset:g}" '
        f'fill="{fill}" stroke="{inks.outline}" stroke-width="1.2"/>'
    )


def _edge(ends: tuple[Point, Point], rank: int, label: str, inks: Inks) -> Iterator[str]:
    """One operation; ``rank`` counts those that lead the same way before it, and sets it aside."""
    start, end = ends
    if start == end:
        yield from _loop(start, rank, label, inks)
        return
    # The bend is to the right of the way, so that an opposite operation bends to the other side.
    length = hypot(end[0] - start[0], end[1] - start[1])
    bend = (BEND + rank * APART) / length
    middle = (
        (start[0] + end[0]) / 2 - (end[1] - start[1]) * bend,
        (start[1] + end[1]) / 2 + (end[0] - start[0]) * bend,
    )
    out, into = _border(start, middle), _border(end, middle)
    yield _path(f"M{out[0]:g} {out[1]:g}Q{middle[0]:g} {middle[1]:g} {into[0]:g} {into[1]:g}", inks)
    # Nearer to the height of its source, where the label of the opposite operation is not.
    yield from _edge_label((middle[0], middle[1] - (end[1] - start[1]) / 8), label, inks)


def _loop(centre: Point, rank: int, label: str, inks: Inks) -> Iterator[str]:
    """A self loop around the upper right corner; the next one lies around it."""
    x, y, size = centre[0] + WIDTH / 2, centre[1] - HEIGHT / 2, 16 + 8 * rank
    up, down = y - 1.5 * size, y + size
    yield _path(
        f"M{x - size:g} {y:g}C{x - size:g} {up:g} {x + 1.5 * size:g} {up:g} "
        f"{x + 1.5 * size:g} {y:g}S{x + size:g} {down:g} {x:g} {down:g}",
        inks,
    )
    yield from _edge_label((x + 8, y - 18 - 16 * rank), label, inks)


def _border(centre: Point, towards: Point) -> Point:
    """Where the line from the centre of a node leaves its box."""
    dx, dy = towards[0] - centre[0], towards[1] - centre[1]
    share = min(
        WIDTH / 2 / abs(dx) if dx else float("inf"), HEIGHT / 2 / abs(dy) if dy else float("inf")
    )
    return centre[0] + dx * share, centre[1] + dy * share


def _path(d: str, inks: Inks) -> str:
    return (
        f'<path d="{d}" fill="none" stroke="{inks.edge}" stroke-width="1.5" '
        'marker-end="url(#head)"/>'
    )


def _edge_label(at: Point, text: str, inks: Inks) -> Iterator[str]:
    """A label on the canvas colour, so that its own line does not run through it."""
    width = 7.0 * len(text) + 4
    yield (
        f'<rect x="{at[0] - width / 2:g}" y="{at[1] - 8:g}" width="{width:g}" height="16" '
        f'fill="{inks.canvas}"/>'
    )
    yield _label((at[0], at[1] + 4), text, 11, 500, inks)


def _label(at: Point, text: str, size: int, weight: int, inks: Inks) -> str:
    return (
        f'<text x="{at[0]:g}" y="{at[1]:g}" font-size="{size}" font-weight="{weight}" '
        f'text-anchor="middle" fill="{inks.text}">{escape(text)}</text>'
    )
