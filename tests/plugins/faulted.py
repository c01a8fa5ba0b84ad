"""Hanoi runs with faults, judged only by the poses of the rings.

The judge does not use the plugin's sensors or its table. It uses only the poses for drawing.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import (
    Committed,
    Event,
    FactChanged,
    Mismatch,
    OperationEnded,
    OperationStarted,
    Relocalised,
    RunFinished,
)
from smsl_studio.shipped import samples_dir

PLAIN, WITH_FAILURES = "hanoi-corrected.json", "hanoi-failures.json"
AFTER = 0.3
"""Seconds of an operation that pass before the fault is injected."""

PEGS = {"a": -0.14, "b": 0.0, "c": 0.14}
THICK = 0.018


@dataclass(frozen=True)
class Case:
    """One fault, injected into the ``during``-th operation (from 1) of a run of three disks."""

    fault: str
    during: int
    parameters: Mapping[str, float | str] = field(default_factory=dict)

    def __str__(self) -> str:
        words = ", ".join(f"{name}={value}" for name, value in self.parameters.items())
        return f"{self.fault}({words})" if words else self.fault


def cases() -> list[Case]:
    """The nine faults, each at three edges of the seven."""
    pegs, moved = {1: "c", 2: "b", 4: "c"}, {1: 3, 2: 1, 4: 2}
    found = []
    for during in (1, 2, 4):
        found += [
            Case("gripper_opens", during),
            Case("slippery", during),
            Case("blocked_peg", during, {"peg": pegs[during]}),
            Case("tower_carried", during + (during == 4)),  # the fourth takes a ring from no tower
            Case("wrong_order", during),
            Case("disk_pushed", during, {"disk": moved[during]}),
            Case("seized_joint", during),
            Case("disk_off_board", during, {"disk": moved[during]}),
            Case("weak_grip", during),
        ]
    return sorted(found, key=lambda case: [one.fault for one in found].index(case.fault))


@dataclass(frozen=True)
class Story:
    """What came of a run: its events, what was sensed and what was so when it was over.

    ``wrong`` are the commits, and the goals told, at which the rings stood elsewhere.
    """

    case: Case
    edge: str
    events: tuple[Event, ...]
    at_first: str
    sensed: str
    stood: str
    wrong: tuple[str, ...]

    @property
    def end(self) -> RunFinished:
        last = self.events[-1]
        assert isinstance(last, RunFinished)
        return last

    @property
    def decision(self) -> str:
        """Reached without the fault in the way, recovered, or the reason it ended for."""
        if self.end.reason != "goal_reached":
            return self.end.reason
        again = any(isinstance(event, Mismatch | Relocalised) for event in self.events)
        return "recovered" if again else "reached"


@dataclass(frozen=True)
class Hand:
    """The world and the robot of a run; the size of its rings is 1 for a Panda."""

    world: str = "hanoi"
    robot: str = ""

    @property
    def size(self) -> float:
        return 0.38 if self.robot == "dvrk" else 1.0

    def __str__(self) -> str:
        return self.robot or self.world


PANDA = Hand()


def run_with(
    case: Case, file: str = PLAIN, adopt: bool = False, seed: int = 0, hand: Hand = PANDA
) -> Story:
    """Run three disks from a to c, with one fault injected on the way."""
    dispatcher = open_run(
        read(samples_dir() / file),
        hand.world,
        robot=hand.robot,
        host="local",
        seed=seed,
        on_mismatch="adopt" if adopt else "hold",
    )
    events: list[Event] = list(dispatcher.open())
    wrong: list[str] = []
    edge, at_first, due = "", "", math.inf
    try:
        while not dispatcher.finished:
            new = dispatcher.tick()
            events += new
            for event in new:
                if isinstance(event, OperationStarted) and not edge:
                    if sum(isinstance(e, OperationStarted) for e in events) == case.during:
                        edge, due = event.address, event.t + AFTER
                elif isinstance(event, Committed):
                    wrong += _judge(dispatcher, f"{event.operations[0]} committed", event, hand)
            ended = [e for e in new if isinstance(e, OperationEnded)]
            if dispatcher.time >= due:
                dispatcher.inject(case.fault, by="a test", **case.parameters)
                due = math.inf
            elif edge and ended and not at_first:
                at_first = ended[0].outcome
        last = events[-1]
        if isinstance(last, RunFinished) and last.reason == "goal_reached":
            wrong += _judge(dispatcher, "goal reached", last, hand)
        stood = standing(dispatcher, hand.size)
    finally:
        dispatcher.close()
    facts = {event.digit: event.value for event in events if isinstance(event, FactChanged)}
    sensed = "".join(facts.get(digit) or "?" for digit in sorted(facts))
    return Story(case, edge, tuple(events), at_first, sensed, stood, tuple(wrong))


def _judge(
    dispatcher: Dispatcher, what: str, event: Committed | RunFinished, hand: Hand
) -> list[str]:
    said = event.configuration["SB1"].removeprefix("State_")
    stood = standing(dispatcher, hand.size)
    return [] if said == stood else [f"{what} as {said}, and the rings stood {stood}"]


def standing(dispatcher: Dispatcher, size: float = 1.0) -> str:
    """Where the rings are, disk 1 first: their pegs, or x for one that stands on none. ``size`` is
    that of the rings, 1 for a Panda."""
    assert dispatcher.opened is not None
    names = [shape.name for shape in dispatcher.opened.shapes]
    poses = dispatcher.host.poses()
    rings = [poses[7 * i : 7 * i + 7] for i in (names.index(f"disk_{n}") for n in (1, 2, 3))]
    found = dict.fromkeys(range(3), "x")
    for peg, y in PEGS.items():
        around = [i for i in range(3) if math.dist(rings[i][:2], (0.5, y * size)) < 0.0085 * size]
        below = 3
        for level, ring in enumerate(sorted(around, key=lambda i: rings[i][2])):
            if not (_flat(rings[ring], level, size) and ring < below):
                break
            found[ring], below = peg, ring
    return "".join(found.values())


def _flat(pose: Sequence[float], level: int, size: float) -> bool:
    """Whether a ring lies level, as high as so many rings below it make it."""
    upward = abs(1.0 - 2.0 * (pose[3] ** 2 + pose[4] ** 2))
    return upward > 0.99 and abs(pose[2] - (level + 0.5) * THICK * size) < 0.004 * size
