"""Runs of the four physical worlds with a fault each, judged by what is drawn.

The judges use neither the sensors of the plugins nor their figures. They look at the shapes and
poses, which are for people, and say which facts hold. In the world ``registration`` a result that
counts must have been touched: the tip of the drawn pointer was on the drawn phantom at five places
while phantom and reference stood to each other as they do now. How good a fit is cannot be seen
from outside; for that the error counts that the world tells at the fit.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from random import Random
from typing import Protocol, TypeGuard

import numpy as np
from numpy.typing import NDArray

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import Committed, Event, OperationEnded, RunFinished
from smsl_studio.world.kinematics import rotation_of
from tests.plugins.faulted import standing
from tests.plugins.piece_games import CHESS, RIVER
from tests.plugins.site_runs import LIMIT
from tests.plugins.world_runs import HANOI, REGISTRATION, blueprint_file, faults_of

STEPS = 3
"""The number of random steps from the start of a game to its goal."""

LONGEST, WHOLE = 2.4, 45.0
"""The time (s) until which faults are injected: during the first operation of a game, and about as
long as a whole registration takes."""

MOST = 60.0
"""The simulated seconds after which a run is stopped."""

UPRIGHT, HIGH, EDGE = 0.97, 0.006, 0.001
"""The least vertical part of the axis of a piece that stands; how far (m) its foot may be above or
below the ground under it, and its middle outside of the ground's edge."""

NOWHERE = "x"

TOUCHES, ASIDE, TIP, NEAR = 5, 0.01, 0.15, 0.0005
"""So many places (m apart at least) must be touched by the tip (m from the flange), to within a
distance (m). Phantom and reference may not move by more than it."""

Array = NDArray[np.float64]


class Judge(Protocol):
    """Says what is not so. ``see`` is called after each tick."""

    def see(self, new: Sequence[Event]) -> None:
        """Hear what was told in this tick, and look."""
        ...

    def doubts(self, values: Sequence[str]) -> list[str]:
        """Return for each fact that has not this value what is seen instead."""
        ...


class Drawing:
    """What is drawn, by name."""

    def __init__(self, dispatcher: Dispatcher) -> None:
        assert dispatcher.opened is not None
        shapes = dispatcher.opened.shapes
        self._host = dispatcher.host
        self._at = {shape.name: 7 * number for number, shape in enumerate(shapes)}
        self._meshes = {shape.name: shape.mesh for shape in shapes}
        self._half: dict[str, Array] = {}

    @property
    def names(self) -> list[str]:
        return list(self._at)

    def pose(self, name: str) -> tuple[Array, Array]:
        """Position (m) and rotation (3, 3) of a shape."""
        at = self._at[name]
        x, y, z, qx, qy, qz, qw = self._host.poses()[at : at + 7]
        return np.array([x, y, z]), rotation_of((qx, qy, qz, qw))

    def half(self, name: str) -> Array:
        """Half of the size of a shape (m) along its axes."""
        if name not in self._half:
            corners = np.array(self._meshes[name]).reshape(-1, 3)
            self._half[name] = (corners.max(axis=0) - corners.min(axis=0)) / 2
        return self._half[name]

    def stands_on(self, piece: str, ground: str) -> bool:
        """Whether a piece stands upright with its middle over a thing and its foot on top of it."""
        (at, turn), (under, _) = self.pose(piece), self.pose(ground)
        half, wide = self.half(piece), self.half(ground)
        over = bool((np.abs(at - under)[:2] < wide[:2] + EDGE).all())
        foot = float(at[2] - half[2] - under[2] - wide[2])
        return over and float(turn[2, 2]) > UPRIGHT and abs(foot) < HIGH


class PieceJudge:
    """Judges pieces by where they stand. ``seen`` returns the values of all facts."""

    def __init__(self, seen: Callable[[], Sequence[str]]) -> None:
        self._seen = seen

    def see(self, new: Sequence[Event]) -> None:
        """Nothing: where they stand is looked at when it is asked."""

    def doubts(self, values: Sequence[str]) -> list[str]:
        pairs = zip(values, self._seen(), strict=True)
        return [
            f"fact {n} is {now}, not {said}" for n, (said, now) in enumerate(pairs) if said != now
        ]


def crossed(drawing: Drawing) -> list[str]:
    """Where the items of the river stand."""
    grounds = {"red_land": "0", "boat": "B", "green_land": "1"}
    found = []
    for item in ("grass", "sheep", "steve", "wolf"):
        on = [value for ground, value in grounds.items() if drawing.stands_on(item, ground)]
        found.append(on[0] if len(on) == 1 else NOWHERE)
    return found


def on_blocks(drawing: Drawing) -> list[str]:
    """Where the chess pieces stand."""
    pieces = ("star", "circle")
    blocks = {piece: _block(drawing, piece) for piece in pieces}
    found = []
    for piece, other in zip(pieces, pieces[::-1], strict=True):
        is_above = blocks[other] and drawing.stands_on(piece, other)
        found.append(f"{blocks[other]}T" if is_above else f"{blocks[piece] or NOWHERE}B")
    return found


