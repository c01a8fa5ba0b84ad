"""What a run sets beside the signed blueprint: levels, a supervisor, brokers, rooms, robots."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import RunRefused
from smsl_studio.front.elsewhere import with_remote
from smsl_studio.front.run_header import log_header
from smsl_studio.front.trust import with_trust
from smsl_studio.host.local import LocalHost
from smsl_studio.host.remote import WithRemote
from smsl_studio.shipped import samples_dir
from tests.approval import DOOR, written_policy
from tests.front.test_trusted_runs import approve, codes, file

__all__ = ["file"]

PEOPLE = {
    "_levels": {"supervision": "human", "inspection": "shared", "DOOR/0": "human"},
    "DOOR": {
        **DOOR["DOOR"],
        "_operations": {"open": {"actor": "human"}, "close": {"actor": "shared"}},
    },
}
"""The door, with people who open it, say whether it is open, inspect and supervise."""


def test_no_level_of_a_run_takes_from_people_what_was_signed(file: Path) -> None:
    """Python, the script of the command line, and the window ask one question."""
    file.write_text(json.dumps(PEOPLE), "utf-8")
    record = approve(file, **accepted(file))
    request = smsl.RunRequest(smsl.read(file), record=record)
    line = file.with_suffix(".jsonl")
    for of, level in (
        ("DOOR/open", "automatic"),
        ("DOOR/open", "shared"),
        ("DOOR/State_1/close", "automatic"),
        ("DOOR/0", "shared"),
        ("supervision", "automatic"),
        ("inspection", "automatic"),
    ):
        less = replace(request, levels={of: level})
        assert asked(less) == ["digest_differs"]
        line.write_text(json.dumps({"do": "level", "of": of, "level": level}), "utf-8")
        script = smsl.read_script(line, request.blueprint)
        refused = smsl.run(request.blueprint, record=record, script=script)
        assert codes(refused) == ["digest_differs"]
        told = of.replace("DOOR/open", "DOOR/State_0/open")
        assert f"{told} is {level} and not " in refused.sentence
    with pytest.raises(RunRefused, match="leave people less to do") as window:
        smsl.open_request(less)
    assert [code for code, _ in window.value.refusals] == ["digest_differs"]


def test_a_level_that_gives_people_more_to_do_may_be_set(file: Path) -> None:
    file.write_text(json.dumps(PEOPLE), "utf-8")
    request = smsl.RunRequest(smsl.read(file), record=approve(file, **accepted(file)))
    for levels in (
        {"DOOR/close": "human", "supervision": "human", "DOOR/open": "human"},
        {"forecast": "show"},
        {"DOOR/State_1/close": "shared", "inspection": "human"},
    ):
        assert asked(replace(request, levels=levels)) == []


def accepted(file: Path) -> dict[str, object]:
    """What must be said about the warnings of a blueprint."""
    found = smsl.inspect(smsl.read(file))
    known = [one for one in found if one.severity.value == "W"]
    return {"dispositions": tuple({f"{one.rule}@{one.address}=it is known": 1 for one in known})}


def test_a_script_is_no_supervisor(file: Path) -> None:
    """It was written before; its moment may never come."""
    approve(file)
    policy = Path(written_policy(file.parent, "supervisor = true"))
    line = file.with_suffix(".jsonl")
    line.write_text(json.dumps({"at": 99999, "do": "pause", "by": "M. Chen"}), "utf-8")
    blueprint = smsl.read(file)
    script = smsl.read_script(line, blueprint)
    assert codes(smsl.run(blueprint, policy=policy, script=script)) == ["supervisor_missing"]
    run = smsl.run(blueprint, policy=policy, script=script, supervisor="limit")
    assert run.reason == "goal_reached"


MQTT = """[mqtt]
broker = "127.0.0.1:1883"
site = "lab"
login = "studio.toml"
room = "site.toml"
[mqtt.facts]
"DOOR/0" = "eye"
"""
SITE = """site = "lab"
[node.eye]
title = "Eye"
kind = "device"
facts = {"DOOR/0" = ["eye"]}
"""


def heard(file: Path) -> Path:
    """Let a camera elsewhere tell the fact of the door."""
    (file.parent / "site.toml").write_text(SITE, "utf-8")
    toml = file.with_suffix(".toml")
    toml.write_text(MQTT, "utf-8")
    return toml


@pytest.mark.parametrize("world", ["table", "remote"])
def test_who_tells_a_fact_from_elsewhere_is_signed_for_its_world(file: Path, world: str) -> None:
    """Also in a world that has no code of its own."""
    record = approve(file)
    request = smsl.RunRequest(smsl.read(file), world, record=record)
    assert asked(request) == []
    heard(file)
    assert asked(request) == ["code_missing", "too_few_persons"]
    found = smsl.verify_approval(request.blueprint, world=world).refusals[0].sentence
    assert found.endswith(f"does not sign who tells facts from elsewhere in the world {world}")
    approve(file, worlds=(world,))
    assert asked(request) == []
    assert smsl.verify_approval(request.blueprint, world=world).is_approved
    assert smsl.verify_approval(request.blueprint).is_approved, "without a world nobody is heard"


def test_another_line_to_what_is_heard_is_no_longer_what_was_signed(file: Path) -> None:
    heard(file)
    request = smsl.RunRequest(smsl.read(file), record=approve(file, worlds=("table",)))
    for name, before, after in (
        ("door.toml", "127.0.0.1:1883", "192.0.2.1:1883"),
        ("door.toml", 'site = "lab"', 'site = "other"'),
        ("door.toml", 'site = "lab"', 'site = "lab"\nrun = "other"'),
        ("door.toml", '"eye"', '"ear"'),
        ("door.toml", "studio.toml", "other.toml"),
        ("door.toml", 'room = "site.toml"\n', ""),
        ("site.toml", "[node.eye]", "[node.ear]"),
    ):
        changed = file.parent / name
        text = changed.read_text("utf-8")
        assert before in text
        changed.write_text(text.replace(before, after), "utf-8")
        assert asked(request) == ["code_changed", "too_few_persons"], after
        changed.write_text(text, "utf-8")
        assert asked(request) == []


def test_an_option_cannot_name_another_line(file: Path) -> None:
    heard(file)
    request = smsl.RunRequest(smsl.read(file), record=approve(file, worlds=("table",)))
    assert asked(replace(request, broker="127.0.0.1:1883", site="lab")) == []
    assert asked(replace(request, broker="192.0.2.1:1883")) == ["code_changed"]
    assert asked(replace(request, site="other")) == ["code_changed"]


def test_what_was_signed_about_a_room_is_what_runs(file: Path) -> None:
    toml = heard(file)
    toml.write_text(MQTT.replace('login = "studio.toml"\n', ""), "utf-8")
    request = smsl.RunRequest(smsl.read(file), record=approve(file, worlds=("table",)))
    checked = with_trust(request)
    (file.parent / "site.toml").unlink()
    toml.write_text("no toml", "utf-8")
    host = with_remote(checked, LocalHost(checked.blueprint, "table"))
    assert isinstance(host, WithRemote)
    assert host.remote.view().broker == "127.0.0.1:1883"
    header = log_header(checked, None)
    assert header["mqtt"]["broker"] == "127.0.0.1:1883"


def test_only_the_usual_robot_of_a_world_is_signed() -> None:
    """Another arm reaches other places, with other forces."""
    blueprint = smsl.read(samples_dir() / "hanoi-corrected.json")
    usual = smsl.RunRequest(blueprint, "hanoi", record=Path("none"), robot="panda")
    assert asked(usual) == ["no_record"]
    trust = with_trust(replace(usual, robot="dvrk")).trust
    assert trust is not None
    assert [one.code for one in trust.refusals] == ["no_record", "code_missing"]
    words = "nobody has signed that the robot dvrk is in hanoi. Leave it out: panda is its usual"
    assert trust.refusals[-1].sentence == f"{words} robot"


def asked(request: smsl.RunRequest) -> list[str]:
    """The codes for which a run is refused before anything is opened."""
    trust = with_trust(request).trust
    assert trust is not None
    return [one.code for one in trust.refusals]
