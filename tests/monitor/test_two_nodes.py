"""Two nodes send samples of one source over a real broker: the fact becomes unknown."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from smsl_studio import front
from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.monitor.facts import SourceState
from smsl_studio.runlog.events import (
    Committed,
    Event,
    FactChanged,
    GoalReached,
    Held,
    OperationRefused,
    OperationStarted,
)
from tests.monitor.broker import Broker, Node, until, with_ages

OP = Address("SB1", "State_aa", "Op_1b")


class TwoNodes:
    """A run of Hanoi with two disks, where ``bench`` reads the first fact as it is."""

    def __init__(self, folder: Path, broker: Broker, automatic: bool) -> None:
        self.broker = broker
        self.bench = Node(broker, "SB1/0:eye=a")
        self.intruder: Node | None = None
        with_ages("hanoi-2", folder)
        text = '[mqtt]\nsite = "lab"\n[mqtt.facts]\n"SB1/0" = "eye"\n'
        (folder / "hanoi-2.toml").write_text(text, "utf-8")
        self.dispatcher: Dispatcher = front.open_run(
            read(folder / "hanoi-2.json"), "table", host="local", automatic=automatic,
            attended=True, broker=broker.address,
        )  # fmt: skip
        self.events: list[Event] = list(self.dispatcher.open())

    def intrude(self, name: str) -> None:
        """Another program reads another value; it was started later, so its boot is higher."""
        self.intruder = Node(self.broker, "SB1/0:eye=b", name=name)

    def until_reason(self, words: str) -> None:
        self._until(lambda: self.source.said.reason.startswith(words), words)

    def until_value(self, value: str) -> None:
        self._until(lambda: self.source.said.value == value, f"it reads {value}")

    def until_told(self, kind: type[Event]) -> Event:
        self._until(lambda: bool(self.told(kind)), kind.event)
        return self.told(kind)[-1]

    def told(self, kind: type[Event]) -> list[Event]:
        return [event for event in self.events if isinstance(event, kind)]

    @property
    def source(self) -> SourceState:
        (found,) = (one for one in self.dispatcher.status.sources if one.said.source == "eye")
        return found

    def close(self) -> None:
        self.dispatcher.close()
        self.bench.kill()
        if self.intruder is not None:
            self.intruder.kill()

    def _until(self, condition: object, what: str) -> None:
        def there() -> bool:
            self.events += self.dispatcher.tick()
            assert callable(condition)
            return bool(condition())

        until(there, what)


@pytest.fixture
def broker(tmp_path: Path) -> Iterator[Broker]:
    made = Broker(tmp_path)
    yield made
    made.kill()


@pytest.fixture(params=[False])
def nodes(
    tmp_path: Path, broker: Broker, request: pytest.FixtureRequest
) -> Iterator[TwoNodes]:  # fmt: skip
    made = TwoNodes(tmp_path, broker, automatic=request.param)
    yield made
    made.close()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("intruder", "two speakers for eye: bench, intruder"),
        ("bench", "two speakers for eye: bench of boot "),
    ],
)
def test_a_second_node_makes_the_fact_unknown_until_it_is_silent(
    nodes: TwoNodes, name: str, words: str
) -> None:
    nodes.until_value("a")
    nodes.intrude(name)
    nodes.until_reason(words)
    nodes.dispatcher.ask(OP)
    refused = nodes.until_told(OperationRefused)
    assert isinstance(refused, OperationRefused)
    assert "two speakers for eye" in refused.reasons[0]
    assert nodes.intruder is not None
    nodes.intruder.kill()
    nodes.until_value("a")
    changes = [one for one in nodes.events if isinstance(one, FactChanged)]
    assert "b" not in {one.value for one in changes if (one.branch, one.digit) == ("SB1", 0)}


@pytest.mark.parametrize("nodes", [True], indirect=True)
def test_no_operation_commits_on_a_lie(nodes: TwoNodes) -> None:
    """The disk did not move. Whoever says that it did speaks under the eye's name."""
    nodes.until_told(OperationStarted)
    nodes.intrude("intruder")
    held = nodes.until_told(Held)
    assert isinstance(held, Held)
    assert not nodes.told(Committed)
    assert not nodes.told(GoalReached)
    nodes.until_reason("two speakers for eye: bench, intruder")
    nodes.bench.kill()
    nodes.until_value("b")  # who is left counts: the other one has said nothing for its age


def test_the_first_node_is_bound_to_the_run_also_when_it_comes_again(nodes: TwoNodes) -> None:
    nodes.until_value("a")
    # A busy machine starts a program late. The new one must speak before the old one is too old.
    first, nodes.bench = nodes.bench, Node(nodes.broker, "SB1/0:eye=a")
    nodes.until_reason("two speakers for eye: bench of boot ")
    first.kill()
    nodes.until_value("a")