def _block(drawing: Drawing, piece: str) -> str:
    """Return the block on which a piece stands, empty for none."""
    place = drawing.pose(piece)[0]
    blocks = [name for name in drawing.names if name.startswith("block_")]
    nearest = min(blocks, key=lambda name: math.dist(drawing.pose(name)[0][:2], place[:2]))
    return nearest.removeprefix("block_") if drawing.stands_on(piece, nearest) else ""


class RegistrationJudge:
    """Judges whether landmarks were touched and a fit is true, as far as that can be seen."""

    def __init__(self, drawing: Drawing) -> None:
        self._drawing = drawing
        self._touched: list[Array] = []
        self._stood: Array | None = None
        """How reference and phantom stood to each other at the last touch."""
        self._error = math.inf
        self._ticks = 0

    def see(self, new: Sequence[Event]) -> None:
        """Look for a touch, a few times a second."""
        for event in new:
            if isinstance(event, OperationEnded):
                told = re.search(r"TRE ([\d.]+) mm", event.message)
                self._error = float(told[1]) if told else self._error
        self._ticks += 1
        if self._ticks % 10 == 0:
            self._look()

    def doubts(self, values: Sequence[str]) -> list[str]:
        whole = len(self._touched) >= TOUCHES and not self._has_moved()
        found = []
        if values[1] == "1" and not whole:
            found.append(f"{len(self._touched)} landmarks were touched, or something moved")
        if values[3] == "1" and not (whole and self._error < LIMIT):
            found.append(f"the registration is {self._error} mm off, or something moved")
        return found

    def _look(self) -> None:
        (middle, _), (flange, turn) = (self._drawing.pose(n) for n in ("phantom", "iiwa tool"))
        away = flange + TIP * turn[:, 2] - middle
        if abs(float(np.linalg.norm(away)) - float(self._drawing.half("phantom")[0])) > NEAR:
            return
        if self._has_moved():
            self._touched = []
        self._stood = self._between()
        if all(float(np.linalg.norm(away - other)) > ASIDE for other in self._touched):
            self._touched.append(away)

    def _has_moved(self) -> bool:
        stood = self._stood
        return stood is None or float(np.linalg.norm(self._between() - stood)) > NEAR

    def _between(self) -> Array:
        (one, _), (other, _) = (self._drawing.pose(name) for name in ("phantom", "reference"))
        found: Array = one - other
        return found


def judge_of(world: str, dispatcher: Dispatcher) -> Judge:
    """Return the judge of a world."""
    drawing = Drawing(dispatcher)
    if world == REGISTRATION:
        return RegistrationJudge(drawing)
    if world == HANOI:
        return PieceJudge(partial(standing, dispatcher))
    return PieceJudge(partial({RIVER: crossed, CHESS: on_blocks}[world], drawing))


@dataclass(frozen=True)
class JudgedStory:
    """One run with a fault: how it ended, its number of commits, and what it committed or told that
    was not so."""

    fault: str
    reason: str
    commits: int
    wrong: tuple[str, ...]


def judged_run(world: str, number: int, most: float = MOST) -> JudgedStory:
    """Return the run of this number: each fault of the world in turn, with other seeds and times.

    Games begin in any state and have a goal three steps away; a registration is always a whole one.
    Half of the runs adopt the sensed state where it is not the expected one.
    """
    faults = faults_of(world)
    fault, given = faults[number % len(faults)]
    random = Random(f"{world} {number}")
    file = read(blueprint_file(world))
    start, goal = (None, None) if world == REGISTRATION else _walked(random, file["SB1"])
    due = random.uniform(0.1, WHOLE if world == REGISTRATION else LONGEST)
    dispatcher = open_run(
        file,
        world,
        start=start,
        goal=goal,
        host="local",
        seed=number // len(faults),
        on_mismatch=random.choice(["hold", "adopt"]),
    )
    told = list(dispatcher.open())
    judge, wrong, commits = judge_of(world, dispatcher), list[str](), 0
    try:
        while not dispatcher.finished:
            if dispatcher.time > most:
                dispatcher.stop()
            if dispatcher.time >= due:
                dispatcher.inject(fault, by="a test", **given)
                due = math.inf
            told = list(dispatcher.tick())
            judge.see(told)
            for event in told:
                commits += isinstance(event, Committed)
                if isinstance(event, Committed) or _is_goal(event):
                    wrong += _doubts(judge, file, event)
        last = told[-1]
        assert isinstance(last, RunFinished)
    finally:
        dispatcher.close()
    return JudgedStory(fault, last.reason, commits, tuple(wrong))


def _walked(random: Random, branch: StateBranch) -> tuple[Address, Address]:
    """Return a state, and one that is some random steps away."""
    start = goal = random.choice(list(branch.table))
    while goal == start:
        for _ in range(STEPS):
            goal = random.choice(list(branch.table[goal].values()))
    return Address(branch.name, start), Address(branch.name, goal)


def _is_goal(event: Event) -> TypeGuard[RunFinished]:
    return isinstance(event, RunFinished) and event.reason == "goal_reached"


def _doubts(judge: Judge, file: Blueprint, event: Committed | RunFinished) -> list[str]:
    ((branch, state),) = event.configuration.items()
    found = judge.doubts(file[branch].facts(state))
    return [f"{event.event} {state} at {event.t:.2f} s: {doubt}" for doubt in found]
