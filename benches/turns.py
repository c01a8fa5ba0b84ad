"""The longest wait of the window while the hazards and properties of a large file are answered.

A timer of the event loop ticks as often as it can. What all threads of the program compute between
two ticks is the time for which a key would wait on a machine that does nothing else. It is CPU
time, so other programs do not count. It has the window's own work, its collections of garbage, and
the steps of the worker that keep the interpreter for themselves. The first answer comes with the
first picture of the file, so the figures are those of *Check again*.
"""

from __future__ import annotations

import json
import os
import random
import tempfile
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

from benches.proof import counter
from benches.row import Row

LONGEST = "at most 50 ms"
MANY = 10_000
PATIENCE = 600.0
"""The CPU seconds after which an answer is given up."""


def rows() -> Iterator[Row]:
    """Many properties, and a space that is too large for one array."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from smsl_studio.__main__ import load_window

    load_window()
    with tempfile.TemporaryDirectory() as folder:
        os.environ["SMSL_STUDIO_HOME"] = folder
        for words, values in (
            (f"{MANY:,} properties", _many()),
            ("7 coupled SBs of 10 states", _coupled()),
        ):
            file = Path(folder) / "large.json"
            file.write_text(json.dumps(values))
            count, worst = _worst(file, Path(folder))
            work = f"{words}, {count:,} ticks: the longest time between two"
            yield Row(work, worst * 1000, bound=LONGEST)


def _worst(file: Path, folder: Path) -> tuple[int, float]:
    """Return how often the event loop came round, and the longest time between (CPU s)."""
    from PySide6.QtCore import QTimer

    from smsl_studio.studio.base.settings import Settings
    from smsl_studio.studio.shell.application import make_application, make_window
    from smsl_studio.studio.shell.windows import Windows

    application = make_application(["bench"])
    window = make_window(Windows(application, Settings(folder)), str(file))
    window.actions_table["show_inspection"].trigger()
    moments: list[float] = []
    timer = QTimer(window)
    timer.timeout.connect(lambda: moments.append(time.process_time()))

    def until(done: Callable[[], bool]) -> None:
        """Let the window work."""
        end = time.process_time() + PATIENCE
        while not done() and time.process_time() < end:
            application.processEvents()

    until(lambda: window.inspector.proof is not None)
    end = time.process_time() + 0.5
    until(lambda: time.process_time() > end)
    timer.start(0)
    window.inspector.look_again()
    until(lambda: window.inspector.proof is not None)
    timer.stop()
    window.session.history.setClean()
    window.close()
    application.processEvents()
    gaps = [later - one for one, later in pairwise(moments)]
    return len(gaps), max(gaps)


def _many() -> dict[str, Any]:
    properties = [
        {"name": f"p{n}", "way_back": {"from": "A in S1", "to": f"B in S{n % 8}"}}
        for n in range(MANY)
    ]
    return {"_properties": properties, "A": counter(8), "B": counter(8)}


def _coupled() -> dict[str, Any]:
    """SBs whose operations require random states of others: no order of them makes it easy."""
    pick = random.Random(3)
    values: dict[str, Any] = {}
    names = [f"C{k}" for k in range(7)]
    for name in names:
        table = {f"S{m}": {f"o{o}": f"S{pick.randrange(10)}" for o in range(3)} for m in range(10)}
        others = [other for other in names if other != name]
        needs = {
            f"S{m}/o{o}": {"requires": {f"{pick.choice(others)}/0": str(pick.randrange(10))}}
            for m in range(10)
            for o in range(3)
            if pick.random() < 0.5
        }
        values[name] = {"HEADER": {"NUM_FACTS": 1}, "_operations": needs, **table}
    far = " and ".join(f"{name} in S{7 * at % 10}" for at, name in enumerate(names))
    back = {"from": "C0 in S3", "to": "C1 in S4 and C2 in S7"}
    before = ["C4 in S2", "C5 in S3 and C1 in S1"]
    properties = [
        {"name": "far", "never": far},
        {"name": "back", "way_back": back},
        {"name": "before", "before": before},
    ]
    return {"_properties": properties, **values}
