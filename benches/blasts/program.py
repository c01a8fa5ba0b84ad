"""The command line, or the window on a file, in a process that reports its memory.

``python -m benches.blasts.program check FILE`` runs that command. With ``window FILE`` it runs the
window: it opens the file, draws it and waits for its findings.
"""

from __future__ import annotations

import os
import resource
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from benches.blasts.measured import KILLED_AFTER

begun = ["0", "0"]
"""The CPU seconds, and the peak of address space in kB, before the file was looked at."""
PATIENCE = 120.0
"""Wall seconds in which the window must have its findings."""
LOOK = 100
"""Milliseconds after which it looks at the latest whether it has."""


def main(arguments: Sequence[str]) -> int:
    """Run the command, and return its exit status."""
    resource.setrlimit(resource.RLIMIT_CPU, (KILLED_AFTER, KILLED_AFTER))
    if arguments[0] == "window":
        return show(arguments[1])
    from smsl_studio.__main__ import main as program

    sys.argv = ["smsl-studio", *arguments]
    return program()


def show(file: str) -> int:
    """Open a window on a file, and wait until it is drawn and inspected, or told to be broken."""
    from PySide6.QtCore import QEventLoop, QTimer

    from smsl_studio.library.loaded import Loaded
    from smsl_studio.studio.base.settings import Settings
    from smsl_studio.studio.base.style import dress
    from smsl_studio.studio.base.theme import LIGHT
    from smsl_studio.studio.shell.application import make_application, make_window
    from smsl_studio.studio.shell.plugins import Plugins
    from smsl_studio.studio.shell.windows import Windows

    application = make_application(sys.argv)
    dress(application, LIGHT)
    settings = Settings(Path(os.environ["SMSL_STUDIO_HOME"]))
    windows = Windows(application, settings, Plugins(lambda: Loaded(())))
    window = make_window(windows)
    window.files.new()  # the start page would draw its pictures while the file is measured
    window.resize(1440, 900)
    application.processEvents()
    begun[:] = str(time.process_time()), peak()
    window.open_path(Path(file))
    end = time.monotonic() + PATIENCE
    alarm = QTimer()
    alarm.start(LOOK)
    while not (window.inspector.current or window.session.broken is not None):
        application.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        if time.monotonic() > end:
            return 3
    for _ in range(20):
        application.processEvents()
    return 0


def peak() -> str:
    """Return the peak of address space of this process, in kB."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(line.split()[1] for line in lines if line.startswith("VmPeak"))


if __name__ == "__main__":
    try:
        code = main(sys.argv[1:])
    except SystemExit as left:
        code = left.code if isinstance(left.code, int) else 3
    print("TOOK", peak(), *begun, file=sys.stderr, flush=True)
    os._exit(code)
