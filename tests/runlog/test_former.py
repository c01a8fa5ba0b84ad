"""Logs of the previous version are read, verified and replayed."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.picture.account import account
from smsl_studio.runlog.events import RunFinished
from smsl_studio.runlog.grammar.log_reader import read_log
from smsl_studio.runlog.playback import Playback
from tests.cli.shell import Shell, make_shell

FORMER = Path(__file__).parent / "former"
TOLD = json.loads((FORMER / "told.json").read_text("utf-8"))
LOGS = sorted(name for name in TOLD if name.endswith(".jsonl"))
BLUEPRINTS = sorted(TOLD.keys() - set(LOGS))


@pytest.fixture
def shell(capsys: pytest.CaptureFixture[str]) -> Shell:
    return make_shell(capsys)


def test_there_are_fifty_of_every_end_and_form() -> None:
    assert len(TOLD) == 50
    ends = {name.rpartition("-")[0] for name in LOGS}
    assert ends == {"goal_reached", "held", "no_route", "refused", "stopped", "failed"}
    assert {Path(name).suffix for name in BLUEPRINTS} == {".json", ".smsl", ".yaml"}


@pytest.mark.parametrize("name", LOGS)
def test_a_former_log_is_read_verified_and_told_again(name: str) -> None:
    run = read_log(FORMER / name, COMMANDS)
    assert run.doubt is None
    text = "".join(f"{record.text}\n" for record in run.records)
    assert len(run.records) == TOLD[name]["events"]
    assert hashlib.sha256(text.encode()).hexdigest() == TOLD[name]["replay"]
    last = run.events[-1]
    assert isinstance(last, RunFinished)
    told = Playback(run.events, run.header["by_hand"]).at(len(run.events))
    assert told.phase == last.reason == name.rpartition("-")[0]
    assert told.operations == last.operations
    assert "Verified" in account(run, COMMANDS)


def test_former_logs_are_replayed_and_verified_by_the_command(shell: Shell) -> None:
    for name in LOGS[::8]:
        file = str(FORMER / name)
        answer = shell("replay", file, "--format", "json")
        assert (answer.status, answer.err) == (0, "")
        assert hashlib.sha256(answer.out.encode()).hexdigest() == TOLD[name]["replay"]
        verified = shell("replay", file, "--verify")
        assert verified.status == 0
        assert "a log of version 2: its goals were told without a fresh check" in verified.out


@pytest.mark.parametrize("name", BLUEPRINTS)
def test_a_former_blueprint_means_what_it_meant_and_runs(
    name: str, tmp_path: Path, shell: Shell
) -> None:
    (found,) = shell("digest", str(FORMER / name), "--format", "json").json["files"]
    assert {key: found[key] for key in TOLD[name]["digest"]} == TOLD[name]["digest"]
    run = smsl.run(smsl.read(FORMER / name), log=tmp_path / "log")
    assert run.reason == "goal_reached"
    assert read_log(tmp_path / "log", COMMANDS).doubt is None
