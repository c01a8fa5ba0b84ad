"""The pages for the readers can be followed: their files, their commands and what these print.

A fence whose first line names a file (```` ```json vial.json ````) is that file. In a ``console``
fence each line after ``$`` is a command, and the lines below it are what it prints, if any stand.
"""

from __future__ import annotations

import json
import re
import shlex
import shutil
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell

DOCS = Path(__file__).parents[2] / "docs"
FENCE = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```", re.MULTILINE | re.DOTALL)
SAMPLES = (
    "registration-people.json",
    "scripts/registration-answered.jsonl",
    "registration-drilling.json",
    "scripts/registration-drilling.jsonl",
)
"""What the pages use besides what they show."""
ERRORS = re.compile(r"operations: [1-9]\d* error")


@pytest.mark.parametrize("reader", ["engineer", "clinician", "plugin-author", "drilling"])
def test_what_a_page_shows_can_be_done(
    reader: str, shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in SAMPLES:
        shutil.copy(samples_dir() / name, tmp_path)
    _write_changed(tmp_path)
    done = 0
    for language, file, body in FENCE.findall((DOCS / f"{reader}.md").read_text("utf-8")):
        if file:
            Path(file).parent.mkdir(exist_ok=True)
            Path(file).write_text(body, "utf-8")
        elif language == "console":
            done += _follow(body, shell, monkeypatch)
        elif language == "python":
            exec(compile(body, f"{reader}.md", "exec"), {})
            done += 1
    assert done >= 2


def _write_changed(folder: Path) -> None:
    """Write the two files that the page about drilling makes from its sample, in its words."""
    for file, change in (("forgotten.json", _forget), ("anew.json", _digitize_anew)):
        values = json.loads((folder / "registration-drilling.json").read_text("utf-8"))
        change(values["REGISTRATION"])
        (folder / file).write_text(json.dumps(values, indent=4), "utf-8")


def _forget(branch: dict[str, Any]) -> None:
    del branch["_operations"]["Op_ClearReg"]["requires"]


def _digitize_anew(branch: dict[str, Any]) -> None:
    for one in branch.values():
        one.pop("Op_UsePrevReg", None)


def _follow(body: str, shell: Shell, monkeypatch: pytest.MonkeyPatch) -> int:
    """Type the commands of a console, and hold what they print against what is shown."""
    commands = body.split("$ ")[1:]
    for command in commands:
        typed, _, shown = command.partition("\n")
        program, *words = shlex.split(typed)
        if program == "export":
            monkeypatch.setenv(*words[0].split("=", 1))
            continue
        assert program == "smsl-studio"
        answer = shell(*words)
        assert answer.status == (1 if ERRORS.search(answer.out) else 0), (typed, answer.err)
        if shown:
            assert answer.out == shown, typed
    return len(commands)
