"""Random cases in shares of several processes: their findings, and the CPU time that they took."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

PROCESSES = 2


def judged(
    share: Callable[[int], tuple[list[str], float]], count: int, size: int
) -> tuple[int, float]:
    """Judge ``count`` cases in shares of ``size``. Return the number of findings and the CPU time
    (s). Findings are printed, and after each tenth how many cases are judged.

    ``share`` gets the number of its first case. It runs in another process without a display.
    """
    found, spent = 0, 0.0
    with ProcessPoolExecutor(PROCESSES, get_context("spawn"), _begin) as pool:
        firsts = range(0, count, size)
        for first, (findings, seconds) in zip(firsts, pool.map(share, firsts), strict=True):
            found, spent = found + len(findings), spent + seconds
            print(*findings, sep="\n", end="\n" * bool(findings), file=sys.stderr, flush=True)
            done = first + size
            if done * 10 // count > first * 10 // count:
                print(f"{done:,} of {count:,} judged", file=sys.stderr, flush=True)
    return found, spent


def _begin() -> None:
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
