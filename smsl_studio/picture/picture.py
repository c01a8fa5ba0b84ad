"""Picture: the states and operations of one SB as arrays for drawing. It knows no places and no
Qt.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.edge_layout import EdgeLayout
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.numbers import numbers_of
from smsl_studio.blueprint.plain_words import is_plain_word
from smsl_studio.picture.bundles import NO_BUNDLES, Bundles, bundles_of, chip_size, with_lane
from smsl_studio.picture.chip_kinds import chip_kind
from smsl_studio.picture.chip_words import ChipWords
from smsl_studio.picture.crowd import MOST_CAREFUL, MOST_LED
from smsl_studio.picture.guards import Guard, guards_of, has_guards
from smsl_studio.picture.prefix import left_out
from smsl_studio.picture.returns import lane_chip_size, returns_of
from smsl_studio.picture.short_form import ShortForms
from smsl_studio.picture.sub_marks import sub_mark

Ints = NDArray[np.int32]
SMALL_STATES, SMALL_EDGES = 250, 260


@dataclass(frozen=True)
class Chip:
    """One fact on a node: its value, its kind (``on``, ``off`` or ``value``), and the sub-SB below
    it.
    """

    text: str
    kind: str
    sub: str = ""


@dataclass(frozen=True)
class Face:
    """The content of a node: name, title, facts, text of the compact form, and role.

    ``short`` is derived from the name, or it is the name (see ``ShortForms``).
    """

    name: str
    title: str
    chips: tuple[Chip, ...]
    short: str
    initial: bool
    activating: bool
    pinned: bool = False
    """Whether the window marks it as pinned. Exported pictures do not show that."""


MOST_CHIPS = 64
"""The largest number of facts of a state with a chip. A node is never wide enough for more."""


class Picture:
    """States and operations of one SB as integer arrays. Faces and labels are made when they are
    asked for.

    ``source`` and ``target`` give the states of each edge by number. An edge whose target is not a
    state of the SB (rule R02) has target -1 and is drawn as a stub. ``crowd`` is the size of a
    picture with several SBs (see ``crowd_of``). All operations of a bundle have one line.
    """

    bundles = NO_BUNDLES
    collapsed = False
    """Whether operations between the same two states are drawn as one line, where nothing speaks
    against it."""

    def __init__(
        self, blueprint: Blueprint, branch: str, crowd: int = 0, words: bool = False
    ) -> None:
        """``words`` shows on the chips what values mean, if the blueprint says it."""
        self.blueprint, self.crowd = blueprint, crowd
        self.branch: StateBranch = blueprint[branch]
        self._words = ChipWords(self.branch) if words else None
        self.names = tuple(self.branch.table)
        numbers, table = numbers_of(self.branch), self.branch.table
        self.index, targets = numbers.of, numbers.targets
        if numbers.dangles:
            targets = [-1 if target is None else target for target in targets]
        counts = np.fromiter(map(len, table.values()), np.int32, len(self.names))
        self.source: Ints = np.repeat(np.arange(len(self.names), dtype=np.int32), counts)
        self.target: Ints = np.array(targets, dtype=np.int32)
        self.first: Ints = np.cumsum(counts, dtype=np.int32) - counts
        """The number of the first edge out of each state; the others follow it."""
        self.operations = tuple(chain.from_iterable(table.values()))
        self.prefix = left_out(self.branch.operation_names)
        self._shorts = ShortForms(self.branch)
        self._faces: dict[int, Face] = {}
        self._chip_kinds: dict[tuple[int, str], str] = {}
        self._kinds: dict[int, str] = {}

    def __len__(self) -> int:
        return len(self.names)

    @property
    def careful(self) -> bool:
        """Whether lines are led around nodes. Larger pictures have no detours."""
        return self.line_count <= MOST_LED and self.crowd <= MOST_CAREFUL

    @property
    def small(self) -> bool:
        """Whether the picture is small: then all its lines are computed together, and labels are
        placed off the lines.
        """
        alone = len(self.names) <= SMALL_STATES and self.line_count <= SMALL_EDGES
        return alone and self.crowd <= MOST_CAREFUL

    @cached_property
    def all_bundles(self) -> Bundles:
        """The bundles of all operations that can be in one. In a small picture one of them may be
        the lane back to the start."""
        found = bundles_of(self.source, self.target)
        back = returns_of(self.source, self.target, self.index.get(self.branch.initial, -1))
        laned = with_lane(found, back)
        return laned if back and self.bundled(laned).small else found

    def collapse(self, alone: Collection[int] = ()) -> Picture:
        """Return the same picture, collapsed.

        Operations in ``alone`` are in no bundle. Operations whose lines are drawn by hand are in
        none, either.
        """
        found = self.bundled(self.all_bundles.without({*alone, *self.edge_layouts()}))
        found.collapsed = True
        return found

    def bundled(self, bundles: Bundles) -> Picture:
        """Return the same picture with these bundles."""
        found = copy(self)
        found.bundles = bundles
        return found

    @property
    def line_count(self) -> int:
        """How many lines are drawn."""
        return len(self.operations) - len(self.bundles.hidden)

    @cached_property
    def grouped(self) -> frozenset[str]:
        """The states that are in a group of the drawing."""
        groups = self.branch.drawn.groups.values()
        return frozenset(chain.from_iterable(group.states for group in groups))

    def chip_size(self, edge: int) -> tuple[float, float]:
        """Return the width and height of the chip of an edge's bundle (pixels of a mark)."""
        count = self.bundles.count(edge)
        lane = self.line_of(edge) == self.bundles.lane
        return lane_chip_size(count) if lane else chip_size(count)

    @property
    def stubs(self) -> list[int]:
        """The states from which an operation leads back to the start by the lane."""
        lane = self.bundles.members.get(self.bundles.lane, ())
        return list(dict.fromkeys(self.source[list(lane)].tolist()))

    def leads_back(self, edge: int) -> bool:
        """Return whether an operation in the bundle of this edge leads the other way."""
        own = self.bundles.members.get(edge, ())
        return any(self.source[other] == self.target[edge] for other in own)

    def line_of(self, edge: int) -> int:
        """Return the edge whose line stands for this one: itself, or the first of its bundle."""
        return self.bundles.first.get(edge, edge)

    def numbered(self, state: str, operation: str) -> int:
        """Return the number of the edge with this name out of a state, -1 if there is none."""
        at = self.index.get(state, -1)
        operations = self.branch.table[state] if at >= 0 else ()
        if operation not in operations:
            return -1
        return int(self.first[at]) + list(operations).index(operation)

    @cached_property
    def incident(self) -> tuple[Ints, Ints]:
        """The edges of each state, both leaving and entering, as two arrays: offsets and edge
        numbers.
        """
        edges = np.arange(len(self.source), dtype=np.int32)
        ends = np.concatenate([self.source, self.target])
        both = np.concatenate([edges, edges])
        keep = ends >= 0
        order = np.argsort(ends[keep], kind="stable")
        starts = np.searchsorted(ends[keep][order], np.arange(len(self) + 1))
        return starts.astype(np.int32), both[keep][order]

    def edges_of(self, state: int) -> list[int]:
        """Return the numbers of the edges that leave or enter a state and have a line."""
        starts, edges = self.incident
        return self._drawn(dict.fromkeys(edges[starts[state] : starts[state + 1]].tolist()))

    def dangling(self, state: int) -> list[int]:
        """Return the edges that leave a state and have no target."""
        return [edge for edge in self.edges_of(state) if self.target[edge] < 0]

    def _drawn(self, edges: Iterable[int]) -> list[int]:
        """Return those of the edges that have a line of their own."""
        hidden = self.bundles.hidden
        return [edge for edge in edges if edge not in hidden]

    @cached_property
    def pair_numbers(self) -> NDArray[np.int64]:
        """A number for each edge. Edges between the same two states have the same, in either
        direction.
        """
        low, high = np.minimum(self.source, self.target), np.maximum(self.source, self.target)
        return low.astype(np.int64) * (len(self) + 1) + high

    @cached_property
    def _by_ends(self) -> tuple[NDArray[np.int64], Ints]:
        """The edges by their two ends in either direction: the sorted keys, and the number of each
        edge.
        """
        keys = self.pair_numbers
        order = np.argsort(keys, kind="stable")
        return keys[order], order.astype(np.int32)

    @cached_property
    def _by_states(self) -> dict[tuple[int, int], list[int]]:
        """The numbers of the edges by source and target, for a small picture."""
        found: dict[tuple[int, int], list[int]] = {}
        ends = zip(self.source.tolist(), self.target.tolist(), strict=True)
        for edge, pair in enumerate(ends):
            found.setdefault(pair, []).append(edge)
        return found

    @cached_property
    def drawn_once(self) -> NDArray[np.bool_]:
        """Whether each edge is drawn if straight lines between the same states are drawn once: one
        of two opposite edges, and every edge without an opposite.
        """
        forward = self.source.astype(np.int64) * len(self) + self.target
        back = self.target.astype(np.int64) * len(self) + self.source
        ordered = np.sort(forward)
        nearest = ordered[np.minimum(np.searchsorted(ordered, back), max(len(ordered) - 1, 0))]
        once: NDArray[np.bool_] = (self.source < self.target) | (nearest != back)
        return once

    def between(self, a: int, b: int) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Return the numbers of the edges with a line from ``a`` to ``b``, and of those from ``b``
        to ``a``.
        """
        if self.small:
            found = self._by_states
            both = found.get((a, b), ()), found.get((b, a), ())
            return tuple(self._drawn(both[0])), tuple(self._drawn(both[1]))
        keys, numbers = self._by_ends
        key = min(a, b) * (len(self) + 1) + max(a, b)
        first, last = np.searchsorted(keys, (key, key + 1))
        edges = numbers[first:last]
        there = self.source[edges] == a
        drawn = self._drawn(edges[there].tolist()), self._drawn(edges[~there].tolist())
        return tuple(drawn[0]), tuple(drawn[1])

    def pairs(self) -> list[tuple[int, int]]:
        """Return the pairs of different states that edges join. The lower number comes first."""
        lines = (self.target >= 0) & (self.source != self.target)
        source, target = self.source[lines], self.target[lines]
        low, high = np.minimum(source, target).tolist(), np.maximum(source, target).tolist()
        return list(dict.fromkeys(zip(low, high, strict=True)))

    def address(self, edge: int) -> Address:
        """Return the address of an edge."""
        return Address(self.branch.name, self.names[self.source[edge]], self.operations[edge])

    def edge(self, address: Address) -> int:
        """Return the number of an edge, -1 if this SB has none at the address."""
        if address.branch != self.branch.name or not address.operation:
            return -1
        return self.numbered(address.state, address.operation)

    def node(self, address: Address) -> int:
        """Return the number of a state, -1 if this SB has none at the address."""
        if address.branch != self.branch.name or address.operation:
            return -1
        return self.index.get(address.state, -1)

    def edge_layouts(self) -> dict[int, EdgeLayout]:
        """Return the edges whose line or label somebody has drawn by hand, with their layout."""
        drawn = self.branch.notes.edges.items()
        found = {self.numbered(*edge): layout for edge, layout in drawn}
        return {edge: layout for edge, layout in found.items() if edge >= 0}

    def label(self, edge: int) -> str:
        """Return an edge's label: the operation's name without the prefix that (nearly) all
        operations share.
        """
        return self.operations[edge].removeprefix(self.prefix)

    def is_cut(self, edge: int) -> bool:
        """Return whether an edge's label lacks the prefix of the operation's name."""
        return bool(self.prefix) and self.operations[edge].startswith(self.prefix)

    @cached_property
    def first_shortened(self) -> int:
        """The first state whose short form is not its name, -1 if there is none."""
        shortened = (at for at, name in enumerate(self.names) if self._shorts.of(name) != name)
        return next(shortened, -1)

    def kind(self, edge: int) -> str:
        """Return ``rise``, ``fall`` or ``mixed``, or the empty text if no fact of a sub-SB
        changes.
        """
        found = self._kinds.get(edge)
        if found is None:
            found = self._kinds[edge] = self._kind_of(edge)
        return found

    def guards(self, edge: int) -> tuple[Guard, ...]:
        """Return the facts that an edge requires before it starts."""
        if not self.guarded:
            return ()
        state = self.names[self.source[edge]]
        return guards_of(self.blueprint, self.branch, state, self.operations[edge])

    @cached_property
    def guarded(self) -> bool:
        """Whether any operation of this SB requires a fact."""
        return has_guards(self.branch)

    @cached_property
    def mixed(self) -> frozenset[int]:
        """The edges that change a sub-SB's fact together with others, or that load a sub-SB."""
        if not self.branch.subs:
            return frozenset()
        note, names = self.branch.operation_note, self.names
        return frozenset(
            edge
            for edge, (state, operation) in enumerate(
                zip(self.source.tolist(), self.operations, strict=True)
            )
            if self.kind(edge) == "mixed" or note(names[state], operation).subs == "load"
        )

    def _kind_of(self, edge: int) -> str:
        if not self.branch.subs or self.target[edge] < 0:
            return ""
        source = self.names[self.source[edge]]
        return sub_mark(self.branch, self.branch.operation(source, self.operations[edge]))

    def face(self, state: int) -> Face:
        """Return the content of a state's node."""
        found = self._faces.get(state)
        if found is None:
            found = self._faces[state] = self._face_of(self.names[state])
        return found

    def _face_of(self, name: str) -> Face:
        branch = self.branch
        note = branch.state_note(name)
        chips: tuple[Chip, ...] = ()
        if not branch.shape.opaque and not is_plain_word(branch, name):
            shown = enumerate(branch.facts(name)[:MOST_CHIPS])
            chips = tuple(self._chip(d, value) for d, value in shown)
        return Face(
            name=name,
            title=note.title if note else "",
            chips=chips,
            short=self._shorts.of(name),
            initial=name == branch.initial,
            activating=name == branch.activating,
            pinned=name in branch.notes.pinned,
        )

    def _chip(self, digit: int, value: str) -> Chip:
        sub = self.branch.subs.get(digit, "")
        text = self._words.text(digit, value) if self._words is not None else value
        key = digit, value
        if key not in self._chip_kinds:
            self._chip_kinds[key] = chip_kind(self.branch, digit, value)
        return Chip(text, self._chip_kinds[key], sub)
