"""Generated C++ drives a world that is a program elsewhere, and believes nothing unchecked."""

from __future__ import annotations

import json
import signal
import subprocess
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.channel.frames import Frame
from smsl_studio.front.generated_code import generate_code
from smsl_studio.shipped import samples_dir
from tests.channel.programs import Lie, driven, honest, program
from tests.channel.test_lying_programs import LIES, at_third
from tests.generate.compiler import COMPILER, FLAGS, needs_compiler

Json = Any
GOAL = "SB1/State_cc"
pytestmark = needs_compiler


@pytest.fixture(scope="session")
def blueprint() -> Blueprint:
    return smsl.read(samples_dir() / "hanoi-2.json")


@pytest.fixture(scope="session")
def made(
    blueprint: Blueprint, engine: list[Path], tmp_path_factory: pytest.TempPathFactory
) -> Path:
    """The program of the blueprint."""
    folder = tmp_path_factory.mktemp("made")
    generate_code(blueprint, folder, target="cpp", name="made")
    sources = [*(folder / "made").glob("*.cpp"), *(folder / "made" / "branches").glob("*.cpp")]
    words = [str(COMPILER), *FLAGS, f"-I{folder / 'made'}", *map(str, [*sources, *engine])]
    subprocess.run([*words, "-o", str(folder / "program")], check=True)
    return folder / "program"


def words_of(made: Path, folder: Path) -> list[str]:
    place = f"unix:{folder / 'p'}"
    said = ["run", "--goal", GOAL, "--world", "remote", "--address", place]
    return [str(made), *said, "--log", str(folder / "run.jsonl")]


def run_made(made: Path, folder: Path) -> tuple[list[Json], int]:
    """The events of a run in the program that listens in a folder, and the exit status."""
    done = subprocess.run(words_of(made, folder), capture_output=True, text=True, check=False)
    return list(map(json.loads, done.stdout.splitlines())), done.returncode


def committed(events: list[Json]) -> list[Json]:
    return [one["operations"] for one in events if one["event"] == "committed"]


def test_it_commits_what_studio_commits(made: Path, blueprint: Blueprint, tmp_path: Path) -> None:
    with program(blueprint, tmp_path):
        events, status = run_made(made, tmp_path)
    with program(blueprint, tmp_path):
        ours = [json.loads(one.line()) for one in driven(blueprint, tmp_path, GOAL)]
    assert committed(events)
    assert committed(events) == committed(ours)
    assert (events[-1]["reason"], status) == ("goal_reached", 0)
    assert smsl.verify(tmp_path / "run.jsonl", blueprint).doubt is None


@pytest.mark.parametrize("lie", LIES)
def test_what_cannot_be_true_ends_its_run(
    lie: str, made: Path, blueprint: Blueprint, tmp_path: Path
) -> None:
    with program(blueprint, tmp_path, at_third("tick", LIES[lie][0])) as running:
        events, status = run_made(made, tmp_path)
    held = [one["reason"] for one in events if one["event"] == "held"]
    assert (events[-1]["reason"], status) == ("failed", 1)
    assert held[-1].startswith(f"the program at unix:{tmp_path / 'p'} is lost: ")
    third = [at for at, verb in enumerate(running.heard) if verb == "tick"][2]
    assert set(running.heard[third + 1 :]) <= {"stop", "close"}
    assert smsl.verify(tmp_path / "run.jsonl", blueprint).doubt is None


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ({"hardware": True}, "hardware"),
        ({"wants_blueprint": True}, "--file"),
        ({"version": 2}, "version"),
        ({"session": ""}, "session"),
    ],
)
def test_what_it_does_not_open(
    said: Frame, words: str, made: Path, blueprint: Blueprint, tmp_path: Path
) -> None:
    def lie(verb: str, answer: Frame) -> bytes | None:
        return honest(verb, {**answer, **said} if verb == "hello" else answer)

    with program(blueprint, tmp_path, lie) as running:
        events, status = run_made(made, tmp_path)
    assert (events[-1]["reason"], status) == ("refused", 1)
    assert words in events[-1]["sentence"]
    assert "open" not in running.heard


def test_where_nobody_listens_nothing_begins(made: Path, tmp_path: Path) -> None:
    events, status = run_made(made, tmp_path)
    assert ([one["event"] for one in events], status) == (["run_finished"], 1)
    assert "nobody listens" in events[0]["sentence"]


@pytest.mark.parametrize("stops", [True, False])
def test_a_stop_does_not_wait_for_an_answer_that_is_owed(
    stops: bool, made: Path, blueprint: Blueprint, tmp_path: Path
) -> None:
    """The program never answers the third tick. The stop of a person is said meanwhile."""
    process: list[subprocess.Popen[str]] = []

    def lie(verb: str, answer: Frame) -> bytes | None:
        seen.append(verb)
        if verb == "tick" and seen.count("tick") == 3:
            process[0].send_signal(signal.SIGINT)
            return None
        return None if verb == "stop" and not stops else honest(verb, answer)

    seen: list[str] = []
    hush: Lie = lie
    with program(blueprint, tmp_path, hush):
        words = words_of(made, tmp_path)
        with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as running:
            process.append(running)
            assert running.stdout is not None
            events = list(map(json.loads, running.stdout))
    assert seen[seen.index("stop") - 1] == "tick"
    assert events[-1]["reason"] == "stopped"
    said = "It acknowledged a stop" if stops else "so it may still move"
    assert said in events[-1]["sentence"]
    assert smsl.verify(tmp_path / "run.jsonl", blueprint).doubt is None


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (["--world", "remote"], "belong together"),
        (["--address", "unix:p"], "belong together"),
        (["--world", "remote", "--address", "127.0.0.1:7007"], "needs a token"),
        (["--world", "remote", "--address", "127.0.0.1:7007", "--token-file", "none"], "token"),
        (["--world", "moon"], "table or remote"),
    ],
)
def test_wrong_words(more: list[str], said: str, made: Path) -> None:
    done = subprocess.run(
        [str(made), "run", "--goal", GOAL, *more], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert said in done.stderr


def test_an_address_beyond_this_computer(made: Path, tmp_path: Path) -> None:
    token = tmp_path / "token"
    token.write_text("0123456789abcdef\n", "utf-8")
    token.chmod(0o600)
    more = ["--world", "remote", "--address", "192.0.2.1:7007", "--token-file", str(token)]
    done = subprocess.run(
        [str(made), "run", "--goal", GOAL, *more], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "beyond this computer" in done.stdout


def test_only_its_owner_reads_a_token(made: Path, tmp_path: Path) -> None:
    token = tmp_path / "token"
    token.write_text("0123456789abcdef\n", "utf-8")
    token.chmod(0o644)
    more = ["--world", "remote", "--address", "127.0.0.1:7007", "--token-file", str(token)]
    done = subprocess.run(
        [str(made), "run", "--goal", GOAL, *more], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "chmod 600" in done.stderr
