"""Removes the steps that a route must not take, because they end in a forbidden configuration or
pass through one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from smsl_studio.blueprint.edges import Edge
from smsl_studio.graph.joint.products import (
    AskedMoves,
    JointBox,
    JointMoves,
    Pairs,
    StateNumbers,
    TooLarge,
)
from smsl_studio.stop import heed

MOST_PRODUCTS = 20_000
"""The largest number of products that may remain after steps were removed."""


def without_shut(
    asked: Iterable[AskedMoves],
    shut: Sequence[JointBox],
    numbers: StateNumbers,
    start: Sequence[int] | None,
) -> list[AskedMoves]:
    """Return the products without the steps that meet a box of ``shut``.

    A step can only enter a box if it moves one of the box's SBs. All other steps stay, if ``start``
    is outside of all boxes. None means that the run may begin anywhere. TooLarge if there are too
    many products, or if it is not known exactly what a step passes through.
    """
    found: list[AskedMoves] = []
    inside = start is None or any(
        all(start[at] in states for at, states in box.items()) for box in shut
    )
    for one in asked:
        places = one.moves.keys() | {at for passed in one.passed for at in passed}
        if not inside and not any(places & box.keys() for box in shut):
            found.append(one)
            continue
        for edge in one.edges:
            heed()
            found += _of_edge(one, edge, shut, numbers)
            if len(found) > MOST_PRODUCTS:
                raise TooLarge(f"{MOST_PRODUCTS:,} products of steps")
    return found


def _of_edge(
    asked: AskedMoves, edge: Edge, shut: Sequence[JointBox], numbers: StateNumbers
) -> Iterator[AskedMoves]:
    """Yield the products of one operation that remain."""
    at = numbers.at[edge.branch]
    own = numbers.number[at][edge.source], numbers.number[at][edge.target]
    if own not in asked.moves[at]:
        return
    moves = {**asked.moves, at: frozenset({own})}
    left: list[JointMoves] = [moves]
    for passed in (moves, *(_narrowed(one, at, own) for one in asked.passed)):
        for box in shut:
            begin = leading_into(passed, box)
            if begin is not None:
                left = [part for one in left for part in _outside(one, begin, numbers.sizes)]
    if left and any(
        leading_into(_narrowed(one, at, own), box) is not None
        for one in asked.rough
        for box in shut
    ):
        raise TooLarge("an exact account of what steps pass")
    for one in left:
        yield AskedMoves([edge], one)


def _narrowed(passed: JointMoves, at: int, own: tuple[int, int]) -> JointMoves:
    """Return only those passed configurations that belong to the operation ``own``.

    The SB of the operation is still in the source state, or already in the target state.
    """
    source, _ = own
    if at not in passed:
        return passed
    fit = frozenset(pair for pair in passed[at] if pair in (own, (source, source)))
    return {**passed, at: fit}


def leading_into(moves: JointMoves, box: JointBox) -> JointBox | None:
    """Return the configurations that a product leads into a box. None if there are none."""
    found: dict[int, frozenset[int]] = {}
    for at, pairs in moves.items():
        wanted = box.get(at)
        found[at] = frozenset(a for a, b in pairs if wanted is None or b in wanted)
    for at, states in box.items():
        found.setdefault(at, states)
    return found if all(found.values()) else None


def _outside(moves: JointMoves, box: JointBox, sizes: Sequence[int]) -> Iterator[JointMoves]:
    """Yield products that have exactly those steps of ``moves`` that do not begin in the box.

    No step is in two of the products.
    """
    rest = dict(moves)
    for at, states in sorted(box.items()):
        pairs = rest.get(at)
        if pairs is None:  # it stands still
            pairs = frozenset((state, state) for state in range(sizes[at]))
        outside = frozenset(pair for pair in pairs if pair[0] not in states)
        if outside:
            yield {**rest, at: outside}
        inside: Pairs = frozenset(pair for pair in pairs if pair[0] in states)
        if not inside:
            return
        rest[at] = inside
