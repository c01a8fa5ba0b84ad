"""Generated C++ builds without warnings, commits what Studio commits; its logs are believed."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import RunRefused
from smsl_studio.front.generated_code import generate_code
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.forms import form_named
from tests.dispatch.generated import blueprint_values
from tests.generate.compiler import COMPILER, FLAGS, needs_compiler
from tests.generate.generated_runs import studio
from tests.generate.spiced import asked_of

Json = Any
RANDOM = (11, 20)
"""A few of those that ``benches/code.py`` leaves to Python: a compiler takes seconds for each."""
SAMPLES = ("three-levels",)


def _built(blueprint: Blueprint, folder: Path, engine: list[Path]) -> Path:
    generate_code(blueprint, folder, target="cpp", name="made")
    sources = [*(folder / "made").glob("*.cpp"), *(folder / "made" / "branches").glob("*.cpp")]
    program = folder / "program"
    words = [str(COMPILER), *FLAGS, f"-I{folder / 'made'}", *map(str, [*sources, *engine])]
    subprocess.run([*words, "-o", str(program)], check=True)
    return program


def _compared(blueprint: Blueprint, folder: Path, engine: list[Path], **asked: Json) -> None:
    log = folder / "run.jsonl"
    words = [str(_built(blueprint, folder, engine)), "run", "--log", str(log)]
    for key, value in asked.items():
        for one in value if isinstance(value, list) else [value]:
            words += [f"--{key.replace('_', '-')}", str(one)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    ours, theirs = list(map(json.loads, done.stdout.splitlines())), studio(blueprint, **asked)
    assert _committed(ours) == _committed(theirs)
    assert ours[-1]["reason"] == theirs[-1]["reason"]
    assert ours[-1]["configuration"] == theirs[-1]["configuration"]
    assert done.returncode == (0 if ours[-1]["reason"] == "goal_reached" else 1)
    assert smsl.verify(log, blueprint).doubt is None


def _committed(events: list[Json]) -> list[Json]:
    return [one["operations"] for one in events if one["event"] == "committed"]


@needs_compiler
@pytest.mark.parametrize("number", RANDOM)
def test_any_blueprint(number: int, tmp_path: Path, engine: list[Path]) -> None:
    text = json.dumps(blueprint_values(number), indent=1)
    blueprint = read_blueprint(form_named("json").parse(text, f"random-{number}.json"))
    _compared(blueprint, tmp_path, engine, **asked_of(number, blueprint))


@needs_compiler
@pytest.mark.parametrize("name", SAMPLES)
def test_the_samples(name: str, tmp_path: Path, engine: list[Path]) -> None:
    _compared(smsl.read(samples_dir() / f"{name}.json"), tmp_path, engine)


def test_what_asks_people_is_refused_with_its_address(tmp_path: Path) -> None:
    blueprint = smsl.read(samples_dir() / "registration-people.json")
    with pytest.raises(RunRefused, match="C\\+\\+ code for that is not generated"):
        generate_code(blueprint, tmp_path, target="cpp")


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
