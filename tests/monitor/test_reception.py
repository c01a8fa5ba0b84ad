"""Messages from a network are checked, counted if they are lost, and kept within bounds."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.message import Status, status_payload
from smsl_studio.monitor.nodes import MOST_NODES, NodeState
from smsl_studio.monitor.reception import SHOWN, Reception
from smsl_studio.monitor.sample import LONGEST
from smsl_studio.monitor.topics import FactTopic, StatusTopic

EYE = FactTopic("lab", "main", "SB1", 0, "eye")
BENCH = StatusTopic("lab", "bench")


@dataclass(frozen=True)
class Sensor:
    name: str = "eye"
    branch: str = "SB1"
    digit: int = 0
    max_age: float = 0.3
    aggregation: str = "single"


def _reception() -> Reception:
    return Reception("lab", "main", [Sensor()])


def _say(
    reception: Reception, sequence: int, now: float = 0.0, *, topic: object = EYE,
    retained: bool = False, **changed: Any,
) -> None:  # fmt: skip
    said = {"version": 1, "node": "bench", "boot": 1, "sequence": sequence, "time": now,
            "value": "1", **changed}  # fmt: skip
    reception.receive(str(topic), json.dumps(said).encode(), retained, now)


def _refused(reception: Reception) -> dict[str, tuple[int, str]]:
    return {one.kind: (one.count, one.example) for one in reception.received.refusals}


def test_a_declared_source_is_heard_with_the_time_of_its_arrival() -> None:
    reception = _reception()
    assert reception.silent == (("SB1", 0, "eye"),)
    _say(reception, 1, now=50.0, time=3.0)
    (sample,) = reception.take()
    assert (sample.value, sample.time, sample.received) == ("1", 3.0, 50.0)
    assert not reception.silent
    assert not reception.take()


def test_everything_else_is_counted_by_its_kind_and_named() -> None:
    reception = _reception()
    _say(reception, 1, topic="smsl/1/lab/run/main/fact/SB1/0")
    _say(reception, 1, topic=FactTopic("elsewhere", "main", "SB1", 0, "eye"))
    _say(reception, 1, topic=FactTopic("lab", "other", "SB1", 0, "eye"))
    _say(reception, 1, topic=FactTopic("lab", "main", "SB1", 1, "eye"))
    _say(reception, 1, retained=True)
    _say(reception, 1, value=1)
    _say(reception, 1, value="x" * (LONGEST + 1))
    reception.receive(str(EYE), b"{", False, 0.0)
    reception.receive(str(BENCH), b"", False, 0.0)
    reception.receive(str(StatusTopic("elsewhere", "bench")), b"", False, 0.0)
    assert reception.take() == ()
    found = _refused(reception)
    assert {kind: count for kind, (count, _) in found.items()} == {
        "unknown topic": 1, "another site": 2, "another run": 1, "undeclared source": 1,
        "retained fact": 1, "unreadable fact": 2, "too long": 1, "unreadable status": 1,
    }  # fmt: skip
    assert found["unreadable fact"][1].startswith("SB1/0 eye: no JSON: ")
    assert found["undeclared source"][1] == "SB1/1 eye"
    assert (reception.received.messages, reception.received.samples) == (10, 0)


def test_a_retained_fact_does_not_even_make_its_source_known() -> None:
    reception = _reception()
    _say(reception, 1, retained=True)
    assert reception.silent
    monitor = FactMonitor([Sensor()])
    monitor.accept(reception.take(), 0.0)
    assert monitor.scene(0.0).readings["SB1", 0].reason == "no reading yet"


def test_a_flood_costs_its_own_samples_only() -> None:
    reception = Reception("lab", "main", [Sensor(), Sensor("ear")])
    _say(reception, 1, topic=FactTopic("lab", "main", "SB1", 0, "ear"))
    for sequence in range(2000):
        _say(reception, sequence)
    assert [(one.source, one.sequence) for one in reception.take()] == [("ear", 1), ("eye", 1999)]
    assert reception.received.replaced == 1999
    assert _refused(reception) == {"overtaken before it was read": (1999, "SB1/0 eye")}


def test_a_reading_that_is_overtaken_now_and_then_is_no_flood() -> None:
    reception = _reception()
    for sequence in range(600):
        _say(reception, sequence)
        if sequence % 5 == 0:
            reception.take()
    assert reception.received.replaced == 479
    assert _refused(reception) == {}


def test_a_flood_of_names_is_bounded() -> None:
    reception = _reception()
    for n in range(2000):
        long = f"{n}" + "x" * 500
        _say(reception, 1, topic=FactTopic("lab", "main", "SB1", 0, long))
        _say(reception, 1, topic=FactTopic(long, "main", "SB1", 0, "eye"))
        reception.receive(
            str(StatusTopic("lab", long)), status_payload(Status(1, "alive")), True, 0
        )
    assert len(reception.nodes(0.0)) == MOST_NODES
    assert set(_refused(reception)) == {"undeclared source", "another site", "unreadable status"}
    assert all(len(example) <= SHOWN for _, example in _refused(reception).values())


def _status(reception: Reception, boot: int, state: str, now: float) -> NodeState:
    reception.receive(str(BENCH), status_payload(Status(boot, state)), True, now)
    (node,) = reception.nodes(now)
    return node


def test_a_node_from_birth_to_will() -> None:
    reception = _reception()
    born = _status(reception, 1, "alive", 10.0)
    assert (born.state, born.boots, born.heard) == ("expected", 1, None)
    _say(reception, 1, 10.1)
    (node,) = reception.nodes(10.2)
    assert (node.state, node.speaks) == ("alive", ("SB1/0 eye",))
    (node,) = reception.nodes(10.5)
    assert (node.state, round(node.since, 3)) == ("frozen", 0.1)
    assert _status(reception, 1, "gone", 12.0).state == "gone"
    assert _status(reception, 1, "alive", 13.0).state == "frozen"
    _say(reception, 2, 13.1)
    assert reception.nodes(13.1)[0].state == "alive"


def test_the_will_of_a_boot_that_is_over_says_nothing() -> None:
    reception = _reception()
    _status(reception, 1, "alive", 10.0)
    again = _status(reception, 2, "alive", 11.0)
    assert (again.boot, again.boots) == (2, 2)
    _say(reception, 1, 11.1, boot=2)
    node = _status(reception, 1, "gone", 11.2)
    assert (node.state, node.boot) == ("alive", 2)
    assert _refused(reception)["unreadable status"][1] == "bench: gone of boot 1, which is over"


def test_a_will_makes_no_fact_stale_and_a_birth_none_fresh() -> None:
    reception, monitor = _reception(), FactMonitor([Sensor()])
    _say(reception, 1, 10.0)
    monitor.accept(reception.take(), 0.0)
    _status(reception, 1, "gone", 10.1)
    assert monitor.scene(0.0, 10.2).readings["SB1", 0].value == "1"
    _status(reception, 1, "alive", 10.3)
    assert monitor.scene(0.0, 10.4).readings["SB1", 0].value is None


def test_samples_from_elsewhere_age_on_the_clock_on_which_they_came() -> None:
    """Simulated time stands still, or runs ahead: neither makes them older."""
    reception, monitor = _reception(), FactMonitor([Sensor()])
    _say(reception, 1, 500.0)
    monitor.accept(reception.take(), 3.0)
    assert monitor.scene(3.0, 500.3).readings["SB1", 0].value == "1"
    assert monitor.scene(99.0, 500.3).readings["SB1", 0].value == "1"
    assert monitor.scene(3.0, 500.31).readings["SB1", 0].reason == "no reading for 0.3 s"
    (state,) = monitor.sources(3.0, 500.2)
    assert round(state.said.age, 3) == 0.2


topics = st.one_of(
    st.text(), st.builds(str, st.builds(FactTopic, *[st.sampled_from(["lab", "x"])] * 2,
                                        st.sampled_from(["SB1", "é"]), st.integers(0, 1),
                                        st.sampled_from(["eye", "+"]))),
)  # fmt: skip


@given(st.lists(st.tuples(topics, st.binary(max_size=60), st.booleans()), max_size=20))
def test_whatever_comes_is_counted_and_nothing_breaks(
    messages: list[tuple[str, bytes, bool]],
) -> None:
    reception = _reception()
    for topic, payload, retained in messages:
        reception.receive(topic, payload, retained, 0.0)
    received = reception.received
    assert received.messages == len(messages)
    assert sum(one.count for one in received.refusals) + received.samples == len(messages)
