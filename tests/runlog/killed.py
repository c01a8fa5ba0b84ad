"""Kills a child that writes a log (kill -9) at random moments: every acknowledged event must be
there."""

from __future__ import annotations

import io
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from random import Random

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.grammar.log_reader import LoggedRun, read_log

WRITER = """
import os, sys
from pathlib import Path
from smsl_studio.runlog.events import FactChanged
from smsl_studio.runlog.log import RunLog

log = RunLog(Path(sys.argv[1]), {"seed": 0})
for number in range(10**9):
    log.write([FactChanged(t=float(number), branch="SB" * 50, digit=number, value="1")])
    os.write(1, b"%d\\n" % number)
"""


@dataclass(frozen=True)
class Killed:
    """How many events were acknowledged before the child died, and what its log has."""

    acknowledged: int
    run: LoggedRun

    @property
    def lost(self) -> int:
        """Acknowledged events that the log has not."""
        numbers = [getattr(event, "digit", None) for event in self.run.events]
        assert numbers == list(range(len(numbers)))
        return max(0, self.acknowledged - len(numbers))


def kill_a_writer(path: Path, random: Random) -> Killed:
    """Let a child write, kill it after some acknowledgements, and read all that it had sent."""
    heard = random.randrange(1, 400)
    with subprocess.Popen([sys.executable, "-c", WRITER, str(path)], stdout=subprocess.PIPE) as one:
        assert isinstance(one.stdout, io.BufferedReader)
        for _ in range(heard):
            one.stdout.readline()
        one.send_signal(signal.SIGKILL)
        rest = one.stdout.read()
    return Killed(heard + rest.count(b"\n"), read_log(path, COMMANDS))
