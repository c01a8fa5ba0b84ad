"""The marks of a difference. Each has a sign and a colour, so it is clear without colour."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from smsl_studio.blueprint.comparison.signs import ADDED, CHANGED, REMOVED
from smsl_studio.picture.colours import Colours
from smsl_studio.picture.shape import Point
from smsl_studio.picture.strokes import circle, polyline

WORDS = {ADDED: "added", REMOVED: "removed", CHANGED: "renamed, retargeted or changed"}
DASHES: Mapping[str, str] = {REMOVED: "5 3"}


class Inks(NamedTuple):
    """The line and fill colours of an element."""

    line: str
    fill: str


def inks(sign: str, colours: Colours) -> Inks:
    """Return the colours of an element with a sign, or with none."""
    return {
        ADDED: Inks(colours["ok"], colours["oks"]),
        REMOVED: Inks(colours["risk"], colours["risks"]),
        CHANGED: Inks(colours["acc"], colours["accs"]),
    }.get(sign, Inks(colours["nl"], colours["surf"]))


def sign_at(at: Point, sign: str, colours: Colours, radius: float = 7.0) -> Iterator[str]:
    """Yield a filled disc with the sign in it."""
    x, y = at
    ink, arm = colours["onacc"], radius * 0.55
    yield circle(at, radius, inks(sign, colours).line)
    if sign == CHANGED:
        wave = [(-1.0, 0.2), (-0.5, -0.45), (0.0, 0.0), (0.5, 0.45), (1.0, -0.2)]
        yield polyline([(x + a * arm, y + b * arm) for a, b in wave], ink, 1.5)
        return
    yield polyline([(x - arm, y), (x + arm, y)], ink, 1.5)
    if sign == ADDED:
        yield polyline([(x, y - arm), (x, y + arm)], ink, 1.5)
