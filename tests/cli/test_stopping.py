"""A signal ends a command in order, at any step of its work."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Collection, Iterator
from pathlib import Path
from threading import Thread

import pytest

from smsl_studio import stop
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.cli import main
from smsl_studio.cli import run as running
from smsl_studio.cli.signals import heard
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front import inputs as reading
from smsl_studio.runlog.grammar.log_reader import verify
from tests.cli.shell import Answer, Shell, sample
from tests.plugin_folder import blueprint_of, write_plugin

WALK = {
    "WALK": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"Walk": "State_1"},
        "State_1": {},
    }
}
STALL = """
import os

def reached():
    open("reached", "w").close()

def spin():
    while True:
        pass

if HOW == "describing":
    reached()
    spin()

def register(library):
    @library.world("stall", engine="table")
    def build(world, blueprint, seed):
        if HOW == "building":
            reached()
            spin()

    @library.sensor("step", fact="1", period=0.01)
    def step(world):
        if HOW == "sensing" and os.path.exists("begun"):
            reached()
            spin()
        return "0"

    @library.operation("Walk", timeout=1e9)
    def walk(world):
        open("begun", "w").close()
        if HOW in ("operation", "hanging", "braking"):
            reached()
        if HOW == "hanging":
            spin()
        try:
            while True:
                yield
        finally:
            if HOW == "braking":
                spin()
"""
PHASES = (
    *((phase, "process") for phase in ("describing", "building", "operation", "hanging")),
    *((phase, "process") for phase in ("braking", "sensing")),
    *((phase, "local") for phase in ("building", "hanging", "braking")),
)


@pytest.fixture(autouse=True)
def handlers_stay() -> Iterator[None]:
    """Whatever a command hears, it hears only while it runs."""
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGALRM)
    before = [signal.getsignal(number) for number in numbers]
    yield
    assert [signal.getsignal(number) for number in numbers] == before
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_command_that_is_stopped_says_so_and_its_status_names_the_signal(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    look = reading.inspect

    def signalled(blueprint: Blueprint, rules: Collection[str] | None = None) -> object:
        if blueprint.state_count:
            os.kill(os.getpid(), number)
        return look(blueprint, rules)

    monkeypatch.setattr("smsl_studio.cli.check.inspect", signalled)
    answer = shell("check", sample("hanoi"))
    assert answer == Answer(128 + number, "", "smsl-studio check: stopped\n")


def test_a_stop_before_the_run_exists_is_its_end(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def signalled(file: str) -> object:
        os.kill(os.getpid(), signal.SIGINT)
        raise AssertionError("nothing goes on after a signal")

    monkeypatch.setattr(running, "read_argument", signalled)
    log = tmp_path / "run.jsonl"
    answer = shell("run", sample("hanoi"), "--world", "table", "--log", str(log), "--format=json")
    (finished,) = [line for line in answer.lines if line["event"] == "run_finished"]
    assert (answer.status, finished["reason"]) == (1, "stopped")
    assert not log.exists()


def test_what_must_be_whole_is_not_broken_off() -> None:
    done: list[str] = []

    def save() -> None:
        with stop.whole():
            os.kill(os.getpid(), signal.SIGTERM)
            done.append("all of it")
        done.append("something after it")

    with heard(), pytest.raises(stop.Stopped):
        save()
    assert done == ["all of it"]


def test_a_second_signal_changes_nothing() -> None:
    done: list[str] = []

    def close() -> None:
        try:
            os.kill(os.getpid(), signal.SIGINT)
        finally:
            os.kill(os.getpid(), signal.SIGINT)
            os.kill(os.getpid(), signal.SIGTERM)
            done.append("closed")

    with heard(), pytest.raises(stop.BrokenOff):
        close()
    assert done == ["closed"]


@pytest.mark.parametrize(("phase", "host"), PHASES)
def test_a_run_is_stopped_in_every_phase_and_its_log_has_a_head(
    tmp_path: Path, phase: str, host: str
) -> None:
    plugins = tmp_path / "plugins"
    write_plugin(plugins, "stall", f"HOW = {phase!r}\n{STALL}")
    file = tmp_path / "walk.json"
    file.write_text(blueprint_of(WALK).document.text, "utf-8")
    command = ("run", str(file), "--world", "stall", "--host", host, "--log", "run.jsonl")
    program = subprocess.Popen(
        [sys.executable, "-m", "smsl_studio", *command, "--format", "json"],
        cwd=tmp_path,
        env={
            **os.environ,
            "SMSL_PLUGIN_PATH": str(plugins),
            "PYTHONPATH": os.pathsep.join(sys.path),
        },
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    with program:
        while not (tmp_path / "reached").exists():
            assert program.poll() is None, program.communicate()
        program.send_signal(signal.SIGTERM)
        out, err = program.communicate(timeout=60)
    assert (program.returncode, json.loads(out.splitlines()[-1])["reason"]) == (1, "stopped")
    assert "Traceback" not in err
    log = tmp_path / "run.jsonl"
    with log.open("rb") as stream:
        assert verify(stream, "run.jsonl", COMMANDS).doubt is None


def test_main_is_deaf_outside_the_main_thread(shell: Shell) -> None:
    statuses: list[int] = []
    thread = Thread(target=lambda: statuses.append(main(["--version"])))
    thread.start()
    thread.join()
    assert statuses == [0]
