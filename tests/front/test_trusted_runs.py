"""Runs that a policy guards: what was checked at the start is what runs."""

from __future__ import annotations

import json
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import ClassVar

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.errors import RunRefused, SaveError, StudioError
from smsl_studio.front import recorder
from smsl_studio.front.trust import with_trust
from smsl_studio.host.child import Recipe
from smsl_studio.host.plugin_offers import describe
from smsl_studio.host.spare import Spare
from smsl_studio.library.permission import allow
from smsl_studio.runlog.events import RunFinished, RunStarted
from tests.approval import DOOR, PASSPHRASE, make_keys_cheap, written_policy
from tests.plugin_folder import LAMP, LAMP_PLUGIN, found_plugin, write_allowed

WORDS = PASSPHRASE.encode()


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A blueprint with a key that can approve it."""
    make_keys_cheap(monkeypatch)
    path = tmp_path / "door.json"
    path.write_text(json.dumps(DOOR), "utf-8")
    smsl.make_key("Ada Lovelace", "engineer", WORDS, "ada")
    return path


def approve(file: Path, **more: object) -> Path:
    request = smsl.ApprovalRequest(smsl.read(file), "ada", WORDS)
    return smsl.approve(replace(request, **more)).file  # type: ignore[arg-type]


def codes(run: smsl.Run) -> list[str]:
    end = run.events[-1]
    assert isinstance(end, RunFinished)
    assert run.reason == "refused"
    assert len(run.events) == 1
    return [one["code"] for one in end.refusals]


def test_an_approved_blueprint_runs_and_its_log_says_who_approved_it(file: Path) -> None:
    approve(file, conditions=("world = table", "sensor DOOR/0 at 1 Hz"))
    log = file.with_suffix(".jsonl")
    policy = written_policy(file.parent, "roles = { engineer = 1 }")
    run = smsl.run(smsl.read(file), policy=policy, log=log)
    assert run.reason == "goal_reached"
    assert run.trust == "APPROVED by 1 person; keys of this computer, not of a register"
    started = next(event for event in run.events if isinstance(event, RunStarted))
    assert started.met == ("world = table", "sensor DOOR/0 at 1 Hz")
    header = json.loads(log.read_bytes().splitlines()[0])
    assert header["policy"]["verdict"] == "approved"
    assert header["policy"]["signers"][0]["person"] == "Ada Lovelace"
    assert smsl.verify(log).doubt is None
    assert smsl.replay(log).events == run.events
    smsl.account(log, log.with_suffix(".html"))
    page = log.with_suffix(".html").read_text("utf-8")
    assert "<dt>Approval</dt><dd>approved</dd>" in page
    assert "Ada Lovelace (engineer): conditions, 20" in page
    assert "keys of this computer, not of a register" in page


def test_a_run_that_asks_for_nothing_is_as_before(file: Path) -> None:
    run = smsl.run(smsl.read(file), log=file.with_suffix(".jsonl"))
    assert (run.reason, run.trust) == ("goal_reached", "")
    assert "met" not in run.events[0].line()
    assert "refusals" not in run.events[-1].line()
    header = json.loads(file.with_suffix(".jsonl").read_bytes().splitlines()[0])
    assert header["policy"] is None


def test_without_a_record_nothing_runs_and_the_log_says_why(file: Path) -> None:
    log = file.with_suffix(".jsonl")
    run = smsl.run(smsl.read(file), policy=written_policy(file.parent, ""), log=log)
    assert codes(run) == ["no_record"]
    assert smsl.verify(log).doubt is None
    assert smsl.replay(log).events == run.events


def test_a_condition_that_the_run_cannot_meet_refuses_it(file: Path) -> None:
    record = approve(file, conditions=("supervisor present",))
    assert codes(smsl.run(smsl.read(file), record=record)) == [
        "condition_unmet",
        "supervisor_missing",
    ]
    strict = smsl.RunRequest(smsl.read(file), record=record, person="M. Chen", host="local")
    assert smsl.run_request(strict).reason == "goal_reached"
    record = approve(file, conditions=("sensor DOOR/0 at 1000000 Hz",))
    assert codes(smsl.run(smsl.read(file), record=record)) == ["condition_unmet", "sensor_missing"]


def test_a_policy_that_wants_a_supervisor_refuses_a_run_without_one(file: Path) -> None:
    approve(file)
    policy = Path(written_policy(file.parent, "supervisor = true"))
    assert codes(smsl.run(smsl.read(file), policy=policy)) == ["supervisor_missing"]


def test_bytes_that_changed_since_they_were_read_do_not_run(file: Path) -> None:
    record = approve(file)
    blueprint = smsl.read(file)
    file.write_text(file.read_text() + "\n")
    assert codes(smsl.run(blueprint, record=record)) == ["file_changed"]
    assert smsl.run(smsl.read(file), record=record).reason == "goal_reached"


def test_a_log_that_cannot_be_written_refuses_the_run(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = approve(file)

    def full(*_: object) -> None:
        raise SaveError("the disk is full")

    monkeypatch.setattr(recorder, "RunLog", full)
    run = smsl.run(smsl.read(file), record=record, log=file.with_suffix(".jsonl"))
    assert codes(run) == ["log_unwritable"]


def test_a_start_that_the_world_does_not_have_is_unconfirmed(file: Path) -> None:
    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    broken = LAMP_PLUGIN.replace("world.set_facts(facts)", "pass").replace(
        'return world.fact("LAMP", n - 1)', "return None"
    )
    record = lamp(file, broken)
    end = smsl.run(smsl.read(file), "lamp", record=record, host="local").events[-1]
    assert isinstance(end, RunFinished)
    assert [one["code"] for one in end.refusals] == ["start_unconfirmed"]


def lamp(file: Path, code: str) -> Path:
    """Approve the lamp with the code of its world."""
    from smsl_studio.home import user_folder

    write_allowed(user_folder(), "lamp", code)
    blueprint = smsl.read(file)
    found = smsl.inspect(blueprint, world="lamp")
    known = [one for one in found if one.severity.value == "W"]
    texts = tuple(dict.fromkeys(f"{one.rule}@{one.address}=it is known" for one in known))
    return approve(file, worlds=("lamp",), dispositions=texts)


@pytest.mark.parametrize("host", ["local", "process"])
def test_the_code_that_was_verified_is_the_code_that_runs(file: Path, host: str) -> None:
    """The files change after the check; the process that loads them hashes them again."""
    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    record = lamp(file, LAMP_PLUGIN)
    request = smsl.RunRequest(smsl.read(file), "lamp", record=record, host=host)
    assert smsl.run_request(request).reason == "goal_reached"
    checked = with_trust(request)
    assert checked.trust is not None
    assert checked.trust.refusals == ()
    from smsl_studio.home import user_folder

    code = user_folder() / "plugins" / "lamp" / "plugin.py"
    code.write_text(code.read_text() + "\n# another version\n")
    allow(found_plugin("lamp"))
    run = smsl.run_request(checked)
    assert codes(run) == ["code_changed"]


BESIDE = """
import sys

