"""The map of branches: a card for each SB, and a line from each expanded fact to its sub-SB.

A base stands left of its sub-SBs. A line begins at the row of the fact that the sub-SB expands. No
line passes through a card. A line to the next column runs between the two columns. A longer line
runs below all cards.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.picture.shape import Point

WIDE, HEAD, SKETCH, ROW, FOOT = 232.0, 46.0, 104.0, 22.0, 8.0
"""The width of a card, and the heights of its title, its small drawing, the row of a fact, and its
lower border (pixels)."""
BETWEEN, BELOW, TRACK = 40.0, 24.0, 9.0
"""The smallest distances between two columns, two cards in a column, and two lines (pixels)."""


@dataclass(frozen=True)
class MapFact:
    """A fact that a sub-SB expands. ``missing`` says that there is no SB of this name."""

    digit: int
    name: str
    sub: str
    missing: bool = False


@dataclass(frozen=True)
class MapCard:
    """The card of one SB at its place. ``file`` is the imported file of the SB. It is empty if the
    SB stands in the blueprint's own file.
    """

    name: str
    states: int
    operations: int
    file: str
    facts: tuple[MapFact, ...]
    plain: int
    """The number of facts that no sub-SB expands."""
    left: float
    top: float

    @property
    def height(self) -> float:
        """The height of the card (pixels)."""
        return HEAD + SKETCH + ROW * (len(self.facts) + bool(self.plain)) + FOOT

    def row(self, digit: int) -> float:
        """Return the y of the middle of a fact's row (pixels from the top of the map)."""
        rows = [fact.digit for fact in self.facts]
        return self.top + HEAD + SKETCH + ROW * (rows.index(digit) + 0.5)


@dataclass(frozen=True)
class MapLink:
    """The line from a fact of a base to the sub-SB that expands it."""

    base: str
    digit: int
    sub: str
    line: tuple[Point, ...]


@dataclass(frozen=True)
class BranchMap:
    """The cards by the names of their SBs, in the order of the columns, and the lines (pixels)."""

    cards: Mapping[str, MapCard]
    links: tuple[MapLink, ...]
    width: float
    height: float


def branch_map(blueprint: Blueprint) -> BranchMap:
    """Return the map of all SBs of a blueprint. Cycles of sub-SBs are drawn, too."""
    columns = _columns(blueprint)
    ways = _ways(blueprint, columns)
    tracks = _tracks(ways, len(columns))
    cards = _cards(blueprint, columns, tracks)
    return _drawn(cards, ways, len(columns))


# columns ----------------------------------------------------------------------------------------


def _columns(blueprint: Blueprint) -> list[list[str]]:
    """Return the SBs of each column. An SB stands right of all its bases.

    The SBs of a column are sorted by the places of their bases.
    """
    level = _levels(blueprint)
    columns: list[list[str]] = [[] for _ in range(max(level.values(), default=-1) + 1)]
    for name in blueprint.branches:
        columns[level[name]].append(name)
    for number in range(1, len(columns)):
        before = {name: at for at, name in enumerate(columns[number - 1])}
        columns[number].sort(key=lambda name: _wish(blueprint, name, before))
    return columns


def _wish(blueprint: Blueprint, name: str, before: Mapping[str, int]) -> tuple[float, int]:
    """Return the sort key of a sub-SB in its column: the first fact that leads to it, as the place
    of the base in the column before and the number of the fact.
    """
    at = [(before[base], digit) for base, digit in blueprint.bases.get(name, ()) if base in before]
    return min(at, default=(len(before), 0))


def _levels(blueprint: Blueprint) -> dict[str, int]:
    """Return the column of each SB. A fact that closes a cycle of sub-SBs does not count."""
    level = dict.fromkeys(blueprint.branches, 0)
    opened: dict[str, Iterator[str]] = {}
    order: list[str] = []
    done: set[str] = set()
    for root in (*blueprint.roots, *blueprint.branches):
        if root in done:
            continue
        opened[root] = _subs(blueprint, root)
        while opened:
            name = next(reversed(opened))
            below = next(_new(opened[name], done, opened), None)
            if below is not None:
                opened[below] = _subs(blueprint, below)
                continue
            del opened[name]
            done.add(name)
            order.append(name)
    place = {name: at for at, name in enumerate(order)}
    for name in reversed(order):
        for sub in _subs(blueprint, name):
            if place[sub] < place[name]:
                level[sub] = max(level[sub], level[name] + 1)
    return level


def _new(subs: Iterator[str], *known: Container[str]) -> Iterator[str]:
    return (sub for sub in subs if not any(sub in names for names in known))


def _subs(blueprint: Blueprint, name: str) -> Iterator[str]:
    return (sub for sub in blueprint[name].subs.values() if sub in blueprint.branches)


