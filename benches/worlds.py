"""Worlds in physics, with each of their robots: every edge alone, and the goal over many seeds.

A run counts as true if its end is true by a judge that uses only what is drawn and told
(``tests/plugins``). Simulated seconds a CPU second tell how quick a world is. A busy machine makes
CPU seconds longer, so the other robots stand beside the Panda in the same run. Without ``--all``
few seeds are run. The bench ``faults`` has the runs with faults.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from benches.row import Row
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import run
from smsl_studio.front.sweeps import sweep
from smsl_studio.runlog.events import Committed, SweepFinished
from smsl_studio.shipped import samples_dir
from tests.plugins.piece_games import GOALS, file_of, run_game
from tests.plugins.site_runs import FLAT, SUBBED, run_site

ROBOTS = ("panda", "iiwa", "dvrk")
QUICK = "at least 5"
"""What is promised of simulated seconds a CPU second."""

HANOI = samples_dir() / "hanoi-corrected.json"


def rows() -> Iterator[Row]:
    """Run three seeds."""
    return _rows(3)


def all_rows() -> Iterator[Row]:
    """Run 30 seeds of each file."""
    return _rows(30)


def _rows(seeds: int) -> Iterator[Row]:
    for file in (FLAT, SUBBED):
        yield _swept(samples_dir() / file, "registration")
        yield from _goals(file, seeds)
    for game in GOALS:
        yield from _game(game, seeds)
    ways: set[tuple[str, ...]] = set()
    usual: tuple[tuple[str, float], ...] = ()
    for robot in ROBOTS:
        for row in _hanoi(robot, seeds, ways):
            if row.bound != QUICK:
                yield row
                continue
            yield replace(row, others=usual)
            usual = usual or ((robot, row.ours),)
    yield Row("hanoi, all robots: different sequences of states", len(ways), "", bound="1")


def _hanoi(robot: str, seeds: int, ways: set[tuple[str, ...]]) -> Iterator[Row]:
    """Sweep Hanoi with one robot, then solve it from each seed. ``ways`` gets the states."""
    begun = time.process_time()
    yield _swept(HANOI, "hanoi", robot)
    name = f"hanoi with {robot}"
    yield Row(f"{name}, sweep: all", time.process_time() - begun, "CPU s")
    start, simulated, missed = time.process_time(), 0.0, 0
    for seed in range(seeds):
        done = run(read(HANOI), "hanoi", "State_ccc", seed=seed, robot=robot)
        missed += done.reason != "goal_reached"
        simulated += done.events[-1].t
        told = (event for event in done.events if isinstance(event, Committed))
        ways.add(tuple(state for event in told for state in event.configuration.values()))
    spent = time.process_time() - start
    name = f"{name}, {seeds} seeds"
    yield Row(f"{name}: runs that miss the goal", missed, "runs", bound="0")
    yield Row(f"{name}: simulated seconds a CPU second", simulated / spent, "s", bound=QUICK)
    yield Row(f"{name}: all", spent, "CPU s")


def _swept(file: Path, world: str, robot: str = "") -> Row:
    *_, last = sweep(read(file), world, robot=robot)
    assert isinstance(last, SweepFinished)
    where = f"{world} with {robot}" if robot else world
    work = f"{where}, {file.name}: edges alone that fail, of {last.edges}"
    return Row(work, last.edges - last.passed, "edges", bound="0")


def _game(game: str, seeds: int) -> Iterator[Row]:
    yield _swept(file_of(game), game)
    start, simulated, missed = time.process_time(), 0.0, 0
    ways = set()
    for seed in range(seeds):
        story = run_game(game, seed=seed)
        missed += not story.reached or story.end.reason != "goal_reached"
        simulated += story.end.t
        ways.add(tuple(story.committed))
    spent = time.process_time() - start
    name = f"{game}, {seeds} seeds"
    yield Row(f"{name}: runs that miss the goal", missed, "runs", bound="0")
    yield Row(f"{name}: different sequences of states", len(ways), "", bound="1")
    yield Row(f"{name}: simulated seconds a CPU second", simulated / spent, "s", bound=QUICK)
    yield Row(f"{name}: all", spent, "CPU s")


def _goals(file: str, seeds: int) -> Iterator[Row]:
    start, simulated, missed, worst = time.process_time(), 0.0, 0, 0.0
    for seed in range(seeds):
        story = run_site(file, seed=seed)
        used = any("UsePrev" in name for name in story.started)
        missed += story.end.reason != "goal_reached" or story.false_goal or used
        worst, simulated = max(worst, story.error), simulated + story.end.t
    spent = time.process_time() - start
    name = f"registration, {file}, {seeds} seeds"
    yield Row(f"{name}: runs that do not really register", missed, "runs", bound="0")
    yield Row(f"{name}: largest error at a target", worst, "mm", bound="below 0.5 mm")
    yield Row(f"{name}: simulated seconds a CPU second", simulated / spent, "s", bound=QUICK)
    yield Row(f"{name}: all", spent, "CPU s")
