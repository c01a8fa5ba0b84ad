"""The sources of messages: the world's own sensors, the broker, all nodes, and refused messages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from smsl_studio.host.protocol import SensorInfo
from smsl_studio.monitor.message import ALIVE, GONE
from smsl_studio.monitor.nodes import EXPECTED, FROZEN, NodeState
from smsl_studio.monitor.reception import RemoteView
from smsl_studio.studio.base.rows import ListRow

NOBODY = "Starts with the run"
NO_NODES = "No node was heard of yet"


def network_rows(
    world: str, running: bool, sensors: Sequence[SensorInfo], remote: RemoteView | None
) -> list[ListRow]:
    """A row for the world, the broker, each node and each kind of refused message."""
    own = [sensor for sensor in sensors if not sensor.remote]
    rows = [ListRow("Nodes", kind="section")]
    if not world:
        rows.append(ListRow(NOBODY, pale=True))
    else:
        words = (
            f"{len(own)} {'sensor' if len(own) == 1 else 'sensors'}, {_rates(own)}" if own else ""
        )
        state = "in its own process" if running else "its run is over"
        rows.append(ListRow(world, icon="layers", right=words or state, tip=f"{world}: {state}"))
    if remote is not None:
        rows += [_node(node) for node in remote.nodes]
        if not remote.nodes:
            rows.append(ListRow(NO_NODES, pale=True))
        rows += _broker(remote, running)
        rows += _refused(remote)
    return rows


def _rates(sensors: Sequence[SensorInfo]) -> str:
    rates = sorted({round(1 / sensor.period) for sensor in sensors if sensor.period > 0})
    return f"{' to '.join(str(rate) for rate in dict.fromkeys((rates[0], rates[-1])))} Hz"


def _node(node: NodeState) -> ListRow:
    said = {
        ALIVE: "alive",
        FROZEN: f"frozen for {_span(node.since)}",
        GONE: f"gone for {_span(node.since)}",
        EXPECTED: "no sample yet",
    }[node.state]
    if node.boots > 1:
        said = f"{said}, boot {node.boots}"
    severity = {FROZEN: "W", GONE: "W", EXPECTED: "I"}.get(node.state, "")
    speaks = ", ".join(node.speaks)
    return ListRow(
        node.name,
        icon="signal",
        right=said,
        severity=severity,
        tip=f"{node.name}: {said}\n{speaks}".strip(),
    )


def _broker(remote: RemoteView, running: bool) -> Iterator[ListRow]:
    yield ListRow("Broker", kind="section")
    lost = remote.lost if running else None
    said = "connected" if lost is None else f"lost for {_span(lost)}"
    said = said if running else "left with the end of the run"
    where = f"site {remote.site}, run {remote.run}"
    if remote.connections > 1:
        said = f"{said}, time {remote.connections}"
    tip = f"{remote.broker}: {said}; {where}"
    severity = "" if lost is None else "W"
    yield ListRow(remote.broker, right=said, severity=severity, tip=tip)
    yield ListRow(where, pale=True, right=f"{remote.received.messages:,} messages")


def _refused(remote: RemoteView) -> Iterator[ListRow]:
    if remote.received.refusals:
        yield ListRow("Ignored messages", kind="section")
    for refusal in remote.received.refusals:
        tip = f"{refusal.kind}, the newest: {refusal.example}"
        yield ListRow(refusal.kind, beside=refusal.example, right=f"{refusal.count:,}", tip=tip)


def _span(seconds: float | None) -> str:
    """A duration in whole seconds, so that the list does not change many times a second."""
    return f"{seconds or 0:.0f} s"
