"""200 walks of a screen reader through a window in which a person draws and runs all the time.

The window is a child on a virtual screen with a bus of its own; Debian's ``pyatspi`` asks every
object in it for everything it offers (``tests/stories/screen_reader``). It counts windows that
died, and objects without a name that a person could act on.
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
from tests.stories.screen_reader.reading import DIED, nameless, session, virtual_screen

SESSIONS, WALKS = 10, 20
BUSY = "tests.stories.screen_reader.busy_window"
FILES = ("hanoi-2.json", "hfsm.json")


def rows() -> Iterator[Row]:
    deaths = broken = 0
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
    yield Row(f"of up to {things:,} things without a name", len(unnamed), "things", bound="0")
    yield Row("one walk (wall)", spent / walks, "s")
