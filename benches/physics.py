"""The hanoi world: how much physics costs, and how reliably the arm does what the file says."""

from __future__ import annotations

import time
from collections.abc import Iterator

import smsl_studio as smsl
from benches.row import Row, median_ms
from smsl_studio.library.loading import discover
from smsl_studio.runlog.events import SweepFinished
from smsl_studio.world.bullet import BulletWorld

CORRECTED, PRINTED = "samples/hanoi-corrected.json", "samples/hanoi.json"
SEEDS = range(10)


def rows() -> Iterator[Row]:
    """Sweeps and solves in CPU seconds, then the single doings of a world in milliseconds."""
    yield _sweep(CORRECTED, "at most 120 s and 78 of 78")
    yield _sweep(PRINTED, "76 of 78: the two misprints fail")
    yield from _solves()
    yield from _doings()


def _sweep(file: str, bound: str) -> Row:
    start = time.process_time()
    *_, last = smsl.sweep(smsl.read(file), "hanoi")
    spent = time.process_time() - start
    assert isinstance(last, SweepFinished)
    return Row(f"sweep {file}: {last.passed} of {last.edges}", spent, "CPU s", bound=bound)


def _solves() -> Iterator[Row]:
    """Three disks from a to c, one solve a seed."""
    blueprint = smsl.read(CORRECTED)
    reached, simulated, start = 0, 0.0, time.process_time()
    for seed in SEEDS:
        done = smsl.run(blueprint, "hanoi", seed=seed)
        reached += done.reason == "goal_reached"
        simulated += done.events[-1].t
    spent = time.process_time() - start
    yield Row(
        f"seven moves, sensed at 50 Hz: {reached} of {len(SEEDS)} seeds",
        spent / len(SEEDS),
        "CPU s",
        (("simulated time", simulated / len(SEEDS)),),
        "all seeds reach",
    )


def _doings() -> Iterator[Row]:
    _, entry = discover().world("hanoi")
    blueprint = smsl.read(CORRECTED)

    def built() -> BulletWorld:
        world = BulletWorld("hanoi")
        entry.build(world, blueprint, 0)
        return world

    world = built()
    snapshot = world.snapshot()
    step = _each(world.step, 500)
    yield Row("one tick, rings asleep, arm held", step, others=(("real time", 1000 / 240),))
    yield Row("poses of everything drawn", _each(world.poses, 500), others=(("one tick", step),))
    yield Row("take a snapshot", _each(world.snapshot, 500), others=(("one tick", step),))
    yield Row("come back to it bit-equally", median_ms(lambda: world.apply(snapshot)))
    yield Row("fork", median_ms(lambda: world.fork().close()))
    yield Row("build the table", median_ms(lambda: built().close()))


def _each(work: object, times: int) -> float:
    """Milliseconds of CPU time of one call, of many in a row."""
    assert callable(work)
    return median_ms(lambda: [work() for _ in range(times)], runs=3) / times