def register(library):
    @library.operation("Op_zebra")
    def run_away(world):
        yield

    files = [str(getattr(module, "__file__", "")) for module in list(sys.modules.values())]
    if any(file.endswith("lamp/plugin.py") for file in files):
        print("zebra is here")
"""
"""A plugin that says so if it is loaded into the process of the lamp."""


@pytest.mark.parametrize("host", ["local", "process"])
def test_no_plugin_that_nobody_signed_runs_beside_signed_code(
    file: Path, host: str, capfd: pytest.CaptureFixture[str]
) -> None:
    """It would stand in the same process, and could change what was signed."""
    from smsl_studio.home import user_folder

    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    record = lamp(file, LAMP_PLUGIN)
    write_allowed(user_folder(), "zebra", BESIDE)
    request = smsl.RunRequest(smsl.read(file), "lamp", record=record, host=host)
    assert smsl.run_request(request).reason == "goal_reached"
    assert "zebra is here" not in capfd.readouterr().err
    smsl.run_request(replace(request, record=None))
    assert "zebra is here" in capfd.readouterr().err, "without a record each allowed one is loaded"


def test_the_bindings_that_were_verified_are_those_that_run(file: Path) -> None:
    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    record = lamp(file, LAMP_PLUGIN)
    request = smsl.RunRequest(smsl.read(file), "lamp", record=record, host="local")
    checked = with_trust(request)
    other = '[world.lamp.operations]\n"Op_on" = {function = "lamp.refuse"}\n'
    file.with_suffix(".toml").write_text(other)
    assert smsl.run_request(checked).reason == "goal_reached", "the file is not read again"
    assert codes(smsl.run_request(request)) == ["code_changed", "too_few_persons"]


@pytest.mark.parametrize("host", ["local", "process"])
def test_hardware_is_not_even_built_before_its_run_is_approved(
    file: Path, host: str, capfd: pytest.CaptureFixture[str]
) -> None:
    """To build a world, and to arrange its start, may move something."""
    from smsl_studio.home import user_folder

    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    code = LAMP_PLUGIN.replace('engine="table"', 'engine="table", hardware=True')
    write_allowed(user_folder(), "lamp", code)
    blueprint, edge = smsl.read(file), Address("LAMP", "State_0", "Op_on")
    with suppress(RunRefused):
        dispatcher = smsl.open_run(blueprint, "lamp", host=host)
        end = dispatcher.open()[-1]
        assert isinstance(end, RunFinished)
        assert (end.reason, "is hardware" in end.sentence) == ("refused", True)
        dispatcher.close()
    try:
        told = smsl.try_edge(blueprint, edge, "lamp", host=host).sentence
    except StudioError as error:
        told = str(error)
    assert "is hardware" in told
    assert "built" not in capfd.readouterr().err


def test_no_hardware_is_kept_ready_for_a_run(file: Path) -> None:
    from smsl_studio.front.hosts import make_ready
    from smsl_studio.home import user_folder

    class Noted(Spare):
        recipes: ClassVar[list[Recipe | None]] = []

        def warm(self, recipe: Recipe | None = None) -> None:
            self.recipes.append(recipe)

    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    code = LAMP_PLUGIN.replace('engine="table"', 'engine="table", hardware=True')
    write_allowed(user_folder(), "lamp", code)
    make_ready(Noted(), smsl.read(file), "lamp", 0, describe())
    assert Noted.recipes == [None]


def test_hardware_runs_only_under_a_policy_that_is_met(file: Path) -> None:
    file.write_text(json.dumps({"LAMP": {**LAMP["LAMP"], "State_0": {"Op_on": "State_1"}}}))
    hardware = LAMP_PLUGIN.replace('engine="table"', 'engine="table", hardware=True')
    record = lamp(file, hardware)
    assert codes(smsl.run(smsl.read(file), "lamp")) == ["policy_unmet"]
    with pytest.raises(RunRefused, match="hardware"):
        list(smsl.sweep(smsl.read(file), "lamp"))
    assert codes(smsl.run(smsl.read(file), "lamp", record=record)) == ["policy_unmet"]
    policy = written_policy(file.parent, "persons = 1")
    assert codes(smsl.run(smsl.read(file), "lamp", policy=policy)) == ["register_invalid"]
    head = smsl.make_key("Head of quality", "quality", WORDS, "head")
    (ada,) = (one for one in smsl.list_keys() if one.id == "ada")
    from smsl_studio.seal.strict_json import base64_text

    person = {"person": "Ada", "roles": ["engineer"], "keys": [base64_text(ada.public)]}
    listed = file.parent / "list.json"
    listed.write_text(json.dumps({"version": 1, "serial": 1, "persons": [person]}))
    smsl.sign_register(listed, "head", WORDS, file.parent / "persons.json")
    policy = written_policy(
        file.parent,
        f'register = "persons.json"\nregister_key = "{base64_text(head.public)}"',
    )
    run = smsl.run(smsl.read(file), "lamp", policy=policy, host="local")
    assert (run.reason, run.sentence) == ("goal_reached", run.sentence)
    assert "keys of a register" in run.trust
    # Edges that are generated in the run need a word of the policy.
    asked = smsl.RunRequest(
        smsl.read(file), "lamp", policy=Path(policy), host="local", generate="reader"
    )
    assert codes(smsl.run_request(asked)) == ["policy_unmet"]
    text = Path(policy).read_text("utf-8")
    Path(policy).write_text(f'{text}\ngenerated_edges = "confirmed"\n')
    assert smsl.run_request(asked).reason == "goal_reached"


def test_the_dispatcher_asks_the_same_question_for_a_window(file: Path) -> None:
    request = smsl.RunRequest(smsl.read(file), policy=Path(written_policy(file.parent, "")))
    with pytest.raises(RunRefused) as refused:
        smsl.open_request(request)
    (refusal,) = refused.value.refusals
    assert refusal[0] == "no_record"
