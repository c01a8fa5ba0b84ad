"""Walks of a screen reader through a window in which a person draws and runs all the time.

The window is a child on a virtual screen with a bus of its own; Debian's ``pyatspi`` asks every
object in it for everything it offers (``tests/stories/screen_reader``). It counts windows that
died, and objects without a name that a person could act on. With ``--all`` a
second window is walked as often while edits give elements new names, and its memory is told.
"""

from __future__ import annotations

import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benches.row import Row
from smsl_studio.shipped import samples_dir
from tests.stories.screen_reader.busy_window import ACTS
from tests.stories.screen_reader.drawing_window import MEMORY
from tests.stories.screen_reader.reading import DIED, nameless, session, virtual_screen

SESSIONS, WALKS = 10, 20
BUSY = "tests.stories.screen_reader.busy_window"
FILES = ("hanoi-2.json", "hfsm.json")
DRAWING = "tests.stories.screen_reader.drawing_window"
EDITS = 2_000
LEAST = 3
"""So many things a person must have done for each walk; else the walks show little."""


def rows() -> Iterator[Row]:
    deaths = broken = acts = 0
    unnamed: set[tuple[str, tuple[str, ...]]] = set()
    things, began = 0, time.monotonic()
    with virtual_screen() as display, tempfile.TemporaryDirectory() as name:
        for number in range(SESSIONS):
            folder = Path(name) / str(number)
            folder.mkdir()
            file = Path(shutil.copy(samples_dir() / FILES[number % len(FILES)], folder))
            done, found = session(file, display, folder / "home", WALKS, BUSY)
            deaths += done.returncode == DIED
            broken += done.returncode not in (0, DIED)
            acts += int(told.read_text()) if (told := file.with_suffix(ACTS)).exists() else 0
            if done.returncode:
                print(done.stderr[-4000:], file=sys.stderr, flush=True)
            unnamed.update(nameless(found))
            things = max(things, len(found))
    for role, path in sorted(unnamed):
        print(f"no name: {role} in {' / '.join(path)}", file=sys.stderr, flush=True)
    spent = time.monotonic() - began
    walks = SESSIONS * WALKS
    yield Row(f"{walks} walks while somebody draws and runs: deaths", deaths, "windows", bound="0")
    yield Row("walks that could not be ended", broken, "sessions", bound="0")
    yield Row(
        "things done meanwhile, for each walk", acts / walks, "things", bound=f"at least {LEAST}"
    )
    yield Row(f"of up to {things:,} things without a name", len(unnamed), "things", bound="0")
    yield Row("one walk (wall)", spent / walks, "s")


def all_rows() -> Iterator[Row]:
    """These, and the memory of a window that is read and drawn in."""
    yield from rows()
    with virtual_screen() as display, tempfile.TemporaryDirectory() as name:
        file = Path(shutil.copy(samples_dir() / FILES[0], name))
        walks = SESSIONS * WALKS
        done, _ = session(file, display, Path(name) / "home", walks, DRAWING)
        told = file.with_suffix(MEMORY).read_text().splitlines()
    print(*told, sep="\n", file=sys.stderr, flush=True)
    edits, memory, _ = zip(*(map(float, line.split()) for line in told), strict=True)
    begun = memory[edits.index(EDITS // 4)]
    words = f"{walks} walks, {edits[-1]:,.0f} edits"
    yield Row(f"{words}: deaths", done.returncode == DIED, "windows", bound="0")
    yield Row(f"{words}: memory more than after {EDITS // 4}", memory[-1] - begun, "MB")
