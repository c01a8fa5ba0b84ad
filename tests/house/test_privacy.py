"""Nothing leaves the machine: no process of the program speaks to a network unless it is told to.

Every interpreter of these tests is watched from its first line, children included. It notes each
socket of a network, each search for a host name, and each program it starts.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.stories.person import SAMPLES

WATCH = """
import os, sys

def note(event, given):
    if event == "socket.__new__" and given[1] not in (0, -1):
        names = {1: "AF_UNIX", 2: "AF_INET", 10: "AF_INET6"}
        family = names.get(int(given[1]), str(given[1]))
        if family == "AF_UNIX":
            return
        said = f"socket {family}"
    elif event in ("socket.connect", "socket.bind", "socket.sendto") and isinstance(
        given[1], tuple
    ):
        said = f"{event} {given[1]}"
    elif event in ("socket.getaddrinfo", "socket.gethostbyname", "urllib.Request"):
        said = f"{event} {given[0]}"
    else:
        return
    with open(os.environ["NOTES"], "a", encoding="utf-8") as notes:
        notes.write(said + "\\n")

sys.addaudithook(note)
with open(os.environ["NOTES"] + ".seen", "a", encoding="utf-8") as seen:
    seen.write("one\\n")
"""
"""Python runs it first in every interpreter that finds it as ``sitecustomize``."""

WINDOW = """
import sys
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.shell.windows import Windows

application = make_application([])
windows = Windows(application, Settings())
window = make_window(windows, sys.argv[1])
for _ in range(200):
    application.processEvents()
assert "PySide6.QtNetwork" not in sys.modules
window.session.history.setClean()
window.close()
windows.plugins.stop()
"""

COMMANDS = (
    ("check", "hanoi.json"),
    ("run", "hfsm.json", "--world", "table", "--host", "process", "--log", "{tmp}/log.jsonl"),
    ("report", "femoroplasty.json", "-o", "{tmp}/report.html"),
    ("render", "hanoi.json", "-o", "{tmp}/picture.svg"),
    ("plugins",),
)


def notes_of(folder: Path, *arguments: str) -> tuple[list[str], int]:
    """What the interpreters of one command noted, and how many there were."""
    watch = folder / "watch"
    watch.mkdir(exist_ok=True)
    (watch / "sitecustomize.py").write_text(WATCH, "utf-8")
    notes = folder / "notes"
    for one in (notes, Path(f"{notes}.seen")):
        one.write_text("", "utf-8")
    environment = {
        **os.environ,
        "PYTHONPATH": str(watch),
        "NOTES": str(notes),
        "SMSL_STUDIO_HOME": str(folder / "home"),
        "QT_QPA_PLATFORM": "offscreen",
    }
    done = subprocess.run(
        [sys.executable, *arguments], env=environment, capture_output=True, text=True, check=False
    )
    assert "Traceback" not in done.stderr, done.stderr
    seen = Path(f"{notes}.seen").read_text("utf-8").splitlines()
    return notes.read_text("utf-8").splitlines(), len(seen)


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command[0])
def test_a_command_speaks_to_no_network(command: tuple[str, ...], tmp_path: Path) -> None:
    words = [
        str(SAMPLES / one) if (SAMPLES / one).is_file() else one.format(tmp=tmp_path)
        for one in command
    ]
    noted, interpreters = notes_of(tmp_path, "-m", "smsl_studio", *words)
    assert noted == []
    assert interpreters >= (2 if command[0] == "run" else 1), "the children are watched too"


def test_the_window_speaks_to_no_network(tmp_path: Path) -> None:
    noted, interpreters = notes_of(tmp_path, "-c", WINDOW, str(SAMPLES / "hanoi-corrected.json"))
    assert noted == []
    assert interpreters >= 1


def test_a_broker_that_is_named_is_noted(tmp_path: Path) -> None:
    """The watch sees a network: a run that is told a broker speaks to it."""
    blueprint = tmp_path / "hfsm.json"
    blueprint.write_bytes((SAMPLES / "hfsm.json").read_bytes())
    bindings = tmp_path / "hfsm.toml"
    bindings.write_text('[mqtt.facts]\n"SB1/0" = "one"\n', "utf-8")
    command = ("run", str(blueprint), "--world", "table", "--broker", "127.0.0.1:9")
    noted, _ = notes_of(tmp_path, "-m", "smsl_studio", *command)
    assert any("127.0.0.1" in one for one in noted)
