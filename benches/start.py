"""Cold starts of whole processes in CPU time: the empty interpreter is the limit."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator

from benches.row import Row, process_ms

SAMPLE = "samples/hanoi-corrected.json"
WINDOW = f"""
import os
from smsl_studio.__main__ import load_window
load_window()
from smsl_studio.studio.shell.application import make_application, make_window
from smsl_studio.studio.shell.windows import Windows
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.style import prepare, tokens_of
application = make_application([])
prepare(application, tokens_of("light", application))
window = make_window(Windows(application, Settings()), {SAMPLE!r})
application.processEvents()
os._exit(0)
"""


def rows() -> Iterator[Row]:
    """Measure ``check`` on the 3-disk file, and the window with this file, drawn once.

    The process of a window ends when it is drawn: neither ours nor the bare one is taken apart.
    """
    empty = process_ms(lambda: _process("-c", "pass"))
    pydantic = process_ms(lambda: _process("-c", "import pydantic"))
    widgets = process_ms(lambda: _process("-c", BARE))
    check = process_ms(lambda: _process("-m", "smsl_studio", "check", SAMPLE))
    yield Row(
        "check, 27 states",
        check,
        "ms",
        (("python -c pass", empty), ("import pydantic", pydantic)),
        "at most 5x python -c pass: not reached, because the standard library alone (dataclasses, "
        "typing, re, argparse) is half of it",
    )
    window = process_ms(lambda: _process("-c", WINDOW), runs=5)
    yield Row(
        "window on 27 states, drawn",
        window,
        "ms",
        (("bare QMainWindow", widgets), ("python -c pass", empty)),
        "at most 5x a bare QMainWindow: not reached, because two thirds of it are imports of about "
        "690 modules that the drawing, its panels and its menus need",
    )


BARE = """
import os
from PySide6.QtWidgets import QApplication, QMainWindow
application = QApplication([])
window = QMainWindow()
window.show()
application.processEvents()
os._exit(0)
"""


def _process(*arguments: str) -> None:
    """A whole process, with its modules compiled as those of an installed program are."""
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen"}
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    subprocess.run(
        [sys.executable, *arguments],
        env=environment,
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
