"""A layout in columns for small procedures. Forward operations point to the right.

If most operations change one fact, the column of a state is the number of facts in which it differs
from INITIAL. Otherwise it is the state's place on the longest chain of forward operations. A fact
is independent if each of its values occurs with all combinations of the other facts, such as a tool
pose that can be planned at any time. The values of an independent fact make the rows of a grid.
"""

from __future__ import annotations

from collections.abc import Sequence

from smsl_studio.blueprint.model import StateBranch
from smsl_studio.graph.build import BranchGraph, graph_of
from smsl_studio.graph.shape import distances, flood

Point = tuple[float, float]
COLUMN, ROW = 218.0, 172.0
"""Pixels between columns and between rows. Columns are further apart if labels need it."""
_ASLANT = 124.0
_TALL = 8
"""A column with more nodes is split into several."""


def in_columns(branch: StateBranch) -> dict[str, Point]:
    """Return the place of each state (pixels), with INITIAL at the left. Parts of the graph that no
    operation joins with INITIAL stand below.
    """
    graph = graph_of(branch)
    if not len(graph):
        return {}
    facts = [branch.facts(name) for name in graph.names]
    start = graph.index.get(branch.initial, 0)
    layer = _differences(facts, start)
    if len(facts[0]) < 2 or not _steps_by_one(graph, facts, layer):
        return _named(graph, _parts(graph, start, None))
    digit = _row_digit(graph, facts)
    places = _parts(graph, start, layer) if digit is None else _grid(graph, facts, digit, start)
    return _named(graph, places)


def _named(graph: BranchGraph, places: dict[int, Point]) -> dict[str, Point]:
    left = min(x for x, _ in places.values())
    return {
        name: (float(round(places[i][0] - left)), float(round(places[i][1])))
        for i, name in enumerate(graph.names)
    }


# What the facts say


def _steps_by_one(
    graph: BranchGraph, facts: Sequence[tuple[str, ...]], layer: Sequence[int]
) -> bool:
    """Return whether at least half of the operations that change facts lead to a neighbouring
    column.
    """
    moves = [
        abs(layer[target] - layer[source])
        for source, target in zip(graph.sources, graph.targets, strict=True)
        if facts[source] != facts[target]
    ]
    return bool(moves) and moves.count(1) * 2 >= len(moves)


def _differences(facts: Sequence[tuple[str, ...]], start: int) -> list[int]:
    """Return for each state in how many facts it differs from the state ``start``."""
    return [sum(a != b for a, b in zip(facts[start], state, strict=True)) for state in facts]


def _row_digit(graph: BranchGraph, facts: Sequence[tuple[str, ...]]) -> int | None:
    """Return the number of the independent fact that makes the rows, or None if there is none.

    Of several, it is the fact that the fewest operations change together with other facts, then the
    last one.
    """
    found: list[tuple[int, int]] = []
    states = set(facts)
    for digit in range(len(facts[0])):
        values = {state[digit] for state in facts}
        rests = {state[:digit] + state[digit + 1 :] for state in facts}
        if 2 <= len(values) <= 4 and len(rests) > 1 and len(values) * len(rests) == len(states):
            mixed = sum(
                facts[s][digit] != facts[t][digit]
                and sum(a != b for a, b in zip(facts[s], facts[t], strict=True)) > 1
                for s, t in zip(graph.sources, graph.targets, strict=True)
            )
            found.append((mixed, -digit))
    if len(states) < len(facts) or not found:
        return None
    return -min(found)[1]


def _grid(
    graph: BranchGraph, facts: Sequence[tuple[str, ...]], digit: int, start: int
) -> dict[int, Point]:
    """Return the places of a grid: one block of columns for each value of ``digit``, that of
    INITIAL on top.

    Several states of a column in one block stand aslant, like the edges of a cube, so that
    operations between the blocks pass beside them.
    """
    values = dict.fromkeys((facts[start][digit], *(state[digit] for state in facts)))
    rests = [state[:digit] + state[digit + 1 :] for state in facts]
    layer = _differences(rests, start)
    top = [i for i in range(len(graph)) if facts[i][digit] == facts[start][digit]]
    columns = _sorted_columns(graph, top, layer, {})
    height = max(map(len, columns))
    twin = {(rests[i], facts[i][digit]): i for i in range(len(graph))}
    used = sorted({layer[i] for i in top})
    xs = _column_places(graph, columns, {i: used.index(layer[i]) for i in range(len(graph))})
    places: dict[int, Point] = {}
    for block, value in enumerate(values):
        for number, (x, column) in enumerate(zip(xs, columns, strict=True)):
            for slot, state in enumerate(column):
                aslant = slot - (len(column) - 1) / 2
                y = (block * height + aslant + (height - 1) / 2) * ROW
                at = x + number * (height - 1) * _ASLANT + aslant * _ASLANT
                places[twin[rests[state], value]] = (at, y)
    return places


# Columns by the shape of the graph


def _parts(graph: BranchGraph, start: int, layer: list[int] | None) -> dict[int, Point]:
    """Return the places of all parts: the part of INITIAL, the others below it by size, and then
    rows of single states.
    """
    left = set(range(len(graph)))
    parts: list[list[int]] = []
    while left:
        found = flood(graph.neighbours, (start if start in left else min(left),))
        left -= found
        parts.append(sorted(found))
    first, others = parts[0], sorted(parts[1:], key=lambda part: (-len(part), part))
    places: dict[int, Point] = {}
    for part in [first, *(other for other in others if len(other) > 1)]:
        root = start if start in part else part[0]
        own = _part(graph, part, root, layer)
        lowest = max((y for _, y in places.values()), default=-ROW)
        shift = lowest + ROW - min(y for _, y in own.values()) if places else 0.0
        places |= {i: (x, y + shift) for i, (x, y) in own.items()}
    lone = [other[0] for other in others if len(other) == 1]
    lowest = max(y for _, y in places.values())
    for position, state in enumerate(lone):
        row, column = divmod(position, 6)
        places[state] = (column * COLUMN, lowest + (row + 1) * ROW)
    return places


