"""The declarations of ``_facts`` reach the monitor of a run."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio import front
from smsl_studio.blueprint.levels import Levels
from smsl_studio.dispatch.execution.senses import Senses
from smsl_studio.dispatch.people.rules import leveled_rules
from smsl_studio.errors import UsageError
from smsl_studio.host.local import LocalHost
from smsl_studio.monitor.aggregate import NOBODY, FactRule
from smsl_studio.monitor.sample import Sample
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

START = {"LAMP": "State_0"}


def _senses(folder: Path, note: dict[str, Any], world: str = "lamp") -> Senses:
    write_plugin(folder, "lamp", LAMP_PLUGIN)
    blueprint = blueprint_of({"LAMP": {"_facts": {"0": note}, **LAMP["LAMP"]}})
    host = LocalHost(blueprint, world, 0, [folder])
    opened = host.open(START)
    senses = Senses(host, opened, leveled_rules(blueprint, opened, Levels(blueprint)))
    senses.look()
    return senses


def _reading(senses: Senses) -> tuple[str | None, str]:
    reading = senses.scene.readings["LAMP", 0]
    return reading.value, reading.reason


def test_the_rule_of_a_fact_is_what_is_written(tmp_path: Path) -> None:
    note = {"aggregation": "k_of_n", "k": 2, "critical": True, "conflict_after": 0.2,
            "max_age": 0.5, "sensors": ["bulb_1", "lux"]}  # fmt: skip
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    values = {"LAMP": {"_facts": {"0": note}, **LAMP["LAMP"]}}
    opened = LocalHost(blueprint_of(values), "lamp", 0, [tmp_path]).open(START)
    rule = FactRule("k_of_n", 2, True, 0.2, ("bulb_1", "lux"), 0.5)
    assert opened.rules == {("LAMP", 0): rule}
    assert LocalHost(blueprint_of(values), "table").open(START).rules == {}


def test_a_sensor_that_is_missing_leaves_all_unknown(tmp_path: Path) -> None:
    senses = _senses(tmp_path, {"sensors": ["bulb_1", "lux"], "aggregation": "all"})
    value, reason = _reading(senses)
    assert value is None
    assert "lux: this world has no such sensor" in reason
    assert [state.said.source for state in senses.sources] == ["bulb_1", "lux"]


def test_no_sensor_answers_for_a_person(tmp_path: Path) -> None:
    senses = _senses(tmp_path, {"aggregation": "human"})
    assert _reading(senses) == (None, NOBODY)
    changes = senses.answer("LAMP", 0, "1", "Ada")
    assert [(change.value, change.reason) for change in changes] == [("1", "")]
    assert senses.answer("LAMP", 0, "1", "Ada") == ()
    assert _reading(senses) == ("1", "")
    with pytest.raises(UsageError):
        senses.answer("LAMP", 1, "1", "Ada")


def test_what_a_person_says_does_not_stand_on_the_table(tmp_path: Path) -> None:
    assert _reading(_senses(tmp_path, {"aggregation": "human"}, "table")) == (None, NOBODY)
    assert _reading(_senses(tmp_path / "all", {"aggregation": "all"}, "table")) == ("0", "")


def test_what_others_publish_is_heard_like_the_host(tmp_path: Path) -> None:
    senses = _senses(tmp_path, {})
    assert _reading(senses) == ("0", "")
    senses.bus.publish([Sample("LAMP", 0, "bulb_1", "1", 0.0, 2, boot=1)])
    senses.tick()
    assert _reading(senses) == ("1", "")


def test_time_never_goes_back_where_all_is_delayed(tmp_path: Path) -> None:
    senses = _senses(tmp_path, {})
    senses._host.disturb("bulb_1", "delay", seconds=0.2)
    times = []
    for _ in range(8):
        senses.tick()
        senses.look()
        times.append(senses.time)
    assert times == sorted(times)
    assert times[-1] == pytest.approx(0.4)


@pytest.mark.parametrize("aggregation", ["single", "any", "all", "k_of_n", "priority"])
def test_a_fact_whose_named_sensors_nobody_has_is_not_believed(
    tmp_path: Path, aggregation: str
) -> None:
    note = {"aggregation": aggregation, "sensors": ["blub_1"]}
    value, reason = _reading(_senses(tmp_path / "one", note))
    assert value is None
    assert reason
    assert _reading(_senses(tmp_path / "other", note, "table"))[0] == "0"


def test_a_misspelt_sensor_in_the_bindings_file_refuses_the_start(tmp_path: Path) -> None:
    write_plugin(tmp_path / "plugins", "lamp", LAMP_PLUGIN)
    file = tmp_path / "lamp.json"
    file.write_text(json.dumps(LAMP))
    (tmp_path / "lamp.toml").write_text('[world.lamp.facts]\n"LAMP/0" = "blub_1"\n')
    run = front.run(smsl.read(file), "lamp", plugin_paths=[tmp_path / "plugins"])
    assert run.reason == "refused"
    assert "this world has no such sensor" in run.sentence
