"""One process under limits: its CPU time, its address space, and its end."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryFile

SECONDS = 15
SPACE = 1_500_000_000
"""The limits of every command with any file: CPU seconds, and bytes of address space."""
KILLED_AFTER = 2 * SECONDS


@dataclass(frozen=True)
class Measured:
    """What one process took: CPU seconds with its children, and bytes of address space.

    ``begun`` are those that it took before it looked at its file. ``wrong`` says how it ended in
    another way than it may; empty where it did not.
    """

    seconds: float
    space: int
    begun: tuple[float, int] = (0.0, 0)
    wrong: str = ""


def measured(arguments: Sequence[str], folder: Path, more: Mapping[str, str]) -> Measured:
    """Run a module of the benches in a process of its own, to its end.

    The module's last line of errors is ``TOOK kB SECONDS kB``: the peak of its address space, and
    the seconds and the peak before it looked at its file.
    """
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", **more}
    with TemporaryFile() as errors:
        command = [sys.executable, "-m", *arguments]
        process = subprocess.Popen(
            command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=errors
        )
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = code = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        said = errors.read().decode("utf-8", "replace")
    head, _, tail = said.rpartition("TOOK ")
    peak, *begun = tail.split() or [""]
    seconds = used.ru_utime + used.ru_stime
    if code not in (0, 1, 2) or len(begun) != 2 or "Traceback" in head:
        return Measured(seconds, 0, wrong=f"ends with {code}: {said.strip()[-160:]!r}")
    return Measured(seconds, int(peak) * 1024, (float(begun[0]), int(begun[1]) * 1024))
