"""At the end of the session or terminal the window closes, once no dialog or save is open."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
WINDOW = """
import os, signal, sys
from PySide6.QtCore import QTimer
from smsl_studio.studio.shell import application as app
from smsl_studio.studio.shell.windows import Windows

# Whoever started the tests may ignore it, as nohup does, and the window would respect that.
signal.signal(signal.SIGNAL, signal.SIG_DFL)
application, at, leave = app.make_application([]), [], Windows.leave

def left(windows):
    print("left while it was at", *at or ["nothing"])
    leave(windows)

def work():
    at.append("work")
    os.kill(os.getpid(), signal.SIGNAL)
    print("heard", sum(range(1000)))
    at.clear()

Windows.leave = left
QTimer.singleShot(0, work)
print("ends with", app.open_window([sys.argv[1]]))
"""


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_a_window_that_is_told_to_end_finishes_its_work_first(tmp_path: Path, name: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", WINDOW.replace("SIGNAL", name), str(ROOT / "samples" / "hfsm.json")],
        env={**os.environ, "SMSL_STUDIO_HOME": str(tmp_path), "QT_QPA_PLATFORM": "offscreen"},
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.splitlines() == [
        "heard 499500",
        "left while it was at nothing",
        "ends with 0",
    ], done.stderr
