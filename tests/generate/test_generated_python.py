"""Generated Python tells the same story as Studio, event by event, and its logs are believed."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.shipped import samples_dir
from tests.generate.generated_runs import alike, ours, studio
from tests.generate.spiced import asked_of, spiced, spiced_script

RANDOM = range(0, 300, 20)
"""A twentieth of what ``benches/code.py`` compares."""
SAMPLES = (
    ("hanoi-hazard", "hanoi-hazard"),
    ("hanoi-corrected", "hanoi-cut"),
    ("registration-drilling", "registration-drilling"),
    ("registration-people", "registration-answered"),
    ("three-levels", ""),
    ("three-roots", ""),
    ("femoroplasty", "femoroplasty"),
)


def _compared(blueprint: Blueprint, folder: Path, script: bytes, **asked: object) -> None:
    log = folder / "run.jsonl"
    events, status = ours(blueprint, folder / "code", script, str(log), **asked)
    assert alike(events) == alike(studio(blueprint, script, **asked))
    assert status == (0 if events[-1]["reason"] == "goal_reached" else 1)
    assert smsl.verify(log, blueprint).doubt is None


@pytest.mark.parametrize("number", RANDOM)
def test_any_blueprint_under_any_script(number: int, tmp_path: Path) -> None:
    blueprint = spiced(number)
    (tmp_path / "code").mkdir()
    script = spiced_script(number, blueprint)
    _compared(blueprint, tmp_path, script, **asked_of(number, blueprint))


@pytest.mark.parametrize(("name", "script"), SAMPLES)
def test_the_samples(name: str, script: str, tmp_path: Path) -> None:
    acts = (samples_dir() / "scripts" / f"{script}.jsonl").read_bytes() if script else b""
    (tmp_path / "code").mkdir()
    _compared(smsl.read(samples_dir() / f"{name}.json"), tmp_path, acts)
