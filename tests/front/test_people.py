"""People in worlds of plugins: a person may do the operations and answer the facts without code."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import smsl_studio as smsl
from smsl_studio import front
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.agents import RiskLimit
from smsl_studio.front.runs import Run, open_run
from smsl_studio.front.script.lines import script_of
from smsl_studio.shipped import samples_dir
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_plugin

HEAD: dict[str, Any] = {"State_0": {"Fix": "State_1"}, "State_1": {"Free": "State_0"}}
THEIRS = {"HEAD/0": "human", "HEAD/Fix": "human", "HEAD/Free": "human"}


def lamp(levels: dict[str, str]) -> Blueprint:
    """A lamp that a plugin switches, and a head that it neither moves nor sees."""
    return blueprint_of({**LAMP, "HEAD": HEAD, "_levels": levels})


def test_a_world_suits_where_people_do_and_say_what_it_cannot(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    paths = [tmp_path]
    # A sensor that names no SB reads the fact of the only root: here it has to be said.
    note = {"_facts": {"0": {"sensors": ["bulb_1"]}}}
    lit = {"LAMP": {**note, **LAMP["LAMP"]}, "HEAD": HEAD}
    for levels in ({}, {"HEAD/0": "human"}):
        assert "lamp" not in front.worlds_for(blueprint_of({**lit, "_levels": levels}), paths)
    assert "lamp" in front.worlds_for(blueprint_of({**lit, "_levels": THEIRS}), paths)


def test_a_human_fact_of_a_plugins_world_is_asked_for(tmp_path: Path) -> None:
    write_plugin(tmp_path, "lamp", LAMP_PLUGIN)
    run = open_run(
        lamp(THEIRS),
        "lamp",
        host="local",
        goal="HEAD/State_1",
        attended=True,
        plugin_paths=[tmp_path],
    )
    try:
        assert [one.event for one in run.open()][-1] == "task_opened"
        run.answer("", "0", by="Ann")
        for _ in range(500):
            run.tick()
            for task in run.status.tasks:
                word = "done" if task.kind == "operation" else "1"
                run.answer(task.name, word, by="Ann")
        assert run.status.reason == "goal_reached"
        assert run.status.configuration["HEAD"] == "State_1"
    finally:
        run.close()


NURSE, SURGEON = ("N. Kaya", "nurse"), ("L. Brandt", "surgeon")
ANSWERS = [
    ("fact", "HEAD/0", "0", NURSE, 1),
    ("fact", "REGISTRATION/1", "0", SURGEON, 1),
    ("operation", "HEAD/State_0/Op_FixHead", "done", NURSE, 12),
    ("fact", "HEAD/0", "1", NURSE, 2),
    ("confirm", "REGISTRATION/State_0000/Op_PlanLandmarks", "confirm", SURGEON, 2),
    ("operation", "REGISTRATION/State_1000/Op_DigitizeLandmarks", "done", SURGEON, 60),
    ("fact", "REGISTRATION/1", "1", SURGEON, 2),
    ("confirm", "REGISTRATION/State_1110/Op_Register", "confirm", SURGEON, 3),
    ("confirm", "REGISTRATION/State_1110/Op_Register", "confirm", NURSE, 5),
]


def answers() -> bytes:
    """A script with the answers above; the second time a fact is asked for is the second line."""
    lines, seen = [], set()
    for kind, address, option, (by, role), after in ANSWERS:
        said = {"do": "answer", "kind": kind, "address": address, "option": option}
        times = 2 if (address, role) in seen else 1
        seen.add((address, role))
        lines.append({**said, "by": by, "role": role, "after": after, "times": times})
    return "\n".join(map(json.dumps, lines)).encode()


def test_the_sample_with_people_in_it_runs_equally_in_both_hosts() -> None:
    blueprint = front.read(samples_dir() / "registration-people.json")
    script = script_of(answers(), "answers.jsonl", blueprint)
    local, process = (front.run(blueprint, script=script, host=h) for h in ("local", "process"))
    assert local.reason == "goal_reached", local.sentence
    assert local.events == process.events
    assert local.left == ()
    told: list[Any] = [one for one in local.events if one.event == "task_closed"]
    assert [one.outcome for one in told] == ["answered"] * 8
    assert told[-1].answers == {"L. Brandt": "confirm", "N. Kaya": "confirm"}


def test_levels_and_an_agent_are_given_to_a_run() -> None:
    blueprint = front.read(samples_dir() / "hanoi-2.json")
    held = front.run(blueprint, levels={"supervision": "human"})
    assert held.reason == "held"
    assert "nobody is there to answer" in held.sentence
    asks = front.run(blueprint, supervisor=RiskLimit())
    assert "No risk is declared" in asks.sentence


def _answered(lines: int | None = None) -> Run:
    blueprint = smsl.read(samples_dir() / "registration-people.json")
    file = samples_dir() / "scripts" / "registration-answered.jsonl"
    raw = b"".join(file.read_bytes().splitlines(keepends=True)[:lines])
    return front.run(blueprint, script=script_of(raw, "script", blueprint))


def test_the_sample_script_answers_all_that_people_are_asked() -> None:
    run = _answered()
    assert (run.reason, run.left) == ("goal_reached", ())
    assert not [event for event in run.events if event.as_json().get("refused")]


def test_a_start_that_a_script_leaves_unknown_is_refused() -> None:
    run = _answered(1)
    assert run.reason == "refused"
    assert "Has every landmark been touched and recorded?" in run.sentence
    assert "run_started" not in [event.event for event in run.events]
