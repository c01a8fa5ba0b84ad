"""The workers of a campaign: processes that carry out runs, one at a time each.

A worker runs the code of plugins, so what it says is not believed: an answer is a line of JSON that
is checked. A worker that dies ends the campaign with a sentence.
"""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from smsl_studio.errors import WorldError
from smsl_studio.front.campaign_runs import (
    CampaignRun,
    RunVerdict,
    judged,
    run_as_json,
    run_of_json,
    verdict_as_json,
    verdict_of_json,
)
from smsl_studio.front.inputs import read
from smsl_studio.host.started_child import environment_of_child
from smsl_studio.stop import heed

WAIT = 0.05
"""How long a wait for the workers lasts before a stop is looked for (s)."""
LONGEST = 10_000
"""The largest length of an answer (bytes)."""


class CampaignWorkers:
    """Some workers on one file. They end with the campaign: what they still do then is of no
    use."""

    def __init__(self, file: str, count: int) -> None:
        self._workers: list[subprocess.Popen[bytes]] = []
        self._heard: dict[int, bytes] = {}
        code = f"import sys; sys.path[:] = {sys.path!r}; "
        code += "from smsl_studio.front.campaign_workers import serve; serve(sys.argv[1])"
        for _ in range(count):
            worker = subprocess.Popen(
                [sys.executable, "-P", "-c", code, file],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=environment_of_child(),
                # Ctrl-C is for the campaign, which ends its workers.
                process_group=0,
            )
            self._workers.append(worker)

    def close(self) -> None:
        """End all workers."""
        for worker in self._workers:
            worker.kill()
        for worker in self._workers:
            worker.wait()
            for pipe in (worker.stdin, worker.stdout):
                if pipe is not None:
                    pipe.close()

    def verdicts(self, asked: Sequence[CampaignRun]) -> Iterator[RunVerdict]:
        """Yield the verdicts of some runs, in their order. WorldError if a worker dies or says
        nonsense."""
        found: dict[int, RunVerdict] = {}
        at_work: dict[int, tuple[int, subprocess.Popen[bytes]]] = {}
        waiting = iter(enumerate(asked))
        idle = list(self._workers)
        told = 0
        while told < len(asked):
            heed()
            while idle and (following := next(waiting, None)) is not None:
                number, run = following
                worker = idle.pop()
                self._ask(worker, run)
                assert worker.stdout is not None
                at_work[worker.stdout.fileno()] = number, worker
            ready, _, _ = select.select(list(at_work), [], [], WAIT)
            for pipe in ready:
                verdict = self._hear(pipe)
                if verdict is not None:
                    number, worker = at_work.pop(pipe)
                    found[number] = verdict
                    idle.append(worker)
            while told in found:
                yield found.pop(told)
                told += 1

    @staticmethod
    def _ask(worker: subprocess.Popen[bytes], run: CampaignRun) -> None:
        assert worker.stdin is not None
        try:
            worker.stdin.write(f"{json.dumps(run_as_json(run))}\n".encode("ascii"))
            worker.stdin.flush()
        except OSError:
            raise _dead() from None

    def _hear(self, pipe: int) -> RunVerdict | None:
        """Read what a worker says. None while its line is not whole."""
        part = os.read(pipe, LONGEST)
        line = self._heard.pop(pipe, b"") + part
        if not part or len(line) > LONGEST:
            raise _dead()
        if not line.endswith(b"\n"):
            self._heard[pipe] = line
            return None
        try:
            verdict = verdict_of_json(json.loads(line))
        except (ValueError, RecursionError):
            verdict = None
        if verdict is None:
            raise _dead()
        return verdict


def _dead() -> WorldError:
    return WorldError(
        "a worker of the campaign died, or said what is no verdict",
        advice="What is done is kept; --resume goes on. A plugin may have crashed.",
    )


def serve(file: str) -> None:
    """Carry out the runs that stand on the standard input, one a line, and answer each."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # What a plugin prints must not stand between the answers.
    answers = os.fdopen(os.dup(1), "w", encoding="ascii")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    blueprint = read(Path(file))
    for line in sys.stdin.buffer:
        verdict = judged(blueprint, run_of_json(json.loads(line)))
        answers.write(f"{json.dumps(verdict_as_json(verdict))}\n")
        answers.flush()
