"""A person who does not see the window has it read out: a real window, a real bus, a real reader.

The window runs as a child on a virtual display, and Debian's ``pyatspi`` walks its tree. ``./dev``
installs what that needs.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from smsl_studio.shipped import samples_dir

SESSION = Path(__file__).parent / "screen_reader" / "session.sh"
NEEDED = ("Xvfb", "dbus-run-session")
SILENT = {"filler", "label", "panel", "unknown", "separator", "split pane", "image", "scroll bar",
          "layered pane", "page tab list", "application"}  # fmt: skip
"""Roles of things that hold or part others: nobody acts on them, so they need no name."""

Thing = tuple[str, str, tuple[str, ...], bool]
"""Role, name, the names of all above it, and whether a label names it."""


@pytest.fixture
def display() -> Iterator[str]:
    """A virtual screen of its own."""
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


def read_out(file: Path, display: str, home: Path, walks: int) -> list[Thing]:
    """What a screen reader finds in a window on a file, walking round several times."""
    lacking = [name for name in NEEDED if shutil.which(name) is None]
    assert not lacking, f"{', '.join(lacking)} cannot be found; ./dev installs it"
    environment = {
        **os.environ,
        "DISPLAY": display,
        "QT_QPA_PLATFORM": "xcb",
        "QT_LINUX_ACCESSIBILITY_ALWAYS_ON": "1",
        "SMSL_STUDIO_HOME": str(home),
        "PYTHONPATH": str(Path(__file__).parents[2]),
    }
    found = file.with_suffix(".things")
    words = (SESSION, sys.executable, file, walks, found)
    done = subprocess.run(
        ["dbus-run-session", "--", "sh", *map(str, words)],
        check=False,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return [(r, n, tuple(path), labelled) for r, n, path, labelled in json.loads(found.read_text())]


def test_a_screen_reader_finds_every_state_operation_and_control(
    display: str, home: Path, tmp_path: Path
) -> None:
    file = Path(shutil.copy(samples_dir() / "hanoi-2.json", tmp_path))
    blueprint = json.loads(file.read_text())["SB1"]
    states = {name: list(edges) for name, edges in blueprint.items() if name != "HEADER"}
    things = read_out(file, display, home, walks=3)

    on_canvas = [(role, name, path) for role, name, path, _ in things if "Canvas" in path]
    first_words = [(name.split(",")[0], path[-1].split(",")[0]) for _, name, path in on_canvas]
    for state, operations in states.items():
        assert (state, "Canvas") in first_words
        for operation in operations:
            assert (operation, state) in first_words
    nameless = [
        (role, path)
        for role, name, path, labelled in things
        if not name and not labelled and role not in SILENT
    ]
    assert not nameless
