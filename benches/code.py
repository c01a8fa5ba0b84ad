"""Generated code against Studio: Python on 300 random blueprints under random scripts, and with
``--all`` C++ on the samples with their scripts and on 40 random ones, 10 of them with sanitizers.

``tests/generate`` compares a twentieth of them. Every log is verified, and told again.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import smsl_studio as smsl
from benches.row import Row
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError, RunRefused
from smsl_studio.front.script.fit import check_faults
from smsl_studio.front.script.lines import script_of
from smsl_studio.library.table_faults import table_faults
from smsl_studio.shipped import samples_dir
from tests.front.any_run import any_run
from tests.generate.built_programs import built, compared, compiled_engine
from tests.generate.generated_runs import alike, ours, studio
from tests.generate.spiced import asked_of, spiced, spiced_script

RUNS = 300
CPP_RUNS = range(2, 122, 3)
SANITIZERS = ("-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")


def rows() -> Iterator[Row]:
    same = sum(_is_same(number) for number in range(RUNS))
    work = "random blueprints and scripts: the same events, and a log that is believed"
    yield Row(f"{RUNS} {work}", same, "runs", bound=str(RUNS))


def all_rows() -> Iterator[Row]:
    """Yield the rows of C++ too, which builds some 60 programs."""
    yield from rows()
    with tempfile.TemporaryDirectory() as name:
        engine = compiled_engine(Path(name))
        told = [_is_same_cpp(engine, *pair, {}) for pair in _samples()]
        runs = [same for same in told if same is not None]
        work = "C++ on the samples and their scripts: the same, and a log that is believed"
        yield Row(work, sum(runs), "runs", bound=f"{len(runs)}")
        same = sum(bool(_is_same_cpp(engine, *_run(number))) for number in CPP_RUNS)
        work = "C++ on random blueprints and scripts: the same, and a log that is believed"
        yield Row(work, same, "runs", bound=f"{len(CPP_RUNS)}")
    with tempfile.TemporaryDirectory() as name:
        engine = compiled_engine(Path(name), *SANITIZERS)
        some = CPP_RUNS[::4]
        same = sum(bool(_is_same_cpp(engine, *_run(number), *SANITIZERS)) for number in some)
        yield Row(
            "the same with sanitizers (address, undefined)", same, "runs", bound=f"{len(some)}"
        )


def _samples() -> Iterator[tuple[Blueprint, bytes]]:
    """Yield every sample alone, and with each script of its name that a table world can play."""
    for path in sorted(samples_dir().glob("*.json")):
        blueprint = smsl.read(path)
        yield blueprint, b""
        for one in sorted((samples_dir() / "scripts").glob(f"{path.stem.split('-')[0]}*.jsonl")):
            raw = one.read_bytes()
            if b'"generate"' in raw:
                continue  # generated code makes no edges
            with suppress(ReadError):
                check_faults(script_of(raw, one.name, blueprint), "table", table_faults(blueprint))
                yield blueprint, raw


def _is_same_cpp(
    engine: list[Path], blueprint: Blueprint, script: bytes, asked: dict[str, Any], *more: str
) -> bool | None:
    """Return whether a program does what Studio does, None if none is generated."""
    with tempfile.TemporaryDirectory() as name:
        try:
            program = built(blueprint, Path(name), engine, *more)
            compared(program, blueprint, script, **asked)
        except RunRefused:
            return None
        except AssertionError as wrong:
            print(f"{blueprint.file}: {wrong}", file=sys.stderr)
            return False
    return True


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
