"""Edges by their effect on sub digits (clause 2), and the data that a joint step needs (clause
5).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from types import MappingProxyType
from typing import Protocol

from smsl_studio.blueprint.address import Address, split_fact
from smsl_studio.blueprint.configuration import Configuration, Hierarchy
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import StateBranch


class EdgeKind(Enum):
    """The effect of an edge on the digits that sub-SBs expand."""

    PURE = "pure"
    """It changes none of them."""
    RISE = "rise"
    """It turns one on, and changes nothing else."""
    FALL = "fall"
    """It turns one off, and changes nothing else."""
    MIXED = "mixed"
    """It changes one together with other digits, or several."""


@dataclass(frozen=True, slots=True)
class Edge:
    """One operation with everything that its joint step depends on.

    ``crossing`` is 1 if it enters its SB's ACTIVATING state, -1 if it leaves it, else 0.
    ``function`` says that its own library function runs. ``cost`` is its own part of a route's cost
    (clause 12). ``price`` is its declared cost, by which edges of bases are chosen (clause 10).
    ``requires`` has (SB, digit, value); a digit of -1 is a fact that does not exist. ``fails``
    names the failure if it leads from a state without failure into a failure state.
    ``text`` is its address as text.
    """

    branch: str
    source: str
    name: str
    target: str
    kind: EdgeKind = EdgeKind.PURE
    falls: tuple[int, ...] = ()
    rises: tuple[int, ...] = ()
    crossing: int = 0
    load: bool = False
    function: bool = True
    cost: float = 1.0
    price: float = 1.0
    requires: tuple[tuple[str, int, str], ...] = ()
    fails: str = ""
    address: Address = field(init=False, repr=False, compare=False)
    text: str = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        address = Address(self.branch, self.source, self.name)
        object.__setattr__(self, "address", address)
        object.__setattr__(self, "text", str(address))

    def __hash__(self) -> int:
        return hash(self.text)

    def __str__(self) -> str:
        return self.text


class Extra(Protocol):
    """The additional cost of an edge. Only edges without a function, edges into a failure, and
    those in ``closed`` may have one.
    """

    @property
    def closed(self) -> Mapping[Address, str]:
        """The edges that routes avoid, with the reason of each."""

    def __call__(self, edge: Edge) -> float: ...


NO_COSTS: Mapping[Address, float] = MappingProxyType({})


class Edges:
    """The edges of one blueprint. Each is made when it is first asked for.

    ``exact`` are the addresses with a function that is bound to exactly this ``State/Operation``.
    Only such functions run on an edge that needs none. ``costs`` replace declared costs, and
    ``extra`` gives additional costs.
    """

    def __init__(
        self,
        hierarchy: Hierarchy,
        exact: Collection[Address] = (),
        costs: Mapping[Address, float] = NO_COSTS,
        extra: Extra | None = None,
    ) -> None:
        self.hierarchy = hierarchy
        self.blueprint = hierarchy.blueprint
        self.exact = exact
        self.costs = costs
        self._extra = extra
        self._out: dict[tuple[str, str], tuple[Edge, ...]] = {}
        self._named: dict[tuple[str, str], dict[str, Edge]] = {}
        self._required_by: dict[str, frozenset[str]] = {}
        self._seen: dict[tuple[str, str], tuple[tuple[int, ...], tuple[str, ...]]] = {}

    def out(self, branch: str, state: str) -> tuple[Edge, ...]:
        """Return every edge out of a state, in written order. Edges to unknown targets are left
        out.
        """
        found = self._out.get((branch, state))
        if found is None:
            own = self.blueprint[branch]
            found = tuple(
                self._edge(own, state, name, target)
                for name, target in own.table[state].items()
                if target in own.table
            )
            if self._extra is not None:
                found = tuple(_dearer(edge, self._extra(edge)) for edge in found)
            self._out[branch, state] = found
        return found

    def get(self, address: Address) -> Edge | None:
        """Return the edge at an address, or None if its target does not exist."""
        at = address.branch, address.state
        found = self._named.get(at)
        if found is None:
            found = self._named[at] = {edge.name: edge for edge in self.out(*at)}
        return found.get(address.operation)

    def required_by(self, branch: str) -> frozenset[str]:
        """Return the SBs whose facts operations of this SB require."""
        found = self._required_by.get(branch)
        if found is None:
            found = self._required_by[branch] = frozenset(
                name
                for note in self.blueprint[branch].notes.operations.values()
                for key, value in note.requires.items()
                for name, digit, _ in [self._required(key, value)]
                if digit >= 0
            )
        return found

    def _edge(self, branch: StateBranch, source: str, name: str, target: str) -> Edge:
        enters = (target == branch.activating) - (source == branch.activating)
        crossing = enters if self.hierarchy.bases[branch.name] else 0
        subs = self.hierarchy.subs[branch.name]
        failing = failing_states(branch)
        fails = failing.get(target, "") if failing and source not in failing else ""
        if not subs and not self.costs and "_operations" not in branch.fields:
            return Edge(branch.name, source, name, target, crossing=crossing, fails=fails)
        (before, own), (after, new) = self._digits(branch, source), self._digits(branch, target)
        falls = tuple(digit for digit in before if digit not in after)
        rises = tuple(digit for digit in after if digit not in before)
        others = self._others(own, new)
        kind = _kind(falls, rises, others)
        note = branch.operation_note(source, name)
        load = note.subs == "load" and bool(falls or rises)
        address = Address(branch.name, source, name)
        exact = address in self.exact
        function = load or kind is EdgeKind.PURE or others or exact
        price = self.costs.get(address)
        if price is None:
            price = branch.cost(source, name)
        single = kind in (EdgeKind.RISE, EdgeKind.FALL)
        requires = tuple(self._required(key, value) for key, value in note.requires.items())
        return Edge(
            branch.name,
            source,
            name,
            target,
            kind,
            falls,
            rises,
            crossing,
            load,
            function,
            0.0 if single and not function else price,
            price,
            requires,
            fails,
        )

    def _digits(self, branch: StateBranch, state: str) -> tuple[tuple[int, ...], tuple[str, ...]]:
        """Return the digits with sub-SBs that are on in a state, and the values of the others."""
        found = self._seen.get((branch.name, state))
        if found is None:
            subs = {digit for digit, _ in self.hierarchy.subs[branch.name]}
            facts = branch.facts(state)
            found = self._seen[branch.name, state] = (
                tuple(digit for digit in sorted(subs) if branch.is_on(state, digit)),
                tuple(value for digit, value in enumerate(facts) if digit not in subs),
            )
        return found

    def _others(self, own: tuple[str, ...], new: tuple[str, ...]) -> bool:
        """Return whether a digit without a sub-SB changes."""
        return own != new and any(a != b for a, b in zip(own, new, strict=False))

    def _required(self, key: str, value: str) -> tuple[str, int, str]:
        name, digit = split_fact(key) or (key, -1)
        branch = self.blueprint.branches.get(name)
        if branch is None or digit >= branch.num_facts:
            return key, -1, value
        return name, digit, value

    def missing(self, edge: Edge, configuration: Configuration) -> Iterator[str]:
        """Yield a sentence for each fact that an edge requires and that the configuration does not
        have.
        """
        for name, digit, value in edge.requires:
            if digit < 0:
                yield f"{edge} requires {name}, which is no fact"
                continue
            held = self.blueprint[name].facts(configuration[name])[digit]
            if held != value:
                yield f"{edge} requires {name}/{digit} to be {value}, and it is {held}"


def _dearer(edge: Edge, extra: float) -> Edge:
    if not extra:
        return edge
    return replace(edge, cost=edge.cost + extra, price=edge.price + extra)


def _kind(falls: tuple[int, ...], rises: tuple[int, ...], others: bool) -> EdgeKind:
    changed = len(falls) + len(rises)
    if changed == 0:
        return EdgeKind.PURE
    if changed > 1 or others:
        return EdgeKind.MIXED
    return EdgeKind.RISE if rises else EdgeKind.FALL
