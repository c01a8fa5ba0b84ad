"""Predicates: 5,000 random stories against the plain way, and 1,000 sources at 100 Hz.

A story has a fact of one to four sources with random predicates, and streams of samples with gaps,
jitter, disorder and faults (``tests/monitor/predicate_stories.py``).
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator

from benches.row import Row
from smsl_studio.blueprint.predicates import sense_of
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.bus import FactBus
from smsl_studio.monitor.facts import FactMonitor
from smsl_studio.monitor.sample import Sample
from tests.monitor.predicate_stories import Source, told_apart

STORIES = 5_000
SOURCES, RATE, SECONDS = 1_000, 100, 10
ENTRY = {
    "sources": {"force": "N"},
    "range": {"force": [-5, 50]},
    "predicate": {"0": "force < 1 N", "1": "force > 2 N for 0.05 s"},
}


def rows() -> Iterator[Row]:
    """The stories that were decided in another way, and the load of many sources."""
    apart = 0
    for number in range(STORIES):
        words = told_apart(number)
        apart += bool(words)
        if words:
            print(words, file=sys.stderr, flush=True)
    yield Row(f"{STORIES:,} random predicates and streams decided in another way", apart, "",
              bound="0")  # fmt: skip
    spent = _load()
    yield Row(
        f"{SOURCES:,} sources at {RATE} Hz, a fact and two predicates each: share of one core",
        100 * spent / SECONDS,
        "%",
        bound="below 100 %",
    )


def _load() -> float:
    """The CPU time (s) for some seconds of samples, over the bus into facts."""
    sense = sense_of(ENTRY)
    rules = {("SB", at): FactRule(sense=sense) for at in range(SOURCES)}
    monitor = FactMonitor([Source("force", 0.3, digit=at) for at in range(SOURCES)], rules)
    bus = FactBus()
    inbox = bus.subscribe()
    began = time.process_time()
    for look in range(1, RATE * SECONDS + 1):
        now = look / RATE
        bus.publish(
            Sample("SB", at, "force", repr((look * 37 + at * 11) % 300 / 100), now, look)
            for at in range(SOURCES)
        )
        monitor.accept(inbox.take(), now)
        monitor.scene(now)
    return time.process_time() - began
