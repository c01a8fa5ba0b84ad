"""Runs of generated Python in this process, and the same runs of Studio."""

from __future__ import annotations

import importlib
import io
import json
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.generated_code import generate_code
from smsl_studio.front.script.lines import script_of

Json = Any
NAME = "generated_for_a_test"
_FUNCTION = re.compile(r"(table\.set_facts|\w+) says that it failed")


@contextmanager
def generated(blueprint: Blueprint, folder: Path) -> Iterator[Any]:
    """The modules of a generated package, while they can be imported."""
    generate_code(blueprint, folder, name=NAME)
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    try:
        yield importlib.import_module(f"{NAME}.dsfo.command_line")
    finally:
        sys.path.remove(str(folder))
        for name in [one for one in sys.modules if one.partition(".")[0] == NAME]:
            del sys.modules[name]


def ours(
    blueprint: Blueprint, folder: Path, script: bytes = b"", log: str = "", **asked: Any
) -> tuple[list[Json], int]:
    """The events that a generated package tells, and its exit status."""
    words = ["run", "--format", "json", *_words(asked)]
    if script:
        (folder / "script.jsonl").write_bytes(script)
        words += ["--script", str(folder / "script.jsonl")]
    if log:
        words += ["--log", log]
    with generated(blueprint, folder) as module:
        out = io.StringIO()
        with redirect_stdout(out), redirect_stderr(io.StringIO()):
            package = importlib.import_module(NAME)
            status = module.main(package.BLUEPRINT, words)
    return [json.loads(line) for line in out.getvalue().splitlines()], status


def studio(blueprint: Blueprint, script: bytes = b"", **asked: Any) -> list[Json]:
    """The events that Studio tells of the same run on the table world."""
    read = script_of(script, "script", blueprint) if script else None
    done = smsl.run(blueprint, script=read, **asked)
    return [json.loads(event.line()) for event in done.events]


def alike(events: list[Json]) -> list[Json]:
    """Events without the names of functions, which generated code gives by itself, and without the
    details of a hold, whose order is free.
    """
    found = []
    for event in events:
        said = {key: one for key, one in event.items() if key not in ("function", "details")}
        found.append(json.loads(_FUNCTION.sub("it failed", json.dumps(said))))
    return found


def _words(asked: Mapping[str, Any]) -> list[str]:
    words = []
    for key, value in asked.items():
        for one in value if isinstance(value, list) else [value]:
            words += [f"--{key.replace('_', '-')}", str(one)]
    return words
