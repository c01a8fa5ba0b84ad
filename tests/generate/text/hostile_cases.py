"""Hostile answers over a server on this machine, to a chain in a process that is watched.

Each case has a seed. Its stage is drawn; the stages before get good answers, and from there on
every answer wishes ill: by its text, or by how the server sends it.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http.server import BaseHTTPRequestHandler
from pathlib import Path

from tests.generate.text.answering import (
    CARRIERS,
    SLOW,
    STAGES,
    completion,
    good_answers,
    hostile_text,
    sent,
    server,
)

ROOT = Path(__file__).parents[3]
CHILD = "tests.generate.text.watched_chain"
WHOLE = 200
"""So many hostile answers are promised. The bench ``hostile`` gives all of them."""
BY_CARRIER = 0.3
"""This share of the cases has a server that answers ill, whatever the text."""


@dataclass(frozen=True)
class HostileCase:
    """What a chain did with the answers of one case."""

    seed: int
    stage: int
    kind: str
    sentence: str
    """What was told. Empty if the chain came to its end."""
    files: tuple[str, ...]
    """What was reached, and kept."""
    events: tuple[str, ...]
    """What the process asked of the system, but for the connection to its server."""
    seconds: float


def hostile_cases(seeds: range, bait: Path) -> list[HostileCase]:
    """Give each case to a chain in one watched process. Return what it did."""
    good = good_answers()
    plans = {seed: _Plan(seed, good, str(bait)) for seed in seeds}
    with _serving(plans) as url:
        told = [(seed, one.stage if one.kind in SLOW else None) for seed, one in plans.items()]
        words = [sys.executable, "-m", CHILD, url, json.dumps(told)]
        done = subprocess.run(words, cwd=ROOT, capture_output=True, timeout=600, check=False)
    if done.returncode:
        raise AssertionError(done.stderr.decode())
    found = []
    for line in done.stdout.decode().splitlines():
        did = json.loads(line)
        plan = plans[did["seed"]]
        found.append(
            HostileCase(
                did["seed"], plan.stage, plan.kind, did["sentence"], tuple(did["files"]),
                tuple(did["events"]), did["seconds"],
            )
        )  # fmt: skip
    return found


class _Plan:
    """The answers of one case, in the order in which they are asked for."""

    def __init__(self, seed: int, good: list[str], bait: str) -> None:
        self._rng = random.Random(seed)
        self._good, self._bait = good, bait
        self.stage = self._rng.randrange(STAGES)
        carried = self._rng.random() < BY_CARRIER
        self.kind = self._rng.choice(sorted(CARRIERS)) if carried else "text"
        self._asked = 0

    def reply(self, handler: BaseHTTPRequestHandler, gone: threading.Event) -> None:
        self._asked += 1
        if self._asked <= self.stage:
            sent(handler, completion(self._good[self._asked - 1]))
        elif self.kind in CARRIERS:
            CARRIERS[self.kind](handler, gone)
        else:
            text = hostile_text(self._rng, self._bait, self._good[self.stage])
            sent(handler, completion(text))


@contextmanager
def _serving(plans: dict[int, _Plan]) -> Iterator[str]:
    gone = threading.Event()

    def reply(handler: BaseHTTPRequestHandler, _: str) -> None:
        _, seed, kind, *_rest = handler.path.split("/")
        if kind == "warm":
            sent(handler, completion("no"))
        else:
            plans[int(seed)].reply(handler, gone)

    with server(reply) as (url, _prompts):
        try:
            yield url.removesuffix("/v1")
        finally:
            gone.set()
