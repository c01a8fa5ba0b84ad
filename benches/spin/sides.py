"""Both sides at work: the whole command ``check``, and Spin from the model to its answer."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

from benches.spin.models import SpinModel
from benches.spin.promela import promela
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json

MEMORY = "4096"
"""MB that Spin may take."""


class Work(NamedTuple):
    """CPU seconds, MB of memory, configurations, and the length of the run that was found."""

    seconds: float
    megabytes: float
    configurations: int
    steps: int | None = None
    alone: float = 0.0
    """CPU seconds of the search alone."""


def ours(model: SpinModel, fails: bool, folder: Path) -> Work:
    """Ask one property with the command ``check``, compiled as an installed one is.

    The first of two runs compiles the modules of Python and is not counted.
    """
    condition = model.can if fails else model.never
    # The spelling of the property language, from that of the model.
    text = condition.replace("&&", "and").replace("!", "not ").replace("@", " in ")
    said, seconds, megabytes = _checked(text, model.values, folder)
    (found,) = json.loads(said)["files"]
    (answer,) = found["properties"]
    told = [one["counterexample"]["path"] for one in found["findings"] if "counterexample" in one]
    assert answer["verdict"] == ("fails" if fails else "holds"), answer
    steps = len(told[0]) if fails else None
    return Work(seconds, megabytes, answer["configurations"] or 0, steps)


def starts(folder: Path) -> Work:
    """Ask about two states: what the command takes before it begins to search."""
    _, seconds, megabytes = _checked("A in S1", {"A": {"S0": {}, "S1": {}}}, folder)
    return Work(seconds, megabytes, 1)


def _checked(never: str, values: dict[str, Any], folder: Path) -> tuple[str, float, float]:
    file = folder / "model.json"
    file.write_text(json.dumps({"_properties": [{"name": "p", "never": never}], **values}))
    command = [sys.executable, "-m", "smsl_studio", "check", str(file), "--rule", "R19"]
    command += ["--limit", "100000000", "--format", "json"]
    _run(command, folder)
    return _run(command, folder)


def spins(model: SpinModel, fails: bool, folder: Path, depth: int) -> Work:
    """Ask the same of Spin: translate, compile, search. A failing one breadth first.

    ``depth`` is the largest number of steps on a way without repetition.
    """
    blueprint = read_blueprint(parse_json(json.dumps(model.values), "model.json"))
    condition = model.can if fails else model.never
    (folder / "model.pml").write_text(promela(blueprint, condition))
    options = ["-O2", "-DSAFETY", "-DNOREDUCE", f"-DMEMLIM={MEMORY}"]
    options += ["-DBFS"] if fails else []
    total = 0.0
    for command in (["spin", "-a", "model.pml"], ["gcc", *options, "-o", "pan", "pan.c"]):
        _, seconds, _ = _run(command, folder)
        total += seconds
    said, seconds, megabytes = _run(["./pan", f"-m{depth}"], folder)
    stored = re.search(r"(\d+(?:\.\d+)?(?:e\+\d+)?) states, stored", said)
    errors = re.search(r"errors: (\d+)", said)
    assert stored is not None, said
    assert errors is not None, said
    assert (errors[1] != "0") is fails, said
    reached = re.search(r"depth reached (\d+)", said)
    # The assertion stands behind the last step, so that one is not in its depth.
    steps = int(reached[1]) + 1 if fails and reached else None
    return Work(total + seconds, megabytes, int(float(stored[1])), steps, seconds)


def _run(command: list[str], folder: Path) -> tuple[str, float, float]:
    """Return what a command prints, its CPU seconds, and its memory (MB)."""
    out = folder / "said"
    settings = {**os.environ, "PYTHONPYCACHEPREFIX": str(folder / "compiled")}
    settings.pop("PYTHONDONTWRITEBYTECODE", None)
    with out.open("wb") as stream:
        child = subprocess.Popen(
            command, cwd=folder, stdout=stream, stderr=subprocess.STDOUT, env=settings
        )
        _, _, used = os.wait4(child.pid, 0)
        child.returncode = 0
    return out.read_text("utf-8", "replace"), used.ru_utime + used.ru_stime, used.ru_maxrss / 1000
