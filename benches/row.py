"""One row of the table, and the functions that measure its figures."""

from __future__ import annotations

import gc
import resource
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """``ours`` in ``unit``; ``others`` are pairs (name, figure in the same unit).

    A figure of an other is a limit (nothing can be quicker) or a peer (another way to do it).
    ``bound`` is what we promise, in words; empty where nothing is promised.
    """

    work: str
    ours: float
    unit: str = "ms"
    others: tuple[tuple[str, float], ...] = ()
    bound: str = ""

    def ratios(self) -> str:
        """Ours as a multiple of every other: below 1 we are quicker."""
        pairs = ((name, self.ours / figure) for name, figure in self.others if figure)
        return ", ".join(f"{ratio:.2g}x {name}" for name, ratio in pairs)


def median_ms(work: Callable[[], object], runs: int = 7, warmup: int = 1) -> float:
    """Return the median of several runs in milliseconds of CPU time. Garbage is collected before
    each."""
    for _ in range(warmup):
        work()
    times = []
    for _ in range(runs):
        gc.collect()
        start = time.process_time()
        work()
        times.append((time.process_time() - start) * 1000)
    return statistics.median(times)


def process_ms(work: Callable[[], object], runs: int = 7, warmup: int = 1) -> float:
    """Return the same for the processes that ``work`` starts and waits for."""
    for _ in range(warmup):
        work()
    times = []
    for _ in range(runs):
        start = _children()
        work()
        times.append((_children() - start) * 1000)
    return statistics.median(times)


def _children() -> float:
    """Return the CPU seconds of all child processes that have ended."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime
