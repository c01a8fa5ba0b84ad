"""Runs whose facts are decided from measures: equal in run, record, replay and Monitor, and held
when something is measured wrongly."""

from __future__ import annotations

import json
from pathlib import Path
from random import Random

import pytest

from smsl_studio import front
from smsl_studio.front.views.measure_traces import traces_of
from smsl_studio.front.views.monitor_rows import FACT, Estimates, monitor_rows
from smsl_studio.runlog.changes import moment_after
from smsl_studio.runlog.events import Committed, Event, FactChanged, Measured
from smsl_studio.runlog.playback import RunObserver
from tests.plugin_folder import write_plugin

STORIES = 12
"""Seeded runs of 8 s each, with gaps, values out of range and dwell times."""

WALK = """
from random import Random

class Walk:
    def __init__(self, seed):
        self.chance, self.force, self.gap, self.reads = Random(seed), 0.5, 2.0, 0

    def missing(self):
        self.reads += 1
        return self.reads > 4 and self.chance.random() < 0.05

def register(library):
    @library.world("walk", engine="table", settle=0.1)
    def build(world, blueprint, seed): return Walk(seed)

    @library.arrange("walk")
    def arrange(walk, facts): walk.force = 4.0 if facts[("SB", 0)] == "1" else 0.5

    @library.sensor("force", unit="N")
    def force(walk):
        step = walk.chance.uniform(-0.6, 0.6) if walk.reads > 4 else 0.0
        walk.force = min(max(walk.force + step, -1.0), 6.0)
        return None if walk.missing() else walk.force

    @library.sensor("gap", unit="m", period=0.1)
    def gap(walk):
        walk.gap += walk.chance.uniform(-0.4, 0.4)
        return None if walk.missing() else walk.gap / 1000

    @library.operation("Close")
    def close(walk):
        yield
"""
ENTRY = {
    "sources": {"force": "mN", "gap": "mm"},
    "range": {"force": [-500, 5500]},
    "predicate": {
        "0": "force < 1 N or gap > 3 mm",
        "1": "force > 2 N for 0.1 s and gap <= 3 mm",
    },
}


def blueprint(folder: Path, **entry: object) -> front.Blueprint:
    facts = {"0": {**ENTRY, **entry}}
    text = {"SB": {"_facts": facts, "State_0": {"Close": "State_1"}, "State_1": {}}}
    file = folder / "walk.json"
    file.write_text(json.dumps(text), encoding="utf-8")
    return front.read(file)


@pytest.mark.parametrize("seed", range(STORIES))
def test_facts_are_equal_in_run_replay_and_monitor(tmp_path: Path, seed: int) -> None:
    write_plugin(tmp_path, "walk", WALK)
    made = blueprint(tmp_path)
    dispatcher = front.open_run(
        made, "walk", seed=seed, host="local", automatic=False, plugin_paths=[tmp_path],
        attended=True,
    )  # fmt: skip
    events: list[Event] = list(dispatcher.open())
    told, estimates = RunObserver(), Estimates()
    told.tell(events)
    for _ in range(160):
        new = dispatcher.tick()
        events += new
        told.tell(new)
        status = dispatcher.status
        sensed = status.scene.get("SB", 0)
        assert sensed is not None
        known = told.story.moment.facts["SB", 0]
        assert known.value == sensed.value
        rows = monitor_rows(made, status, estimates.of(made, status), {})
        (row,) = (one for one in rows if one.kind == FACT)
        assert row.cells[2] == ("?" if sensed.value is None else sensed.value)
    dispatcher.close()
    assert moment_after(events).facts == told.story.moment.facts
    changes = [one.value for one in events if isinstance(one, FactChanged)]
    assert len(changes) > 4
    traces = traces_of(made, ("SB", 0), told.story.history, dispatcher.status.time)
    kept = [one for one in events if isinstance(one, Measured)]
    assert sum(len(one.times) for one in traces) == len(kept)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("float('nan')", "no finite number"),
        ("float('inf')", "no finite number"),
        ("-1e999", "no finite number"),
        ("10 ** 400", "no finite number"),
        ("'4.0'", "no finite number"),
        ("True", "no finite number"),
        ("[1.0, 2.0]", "no finite number"),
        ("[1.0, 2.0, 3.0]", "which is no number"),
        ("[[1.0], 2.0, 3.0]", "no finite number"),
        ("99.0", "99000 mN is outside -500 to 5500 mN"),
        ("1 / 0", "division by zero"),
    ],
)
def test_a_critical_fact_that_is_measured_wrongly_holds_the_run(
    tmp_path: Path, value: str, words: str
) -> None:
    """The clamp opens in the middle of the operation, and its sensor breaks with it."""
    broken = f"        if walk.gap > 9: return {value}\n        step = "
    code = WALK.replace("        step = ", broken).replace("        yield\n", CLOSE)
    code = code.replace("uniform(-0.6, 0.6)", "uniform(0, 0)")
    code = code.replace("self.reads > 4 and", "False and")
    write_plugin(tmp_path, "walk", code)
    entry = {
        "sources": {"force": "mN"},
        "predicate": {"0": "force < 1 N", "1": "force > 2 N"},
        "critical": True,
    }
    made = blueprint(tmp_path, **entry)
    log = tmp_path / "run.jsonl"
    done = front.run(made, "walk", host="local", plugin_paths=[tmp_path], log=log)
    assert done.reason == "held"
    (lost,) = (one for one in done.events if isinstance(one, FactChanged) and one.value is None)
    assert words in lost.reason
    assert not any(isinstance(one, Committed) for one in done.events)
    assert [one.line() for one in front.replay(log).events] == [one.line() for one in done.events]


CLOSE = """        for _ in range(10):
            yield
        walk.gap = 10
        for _ in range(10):
            yield
"""


def test_any_log_of_measures_can_be_read_again(tmp_path: Path) -> None:
    """Also numbers at the ends of what a double can be, which JSON readers round."""
    chance = Random(5)
    numbers = [chance.uniform(-1, 1) * 10.0 ** chance.randint(-300, 300) for _ in range(50)]
    for number in (*numbers, 5e-324, 1.7976931348623157e308, -0.0, 1 / 3):
        one = Measured(t=1.0, branch="SB", digit=0, source="x", value=repr(number),
                       quality="good", taken=0.5)  # fmt: skip
        again = json.loads(one.line())
        assert float(again["value"]) == number
