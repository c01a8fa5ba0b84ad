"""A statechart of another program, and the SBs that behave as it does.

SCXML and XState nest states in states. An SB has no nested states: each innermost state becomes a
state, and has the transitions of all states around it, as far as no inner one takes the event
before. Regions of a parallel state become SBs of their own.
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
from smsl_studio.smsl.document.limits import MAX_BRANCHES
from smsl_studio.stop import heed

Json = Any
MOST_EDGES = 400_000
"""The largest number of operations that a chart may become."""


@dataclass(eq=False)
class ChartWay:
    """A transition: the events that it waits for, and the nodes it leads to, by their ids.

    ``operation`` is the name that Studio has written. ``conditional`` tells that it may be refused.
    """

    events: tuple[str, ...]
    targets: tuple[str, ...]
    place: tuple[int, int]
    operation: str = ""
    conditional: bool = False


@dataclass(eq=False)
class ChartNode:
    """A state of a chart. ``initial`` and ``activating`` are ids of nodes below it.

    ``branch`` has what Studio wrote beside an SB, ``state`` what it wrote beside a state.
    """

    id: str
    name: str
    kind: str
    place: tuple[int, int]
    initial: str = ""
    activating: str = ""
    children: list[ChartNode] = field(default_factory=list)
    ways: list[ChartWay] = field(default_factory=list)
    parent: ChartNode | None = None
    branch: dict[str, Json] | None = None
    state: dict[str, Json] = field(default_factory=dict)

    @property
    def inner(self) -> list[ChartNode]:
        """The states in it, without history."""
        return [one for one in self.children if one.kind != "history"]


@dataclass(eq=False)
class Chart:
    """A whole chart, with its nodes by id and what Studio wrote beside the file."""

    root: ChartNode
    nodes: dict[str, ChartNode]
    file: str
    fields: dict[str, Json] = field(default_factory=dict)


def values_of_chart(chart: Chart, findings: ExchangeFindings) -> dict[str, Json]:
    """Return a chart as the plain values of a blueprint. ReadError if it would be too large."""
    names = ForeignNames("State Branch", findings)
    values: dict[str, Json] = dict(chart.fields)
    waiting = _regions(chart.root)
    left = MOST_EDGES
    while waiting:
        region = waiting.pop(0)
        if len(values) > MAX_BRANCHES:
            break  # the reader of blueprints says so
        flat = _FlatRegion(chart, region, findings)
        values[names.of(region.name, region.place)] = flat.values(left)
        left -= flat.edges
        waiting.extend(flat.apart)
    return values


def _regions(root: ChartNode) -> list[ChartNode]:
    """Return the nodes that become SBs: the regions of a parallel root, else the root."""
    inner = root.inner
    if root.kind != "parallel" and len(inner) == 1 and not root.ways:
        only = inner[0]
        if only.kind == "parallel":
            return only.inner
        if only.branch is not None:
            return [only]
    return inner if root.kind == "parallel" else [root] if inner else []


class _FlatRegion:
    """One region, with its innermost states as the states of an SB."""

    def __init__(self, chart: Chart, region: ChartNode, findings: ExchangeFindings) -> None:
        self._chart, self._region, self._findings = chart, region, findings
        self.apart: list[ChartNode] = []
        self.edges = 0
        found = list(self._innermost(region)) if region.inner else []
        self._leaves = leaf_names(found, region, ForeignNames("state", findings))

    def values(self, most: int) -> dict[str, Json]:
        """Return the SB. ReadError if it has more than ``most`` operations."""
        region = self._region
        found: dict[str, Json] = dict(region.branch or {})
        for leaf, name in self._leaves.items():
            heed()
            found[name] = {**leaf.state, **self._operations(leaf)}
            if self.edges > most:
                words = f"it would become more than {MOST_EDGES:,} operations"
                place = Place(self._chart.file, *leaf.place)
                raise ReadError(words, place, "Split the chart.")
        start = self._entered(region) if self._leaves else None
        with_ends(found, self._leaves.get(start, "") if start else "", self._goal())
        return found

    def _goal(self) -> str:
        region = self._region
        known = self._chart.nodes.get(region.activating)
        if known is not None and known in self._leaves:
            return self._leaves[known]
        finals = [leaf for leaf in self._leaves if leaf.kind == "final" and leaf.parent is region]
        if len(finals) == 1:
            return self._leaves[finals[0]]
        if self._leaves and region.branch is None:
            last = next(reversed(self._leaves.values()))
            words = (
                f"{len(finals)} outer states are final, so ACTIVATING is the last state, {last}."
            )
            self._findings.add("activating", region.name, words, region.place)
        return ""

    def _innermost(self, node: ChartNode) -> Iterator[ChartNode]:
        for one in node.inner:
            if one.kind == "parallel":
                words = (
                    "A parallel state inside another one becomes one state, and each of its "
                    "regions an SB of its own that is not coupled with it."
                )
                self._findings.add("parallel", one.id, words, one.place)
                self.apart.extend(one.inner)
                yield one
            elif one.inner:
                yield from self._innermost(one)
            else:
                yield one

    def _operations(self, leaf: ChartNode) -> dict[str, str]:
        """Return the operations of an innermost state. Those of inner states come first."""
        found: dict[str, str] = {}
        taken: dict[str, bool] = {}
        node: ChartNode | None = leaf
        names = ForeignNames("operation", self._findings)
        while node is not None:
            for way in node.ways:
                for event in way.events or ("always",):
                    if taken.get(event) or not self._comes(leaf, node, event):
                        continue
                    target = self._target(leaf, way)
                    if target is None:
                        continue
                    taken[event] = not way.conditional
                    found[names.of(way.operation or event, way.place)] = self._leaves[target]
                    self.edges += 1
            if node is self._region:
                break
            node = node.parent
        return found

    def _comes(self, leaf: ChartNode, node: ChartNode, event: str) -> bool:
        """Return whether an event can come here: that of a completed state only in its end."""
        if not event.startswith("done.state."):
            return True
        done = event.removeprefix("done.state.")
        return node.id != done or (leaf.kind == "final" and leaf.parent is node)

    def _target(self, leaf: ChartNode, way: ChartWay) -> ChartNode | None:
        if not way.targets:
            return leaf
        if len(way.targets) > 1:
            words = "It leads to several states at once. Only the first one is taken."
            self._findings.add("targets", leaf.id, words, way.place)
        node = self._chart.nodes.get(way.targets[0])
        found = self._entered(node) if node is not None else None
        if found is None:
            words = f"It leads to {way.targets[0][:200]!r}, which is no state of this region."
            self._findings.add("target", leaf.id, words, way.place)
        return found

    def _entered(self, node: ChartNode) -> ChartNode | None:
        """Return the innermost state in which a node is entered, None outside of the region."""
        if node.kind == "history":
            words = "A history is entered as for the first time."
            self._findings.add("history", node.id, words, node.place)
            if node.parent is None:
                return None
            node = node.parent
        for _ in range(len(self._chart.nodes) + 1):
            if node in self._leaves or not node.inner or node.kind == "parallel":
                break
            named = self._chart.nodes.get(node.initial)
            if named is None or not _below(named, node):
                named = node.inner[0]
            node = named
        above: ChartNode | None = node
        while above is not None and above not in self._leaves:
            above = above.parent
        return above


def _below(node: ChartNode, other: ChartNode) -> bool:
    above = node.parent
    while above is not None and above is not other:
        above = above.parent
    return above is other
