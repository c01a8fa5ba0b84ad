"""The time until a stop has an effect: the program is stopped at random moments of every phase.

The command line is forked at the beginning of a phase and goes on. It gets SIGINT or SIGTERM at a
random moment of the phase, and the time until its process and all children have ended is measured.
The exit status, ``run_finished`` and the head of the log are checked; a run that did not end in
order is reported as an error. In the window a run is stopped by F8, or by closing. Times are wall
time: measure on a quiet machine.

``--phases=planning;building`` chooses phases, ``--moments=60`` the number of moments in each.
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
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    if ended.returncode:
        raise SystemExit(f"{phase}: its program ended with {ended.returncode}: {ended.stderr}")
    yield from map(json.loads, ended.stdout.splitlines())


def _option(name: str, otherwise: str) -> str:
    given = [one.partition("=")[2] for one in sys.argv if one.startswith(f"--{name}=")]
    return given[-1] if given else otherwise
