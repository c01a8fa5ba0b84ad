"""The few shapes of a picture as SVG. Lengths are pixels, rounded to a tenth."""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.legible import markup
from smsl_studio.picture.shape import Floats, Point
from smsl_studio.picture.words import MONO_FAMILY


def number(value: float) -> str:
    """Return a number for SVG, rounded to a tenth."""
    return f"{value:.1f}".removesuffix(".0")


def points(line: Iterable[Point] | Floats) -> str:
    """Return the points of a line as SVG lists them: ``x,y x,y``."""
    return " ".join(f"{number(float(x))},{number(float(y))}" for x, y in line)


def box(
    rect: tuple[float, float, float, float],
    radius: float,
    fill: str,
    line: str = "",
    width: float = 1.2,
    dashes: str = "",
) -> str:
    """Return a rounded rectangle. ``rect`` is left, top, width, height."""
    x, y, w, h = map(number, rect)
    stroke = f' stroke="{line}" stroke-width="{number(width)}"' if line else ""
    pattern = f' stroke-dasharray="{dashes}"' if dashes else ""
    return (
        f'<rect x="{x}" y="{y}" width="{w}" height="{h}" rx="{number(radius)}" '
        f'fill="{fill}"{stroke}{pattern}/>'
    )


def polyline(
    line: Iterable[Point] | Floats, colour: str, width: float = 1.5, dashes: str = ""
) -> str:
    """Return an open line through points, without a fill."""
    pattern = f' stroke-dasharray="{dashes}"' if dashes else ""
    return (
        f'<polyline points="{points(line)}" fill="none" stroke="{colour}" '
        f'stroke-width="{number(width)}"{pattern}/>'
    )


def polygon(corners: Iterable[Point], fill: str, line: str = "") -> str:
    """Return a closed, filled shape with these corners."""
    stroke = f' stroke="{line}" stroke-width="1.3"' if line else ""
    return f'<polygon points="{points(corners)}" fill="{fill}"{stroke}/>'


def circle(at: Point, radius: float, fill: str, line: str = "") -> str:
    """Return a filled circle around a point."""
    stroke = f' stroke="{line}" stroke-width="1.4"' if line else ""
    x, y = map(number, at)
    return f'<circle cx="{x}" cy="{y}" r="{number(radius)}" fill="{fill}"{stroke}/>'


def arch(at: Point, radius: float, height: float, colour: str, width: float) -> str:
    """Return an upright arch. ``at`` is the middle between its feet."""
    x, y = at
    left, right, top = number(x - radius), number(x + radius), number(y - height + radius)
    r, foot, stroke = number(radius), number(y), number(width)
    return (
        f'<path d="M{left} {foot}L{left} {top}A{r} {r} 0 0 1 {right} {top}L{right} {foot}" '
        f'fill="none" stroke="{colour}" stroke-width="{stroke}"/>'
    )


def text(
    at: Point,
    words: str,
    size: float,
    colour: str,
    weight: int = 400,
    anchor: str = "middle",
) -> str:
    """Return a line of text at a point of its baseline."""
    return _text(at, words, size, f'text-anchor="{anchor}" fill="{colour}"', _heavy(weight))


def mono_text(at: Point, words: str, size: float, colour: str, weight: int = 400) -> str:
    """Return a line of monospaced text, centred at a point of its baseline."""
    look = f'text-anchor="middle" fill="{colour}"'
    return _text(at, words, size, look, f'{_heavy(weight)} font-family="{MONO_FAMILY}"')


def _heavy(weight: int) -> str:
    return f' font-weight="{weight}"' if weight != 400 else ""


def _text(at: Point, words: str, size: float, look: str, font: str) -> str:
    x, y = map(number, at)
    return f'<text x="{x}" y="{y}" font-size="{number(size)}"{font} {look}>{markup(words)}</text>'
