"""The hanoi world: the cost of physics, and the reliability of the arm, in both engines."""

from __future__ import annotations

import statistics
import time
from collections.abc import Iterator

import smsl_studio as smsl
from benches.row import Row, median_ms
from smsl_studio.host.process import ProcessHost
from smsl_studio.host.spare import Spare
from smsl_studio.library.loading import discover
from smsl_studio.runlog.events import SweepFinished
from smsl_studio.world.bullet import BulletWorld

CORRECTED, PRINTED = "samples/hanoi-corrected.json", "samples/hanoi.json"
FOUR = "samples/hanoi-4.json"


OTHER = "hanoi-mujoco"


def rows() -> Iterator[Row]:
    """Measure sweeps and solves in CPU seconds, then single calls of a world in milliseconds."""
    yield _sweep(CORRECTED, "at most 120 s and 78 of 78")
    yield _sweep(PRINTED, "76 of 78: the two misprints fail")
    yield from _solves(CORRECTED, 20)
    yield from _solves(FOUR, 2)
    yield _sweep(CORRECTED, "78 of 78", OTHER)
    yield from _solves(CORRECTED, 5, OTHER)
    yield from _doings()
    yield from _starts()


def all_rows() -> Iterator[Row]:
    """Measure the same with five times as many solves."""
    yield _sweep(CORRECTED, "at most 120 s and 78 of 78")
    yield _sweep(PRINTED, "76 of 78: the two misprints fail")
    yield from _solves(CORRECTED, 100)
    yield from _solves(FOUR, 10)
    yield _sweep(CORRECTED, "78 of 78", OTHER)
    yield from _solves(CORRECTED, 30, OTHER)
    yield from _doings()
    yield from _starts()


def _sweep(file: str, bound: str, world: str = "hanoi") -> Row:
    start = time.process_time()
    *_, last = smsl.sweep(smsl.read(file), world)
    spent = time.process_time() - start
    assert isinstance(last, SweepFinished)
    name = "" if world == "hanoi" else f"{world}: "
    words = f"{name}sweep {file}: {last.passed} of {last.edges}"
    return Row(words, spent, "CPU s", bound=bound)


def _solves(file: str, seeds: int, world: str = "hanoi") -> Iterator[Row]:
    """All disks from a to c by the cheapest way, one solve a seed; each starts 3 mm off at most."""
    blueprint = smsl.read(file)
    disks = blueprint["SB1"].num_facts
    reached, simulated, start = 0, 0.0, time.process_time()
    for seed in range(seeds):
        done = smsl.run(blueprint, world, seed=seed)
        reached += done.reason == "goal_reached"
        simulated += done.events[-1].t
    spent = time.process_time() - start
    name = "" if world == "hanoi" else f"{world}: "
    words = (
        f"{name}{disks} disks, {2**disks - 1} moves, sensed at 50 Hz: {reached} of {seeds} seeds"
    )
    simulated_each = (("simulated time", simulated / seeds),)
    yield Row(words, spent / seeds, "CPU s", simulated_each, "all seeds reach")
    rate = f"{name}{disks} disks: simulated seconds a CPU second"
    yield Row(rate, simulated / spent, "s", bound="at least 5")


def _starts() -> Iterator[Row]:
    """Measure the wall time from the request of a run in a child to an open world."""
    blueprint = smsl.read(CORRECTED)
    spare = Spare()
    cold = [_started(ProcessHost(blueprint, "hanoi")) for _ in range(5)]
    imported: list[float] = []
    prepared: list[float] = []
    for recipe, times in ((None, imported), (ProcessHost(blueprint, "hanoi").recipe, prepared)):
        for _ in range(5):
            spare.warm(recipe)
            time.sleep(4.0)  # as long as a person thinks between two runs
            times.append(_started(ProcessHost(blueprint, "hanoi", spare=spare)))
    spare.close()
    cold_ms = statistics.median(cold)
    beside = (("without a spare", cold_ms),)
    yield Row("a run's world stands, no spare child (wall)", cold_ms)
    yield Row(
        "with a spare that has its imports done (wall)", statistics.median(imported), "ms", beside
    )
    yield Row("with a spare prepared for it (wall)", statistics.median(prepared), "ms", beside)


def _started(host: ProcessHost) -> float:
    start = time.perf_counter()
    host.open({"SB1": "State_aaa"})
    spent = time.perf_counter() - start
    host.close()
    return spent * 1000


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
