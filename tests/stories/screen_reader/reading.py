"""What a screen reader finds in a real window, on a virtual screen and a real bus."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

SESSION = Path(__file__).parent / "session.sh"
NEEDED = ("Xvfb", "dbus-run-session")
DIED = 99
"""How a session ends whose window died."""
SILENT = {"filler", "label", "panel", "unknown", "separator", "split pane", "image", "scroll bar",
          "layered pane", "page tab list", "application"}  # fmt: skip
"""Roles of things that hold or part others: nobody acts on them, so they need no name."""

Thing = tuple[str, str, tuple[str, ...], bool]
"""Role, name, the names of all above it, and whether a label names it."""


@contextmanager
def virtual_screen() -> Iterator[str]:
    """A virtual screen of its own; the name of the display."""
    ours, theirs = os.pipe()
    screen = subprocess.Popen(
        ["Xvfb", "-displayfd", str(theirs), "-screen", "0", "1440x900x24", "-nolisten", "tcp"],
        pass_fds=(theirs,),
        stderr=subprocess.DEVNULL,
    )
    os.close(theirs)
    with os.fdopen(ours) as told:
        number = told.readline().strip()
    try:
        assert number, "Xvfb did not start"
        yield f":{number}"
    finally:
        screen.terminate()
        screen.wait()


def session(
    file: Path, display: str, home: Path, walks: int, window: str = "smsl_studio open"
) -> tuple[subprocess.CompletedProcess[str], list[Thing]]:
    """A session in which a window on a file is walked; how it ended, and what was found in it.

    Found is everything of the last walk, and of those before what had no name. ``window`` are the
    module that shows the window and its arguments.
    """
    lacking = [name for name in NEEDED if shutil.which(name) is None]
    assert not lacking, f"{', '.join(lacking)} cannot be found; ./dev installs it"
    environment = {
        **os.environ,
        "DISPLAY": display,
        "QT_QPA_PLATFORM": "xcb",
        "QT_LINUX_ACCESSIBILITY_ALWAYS_ON": "1",
        "SMSL_STUDIO_HOME": str(home),
        "PYTHONPATH": str(Path(__file__).parents[3]),
    }
    found = file.with_suffix(".things")
    words = (SESSION, sys.executable, file, walks, found, window)
    done = subprocess.run(
        ["dbus-run-session", "--", "sh", *map(str, words)],
        check=False,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300 + 60 * walks,
    )
    if not found.exists():
        return done, []
    things = json.loads(found.read_text())
    return done, [(role, name, tuple(path), labelled) for role, name, path, labelled in things]


def nameless(things: list[Thing]) -> list[tuple[str, tuple[str, ...]]]:
    """What somebody acts on and nobody has named: role, and the names of all above it."""
    return [
        (role, path)
        for role, name, path, labelled in things
        if not name and not labelled and role not in SILENT
    ]
