"""The sample drivers of ``generate driver``: driven, killed, hung, lying, and left alone."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.channel.address import ChannelAddress
from smsl_studio.errors import UsageError
from smsl_studio.runlog.events import Event, OperationEnded, OperationStarted
from tests.channel.frame_trials import framed
from tests.channel.programs import driven, end_of
from tests.monitor.broker import free_port

GOAL = "LAMP/State_1"
ON = "    yield\n    lamp.on = True"
"""What the first operation of the Python driver does."""


@contextmanager
def running(command: list[str], address: str) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen([*command, address], stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == f"listening at {address}\n"
            yield process
        finally:
            process.kill()


@contextmanager
def python_driver(folder: Path, old: str = "", new: str = "") -> Iterator[subprocess.Popen[str]]:
    """The Python driver at the socket ``p`` of a folder, with a change."""
    smsl.generate_driver(folder)
    file = folder / "driver.py"
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1) if old else text, "utf-8")
    with running([sys.executable, "-I", str(file)], f"unix:{folder / 'p'}") as process:
        yield process


def lamp(folder: Path) -> Blueprint:
    return smsl.read(folder / "lamp.json")


def test_the_driver_in_python_is_driven(tmp_path: Path) -> None:
    with python_driver(tmp_path):
        for _ in range(2):  # it serves one after the other
            events = driven(lamp(tmp_path), tmp_path, GOAL)
            assert end_of(events)[0] == "goal_reached"


def test_the_driver_in_cpp_is_driven_and_tells_the_same_story(tmp_path: Path) -> None:
    smsl.generate_driver(tmp_path / "cpp", target="cpp")
    flags = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    program = str(tmp_path / "driver")
    source = str(tmp_path / "cpp" / "driver.cpp")
    subprocess.run(["g++", *flags, source, "-o", program], check=True)
    with running([program], f"unix:{tmp_path / 'p'}") as process:
        told = driven(lamp(tmp_path / "cpp"), tmp_path, GOAL)
        # What is no frame ends the connection, and the next one is served.
        address = ChannelAddress("unix:p", path=str(tmp_path / "p"))
        for said in (b"\xff" * 4, framed(b"[[[[[[[[[[[["), framed({"n": 1, "ask": "open"})):
            with address.connected(5.0) as end:
                end.setblocking(True)
                end.sendall(said)
                assert end.recv(9) == b""
        assert end_of(driven(lamp(tmp_path / "cpp"), tmp_path, GOAL))[0] == "goal_reached"
        process.terminate()
        assert process.wait(timeout=60) == 0
    assert not (tmp_path / "p").exists()
    with python_driver(tmp_path):
        assert driven(lamp(tmp_path), tmp_path, GOAL) == told


def test_a_driver_that_is_killed(tmp_path: Path) -> None:
    with python_driver(tmp_path, ON, "    while True:\n        yield") as process:

        def kill(event: Event) -> None:
            if isinstance(event, OperationStarted):
                process.kill()

        address = f"unix:{tmp_path / 'p'}"
        done = smsl.run(lamp(tmp_path), "remote", GOAL, address=address, on_event=kill)
    assert done.reason == "failed"
    assert "is lost: the connection " in done.sentence
    assert "in the middle of LAMP/State_0/Op_on" in done.sentence
    assert done.sentence.endswith("It did not acknowledge a stop, so it may still move")


def test_a_driver_that_hangs(tmp_path: Path) -> None:
    with python_driver(tmp_path, ON, "    yield\n    time.sleep(60)"):
        limits = {"answer_limit": 0.3, "stop_limit": 0.1}
        reason, held = end_of(driven(lamp(tmp_path), tmp_path, GOAL, **limits))
    assert reason == "failed"
    assert "it did not answer for 0.3 s in the middle of LAMP/State_0/Op_on" in held
    assert held.endswith("so it may still move")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"1" if lamp.on', '"7" if lamp.on', "bulb reads '7', which is no value of LAMP/0"),
        ('"time": self.ticks * TICK, "seq', '"time": 9.0, "seq', "comes from the future"),
        ('outcome = "running"', 'outcome = "idle"', "it does nothing, and an operation has begun"),
        ('outcome, message = "idle", ""', 'outcome, message = "failed", ""', "none has begun"),
        ("self.end.sendall(struct", "self.end.sendall(raw + struct", "does not say hello"),
    ],
)
def test_a_driver_that_lies(tmp_path: Path, old: str, new: str, words: str) -> None:
    with python_driver(tmp_path, old, new):
        reason, held = end_of(driven(lamp(tmp_path), tmp_path, GOAL, answer_limit=1.0))
    assert (reason, words in held) == ("failed", True), held


def test_an_operation_that_breaks_is_a_failure_with_its_words(tmp_path: Path) -> None:
    with python_driver(tmp_path, ON, '    yield\n    raise OSError("the bulb broke")'):
        events = driven(lamp(tmp_path), tmp_path, GOAL)
    assert end_of(events)[0] == "held"
    (ended,) = (event for event in events if isinstance(event, OperationEnded))
    assert ended.outcome == "raised"
    assert "the bulb broke" in ended.line()


def test_a_driver_that_is_left_brakes(tmp_path: Path) -> None:
    told = 'always work."""\n        print("braked", flush=True)'
    with python_driver(tmp_path, 'always work."""', told) as process:
        address = ChannelAddress("unix:p", path=str(tmp_path / "p"))
        with address.connected(5.0) as end:
            end.setblocking(True)
            end.sendall(framed({"n": 1, "ask": "hello", "version": 1, "token": ""}))
            assert end.recv(4)
        assert process.stdout is not None
        assert process.stdout.readline() == "braked\n"