# lines ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Way:
    """The plan of a line. ``lane`` is its number among the lines below all cards. It is -1 if the
    line does not run there.
    """

    base: str
    digit: int
    sub: str
    leaves: int
    enters: int
    """``leaves`` and ``enters`` are the gaps in which the line goes up or down, after its base and
    before its sub-SB. Gap 0 is left of the first column.
    """
    lane: int


def _ways(blueprint: Blueprint, columns: Sequence[Sequence[str]]) -> list[_Way]:
    level = {name: number for number, names in enumerate(columns) for name in names}
    found: list[_Way] = []
    lanes = 0
    for name in (name for names in columns for name in names):
        for digit, sub in blueprint[name].subs.items():
            if sub not in level:
                continue
            near = level[sub] == level[name] + 1
            leaves, enters = level[name] + 1, level[sub]
            found.append(_Way(name, digit, sub, leaves, enters, -1 if near else lanes))
            lanes += not near
    return found


def _tracks(ways: Sequence[_Way], columns: int) -> list[int]:
    """Return the number of vertical lines in each gap between columns."""
    counts = [0] * (columns + 1)
    for way in ways:
        counts[way.leaves] += 1
        if way.lane >= 0:
            counts[way.enters] += 1
    return counts


def _cards(
    blueprint: Blueprint, columns: Sequence[Sequence[str]], tracks: Sequence[int]
) -> dict[str, MapCard]:
    """Return the cards at their places, from top to bottom in each column. A card stands as high as
    the first fact that leads to it, or lower if there is no room.
    """
    made: dict[str, MapCard] = {}
    left = _gap(tracks[0]) if columns and tracks[0] else 0.0
    for number, names in enumerate(columns):
        free = 0.0
        for name in names:
            wished = min(
                (made[base].row(digit) for base, digit in blueprint.bases.get(name, ())
                 if base in made and made[base].left < left),
                default=0.0,
            )  # fmt: skip
            top = max(free, wished - HEAD - SKETCH / 2)
            made[name] = card = _card(blueprint, blueprint[name], left, top)
            free = top + card.height + BELOW
        left += WIDE + _gap(tracks[number + 1])
    return made


def _card(blueprint: Blueprint, branch: StateBranch, left: float, top: float) -> MapCard:
    home = blueprint.imported.get(branch.name)
    facts = tuple(
        MapFact(digit, branch.fact_name(digit), sub, sub not in blueprint.branches)
        for digit, sub in sorted(branch.subs.items())
    )
    plain = max(branch.num_facts - len(facts), 0)
    file = home.file if home is not None else ""
    return MapCard(branch.name, len(branch.table), branch.edge_count, file, facts, plain, left, top)


def _gap(tracks: int) -> float:
    return BETWEEN + TRACK * tracks


def _drawn(cards: Mapping[str, MapCard], ways: Sequence[_Way], columns: int) -> BranchMap:
    """Return the finished map: the cards at their places, and the lines between them."""
    bottom = max((card.top + card.height for card in cards.values()), default=0.0)
    lefts = sorted({card.left for card in cards.values()})
    starts = [0.0, *(left + WIDE for left in lefts)]
    used = [0] * (columns + 1)

    def track(gap: int) -> float:
        """Return the x of the next vertical line in a gap."""
        used[gap] += 1
        return starts[gap] + BETWEEN / 2 + TRACK * (used[gap] - 1)

    links = []
    for way in sorted(ways, key=lambda way: _order_in_gap(cards, way)):
        base, sub = cards[way.base], cards[way.sub]
        out, into = base.row(way.digit), sub.top + HEAD / 2
        x = track(way.leaves)
        line: list[Point] = [(base.left + WIDE, out), (x, out)]
        if way.lane >= 0:
            y, back = bottom + BELOW + TRACK * way.lane, track(way.enters)
            line += [(x, y), (back, y), (back, into)]
        else:
            line.append((x, into))
        links.append(MapLink(way.base, way.digit, way.sub, (*line, (sub.left, into))))
    wide = max((x for link in links for x, _ in link.line), default=0.0)
    high = max((y for link in links for _, y in link.line), default=0.0)
    width = max(wide, *(left + WIDE for left in lefts), 0.0) if lefts else 0.0
    return BranchMap(cards, tuple(links), width, max(high, bottom))


def _order_in_gap(cards: Mapping[str, MapCard], way: _Way) -> tuple[int, float, str, int]:
    """Return the sort key of a vertical line among those of its gap, from left to right.

    Lines that go down are sorted from the lowest start to the highest one. Lines that go up are
    sorted from the highest start to the lowest one. In this order few lines cross.
    """
    out, into = cards[way.base].row(way.digit), cards[way.sub].top + HEAD / 2
    down = way.lane >= 0 or into > out
    return way.leaves, -out if down else out, way.base, way.digit
