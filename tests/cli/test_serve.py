"""``serve`` and ``run --world remote``: the same story as in the world itself, and one program at a
time. A program that is killed leaves the world braked."""

from __future__ import annotations

import json
import os
import signal
import socket
import struct
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.cli.shell import Shell, sample
from tests.monitor.broker import free_port
from tests.plugin_folder import LAMP, LAMP_PLUGIN, blueprint_of, write_allowed

TOKEN = "0123456789abcdef"


class Serving:
    """A ``serve`` in a process of its own. ``told`` reads what it says next."""

    def __init__(self, process: subprocess.Popen[str], address: str) -> None:
        self.address = address
        self._process = process

    @property
    def told(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        found: dict[str, Any] = json.loads(self._process.stdout.readline())
        return found


@contextmanager
def serving(world: str, address: str, *more: str) -> Iterator[Serving]:
    words = ["serve", "--world", world, "--address", address, *more, "--format", "json"]
    command = [sys.executable, "-m", "smsl_studio", *words]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            own = Serving(process, address)
            assert own.told == {"event": "serving", "world": world, "address": address}
            yield own
        finally:
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)
    assert process.returncode == 128 + signal.SIGTERM


@pytest.fixture
def place(tmp_path: Path) -> str:
    return f"unix:{tmp_path / 's'}"


@pytest.fixture
def token(tmp_path: Path) -> str:
    path = tmp_path / "token"
    path.write_text(f"{TOKEN}\n", "utf-8")
    path.chmod(0o600)
    return str(path)


