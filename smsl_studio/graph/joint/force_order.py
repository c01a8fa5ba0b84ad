"""An order of SBs in which those that move together stand near each other (FORCE).

Diagrams stay small in such an order. Each SB moves to the mean of the centres of its products,
again and again.
"""

from __future__ import annotations

from collections.abc import Iterable

from smsl_studio.stop import heed

_ROUNDS = 60


def force_order(count: int, members: Iterable[Iterable[int]]) -> list[int]:
    """Return the place of each of ``count`` SBs. ``members`` are the SBs of each product."""
    groups = sorted({tuple(sorted(group)) for group in members})
    groups = [group for group in groups if len(group) > 1]
    of: list[list[int]] = [[] for _ in range(count)]
    for number, group in enumerate(groups):
        for one in group:
            of[one].append(number)
    places = list(range(count))
    best, least = places, None
    for _ in range(_ROUNDS):
        heed()
        spans = (max(places[one] for one in group) - min(places[one] for one in group)
                 for group in groups)  # fmt: skip
        span = sum(spans)
        if least is None or span < least:
            best, least = places, span
        centres = [sum(places[one] for one in group) / len(group) for group in groups]
        drawn = [
            sum(centres[group] for group in of[one]) / len(of[one]) if of[one] else places[one]
            for one in range(count)
        ]
        order = sorted(range(count), key=lambda one: (drawn[one], one))
        further = [0] * count
        for place, one in enumerate(order):
            further[one] = place
        if further == places:
            break
        places = further
    return best
