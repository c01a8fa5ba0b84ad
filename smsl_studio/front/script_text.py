"""The text of a script that was made from what people did in a run."""

from __future__ import annotations

import json
import shlex
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from smsl_studio.front.request import RunRequest

Json = Any


def script_text(request: RunRequest, lines: Iterable[Mapping[str, Json]]) -> str:
    """Return the text of a script with these lines, for a run that is asked for like this one.

    The first line is no act: it says how the script is run.
    """
    levels = ({"do": "level", "of": of, "level": one} for of, one in request.levels.items())
    every = ({"_run": run_words(request)}, *levels, *lines)
    return "".join(f"{json.dumps(line, ensure_ascii=False)}\n" for line in every)


def run_words(request: RunRequest, script: str = "SCRIPT") -> str:
    """Return the command line that runs this request again, with a script of this name."""
    words = ["smsl-studio", "run", Path(request.blueprint.file).name, "--world", request.world]
    for option, states in (("--start", request.starts), ("--goal", request.goals)):
        for state in states:
            words += [option, str(state)]
    return shlex.join([*words, "--seed", str(request.seed), "--script", script])
