"""Sensors that measure: from a plugin's number to a fact that the blueprint decides."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio import front
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import PluginError
from smsl_studio.library.operation_library import OperationLibrary
from smsl_studio.monitor.message import UnreadableError, fact_payload, read_fact
from smsl_studio.monitor.sample import Sample
from smsl_studio.monitor.topics import FactTopic
from smsl_studio.runlog.decoder import event_of
from smsl_studio.runlog.events import Committed, FactChanged, Measured, OperationStarted
from smsl_studio.runlog.grammar.automaton import Grammar

PLUGIN = """
class Clamp:
    force, lost = 0.5, False

def register(library):
    @library.world("clamp", engine="table", settle=0.1)
    def build(world, blueprint, seed): return Clamp()

    @library.arrange("clamp")
    def arrange(clamp, facts): clamp.force = 4.0 if facts[("SB", 0)] == "1" else 0.5

    @library.sensor("force_{unit}", unit="kN")
    def force(clamp, unit: str):
        return clamp.force / 1000 if unit != "bad" else float("nan")

    @library.sensor("closed")
    def closed(clamp): return "1"

    @library.operation("Close")
    def close(clamp):
        for _ in range(%d):
            yield
        clamp.force = %s
        yield

    @library.operation("Open")
    def open(clamp):
        clamp.force = 0.5
        yield