def story(answer: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The events of a run without the name of its world."""
    return [{key: value for key, value in one.items() if key != "world"} for one in answer]


def test_a_served_table_gives_the_same_story(shell: Shell, place: str) -> None:
    with serving("table", place) as own:
        for name, *words in (
            ("hanoi-2", "--goal", "State_cc"),
            ("hfsm", "--goal", "SB1/State111"),
            ("three-levels",),
        ):
            argv = ("run", sample(name), *words, "--format", "json")
            there = shell(*argv, "--world", "remote", "--address", place)
            assert story(there.lines) == story(shell(*argv, "--world", "table").lines), name
            assert there.status == 0
            assert [own.told["event"], own.told["reason"]] == ["program_came", "it said goodbye"]


def test_a_served_plugin_gives_the_same_story_with_its_faults(
    shell: Shell, home: Path, tmp_path: Path, place: str
) -> None:
    write_allowed(home, "lamp", LAMP_PLUGIN)
    file = tmp_path / "lamp.json"
    file.write_text(blueprint_of(LAMP).document.text, "utf-8")
    script = tmp_path / "script.jsonl"
    act = {"at": 0.05, "do": "disturb", "target": "LAMP/0", "kind": "dropout"}
    script.write_text(json.dumps(act), "utf-8")
    with serving("lamp", place):
        for words in (
            ["--avoid=State_0/Op_on", "--avoid=State_0/Op_spin"],
            ["--avoid=State_0/Op_break", "--avoid=State_0/Op_spin", "--script", str(script)],
        ):
            argv = ("run", str(file), *words, "--format", "json")
            there = shell(*argv, "--world", "remote", "--address", place)
            here = shell(*argv, "--world", "lamp", "--host", "local")
            assert story(there.lines) == story(here.lines), words
            assert there.status == here.status


def test_faults_of_a_served_table_are_injected_and_refused_alike(
    shell: Shell, tmp_path: Path, place: str
) -> None:
    script = tmp_path / "script.jsonl"
    acts: list[dict[str, Any]] = [
        {"at": 0.0, "do": "inject", "fault": "fail"},
        {"at": 0.2, "do": "inject", "fault": "set", "fact": "SB1/0", "value": "b"},
    ]
    script.write_text("\n".join(map(json.dumps, acts)), "utf-8")
    argv = ("run", sample("hanoi-2"), "--script", str(script), "--format", "json")
    with serving("table", place):
        there = shell(*argv, "--world", "remote", "--address", place)
        assert story(there.lines) == story(shell(*argv, "--world", "table").lines)
        assert "fault_injected" in there.out
        unknown = {"at": 0.0, "do": "inject", "fault": "fial"}
        broken = {"at": 0.0, "do": "inject", "fault": "set", "fact": "SB9/0", "value": "b"}
        script.write_text("\n".join(map(json.dumps, (unknown, broken))), "utf-8")
        refused = [
            one["refused"]
            for one in shell(*argv, "--world", "remote", "--address", place).lines
            if one["event"] == "commanded"
        ]
    assert refused[0] == "the world 'remote' has no fault 'fial'. Did you mean fail?"
    assert refused[1].startswith("the fault set: no fact called 'SB9/0' is sensed")


def test_a_log_of_a_remote_world_is_told_again(shell: Shell, tmp_path: Path, place: str) -> None:
    log = str(tmp_path / "run.jsonl")
    with serving("table", place):
        argv = ("run", sample("hfsm"), "--goal", "SB1/State111", "--log", log)
        assert shell(*argv, "--world", "remote", "--address", place).status == 0
    assert json.loads(Path(log).read_bytes().splitlines()[0])["address"] == place
    told = shell("replay", log, "--verify", "--blueprint", sample("hfsm"))
    assert (told.status, "told again" in told.out) == (0, True)


def test_a_program_that_is_killed_leaves_the_world_braked(place: str) -> None:
    with serving("table", place) as own:
        argv = ("run", sample("registration"), "--world", "remote", "--address", place)
        command = [sys.executable, "-m", "smsl_studio", *argv, "--speed", "0.02", "--format=json"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as run:
            assert run.stdout is not None
            while "operation_started" not in run.stdout.readline():
                pass
            assert own.told == {"event": "program_came"}
            run.kill()
        told = own.told
    assert (told["event"], told["braked"]) == ("program_left", True)


def test_one_program_at_a_time(shell: Shell, place: str) -> None:
    with serving("table", place) as own:
        first = socket.socket(socket.AF_UNIX)
        with first:
            first.connect(place.removeprefix("unix:"))
            hello = json.dumps({"n": 1, "ask": "hello", "version": 1}).encode()
            first.sendall(struct.pack("!I", len(hello)) + hello)
            assert own.told == {"event": "program_came"}
            argv = ("run", sample("hanoi-2"), "--world", "remote", "--address", place)
            second = shell(*argv, "--format", "json")
            assert second.status == 1
            assert "another program is connected" in second.lines[-1]["sentence"]
        assert own.told["braked"]
        assert shell(*argv).status == 0


def test_a_port_needs_the_token(shell: Shell, tmp_path: Path, token: str) -> None:
    address = f"127.0.0.1:{free_port()}"
    other = tmp_path / "other"
    other.write_text("f" * 16, "utf-8")
    other.chmod(0o600)
    argv = ("run", sample("hanoi-2"), "--world", "remote", "--address", address)
    with serving("table", address, "--token-file", token):
        assert shell(*argv, "--token-file", token).status == 0
        refused = shell(*argv, "--token-file", str(other))
        assert (refused.status, "the token is not the right one" in refused.out) == (1, True)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--address", "10.0.0.7:7000"), "is beyond this computer, and the connection is not enc"),
        (("--address", "0.0.0.0:7000"), "is beyond this computer"),
        (("--address", "nowhere"), "'nowhere' is no address"),
        (("--address", "127.0.0.1:70000"), "is no address"),
        (("--address", "unix:"), "names no socket"),
        (("--address", "127.0.0.1:7000"), "127.0.0.1:7000 needs a token"),
        ((), "the world 'remote' needs the address of a program"),
        (("--address", "unix:s", "--forecast", "show"), "cannot be tried beforehand"),
    ],
)
def test_addresses_that_are_refused(shell: Shell, words: tuple[str, ...], said: str) -> None:
    run = shell("run", sample("hanoi-2"), "--world", "remote", *words)
    assert (run.status, said in run.err) == (2, True)
    if words and "--forecast" not in words:
        served = shell("serve", "--world", "table", *words)
        assert (served.status, said in served.err) == (2, True)


def test_a_token_that_others_can_read_is_refused(shell: Shell, token: str) -> None:
    Path(token).chmod(0o644)
    argv = ("serve", "--world", "table", "--address", "127.0.0.1:7000", "--token-file", token)
    answer = shell(*argv)
    assert (answer.status, "can be read by others" in answer.err) == (2, True)
    Path(token).chmod(0o600)
    Path(token).write_text("short", "utf-8")
    assert "has no token" in shell(*argv).err


def test_remote_is_listed_and_only_a_run_reaches_it(shell: Shell, place: str) -> None:
    worlds = shell("worlds", "--format", "json").json["worlds"]
    assert worlds[-1]["name"] == "remote"
    checked = shell("check", sample("hanoi-2"), "--world", "remote")
    assert (checked.status, "which only a run reaches" in checked.err) == (2, True)
    served = shell("serve", "--world", "remote", "--address", place)
    assert (served.status, "cannot be served from here" in served.err) == (2, True)
    table = shell("run", sample("hanoi-2"), "--world", "table", "--address", place)
    assert (table.status, "an address is for the world 'remote'" in table.err) == (2, True)


def test_nobody_answers(shell: Shell, place: str) -> None:
    run = shell("run", sample("hanoi-2"), "--world", "remote", "--address", place)
    assert (run.status, "nothing answers at" in run.out) == (1, True)


def test_the_blueprint_of_the_one_who_serves(shell: Shell, place: str) -> None:
    with serving("table", place, "--file", sample("hanoi-2")):
        argv = ("--world", "remote", "--address", place)
        assert shell("run", sample("hanoi-2"), *argv).status == 0
        other = shell("run", sample("hanoi-4"), *argv, "--format", "json")
        assert other.lines[-1]["reason"] == "refused"
        assert "hanoi-2.json is served, and this is another" in other.lines[-1]["sentence"]


def test_a_socket_that_was_left_behind_is_no_obstacle(place: str) -> None:
    path = place.removeprefix("unix:")
    with socket.socket(socket.AF_UNIX) as left:
        left.bind(path)
    assert os.path.lexists(path)
    with serving("table", place):
        assert Path(path).stat().st_mode & 0o777 == 0o600
    assert not os.path.lexists(path)
