"""A window is killed in the middle of work: everything acknowledged is offered again."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.place import folder_of
from smsl_studio.studio.document.journal.writer import WAIT

ROOT = Path(__file__).parents[4]
SAMPLE = ROOT / "samples" / "hfsm.json"
CHILD = Path(__file__).with_name("child.py")


def test_the_wait_leaves_time_to_write_within_a_second() -> None:
    assert WAIT <= 500


@pytest.mark.parametrize(("doing", "acknowledged"), [("draw", 1), ("draw", 3), ("type", 2)])
def test_what_was_acknowledged_before_a_kill_is_there(
    doing: str, acknowledged: int, tmp_path: Path, home: Path
) -> None:
    file = Path(shutil.copy(SAMPLE, tmp_path / "work.json"))
    edits, safe = killed_after(acknowledged, file, doing)
    (left,) = left_behind(folder_of(home))
    (kept,) = left.entry.texts
    assert left.entry.path == str(file)
    reached = max((number for number, changes in edits if changes <= safe), default=0)
    assert reached > 0
    found = done_in(kept.text, doing)
    assert found == list(range(1, len(found) + 1)), "work is missing in between"
    assert reached <= len(found) <= edits[-1][0] + 1
    assert file.read_bytes() == SAMPLE.read_bytes()
    left.drop()


def killed_after(acknowledged: int, file: Path, doing: str) -> tuple[list[tuple[int, int]], int]:
    """Let a window work until so many times its work was safe, and kill it then and there."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(
        [sys.executable, str(CHILD), str(file), doing],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment, text=True,
    ) as child:  # fmt: skip
        assert child.stdout is not None
        lines = []
        for line in child.stdout:
            lines.append(line.split())
            if sum(words[0] == "safe" for words in lines) == acknowledged:
                child.kill()
        lines += [line.split() for line in child.stdout]
    whole = [words for words in lines if len(words) == {"edit": 3, "safe": 2}.get(words[0])]
    edits = [(int(words[1]), int(words[2])) for words in whole if words[0] == "edit"]
    return edits, max(int(words[1]) for words in whole if words[0] == "safe")


def done_in(text: str, doing: str) -> list[int]:
    """The edits that a text shows, by number."""
    if doing == "type":
        typed = re.search("x+", text)
        return list(range(1, len(typed[0]) + 1)) if typed else []
    # A state that was drawn has a place, too; before an opening brace stands the state itself.
    return [int(number) for number in re.findall(r'"State_(\d{5})": \{', text)]
