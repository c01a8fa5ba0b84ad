"""Kill -9 during drawing and typing: the amount of work that the next start does not offer.

A window does an edit every few milliseconds and writes the wall time of each to its parent, which
kills it at a random moment and reads what its journal holds. ``rows`` kills ten times in each way,
``all_rows`` a hundred times. Wall time, because that is what a person loses.
"""

from __future__ import annotations

import os
import random
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benches.row import Row
from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.place import folder_of

ROOT = Path(__file__).resolve().parents[1]
SAMPLE = ROOT / "samples" / "hfsm.json"
LONGEST = 2.5
"""Seconds of work after which the window is killed at the latest."""
WINDOW = """
import os, sys, time
from PySide6.QtCore import QTimer
from PySide6.QtTest import QTest
from smsl_studio.blueprint import editing
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.shell.windows import Windows

application = make_application([])
window = make_window(Windows(application, Settings()), sys.argv[1])
typing, done = sys.argv[2] == "type", 0
if typing:
    window.show_tab("Source")

def edit():
    global done
    done += 1
    if typing:
        QTest.keyClicks(window.source.editor, "x")
    else:
        name = f"State_{done:05}"
        window.session.edit("Add", lambda bp: editing.add_state(bp, "SB1", name))
    os.write(1, f"{time.monotonic()}\\n".encode())

timer = QTimer()
timer.timeout.connect(edit)
timer.start(5)
application.exec()
"""


def rows() -> Iterator[Row]:
    """The rows of this bench, quickly."""
    yield from _rows(10)


def all_rows() -> Iterator[Row]:
    """A hundred kills in each way."""
    yield from _rows(100)


def _rows(kills: int) -> Iterator[Row]:
    chance = random.Random(7)
    for doing, words in (("draw", "drawing"), ("type", "typing without a pause")):
        lost = [_lost_ms(doing, chance.uniform(0.3, LONGEST)) for _ in range(kills)]
        yield Row(f"kill -9 while {words}, {kills} times: the most that was lost", max(lost),
                  bound="under 1,000 ms of work (wall time)")  # fmt: skip


def _lost_ms(doing: str, after: float) -> float:
    """Return the milliseconds of work before the kill that the journal does not contain."""
    with TemporaryDirectory() as home:
        file = Path(shutil.copy(SAMPLE, Path(home) / "work.json"))
        times, killed = _killed(home, file, doing, after)
        held = sum(
            _held(left.entry.texts[0].text, doing) for left in left_behind(folder_of(Path(home)))
        )
    lost = times[held:]
    return (killed - lost[0]) * 1000 if lost else 0.0


def _killed(home: str, file: Path, doing: str, after: float) -> tuple[list[float], float]:
    """The wall time of every edit, and of the kill."""
    environment = {**os.environ, "SMSL_STUDIO_HOME": home, "QT_QPA_PLATFORM": "offscreen"}
    with subprocess.Popen(
        [sys.executable, "-c", WINDOW, str(file), doing], cwd=ROOT, env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
    ) as child:  # fmt: skip
        assert child.stdout is not None
        times = [float(child.stdout.readline())]
        time.sleep(after)
        killed = time.monotonic()
        child.kill()
        times += [float(line) for line in child.stdout if line.endswith("\n")]
    return times, killed


def _held(text: str, doing: str) -> int:
    if doing == "type":
        typed = re.search("x+", text)
        return len(typed[0]) if typed else 0
    return len(re.findall(r'"State_\d{5}": \{\}', text))
