"""The heights of the states in the columns of a layered layout, by the method of Brandes and Köpf
("Fast and simple horizontal coordinate assignment", 2002).

Every state is aligned with the middle one of its neighbours in the next column. This is done four
times: from the left and from the right, from the top and from the bottom. Each height is the mean
of the two middle results. A line that passes several columns is straight there.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from smsl_studio.graph.column_order import OrderedColumns

Near = Sequence[Sequence[tuple[int, float]]]


def heights(given: OrderedColumns, room: Sequence[int]) -> list[int]:
    """Return the y of each state and each knot (pixels). ``room`` is the height that each needs."""
    layouts: list[list[int]] = []
    marked = _conflicts(given)
    for onwards in (True, False):
        columns = given.columns if onwards else given.columns[::-1]
        near = given.left if onwards else given.right
        for down in (True, False):
            ways = columns if down else [column[::-1] for column in columns]
            root, align = _aligned(ways, near, marked)
            at = _compacted(ways, root, align, room)
            layouts.append(at if down else [-y for y in at])
    narrow = min(layouts, key=lambda at: max(at) - min(at))
    for number, at in enumerate(layouts):
        end = min if number % 2 == 0 else max
        shift = end(narrow) - end(at)
        layouts[number] = [y + shift for y in at]
    return [sum(sorted(ys)[1:3]) // 2 for ys in zip(*layouts, strict=True)]


def _conflicts(given: OrderedColumns) -> set[tuple[int, int]]:
    """Return the lines between two columns that cross the straight part of a longer line. Their
    ends are not aligned, so the longer line stays straight.
    """
    marked: set[tuple[int, int]] = set()
    for before, column in pairwise(given.columns):
        place = {v: i for i, v in enumerate(before)}
        inner = [
            (place[u], at)
            for at, v in enumerate(column)
            for u, _ in given.left[v]
            if v >= given.states and u >= given.states
        ]
        for at, v in enumerate(column):
            for u, _ in given.left[v]:
                if v >= given.states and u >= given.states:
                    continue
                if any((place[u] - p) * (at - q) < 0 for p, q in inner):
                    marked |= {(u, v), (v, u)}
    return marked


def _aligned(
    columns: Sequence[Sequence[int]], near: Near, marked: set[tuple[int, int]]
) -> tuple[list[int], list[int]]:
    """Return the blocks: for each state and knot the first one and the next one of its block. All
    in a block have the same height.
    """
    root, align = list(range(len(near))), list(range(len(near)))
    for before, column in pairwise(columns):
        place = {v: i for i, v in enumerate(before)}
        last = -1
        for v in column:
            others = sorted((u for u, _ in near[v]), key=place.__getitem__)
            middle = len(others) // 2
            for u in others[(len(others) - 1) // 2 : middle + 1]:
                if align[v] == v and (u, v) not in marked and last < place[u]:
                    align[u], root[v] = v, root[u]
                    align[v] = root[v]
                    last = place[u]
    return root, align


def _compacted(
    columns: Sequence[Sequence[int]], root: list[int], align: list[int], room: Sequence[int]
) -> list[int]:
    """Return the y of each state and knot. A block stands just below the blocks above it, with the
    room that its members need.

    "Above" makes a graph of blocks without cycles. So a block is placed after all blocks above it.
    """
    above: dict[int, dict[int, int]] = {v: {} for v in root}
    below: dict[int, list[int]] = {v: [] for v in root}
    for column in columns:
        for upper, lower in pairwise(column):
            a, b = root[upper], root[lower]
            gap = (room[upper] + room[lower]) // 2
            if a not in above[b]:
                below[a].append(b)
            above[b][a] = max(above[b].get(a, 0), gap)
    at: dict[int, int] = {}
    missing = {b: len(one) for b, one in above.items()}
    ready = [b for b, count in missing.items() if not count]
    for block in ready:
        at[block] = max((at[a] + gap for a, gap in above[block].items()), default=0)
        for other in below[block]:
            missing[other] -= 1
            if not missing[other]:
                ready.append(other)
    _drawn_down(ready, above, below, at)
    return [at[one] for one in root]


def _drawn_down(
    order: list[int],
    above: dict[int, dict[int, int]],
    below: dict[int, list[int]],
    at: dict[int, int],
) -> None:
    """Move each block that has no block above it down to the blocks below it."""
    for block in reversed(order):
        if not above[block] and below[block]:
            at[block] = max(at[block], min(at[o] - above[o][block] for o in below[block]))
