"""Generated C++ builds without warnings, commits what Studio commits; its logs are believed."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.generated_code import generate_code
from smsl_studio.shipped import samples_dir
from tests.generate.compiler import COMPILER, FLAGS, needs_compiler
from tests.generate.generated_runs import studio
from tests.generate.spiced import asked_of, spiced, spiced_script

Json = Any
RANDOM = (11, 20)
"""A few of those that ``benches/code.py`` counts: a compiler takes seconds for each."""
SAMPLES = (
    ("three-levels", ("",)),
    ("hanoi-corrected", ("hanoi-chosen", "hanoi-cut", "hanoi-pruned", "hanoi-taken-over")),
)
BAD_LINES = (
    ('{"do": "fly"}', "is no command"),
    ('{"do": "stop", "do": "stop"}', "is no JSON object in UTF-8, each key once"),
    ('{"do": "stop", "at": -1}', "is no number from 0 to 1e+09"),
    ('{"do": "stop", "turn": 1.5}', "is no count"),
    ('{"do": "stop", "when": "REGISTRATION/Nowhere"}', "is no state"),
    ('{"do": "ask"}', "needs 'address'"),
    ('{"do": "ask", "address": ["REGISTRATION/State_0000/Op_PlanLandmarks"]}', "is no text"),
    ('{"do": "inject", "fault": "set", "fact": "REGISTRATION/0"}', "value is missing"),
    (
        '{"do": "disturb", "target": "REGISTRATION/0", "kind": "noise", "rate": 2}',
        "no number from 0 to 1",
    ),
    ('{"do": "disturb", "target": "REGISTRATION/9", "kind": "none"}', "there is no fact"),
    ('{"do": "level", "of": "REGISTRATION/0", "level": "robot"}', "is no level of"),
    ('{"do": "stop", "by": "\\u200b"}', "is no text"),
    ("[" * 5000, "is no JSON object"),
    ('{"do": "stop", "_": "' + "x" * 70_000 + '"}', "longer than"),
)


def _built(blueprint: Blueprint, folder: Path, engine: list[Path]) -> Path:
    generate_code(blueprint, folder, target="cpp", name="made")
    sources = [*(folder / "made").glob("*.cpp"), *(folder / "made" / "branches").glob("*.cpp")]
    program = folder / "program"
    words = [str(COMPILER), *FLAGS, f"-I{folder / 'made'}", *map(str, [*sources, *engine])]
    subprocess.run([*words, "-o", str(program)], check=True)
    return program


def _compared(program: Path, blueprint: Blueprint, script: bytes, **asked: Json) -> list[Json]:
    """Run a program and Studio. Return the events of the program."""
    log = program.with_name("run.jsonl")
    log.unlink(missing_ok=True)
    ours, status = _run(program, script, log=log, **asked)
    theirs = studio(blueprint, script, **asked)
    assert _committed(ours) == _committed(theirs)
    assert ours[-1]["reason"] == theirs[-1]["reason"]
    assert ours[-1]["configuration"] == theirs[-1]["configuration"]
    assert status == (0 if ours[-1]["reason"] == "goal_reached" else 1)
    assert smsl.verify(log, blueprint).doubt is None
    return ours


def _run(program: Path, script: bytes = b"", **asked: Json) -> tuple[list[Json], int]:
    words = [str(program), "run"]
    if script:
        acts = program.with_name("script.jsonl")
        acts.write_bytes(script)
        asked = {**asked, "script": acts}
    for key, value in asked.items():
        for one in value if isinstance(value, list) else [value]:
            words += [f"--{key.replace('_', '-')}", str(one)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    return list(map(json.loads, done.stdout.splitlines())), done.returncode


def _committed(events: list[Json]) -> list[Json]:
    return [one["operations"] for one in events if one["event"] == "committed"]


@needs_compiler
@pytest.mark.parametrize("number", RANDOM)
def test_any_blueprint_under_any_script(number: int, tmp_path: Path, engine: list[Path]) -> None:
    blueprint = spiced(number)
    program = _built(blueprint, tmp_path, engine)
    script = spiced_script(number, blueprint)
    _compared(program, blueprint, script, **asked_of(number, blueprint))


@needs_compiler
@pytest.mark.parametrize(("name", "scripts"), SAMPLES)
def test_the_samples(
    name: str, scripts: tuple[str, ...], tmp_path: Path, engine: list[Path]
) -> None:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    program = _built(blueprint, tmp_path, engine)
    for script in scripts:
        path = samples_dir() / "scripts" / f"{script}.jsonl"
        _compared(program, blueprint, path.read_bytes() if script else b"")


@needs_compiler
def test_people_answer_and_one_person_is_not_two(tmp_path: Path, engine: list[Path]) -> None:
    blueprint = smsl.read(samples_dir() / "registration-people.json")
    program = _built(blueprint, tmp_path, engine)
    script = samples_dir() / "scripts" / "registration-answered.jsonl"
    whole = _compared(program, blueprint, script.read_bytes())
    assert whole[-1]["reason"] == "goal_reached"
    alone = _compared(program, blueprint, b"")
    assert "nobody is there to answer" in alone[-1]["sentence"]
    again = script.read_text("utf-8").rpartition("N. Kaya")
    twice = _compared(program, blueprint, f"{again[0]} DR.  sun {again[2]}".encode())
    told = [one["refused"] for one in twice if one["event"] == "task_answered"]
    assert any("has answered already" in words for words in told)
    for line, words in BAD_LINES:
        script = tmp_path / "bad.jsonl"
        script.write_text(f'{{"do": "pause"}}\n{line}\n', "utf-8")
        said = [str(program), "run", "--script", str(script)]
        done = subprocess.run(said, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stdout) == (2, ""), line[:80]
        assert done.stderr.startswith(f"{script}:2:1: "), done.stderr
        assert words in done.stderr, done.stderr


def test_generating_again_writes_nothing_and_keeps_what_people_wrote(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "registration.json")
    generate_code(blueprint, tmp_path, target="cpp")
    assert generate_code(blueprint, tmp_path, target="cpp", check=True).agrees
    path = tmp_path / "registration" / "operations.cpp"
    text = path.read_text("utf-8")
    written = text.replace("return world.carry_out(edge);", "return mine(world);", 1)
    path.write_text(written, "utf-8")
    assert generate_code(blueprint, tmp_path, target="cpp").agrees
    assert "return mine(world);" in path.read_text("utf-8")
