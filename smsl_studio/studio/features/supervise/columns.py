"""Where the columns of the partial view stand, for any width: numbers alone."""

from __future__ import annotations

from dataclasses import dataclass

LEFT, RIGHT = 18.0, 22.0
CARD = (230.0, 265.0, 380.0)
"""The width of a card where it is narrow, as designed, and at most."""
LEAST = (84.0, 52.0, 44.0)
"""The gaps: to the active state, to the cards, to their targets."""
SHARES = (0.48, 0.29, 0.23)
NODE = 90.0
"""No state is drawn narrower."""
DESIGNED = 1045.0
NARROWEST = 724
"""So many pixels take the columns at least; where there are fewer, one scrolls."""


@dataclass(frozen=True)
class Columns:
    """Left edges and widths, in pixels."""

    previous: tuple[float, float]
    current: tuple[float, float]
    cards: tuple[float, float]
    neighbours: tuple[float, float]


def columns(width: float, wanted: tuple[float, float, float]) -> Columns:
    """Spread the columns over ``width``; ``wanted`` are the widths the previous state, the active
    one and the neighbours would have. States give way before the gaps are less than they may be.
    """
    width = max(width, NARROWEST)
    low, usual, high = CARD
    card = min(max(usual + (width - DESIGNED) * 0.11, low), high)
    room = width - LEFT - RIGHT - card - sum(LEAST)
    asked = sum(wanted)
    shrink = min(1.0, room / asked) if asked else 1.0
    before, here, after = (max(one * shrink, NODE) for one in wanted)
    spare = max(width - LEFT - RIGHT - card - before - here - after - sum(LEAST), 0.0)
    first, second, third = (
        least + spare * share for least, share in zip(LEAST, SHARES, strict=True)
    )
    x = LEFT + before + first
    cards = x + here + second
    return Columns(
        previous=(LEFT, before),
        current=(x, here),
        cards=(cards, card),
        neighbours=(cards + card + third, after),
    )
