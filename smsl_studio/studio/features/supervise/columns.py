"""The places of the columns of the partial view at any width: numbers only."""

from __future__ import annotations

from dataclasses import dataclass

LEFT, RIGHT = 18.0, 22.0
CARD = (230.0, 265.0, 380.0)
"""The width of a card: smallest, as designed, largest (pixels)."""
LEAST = (84.0, 52.0, 44.0)
"""The smallest gaps before the active state, the cards, and the targets (pixels)."""
SHARES = (0.48, 0.29, 0.23)
NODE = 90.0
"""The smallest width of a state (pixels)."""
DESIGNED = 1045.0
NARROWEST = 724
"""The smallest width of all columns (pixels); a narrower view scrolls."""
STACKED = 420
"""The same where the previous state stands above the active one."""
TALL = 200
"""The smallest height (pixels) in which two states stand above each other."""


@dataclass(frozen=True)
class Columns:
    """The (left edge, width) of each column in pixels."""

    previous: tuple[float, float]
    current: tuple[float, float]
    cards: tuple[float, float]
    neighbours: tuple[float, float]
    stacked: bool = False
    """Whether the previous state stands above the active one, in the same column."""


def columns(width: float, wanted: tuple[float, float, float]) -> Columns:
    """Distribute the columns over ``width`` pixels.

    ``wanted`` are the widths that the previous state, the active state and the targets need. States
    become narrower before the gaps fall below their smallest size.
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


def stacked_columns(width: float, wanted: tuple[float, float, float]) -> Columns:
    """Distribute the columns like ``columns``, with the previous state above the active one."""
    width = max(width, STACKED)
    before, here, after = (min(max(one, NODE), 120.0) for one in wanted)
    states, first, second, least = max(before, here), 26.0, 20.0, 178.0
    shrink = min(1.0, (width - 16 - first - second - least) / (states + after))
    states, after = states * shrink, after * shrink
    spare = width - 16 - states - after - first - second
    card = min(max(spare, least), CARD[1])
    gap = max(spare - card, 0.0) / 2
    cards = 8 + states + first + gap
    return Columns(
        previous=(8.0, states),
        current=(8.0, states),
        cards=(cards, card),
        neighbours=(cards + card + second + gap, after),
        stacked=True,
    )
