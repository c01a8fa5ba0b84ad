"""Nodes: the programs that send samples of network sensors, and the state of each.

This is for people alone: no fact is fresh because a node says that it lives, and none is stale
because its will came. A will counts only for the boot that left it.
"""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.address import fact_text
from smsl_studio.monitor.message import ALIVE, GONE, Status
from smsl_studio.monitor.sample import Sample

MOST_NODES = 256
"""Nodes that are remembered: far more than a site has."""

EXPECTED, FROZEN = "expected", "frozen"
"""Nobody spoke yet; it lives as far as anybody knows, and its samples stopped."""


@dataclass(frozen=True, slots=True)
class NodeState:
    """One node as it stands: ``state`` is alive, frozen, gone or expected.

    ``heard`` is how long ago (s) its newest sample came, None: never. ``since`` is how long (s) it
    has been so. ``boots`` counts how often it was seen to start. ``speaks`` are its sources, as
    ``SB/digit source``.
    """

    name: str
    state: str
    boot: int = 0
    boots: int = 0
    heard: float | None = None
    since: float = 0.0
    speaks: tuple[str, ...] = ()


@dataclass(slots=True)
class _Node:
    boot: int
    began: float
    boots: int = 1
    gone: float | None = None
    heard: float | None = None
    patience: float = 0.0
    speaks: tuple[str, ...] = ()


class Nodes:
    """The nodes of one site that were heard of; all times on the receiver's clock."""

    def __init__(self) -> None:
        self._nodes: dict[str, _Node] = {}

    def said(self, name: str, status: Status, now: float) -> str:
        """A node's birth or will; the empty text, or why it counts for nothing."""
        node = self._nodes.get(name)
        if node is not None and status.boot < node.boot:
            return f"{status.state} of boot {status.boot}, which is over"
        node = self._of(name, status.boot, now)
        if node is None:
            return f"more than {MOST_NODES} nodes"
        if status.state == GONE:
            node.gone = now if node.gone is None else node.gone
        elif node.gone is not None:
            node.gone, node.began = None, now
        return ""

    def spoke(self, name: str, sample: Sample, max_age: float, now: float) -> None:
        """A sample of one of the run's facts came from a node."""
        known = self._nodes.get(name)
        if known is not None and sample.boot < known.boot:
            return
        node = self._of(name, sample.boot, now)
        if node is None:
            return
        node.heard, node.patience = now, max(node.patience, max_age)
        speaks = f"{fact_text(*sample.fact)} {sample.source}"
        if speaks not in node.speaks:
            node.speaks = (*node.speaks, speaks)

    def states(self, now: float) -> tuple[NodeState, ...]:
        """Every node at ``now``, by name."""
        return tuple(_state(name, node, now) for name, node in sorted(self._nodes.items()))

    def _of(self, name: str, boot: int, now: float) -> _Node | None:
        node = self._nodes.get(name)
        if node is None:
            if len(self._nodes) >= MOST_NODES:
                return None
            node = self._nodes[name] = _Node(boot, now)
        elif boot > node.boot:
            self._nodes[name] = node = _Node(boot, now, node.boots + 1, speaks=node.speaks)
        return node


def _state(name: str, node: _Node, now: float) -> NodeState:
    silent = None if node.heard is None else now - node.heard
    if node.gone is not None:
        state, since = GONE, now - node.gone
    elif silent is None:
        state, since = EXPECTED, now - node.began
    elif silent > node.patience:
        state, since = FROZEN, silent - node.patience
    else:
        state, since = ALIVE, now - node.began
    return NodeState(name, state, node.boot, node.boots, silent, since, node.speaks)
