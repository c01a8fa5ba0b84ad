"""Before a run begins, sources elsewhere that decide its start are watched for 3 s at most.

The clock is that of the test: each wait of the run takes 0.1 s of it.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.dispatch.drive.start_tasks import WATCH
from smsl_studio.front.inputs import read
from smsl_studio.host.remote import Remote
from smsl_studio.monitor.reception import Reception
from smsl_studio.monitor.topics import FactTopic
from smsl_studio.runlog.events import Event, RunFinished, RunStarted

STEP = 0.1
MEASURED = {
    "sources": {"force": "N"},
    "predicate": {"0": "force < 1 N for 0.5 s", "1": "force > 2 N for 0.5 s"},
    "max_age": 1,
}


class Bench:
    """A source elsewhere that speaks from a moment on, and the clock of the test."""

    def __init__(self, since: float, value: object) -> None:
        self.now, self._since, self._value, self._sequence = 0.0, since, value, 0
        self._reception: Reception | None = None

    def line(self, broker: str, reception: Reception, login: object) -> Any:
        self._reception = reception
        return _Line()

    def wait(self) -> None:
        self.now += STEP
        if self.now < self._since or self._reception is None:
            return
        self._sequence += 1
        said = {"version": 1, "node": "bench", "boot": 1, "sequence": self._sequence,
                "time": self.now, "value": self._value}  # fmt: skip
        topic = str(FactTopic("lab", "main", "SB", 0, "force"))
        self._reception.receive(topic, json.dumps(said).encode(), False, self.now)


class _Line:
    broker, lost, connections, connected, secure = "nowhere", None, 1, True, False

    def open(self) -> None:
        """Nothing to connect to."""

    def close(self) -> None:
        """Nothing to leave."""


def started(
    patch: pytest.MonkeyPatch, folder: Path, bench: Bench, entry: dict[str, object]
) -> list[Event]:
    """The events of a start at State_0."""
    patch.setattr("smsl_studio.monitor.mqtt.BrokerLink", bench.line)
    patch.setattr(Remote, "clock", lambda self: bench.now)
    patch.setattr(Remote, "wait", lambda self: bench.wait())
    patch.setattr(Remote, "open", lambda self: None)
    table = {"State_0": {"Go": "State_1"}, "State_1": {}}
    (folder / "sb.json").write_text(json.dumps({"SB": {"_facts": {"0": entry}, **table}}), "utf-8")
    text = '[mqtt]\nbroker = "nowhere:1"\nsite = "lab"\n[mqtt.facts]\n"SB/0" = "force"\n'
    (folder / "sb.toml").write_text(text, "utf-8")
    run = front.open_run(read(folder / "sb.json"), "table", host="local", automatic=False)
    try:
        return list(run.open())
    finally:
        run.close()


def refused(events: list[Event]) -> str:
    """Why a run was refused, and nothing began."""
    assert not any(isinstance(one, RunStarted) for one in events)
    (end,) = (one for one in events if isinstance(one, RunFinished))
    assert end.reason == "refused"
    return end.sentence


@pytest.mark.parametrize("since", [0.0, 1.0, 2.0])
def test_a_start_waits_until_its_facts_are_known(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, since: float
) -> None:
    """The predicate must have held for 0.5 s. The run does not wait longer than that."""
    bench = Bench(since, 0.3)
    events = started(monkeypatch, tmp_path, bench, MEASURED)
    assert any(isinstance(one, RunStarted) for one in events)
    assert not any(isinstance(one, RunFinished) for one in events)
    assert since + 0.5 <= bench.now <= since + 1.0


@pytest.mark.parametrize(
    ("since", "value", "why"),
    [(99.0, 0.3, "force: no reading yet"), (0.0, "much", "no reading yet"),
     (2.8, 0.3, "was not watched for long enough")],
)  # fmt: skip
def test_after_3_s_a_start_that_is_unknown_is_refused(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, since: float, value: object, why: str
) -> None:
    bench = Bench(since, value)
    said = refused(started(monkeypatch, tmp_path, bench, MEASURED))
    assert WATCH == 3.0
    assert WATCH <= bench.now < WATCH + 2 * STEP
    assert why in said


def test_a_start_that_is_known_to_be_elsewhere_is_refused_at_once(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    bench = Bench(0.0, 4.0)
    assert "reads 1" in refused(started(monkeypatch, tmp_path, bench, MEASURED))
    assert bench.now <= 1.0


def test_a_source_that_says_values_is_not_waited_for(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    bench = Bench(0.0, "0")
    assert "no reading yet" in refused(started(monkeypatch, tmp_path, bench, {}))
    assert bench.now == 0.0
