"""The real command line, forked at the beginning of a phase and stopped at random moments.

``python -m benches.stops.program PHASE MOMENTS FOLDER`` prints one JSON object for each moment.
Forking avoids reading 30 MB again for each moment of the phases after it; the fork goes on as the
program would.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path
from random import Random
from typing import Any, NoReturn

from benches.stops.hooks import call_before
from benches.stops.scenes import SCENES, Scene
from smsl_studio.cli import program
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.runlog.grammar.log_reader import verify

LIMIT = 20.0
"""Wall seconds after which a program that was to stop is killed."""
SOON = 100.0
"""Milliseconds in which a run may end by itself although it was to stop: it was over by then."""
TRIES = 20
"""How many copies are made at most for each moment: in some the phase is over before it."""
PLACE = Path("reached")
"""Appears in the folder of a moment when its phase has been reached; holds numbers of children."""


def main(phase: str, moments: int, folder: Path) -> NoReturn:
    scene = SCENES[phase]
    os.environ["STALL"] = scene.stall
    os.environ["SMSL_PLUGIN_PATH"] = str(folder / "plugins")
    results = os.fdopen(os.dup(1), "w")
    said = os.open(folder / "said", os.O_RDWR | os.O_CREAT | os.O_APPEND)
    for number in (1, 2):
        os.dup2(said, number)
    reached = Moments(phase, scene, moments, results, said)
    if scene.reached:
        call_before(scene.reached, lambda: PLACE.touch(), scene.fits)
    call_before(scene.forks, reached.fork, scene.fits)  # the copies are made before anything else
    status = program([word.format(folder) for word in scene.command])
    if reached.forked:
        raise SystemExit(status)
    raise SystemExit("the phase was never reached")


class Moments:
    """Copies of this process, each stopped at a random moment."""

    def __init__(self, phase: str, scene: Scene, count: int, results: Any, said: int) -> None:
        self._phase, self._scene, self._count = phase, scene, count
        self._results, self._said = results, said
        self._random = Random(phase)
        self.forked = False

    def fork(self) -> None:
        """Make and stop one copy after the other; in each copy this returns."""
        if self.forked:
            return
        self.forked = True
        number = 0
        for _ in range(TRIES * self._count):
            folder = tempfile.mkdtemp()  # no context manager: the copy would leave it, too
            os.chdir(folder)
            os.ftruncate(self._said, 0)
            pid = os.fork()
            if pid == 0:
                return
            signalled = (signal.SIGINT, signal.SIGTERM)[number % 2]
            told = {"phase": self._phase, **self._stopped(pid, signalled)}
            self._results.write(json.dumps(told) + "\n")
            self._results.flush()
            shutil.rmtree(folder)
            number += "over" not in told
            if number == self._count:
                break
        os._exit(0)

    def _stopped(self, pid: int, signalled: int) -> dict[str, Any]:
        began = time.monotonic()
        while not PLACE.exists():
            if os.waitpid(pid, os.WNOHANG)[0] or time.monotonic() > began + 60:
                return {"wrong": f"the phase was not reached: {self._text()[-300:]}"}
            time.sleep(0.001)
        after = self._random.uniform(0.0, self._scene.span)
        time.sleep(after)
        if os.waitpid(pid, os.WNOHANG)[0]:
            return {"over": after}
        asked = time.monotonic()
        os.kill(pid, signalled)
        status = self._ended(pid, asked)
        ms = (time.monotonic() - asked) * 1000
        if ms < SOON and self._ended_by_itself(status, signalled):
            return {"over": after}
        children = [int(one) for one in PLACE.read_text().split()]
        return {"after": after, "ms": ms, "wrong": self._wrong(status, signalled, children)}

    def _ended(self, pid: int, asked: float) -> int:
        while time.monotonic() < asked + LIMIT:
            ended, status = os.waitpid(pid, os.WNOHANG)
            if ended:
                return os.waitstatus_to_exitcode(status)
            time.sleep(0.0005)
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        return -9

    def _wrong(self, status: int, signalled: int, children: list[int]) -> str:
        """Say what is wrong with its end. The text is empty if it ended in order."""
        text = self._text()
        if "Traceback" in text:
            return text[-500:]
        if self._scene.command[0] == "run":
            if status != 1 or self._reason() != "stopped":
                return f"status {status}: {text[-300:]}"
            log = Path("run.jsonl")
            if log.exists():
                with log.open("rb") as stream:
                    verdict = verify(stream, "run.jsonl", COMMANDS)
                if verdict.doubt is not None:
                    return str(verdict.doubt)
        elif status != 128 + signalled:
            return f"status {status}"
        until = time.monotonic() + 2
        while any(Path(f"/proc/{one}").exists() for one in children if one != os.getpid()):
            if time.monotonic() > until:
                return "a child is left"
            time.sleep(0.01)
        return ""

    def _ended_by_itself(self, status: int, signalled: int) -> bool:
        """Whether the command had finished its work when the signal came."""
        if self._scene.command[0] == "run":
            return self._reason() not in ("stopped", "")
        return status in (0, -signalled)

    def _reason(self) -> str:
        """Return the reason in the run's last event. The text is empty if there is none."""
        last = [line for line in self._text().splitlines() if line.startswith("{")][-1:]
        return str(json.loads(last[0]).get("reason", "")) if last else ""

    def _text(self) -> str:
        size = os.fstat(self._said).st_size
        return os.pread(self._said, size, 0).decode("utf-8", "replace")


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        main(sys.argv[1], int(sys.argv[2]), Path(sys.argv[3]))
