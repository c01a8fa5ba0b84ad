"""Nodes: the programs that send samples of network sensors, and the state of each.

These states are only for people. They make no fact fresh or stale. The MQTT will of a node counts
only for the boot that left it.
"""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.address import fact_text
from smsl_studio.monitor.message import ALIVE, GONE, Status
from smsl_studio.monitor.sample import Sample

MOST_NODES = 256
"""The largest number of nodes that are remembered. It is far more than a site has."""

EXPECTED, FROZEN = "expected", "frozen"
"""``expected``: the node has sent no sample yet. ``frozen``: its samples have stopped, although it
has not reported its end."""


@dataclass(frozen=True, slots=True)
class NodeState:
    """The state of one node: ``state`` is alive, frozen, gone or expected.

    ``heard`` is the age (s) of its newest sample; None means that it has sent none. ``since`` is
    the time (s) that it has been in this state. ``boots`` is the number of its starts.
    ``speaks`` are its sources, as ``SB/digit source``.
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
    """The known nodes of one site. All times are seconds on the receiver's monotonic clock."""

    def __init__(self) -> None:
        self._nodes: dict[str, _Node] = {}

    def said(self, name: str, status: Status, now: float) -> str:
        """Take in the status of a node. Return the empty text, or the reason why the status does
        not count."""
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
        """Note that a node has sent a sample of one of the run's facts. ``max_age`` is in
        seconds."""
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
        """Return the state of every node at ``now`` (s), in the order of their names."""
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