"""
PREDICATE = {"0": "force_a < 1 N", "1": "force_a > 2 N"}


def run(
    folder: Path, force: str = "4.0", host: str = "local", waits: int = 0, **entry: Any
) -> front.Run:
    plugin = folder / "clamp"
    plugin.mkdir()
    (plugin / "plugin.toml").write_text('name = "clamp"\n', encoding="utf-8")
    (plugin / "plugin.py").write_text(PLUGIN % (waits, force), encoding="utf-8")
    said = {"sources": {"force_a": "N"}, "predicate": PREDICATE, **entry}
    text = {"SB": {"_facts": {"0": said}, "State_0": {"Close": "State_1"},
                   "State_1": {"Open": "State_0"}}}  # fmt: skip
    file = folder / "clamp.json"
    file.write_text(json.dumps(text), encoding="utf-8")
    log = folder / "run.jsonl"
    return front.run(front.read(file), "clamp", plugin_paths=[folder], host=host, log=log)


def told(done: front.Run) -> list[str | None]:
    return [one.value for one in done.events if isinstance(one, FactChanged)]


def kept(done: front.Run) -> list[tuple[str, str | None, str, str]]:
    measured = [one for one in done.events if isinstance(one, Measured)]
    return [(one.source, one.value, one.quality, one.reason) for one in measured]


@pytest.mark.parametrize("host", ["local", "process"])
def test_a_plugin_measures_and_the_blueprint_decides(tmp_path: Path, host: str) -> None:
    done = run(tmp_path, host=host)
    assert done.reason == "goal_reached"
    assert told(done) == ["0", "1"]
    log = tmp_path / "run.jsonl"
    # The log has times in microseconds.
    assert [one.line() for one in front.replay(log).events] == [one.line() for one in done.events]
    assert kept(done)[0] == ("force_a", "0.5", "good", "")
    assert kept(done)[-1] == ("force_a", "4.0", "good", "")
    verdict = front.verify(log, front.read(tmp_path / "clamp.json"))
    assert (verdict.doubt, verdict.order) == (None, None)


def test_between_the_bounds_no_operation_is_confirmed(tmp_path: Path) -> None:
    done = run(tmp_path, "1.5")
    assert done.reason == "held"
    assert told(done) == ["0"]
    assert not any(isinstance(one, Committed) for one in done.events)


@pytest.mark.parametrize("rate", [1, 4, 20])
def test_the_log_keeps_measures_at_the_declared_rate(tmp_path: Path, rate: int) -> None:
    """The table ticks every 0.05 s, and the fact stays for all of the 2 s that the run waits."""
    done = run(tmp_path, waits=40, log_rate=rate)
    assert done.reason == "goal_reached"
    times = [one.t for one in done.events if isinstance(one, Measured)]
    still = [one for one in times if 0.1 < one < 1.95]
    assert 1.8 * rate - 1 <= len(still) <= 1.8 * rate + 1
    changes = [one.t for one in done.events if isinstance(one, FactChanged)]
    assert set(changes) <= set(times)


def test_what_measures_nothing_is_kept_with_its_reason(tmp_path: Path) -> None:
    done = run(tmp_path, 'float("nan")')
    assert done.reason == "held"
    assert told(done) == ["0", None]
    last = kept(done)[-1]
    assert last[:3] == ("force_a", None, "bad")
    assert "no finite number" in last[3]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"value": "much"}, "no number"),
        ({"value": None}, "measured nothing, in good quality"),
        ({"quality": "fine"}, "quality 'fine'"),
        ({"branch": "TB"}, "no fact of this run"),
        ({"digit": 7}, "no fact"),
        ({"t": -1.0}, "the time goes back"),
        ({"source": ""}, "by nothing"),
    ],
)
def test_a_forged_measure_is_seen(tmp_path: Path, change: dict[str, Any], words: str) -> None:
    run(tmp_path)
    lines = (tmp_path / "run.jsonl").read_text(encoding="utf-8").splitlines()
    at = next(n for n, line in enumerate(lines) if '"measured"' in line)
    grammar = Grammar(json.loads(lines[0]), COMMANDS)
    for line in lines[1:at]:
        assert grammar.follow(event_of(event(line))) == ""
    assert words in grammar.follow(event_of({**event(lines[at]), **change}))


def event(line: str) -> dict[str, Any]:
    return {key: value for key, value in json.loads(line).items() if key != "chain"}


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        ({"sources": {"force_a": "mm"}, "predicate": {"0": "force_a < 1 mm"}},
         "force_a: this world has no such source"),
        ({"sources": {"forse": "N"}, "predicate": {"0": "forse < 1 N"}},
         "forse: this world has no such source"),
        ({"sources": {"closed": "N"}, "predicate": {"0": "closed < 1 N"}},
         "closed: this world has no such source"),
        ({"sources": {"force_bad": "N"}, "predicate": {"0": "force_bad < 1 N"}},
         "no finite number"),
        ({"predicate": {"0": "force_a < 1 mm"}}, "compared with a measure in N"),
        ({"predicate": {"0": "force_a < 1 N" + " " * 1_000_000}}, "is too long"),
    ],
)  # fmt: skip
def test_what_cannot_be_measured_is_told_and_nothing_moves(
    tmp_path: Path, entry: dict[str, Any], words: str
) -> None:
    done = run(tmp_path, **entry)
    assert done.reason == "refused"
    assert not any(isinstance(one, OperationStarted) for one in done.events)
    assert words in str(done.events)
    if "no such source" in words:
        assert any("sensor" in sentence for sentence in done.unbound)


@pytest.mark.parametrize("unit", ["Newton", 5, "m" * 50])
def test_a_sensor_in_no_unit_is_no_sensor(unit: Any) -> None:
    with pytest.raises(PluginError, match="unit"):
        OperationLibrary("x").sensor("force", unit=unit)


def test_a_sensor_that_measures_tells_no_fact_by_itself() -> None:
    with pytest.raises(PluginError, match="cannot tell 'SB/1' by itself"):
        OperationLibrary("x").sensor("force", "SB/1", unit="N")


TOPIC = FactTopic("lab", "main", "SB", 0, "force")


def message(value: str) -> bytes:
    return b'{"version":1,"boot":1,"sequence":1,"time":0,"value":%s}' % value.encode()


@pytest.mark.parametrize(
    ("value", "text"), [("2.5", "2.5"), ("3", "3.0"), ("[1, 2.5, -3]", "1.0 2.5 -3.0"),
                        ("null", None)]
)  # fmt: skip
def test_a_node_sends_numbers(value: str, text: str | None) -> None:
    assert read_fact(TOPIC, message(value), measures=True)[1].value == text


@pytest.mark.parametrize("value", ["NaN", "Infinity", "1e999", '"2.5"', "true", "[1, 2]", "{}",
                                   "[[1], 2, 3]", "9007199254740993"])  # fmt: skip
def test_what_is_no_number_is_no_message(value: str) -> None:
    with pytest.raises(UnreadableError):
        read_fact(TOPIC, message(value), measures=True)


def test_a_value_is_still_a_text() -> None:
    with pytest.raises(UnreadableError, match="not a text"):
        read_fact(TOPIC, message("2.5"))
    sent = fact_payload("bench", Sample("SB", 0, "force", "1", 0.0, 1))
    assert read_fact(TOPIC, sent)[1].value == "1"