def _part(
    graph: BranchGraph, part: list[int], root: int, layer: list[int] | None
) -> dict[int, Point]:
    """Return the places of one connected part. Each column is centred about y = 0 and has a free
    lane for operations that pass it.
    """
    layer = layer or _forward_layers(graph, part, root)
    used = sorted({layer[i] for i in part})
    rank = {i: used.index(layer[i]) for i in part}
    columns = _sorted_columns(graph, part, layer, _lanes(graph, part, rank))
    xs = _column_places(graph, columns, rank)
    places: dict[int, Point] = {}
    for x, column in zip(xs, columns, strict=True):
        for state, at in _stack(column, x).items():
            if state >= 0:
                places[state] = at
    return places


def _stack(column: list[int], x: float) -> dict[int, Point]:
    """Return the places of one column, centred about y = 0. A tall column is split into several
    that stand closer together.
    """
    step = ROW if len(column) <= 3 else 126.0 if len(column) <= 5 else 96.0
    pieces = -(-len(column) // _TALL)
    places: dict[int, Point] = {}
    for piece in range(pieces):
        own = column[piece::pieces]
        for slot, state in enumerate(own):
            places[state] = (x + piece * 160.0, (slot - (len(own) - 1) / 2) * step)
    return places


def _forward_layers(graph: BranchGraph, part: list[int], root: int) -> list[int]:
    """Return for each state its place on the longest chain of forward operations.

    An operation is forward if its target is further from the root. Between states at the same
    distance it is forward if no operation leads back and it follows the written order, so no cycle
    arises.
    """
    away = distances(graph.successors, root)
    beyond = max(away) + 1
    steps = [step if step >= 0 else beyond for step in away]
    pairs = set(zip(graph.sources, graph.targets, strict=True))
    layer = [0] * len(graph)
    for state in sorted(part, key=lambda i: (steps[i], i)):
        layer[state] = max(
            (
                layer[before] + 1
                for before in graph.predecessors[state]
                if steps[before] < steps[state]
                or (
                    steps[before] == steps[state]
                    and before < state
                    and (state, before) not in pairs
                )
            ),
            default=0,
        )
    return layer


def _lanes(graph: BranchGraph, part: list[int], rank: dict[int, int]) -> dict[int, list[int]]:
    """Return for each column the states at the ends of the operations that pass it."""
    found: dict[int, list[int]] = {}
    for state in part:
        for other in graph.neighbours[state]:
            for column in range(rank[state] + 1, rank[other]):
                found.setdefault(column, []).extend((state, other))
    return found


def _sorted_columns(
    graph: BranchGraph, states: list[int], layer: list[int], lanes: dict[int, list[int]]
) -> list[list[int]]:
    """Return the columns from left to right, sorted so that few operations cross.

    A lane is a negative number in its column, so it is sorted like a node.
    """
    keys = sorted({layer[i] for i in states})
    columns = [[i for i in states if layer[i] == key] for key in keys]
    near: dict[int, list[int]] = {i: list(graph.neighbours[i]) for i in states}
    for column, ends in lanes.items():
        columns[column].append(-1 - column)
        near[-1 - column] = ends
    for sweep in range(6):
        order = range(1, len(columns)) if sweep % 2 == 0 else range(len(columns) - 2, -1, -1)
        height = {i: slot - (len(c) - 1) / 2 for c in columns for slot, i in enumerate(c)}
        for number in order:
            columns[number] = _by_neighbours(columns[number], near, height)
            for slot, i in enumerate(columns[number]):
                height[i] = slot - (len(columns[number]) - 1) / 2
    return columns


def _by_neighbours(
    column: list[int], near: dict[int, list[int]], height: dict[int, float]
) -> list[int]:
    """Return a column sorted by the mean height of the neighbours of each node."""

    def key(state: int) -> tuple[float, bool, int]:
        """Sort by the mean height of the neighbours, then nodes before lanes, then by number."""
        heights = [height[other] for other in near[state] if other in height]
        mean = sum(heights) / len(heights) if heights else height[state]
        return round(mean, 6), state < 0, state

    return sorted(column, key=key)


def _column_places(
    graph: BranchGraph, columns: list[list[int]], rank: dict[int, int]
) -> list[float]:
    """Return the x of each column (pixels): 218 apart, or more if the labels between two columns
    need it.
    """
    drop = _dropped(graph.operations)
    longest = [0] * len(columns)
    for source, target, name in zip(graph.sources, graph.targets, graph.operations, strict=True):
        left, right = sorted((rank.get(source, -1), rank.get(target, -1)))
        if left >= 0 and right - left == 1:
            longest[left] = max(longest[left], len(name) - drop)
    xs = [0.0]
    for column, label in zip(columns[:-1], longest, strict=False):
        width = 160.0 * (-(-len(column) // _TALL) - 1)
        xs.append(xs[-1] + width + min(300.0, max(COLUMN, 140.0 + 6.2 * label)))
    return xs


def _dropped(operations: Sequence[str]) -> int:
    """Return the length of the prefix that the canvas leaves out, such as ``Op_``."""
    first, last = min(operations, default=""), max(operations, default="")
    same = 0
    while same < min(len(first), len(last)) and first[same] == last[same]:
        same += 1
    return first[:same].rfind("_") + 1
