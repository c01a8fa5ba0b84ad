"""Generated C++ programs, built, and their runs compared with those of Studio."""

from __future__ import annotations

import json
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.generated_code import generate_code
from smsl_studio.shipped import resources_dir
from tests.generate.compiler import COMPILER, FLAGS
from tests.generate.generated_runs import studio

Json = Any


def compiled_engine(folder: Path, *more: str) -> list[Path]:
    """Compile the dispatcher, which is the same for every blueprint. Return its object files."""
    sources = sorted((resources_dir() / "code" / "cpp" / "dsfo").glob("*.cpp"))
    objects = [folder / f"{one.stem}.o" for one in sources]

    def compile_one(source: Path, made: Path) -> None:
        words = [str(COMPILER), *FLAGS, *more, "-c", str(source), "-o", str(made)]
        subprocess.run(words, check=True)

    with ThreadPoolExecutor(2) as pool:  # a compiler takes much memory
        list(pool.map(compile_one, sources, objects))
    return objects


def built(
    blueprint: Blueprint,
    folder: Path,
    engine: list[Path],
    *more: str,
    record: Path | None = None,
) -> Path:
    """Generate the code of a blueprint and build it. Return the program."""
    generate_code(blueprint, folder, target="cpp", name="made", record=record)
    sources = [*(folder / "made").glob("*.cpp"), *(folder / "made" / "branches").glob("*.cpp")]
    program = folder / "program"
    words = [str(COMPILER), *FLAGS, *more, f"-I{folder / 'made'}", *map(str, [*sources, *engine])]
    subprocess.run([*words, "-o", str(program)], check=True)
    return program


def run(program: Path, script: bytes = b"", **asked: Json) -> tuple[list[Json], int]:
    """Return the events of one run of a program, and its exit status."""
    words = [str(program), "run"]
    if script:
        acts = program.with_name("script.jsonl")
        acts.write_bytes(script)
        asked = {**asked, "script": acts}
    for key, value in asked.items():
        for one in value if isinstance(value, list) else [value]:
            words += [f"--{key.replace('_', '-')}", str(one)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert "ERROR: AddressSanitizer" not in done.stderr, done.stderr
    assert "runtime error" not in done.stderr, done.stderr
    return list(map(json.loads, done.stdout.splitlines())), done.returncode


def compared(program: Path, blueprint: Blueprint, script: bytes, **asked: Json) -> list[Json]:
    """Run a program and Studio: the same is committed, with the same end, and the log is believed.
    Return the events of the program.
    """
    log = program.with_name("run.jsonl")
    log.unlink(missing_ok=True)
    ours, status = run(program, script, log=log, **asked)
    theirs = studio(blueprint, script, **asked)
    assert committed(ours) == committed(theirs)
    assert ours[-1]["reason"] == theirs[-1]["reason"]
    assert ours[-1]["configuration"] == theirs[-1]["configuration"]
    assert status == (0 if ours[-1]["reason"] == "goal_reached" else 1)
    assert smsl.verify(log, blueprint).doubt is None
    return ours


def committed(events: list[Json]) -> list[Json]:
    """Return the operations of each commit."""
    return [one["operations"] for one in events if one["event"] == "committed"]
