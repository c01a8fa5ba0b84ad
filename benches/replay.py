"""Replay: a log of 100,000 events, opened and jumped about in."""

from __future__ import annotations

import time
from collections.abc import Iterator
from random import Random

from benches.row import Row, median_ms
from smsl_studio.runlog.events import Committed, Event, FactChanged, OperationStarted, RunStarted
from smsl_studio.runlog.retelling import Retelling

EVENTS = 100_000
JUMPS = 300


def long_run(count: int = EVENTS) -> tuple[Event, ...]:
    """A run that goes round for ever: three events an operation."""
    told: list[Event] = [
        RunStarted(t=0.0, world="table", seed=0, start={"SB1": "State_0"}, goals=("SB1/State_9",))
    ]
    while len(told) < count:
        number = len(told) // 3
        here, there = f"State_{number % 10}", f"State_{(number + 1) % 10}"
        edge, t = f"SB1/{here}/Op", number * 0.5
        told += [
            OperationStarted(t=t, address=edge, target=there, function="table.set_facts"),
            FactChanged(t=t + 0.4, branch="SB1", digit=0, value=there[-1]),
            Committed(t=t + 0.5, operations=(edge,), configuration={"SB1": there}),
        ]
    return tuple(told[:count])


def rows() -> Iterator[Row]:
    events = long_run()
    retelling = Retelling(events)
    yield Row(f"fold {EVENTS:,} events, with snapshots", median_ms(lambda: Retelling(events), 3))
    chance, slowest = Random(1), 0.0
    for _ in range(JUMPS):
        at = chance.randrange(EVENTS)
        began = time.perf_counter()
        retelling.at(at)
        slowest = max(slowest, time.perf_counter() - began)
    yield Row(f"the slowest of {JUMPS} jumps in them", slowest * 1e3, bound="50 ms")
