"""State machines whose states end with outcomes, and the SB that behaves as they do.

RAFCON and FlexBE run a state until it ends with one of its outcomes. A transition leads from an
outcome to the next state, or to an outcome of the machine around it. In an SB each innermost state
is a state, and each of its outcomes is an operation ``State.outcome`` to where it leads in the end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.carried import with_ends
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.foreign_names import ForeignNames
from smsl_studio.exchange.leaf_names import leaf_names
from smsl_studio.stop import heed

Json = Any
MOST_STATES = 50_000
"""The largest number of states of a machine, those in inner machines too."""


@dataclass(eq=False)
class OutcomeNode:
    """One state. ``outcomes`` are names by key. A machine has ``children`` by their ids.

    ``ways`` lead from an outcome of a child, as (id, key), to a child (its id) or, if that is
    empty, to an own outcome (its key). In a ``concurrent`` machine all children run together.
    """

    id: str
    name: str
    place: tuple[int, int]
    outcomes: dict[str, str] = field(default_factory=dict)
    machine: bool = False
    concurrent: bool = False
    start: str = ""
    children: dict[str, OutcomeNode] = field(default_factory=dict)
    ways: dict[tuple[str, str], tuple[str, str]] = field(default_factory=dict)
    parent: OutcomeNode | None = None


def alone(state: OutcomeNode) -> OutcomeNode:
    """Return a machine that runs one state alone and ends as it does."""
    around = OutcomeNode("", state.name, state.place, dict(state.outcomes), machine=True)
    around.start, around.children = state.id, {state.id: state}
    around.ways = {(state.id, key): ("", key) for key in state.outcomes}
    state.parent = around
    return around


QUIET = ("aborted", "preempted")
"""Outcomes that need no transition: they end the machines around, too."""


def values_of_machine(root: OutcomeNode, file: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return a machine as the plain values of a blueprint. ReadError if it has no state."""
    names = ForeignNames("State Branch", findings)
    values: dict[str, Json] = {}
    waiting = [root]
    while waiting:
        machine = waiting.pop(0)
        flat = _FlatMachine(machine, file, findings)
        values[names.of(machine.name, machine.place)] = flat.values()
        waiting.extend(flat.apart)
    return values


class _FlatMachine:
    """One machine, with its innermost states and its own outcomes as the states of an SB."""

    def __init__(self, root: OutcomeNode, file: str, findings: ExchangeFindings) -> None:
        self._root, self._findings = root, findings
        self.apart: list[OutcomeNode] = []
        self._ends: dict[str, str] = {}
        self._names = ForeignNames("state", findings)
        found = list(self._innermost(root))
        if not found:
            words, advice = "the machine has no state", "Name another machine."
            raise ReadError(words, Place(file, *root.place), advice)
        if len(found) > MOST_STATES:
            words = f"it has more than {MOST_STATES:,} states"
            raise ReadError(words, Place(file, *root.place), "Split it.")
        self._leaves = leaf_names(found, root, self._names)

    def values(self) -> dict[str, Json]:
        """Return the SB."""
        found: dict[str, Json] = {
            name: self._operations(leaf) for leaf, name in self._leaves.items()
        }
        found |= {name: {} for name in self._ends.values()}
        start = self._entered(self._root)
        named = [one for one in self._root.outcomes if one in self._ends]
        first = min(named, key=lambda one: self._root.outcomes[one] in QUIET, default="")
        if len(self._ends) != 1:
            last = next(reversed(found))
            words = f"{len(self._ends)} outcomes end the machine; ACTIVATING is"
            words = f"{words} {self._ends[first] if first else last}."
            self._findings.add("activating", self._root.name, words, self._root.place)
        with_ends(found, start or "", self._ends.get(first, ""))
        return found

    def _innermost(self, node: OutcomeNode) -> Iterator[OutcomeNode]:
        for one in node.children.values():
            heed()
            if one.concurrent:
                words = (
                    "What runs together becomes one state, and each inner machine an SB of its own "
                    "that is not coupled with it."
                )
                self._findings.add("concurrent", one.name, words, one.place)
                self.apart.extend(inner for inner in one.children.values() if inner.children)
                yield one
            elif one.children:
                yield from self._innermost(one)
            else:
                if one.machine:
                    words = "The machine has no states, and becomes one state."
                    self._findings.add("empty", one.name, words, one.place)
                yield one

    def _operations(self, leaf: OutcomeNode) -> dict[str, str]:
        found: dict[str, str] = {}
        names = ForeignNames("operation", self._findings)
        for key, outcome in leaf.outcomes.items():
            target = self._after(leaf, key)
            if target:
                found[names.of(f"{leaf.name}.{outcome}", leaf.place)] = target
            elif outcome not in QUIET:
                words = f"The outcome {outcome[:200]!r} has no transition, and is left out."
                self._findings.add("outcome", leaf.name, words, leaf.place)
        return found

    def _after(self, node: OutcomeNode, key: str) -> str:
        """Return the state to which an outcome leads in the end, empty if there is none."""
        while node.parent is not None and node is not self._root:
            machine = node.parent
            way = machine.ways.get((node.id, key))
            if way is None:
                return ""
            child, outcome = way
            if child:
                target = machine.children.get(child)
                return self._entered(target) if target is not None else ""
            if outcome not in machine.outcomes:
                return ""
            if machine is self._root:
                return self._end(outcome)
            node, key = machine, outcome
        return ""

    def _end(self, outcome: str) -> str:
        if outcome not in self._ends:
            self._ends[outcome] = self._names.of(self._root.outcomes[outcome], self._root.place)
        return self._ends[outcome]

    def _entered(self, node: OutcomeNode) -> str:
        """Return the innermost state in which a state begins."""
        while node not in self._leaves and node.children:
            start = node.children.get(node.start)
            if start is None:
                start = next(iter(node.children.values()))
                words = f"It has no start; {start.name[:200]!r} is taken."
                self._findings.add("start", node.name, words, node.place)
            node = start
        return self._leaves.get(node, "")