def test_a_port_and_a_token(tmp_path: Path) -> None:
    smsl.generate_driver(tmp_path)
    token = tmp_path / "token"
    token.write_text("0123456789abcdef\n", "ascii")
    token.chmod(0o600)
    address = f"127.0.0.1:{free_port()}"
    command = [sys.executable, str(tmp_path / "driver.py"), address, str(token)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            process.stdout.readline()
            done = smsl.run(lamp(tmp_path), "remote", GOAL, address=address, token_file=str(token))
            other = tmp_path / "other"
            other.write_text("x" * 16, "ascii")
            other.chmod(0o600)
            refused = smsl.run(
                lamp(tmp_path), "remote", GOAL, address=address, token_file=str(other)
            )
        finally:
            process.kill()
    assert (done.reason, refused.reason) == ("goal_reached", "failed")


def test_a_driver_is_not_written_over_what_somebody_has_written(tmp_path: Path) -> None:
    made = smsl.generate_driver(tmp_path)
    assert made.changed == ("driver.py", "lamp.json", "README.md")
    assert smsl.generate_driver(tmp_path).changed == ()
    (tmp_path / "driver.py").write_text("mine", "utf-8")
    with pytest.raises(UsageError, match="would be replaced"):
        smsl.generate_driver(tmp_path)
    with pytest.raises(UsageError, match="no driver is written in 'ros2'"):
        smsl.generate_driver(tmp_path, target="ros2")
    assert json.loads((tmp_path / "lamp.json").read_text("utf-8"))["LAMP"]


def test_a_driver_that_is_told_to_end_brakes_and_leaves_no_socket(tmp_path: Path) -> None:
    braked = tmp_path / "braked"
    old = "def brake(self) -> None:"
    mark = f"{old}\n        open({str(braked)!r}, 'w').close()\n        return\n"
    with python_driver(tmp_path, old, mark) as process:
        address = ChannelAddress("unix:p", path=str(tmp_path / "p"))
        with address.connected(5.0) as end:
            end.setblocking(True)
            end.sendall(framed({"n": 1, "ask": "hello", "version": 1, "token": ""}))
            assert end.recv(4096)
            process.terminate()
            assert process.wait(timeout=60) == 0
    assert braked.exists()
    assert not (tmp_path / "p").exists()


def test_a_socket_that_a_killed_driver_left_is_taken(tmp_path: Path) -> None:
    with python_driver(tmp_path) as process:
        process.kill()
        process.wait()
    with python_driver(tmp_path):
        assert end_of(driven(lamp(tmp_path), tmp_path, GOAL))[0] == "goal_reached"
