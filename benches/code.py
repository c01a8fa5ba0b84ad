"""Generated Python against Studio: 300 random blueprints under random scripts, and the samples.

``tests/generate`` compares a twentieth of them. Every log is verified, and told again.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import smsl_studio as smsl
from benches.row import Row
from smsl_studio.blueprint.model import Blueprint
from tests.front.any_run import any_run
from tests.generate.generated_runs import alike, ours, studio
from tests.generate.spiced import asked_of, spiced, spiced_script

RUNS = 300


def rows() -> Iterator[Row]:
    same = sum(_is_same(number) for number in range(RUNS))
    work = "random blueprints and scripts: the same events, and a log that is believed"
    yield Row(f"{RUNS} {work}", same, "runs", bound=str(RUNS))


def _is_same(number: int) -> bool:
    blueprint, script, asked = _run(number)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "code").mkdir()
        log = folder / "run.jsonl"
        events, _ = ours(blueprint, folder / "code", script, str(log), **asked)
        if smsl.verify(log, blueprint).doubt is not None:
            return False
    return alike(events) == alike(studio(blueprint, script, **asked))


def _run(number: int) -> tuple[Blueprint, bytes, dict[str, Any]]:
    if number % 3:
        blueprint = spiced(number)
        return blueprint, spiced_script(number, blueprint), asked_of(number, blueprint)
    run = any_run(number)
    return run.blueprint, run.raw, dict(run.asked)
