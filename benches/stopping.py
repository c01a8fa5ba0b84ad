"""The time until a stop has an effect: the real program is stopped at random moments of every
phase.

The command line is copied (fork) at the beginning of a phase, goes on, and gets SIGINT or SIGTERM
at a moment drawn from the phase; the time until its process has ended is taken, with all its
children. The status, ``run_finished`` and the head of the log are checked: what did not end in
order is told as an error. In the window a run is stopped by F8, or closed. Times are wall time:
measure on a quiet machine.

``--phases=planning;building`` chooses phases, ``--moments=60`` how many of each.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benches.row import Row
from benches.stops import window
from benches.stops.inputs import make
from benches.stops.scenes import SCENES

MOMENTS = 60
PROMISE = "at most 200 ms (wall time)"


def rows() -> Iterator[Row]:
    """One row a phase: the worst of its moments, and their median beside it."""
    phases = [one for one in _option("phases", "").split(";") if one]
    moments = int(_option("moments", str(MOMENTS)))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        make(folder)
        for phase in phases or (*SCENES, *window.SCENES):
            found = list(_moments(phase, moments, folder))
            wrong = [one["wrong"] for one in found if one.get("wrong")]
            if wrong:
                raise SystemExit(f"{phase}: {len(wrong)} of {len(found)}: {wrong[0]}")
            if not any("ms" in one for one in found):
                raise SystemExit(f"{phase}: it was over before each of its moments")
            times = sorted(one["ms"] for one in found if "ms" in one)
            late = sum(ms > 200 for ms in times)
            work = f"{phase}, {len(times)} moments, {late} over 200 ms: the worst"
            yield Row(work, times[-1], "ms", (("median", statistics.median(times)),), PROMISE)


def _moments(phase: str, count: int, folder: Path) -> Iterator[dict[str, Any]]:
    module = "benches.stops.window" if phase in window.SCENES else "benches.stops.program"
    command = [sys.executable, "-m", module, phase, str(count), str(folder)]
    told = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout
    yield from map(json.loads, told.splitlines())


def _option(name: str, otherwise: str) -> str:
    given = [one.partition("=")[2] for one in sys.argv if one.startswith(f"--{name}=")]
    return given[-1] if given else otherwise
