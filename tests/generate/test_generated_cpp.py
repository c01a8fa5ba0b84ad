"""Generated C++ builds without warnings, commits what Studio commits; its logs are believed."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.front.generated_code import generate_code
from smsl_studio.shipped import samples_dir
from tests.generate.built_programs import built, committed, compared, run
from tests.generate.compiler import needs_compiler
from tests.generate.generated_runs import studio
from tests.generate.spiced import asked_of, spiced, spiced_script

RANDOM = (11, 20)
"""A few of those that ``benches/code.py`` counts: a compiler takes seconds for each."""
SAMPLES = (("hanoi-corrected", ("hanoi-chosen", "hanoi-cut", "hanoi-pruned", "hanoi-taken-over")),)
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


@needs_compiler
@pytest.mark.parametrize("number", RANDOM)
def test_any_blueprint_under_any_script(number: int, tmp_path: Path, engine: list[Path]) -> None:
    blueprint = spiced(number)
    program = built(blueprint, tmp_path, engine)
    script = spiced_script(number, blueprint)
    compared(program, blueprint, script, **asked_of(number, blueprint))


@needs_compiler
@pytest.mark.parametrize(("name", "scripts"), SAMPLES)
def test_the_samples(
    name: str, scripts: tuple[str, ...], tmp_path: Path, engine: list[Path]
) -> None:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    program = built(blueprint, tmp_path, engine)
    for script in scripts:
        path = samples_dir() / "scripts" / f"{script}.jsonl"
        compared(program, blueprint, path.read_bytes())


@needs_compiler
def test_a_run_starts_only_with_the_record_that_is_compiled_in(
    tmp_path: Path, engine: list[Path]
) -> None:
    record, other = tmp_path / "record.json", tmp_path / "other.json"
    record.write_text('{"approved": true}')
    other.write_text('{"approved": true }')
    path = samples_dir() / "three-levels.json"
    program = built(smsl.read(path), tmp_path, engine, record=record)
    events, status = run(program, record=record, blueprint=path)
    assert (events, status) == (run(program, record=record)[0], 0)
    assert committed(events) == committed(studio(smsl.read(path)))
    for named in (
        {},
        {"record": other},
        {"record": tmp_path},
        {"record": record, "blueprint": other},
    ):
        events, status = run(program, b"", **named)
        assert [one["event"] for one in events] == ["run_finished"]
        assert (events[0]["reason"], status) == ("refused", 1)


@needs_compiler
def test_people_answer_and_one_person_is_not_two(tmp_path: Path, engine: list[Path]) -> None:
    blueprint = smsl.read(samples_dir() / "registration-people.json")
    program = built(blueprint, tmp_path, engine)
    script = samples_dir() / "scripts" / "registration-answered.jsonl"
    whole = compared(program, blueprint, script.read_bytes())
    assert whole[-1]["reason"] == "goal_reached"
    alone = compared(program, blueprint, b"")
    assert "nobody is there to answer" in alone[-1]["sentence"]
    again = script.read_text("utf-8").rpartition("N. Kaya")
    twice = compared(program, blueprint, f"{again[0]} DR.  sun {again[2]}".encode())
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
