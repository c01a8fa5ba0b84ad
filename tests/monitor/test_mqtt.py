"""A run whose facts come over a real broker. Tests check the order; ``benches/sensors.py`` has
times."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.errors import RunRefused, UsageError
from smsl_studio.front.inputs import read
from smsl_studio.monitor.facts import SourceState
from smsl_studio.monitor.mqtt import BrokerLink, host_and_port
from smsl_studio.monitor.nodes import NodeState
from smsl_studio.monitor.reception import Reception, RemoteView
from smsl_studio.monitor.topics import FactTopic, StatusTopic
from smsl_studio.runlog.events import Committed, Event, FactChanged, Held, OperationRefused
from tests.monitor.broker import Broker, Node, Speaker, until, with_ages

EYE = FactTopic("lab", "main", "SB1", 0, "eye")
OP = Address("SB1", "State_aa", "Op_1b")


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.kill()


@pytest.fixture
def node(broker: Broker) -> Iterator[Node]:
    made = Node(broker, "SB1/0:eye=a")
    yield made
    made.kill()


Open = Callable[..., "AtRun"]


class AtRun:
    """A run of Hanoi with two disks, whose first fact an eye tells over the broker."""

    def __init__(self, dispatcher: Dispatcher) -> None:
        self.dispatcher = dispatcher
        self.events: list[Event] = list(dispatcher.open())

    def tick(self) -> None:
        self.events += self.dispatcher.tick()

    def until(self, condition: Callable[[], bool], what: str) -> None:
        """Tick until something is so."""

        def there() -> bool:
            self.tick()
            return condition()

        until(there, what)

    def until_fact(self, value: str | None) -> None:
        self.until(lambda: self.value == value, f"the fact reads {value}")

    @property
    def value(self) -> str | None:
        return self.dispatcher.status.scene.readings["SB1", 0].value

    @property
    def source(self) -> SourceState:
        (found,) = (one for one in self.dispatcher.status.sources if one.said.source == "eye")
        return found

    @property
    def view(self) -> RemoteView:
        opened = self.dispatcher.opened
        assert opened is not None
        assert opened.remote is not None
        return opened.remote.view()

    @property
    def node(self) -> NodeState:
        (found,) = self.view.nodes
        return found

    def told(self, kind: type[Event]) -> list[Event]:
        return [event for event in self.events if isinstance(event, kind)]


@pytest.fixture
def start(tmp_path: Path, broker: Broker) -> Iterator[Open]:
    with_ages("hanoi-2", tmp_path)
    text = '[mqtt]\nsite = "lab"\n[mqtt.facts]\n"SB1/0" = "eye"\n'
    (tmp_path / "hanoi-2.toml").write_text(text, "utf-8")
    opened: list[Dispatcher] = []

    def begin(automatic: bool = False) -> AtRun:
        dispatcher = front.open_run(
            read(tmp_path / "hanoi-2.json"), "table", host="local", automatic=automatic,
            attended=True, broker=broker.address,
        )  # fmt: skip
        opened.append(dispatcher)
        return AtRun(dispatcher)

    yield begin
    for dispatcher in opened:
        dispatcher.close()


def test_a_fact_comes_over_the_broker(start: Open, node: Node) -> None:
    run = start()
    run.until_fact("a")
    run.until(lambda: run.node.state == "alive" and run.node.heard is not None, "it is alive")
    assert (run.node.name, run.node.speaks) == ("bench", ("SB1/0 eye",))
    node.say("eye ?")
    run.until_fact(None)
    assert run.source.said.reason == "the sensor has no valid reading"
    node.say("eye a")
    run.until_fact("a")


@pytest.mark.parametrize("frozen", ["node", "broker"])
def test_who_is_frozen_costs_a_fact_and_then_nothing_begins(
    frozen: str, start: Open, node: Node, broker: Broker
) -> None:
    run = start()
    who: Node | Broker = node if frozen == "node" else broker
    who.freeze()
    run.until_fact(None)
    assert run.source.said.reason.startswith("no reading for ")
    counted = run.source.counted
    run.dispatcher.ask(OP)
    run.tick()
    (refused,) = run.told(OperationRefused)
    assert isinstance(refused, OperationRefused)
    assert "Fact 1 of SB1 is unknown, no reading for" in refused.reasons[0]
    who.thaw()
    run.until_fact("a")
    assert run.source.counted > counted
    assert not run.told(Committed)


def test_a_run_holds_when_a_fact_it_needs_is_unknown(start: Open, node: Node) -> None:
    run = start(automatic=True)
    run.dispatcher.pause()
    run.tick()
    node.freeze()
    until(lambda: bool(run.dispatcher.watch()) or run.value is None, "the fact is unknown")
    assert run.dispatcher.phase == "paused"
    run.dispatcher.resume()
    run.until(lambda: run.dispatcher.phase == "fault_hold", "the run holds")
    held = run.told(Held)[-1]
    assert isinstance(held, Held)
    assert "is unknown" in " ".join((held.reason, *held.details))
    assert not run.told(Committed)
    node.thaw()
    run.until_fact("a")


def test_a_node_that_was_killed_and_comes_again(start: Open, node: Node, broker: Broker) -> None:
    run = start()
    node.kill()
    run.until(lambda: run.node.state == "gone", "its will comes")
    run.until_fact(None)
    again = Node(broker, "SB1/0:eye=b")
    run.until_fact("b")
    run.until(lambda: run.node.state == "alive", "it is there again")
    assert run.node.boots == 2
    again.end()
    run.until(lambda: run.node.state == "gone", "it says that it goes")


def test_a_broker_that_was_killed_and_comes_again(start: Open, node: Node, broker: Broker) -> None:
    run = start()
    broker.kill()
    run.until(lambda: run.view.lost is not None, "the broker is lost")
    run.until_fact(None)
    broker.start()
    run.until_fact("a")
    # The eye's own connection may be there again before the one of the nodes.
    run.until(lambda: run.view.lost is None, "the nodes are connected again")
    assert run.view.connections == 2
    assert run.source.said.value == "a"


def _said(sequence: int, **changed: object) -> dict[str, object]:
    return {"version": 1, "node": "n", "boot": 5, "sequence": sequence, "time": 100.0,
            "value": "a", **changed}  # fmt: skip


def test_what_a_broker_has_kept_lets_no_run_begin(start: Open, broker: Broker) -> None:
    speaker = Speaker(broker)
    speaker.send(str(EYE), _said(1), retain=True)
    speaker.close()
    run = start()
    assert run.dispatcher.finished
    assert "Fact 1 of SB1 is unknown, no reading yet" in run.dispatcher.status.sentence


@pytest.fixture
def speaker(broker: Broker) -> Iterator[Speaker]:
    made = Speaker(broker)
    yield made
    made.close()


def test_hostile_messages_are_counted_and_cost_nothing(
    start: Open, node: Node, broker: Broker, speaker: Speaker
) -> None:
    run = start()
    before = run.source.counted
    speaker.send(str(EYE), b"\xff" * 5000)
    speaker.send(str(EYE), b"{" * 9000)
    speaker.send(str(EYE), _said(1, value=7))
    speaker.send(str(EYE), _said(9, boot=2**53), retain=True)
    speaker.send("smsl/1/lab/run/main/fact/SB1/0/eye/more", b"")
    speaker.send("smsl/1/lab/run/main/fact/SB%2B%23/0/eye", _said(1))
    speaker.send(str(StatusTopic("lab", "a/b+#é")), b"not at all", retain=True)
    speaker.send("smsl/1/other/run/main/fact/SB1/0/eye", _said(1))
    speaker.send("smsl/1/lab/run/other/fact/SB1/0/eye", _said(1))
    kinds = {"unreadable fact": 3, "retained fact": 1, "unknown topic": 1, "undeclared source": 1,
             "unreadable status": 1}  # fmt: skip

    def counted() -> dict[str, int]:
        refusals = run.view.received.refusals
        return {one.kind: one.count for one in refusals if not one.kind.startswith("overtaken")}

    run.until(lambda: counted() == kinds, f"all are counted: {kinds}")
    run.until(lambda: run.source.counted > before, "the node goes on")
    run.until_fact("a")


def test_growing_samples_refresh_and_no_others_do(
    start: Open, node: Node, broker: Broker, speaker: Speaker
) -> None:
    run = start()
    node.kill()
    run.until_fact(None)
    boot = 2**52
    speaker.send(str(EYE), _said(5, boot=boot, value="b"))
    run.until(lambda: run.source.sample is not None and run.source.sample.boot == boot, "it came")
    counted = run.source.counted
    repeated, late = run.source.repeated, run.source.late
    speaker.send(str(EYE), _said(5, boot=boot, value="c"))
    run.until(lambda: run.source.repeated == repeated + 1, "it is seen as repeated")
    speaker.send(str(EYE), _said(4, boot=boot, value="c"))
    run.until(lambda: run.source.repeated == repeated + 2, "it is seen as overtaken")
    speaker.send(str(EYE), _said(6, boot=boot, time=40.0, value="c"))
    run.until(lambda: run.source.late == late + 1, "it is seen as held up")
    speaker.send(str(EYE), _said(7, boot=boot, value="c"), retain=True)
    kept = "retained fact"
    run.until(lambda: kept in [one.kind for one in run.view.received.refusals], kept)
    assert run.source.counted == counted
    run.until_fact(None)
    values = {event.value for event in run.told(FactChanged) if isinstance(event, FactChanged)}
    assert "c" not in values


def test_a_flood_is_counted_and_named_and_the_newest_counts(
    start: Open, node: Node, broker: Broker, speaker: Speaker
) -> None:
    run = start()
    node.kill()
    run.until_fact(None)
    before = run.view.received.samples
    speaker.flood(str(EYE), [_said(n, boot=2**52, value="b") for n in range(1000)])
    speaker.flood(
        str(FactTopic("lab", "main", "SB1", 0, "x" * 300)), [_said(n) for n in range(1000)]
    )
    until(lambda: run.view.received.samples >= before + 1000, "all of them came")
    run.until_fact("b")
    sample = run.source.sample
    assert sample is not None
    assert sample.sequence == 999
    until(lambda: len(run.view.received.refusals) == 2, "both are counted")
    refusals = {one.kind: one.example for one in run.view.received.refusals}
    assert refusals["overtaken before it was read"] == "SB1/0 eye"
    assert refusals["undeclared source"].startswith("SB1/0 xxx")


def test_without_a_broker_a_run_is_refused(tmp_path: Path, broker: Broker, start: Open) -> None:
    broker.kill()
    run = start()
    assert run.dispatcher.finished
    assert f"there is no broker at 127.0.0.1:{broker.port}" in run.dispatcher.status.sentence


def test_a_broker_that_says_nothing_is_none(broker: Broker) -> None:
    broker.freeze()
    link = BrokerLink(broker.address, Reception("lab", "main", ()))
    with pytest.raises(RunRefused, match="it accepts the connection and says nothing"):
        link.open()
    link.close()


def test_no_broker_is_waited_for_once_a_run_is_closed(broker: Broker) -> None:
    """Whenever in between it is closed."""
    link = BrokerLink(broker.address, Reception("lab", "main", ()))
    broker.freeze()
    refused: list[RunRefused] = []

    def open_link() -> None:
        try:
            link.open()
        except RunRefused as error:
            refused.append(error)

    thread = threading.Thread(target=open_link)
    thread.start()
    link.close()
    thread.join()
    assert refused
    link.close()


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("localhost", ("localhost", 1883)),
        ("10.0.0.1:1884", ("10.0.0.1", 1884)),
        ("[::1]:1885", ("::1", 1885)),
        ("[::1]", ("::1", 1883)),
        ("::1", ("::1", 1883)),
    ],
)
def test_where_a_broker_is(text: str, found: tuple[str, int]) -> None:
    assert host_and_port(text) == found


@pytest.mark.parametrize("text", ["", ":1883", "host:", "host:0", "host:99999", "host:x", "a b"])
def test_what_is_no_broker(text: str) -> None:
    with pytest.raises(UsageError, match="the broker is"):
        host_and_port(text)
