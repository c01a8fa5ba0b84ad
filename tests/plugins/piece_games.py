"""Runs of the worlds river and chess, judged only by where the pieces are drawn.

The judge uses neither the plugins' sensors nor their figures of places: a piece stands if its
middle is as high as it was at the start, and if its axis is upright.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import Committed, Event, RunFinished
from smsl_studio.shipped import plugins_dir

RIVER, CHESS = "river", "chess"
GOALS = {RIVER: "State_1111", CHESS: "State_1B0B"}
PIECES = {RIVER: ("grass", "sheep", "steve", "wolf"), CHESS: ("star", "circle")}


def file_of(game: str) -> Path:
    """The blueprint that ships with the plugin."""
    return plugins_dir() / game / f"{game}.json"


@dataclass(frozen=True)
class GameFault:
    """One fault, injected at a time (s of the run)."""

    fault: str
    at: float
    parameters: Mapping[str, float] = field(default_factory=dict)


@dataclass
class GameStory:
    """One run: its events, and whether the pieces stand at the goal at its end."""

    events: list[Event]
    reached: bool = False

    @property
    def end(self) -> RunFinished:
        last = self.events[-1]
        assert isinstance(last, RunFinished)
        return last

    @property
    def false_goal(self) -> bool:
        """Whether the run says that the goal is reached, and it is not."""
        return self.end.reason == "goal_reached" and not self.reached

    @property
    def committed(self) -> list[str]:
        """The states that were committed, in order."""
        found = [event for event in self.events if isinstance(event, Committed)]
        return [event.configuration["SB1"] for event in found]


def run_game(
    game: str, fault: GameFault | None = None, seed: int = 0, most: float = 200.0, goal: str = ""
) -> GameStory:
    """Run a game to its goal, or for ``most`` simulated seconds. Without a goal it is that of the
    blueprint."""
    goals = Address("SB1", goal) if goal else None
    dispatcher = open_run(read(file_of(game)), game, goal=goals, host="local", seed=seed)
    story = GameStory(list(dispatcher.open()))
    due = math.inf if fault is None else fault.at
    try:
        before = places(dispatcher, game)
        while not dispatcher.finished:
            if dispatcher.time > most:
                dispatcher.stop()
            story.events += dispatcher.tick()
            if fault is not None and dispatcher.time >= due:
                dispatcher.inject(fault.fault, by="a test", **fault.parameters)
                due = math.inf
        story.reached = at_goal(game, before, places(dispatcher, game))
    finally:
        dispatcher.close()
    return story


Place = tuple[float, float, float, float]
"""x, y, z (m), and the vertical part of the axis."""


def places(dispatcher: Dispatcher, game: str) -> list[Place]:
    """Where the pieces are drawn."""
    assert dispatcher.opened is not None
    names = [shape.name for shape in dispatcher.opened.shapes]
    poses = dispatcher.host.poses()
    found = []
    for piece in PIECES[game]:
        x, y, z, qx, qy, _, _ = poses[7 * names.index(piece) : 7 * names.index(piece) + 7]
        found.append((x, y, z, 1.0 - 2.0 * (qx * qx + qy * qy)))
    return found


def at_goal(game: str, before: list[Place], now: list[Place]) -> bool:
    """Whether all items are on the other bank, or the pieces have changed their corners."""
    if any(upright < 0.97 for *_, upright in now):
        return False
    if any(abs(z - z0) > 0.005 for (_, _, z, _), (_, _, z0, _) in zip(now, before, strict=True)):
        return False
    if game == RIVER:
        return all(y > 0.12 for _, y, _, _ in now)
    (x1, y1, *_), (x2, y2, *_) = now
    corners = ((0.46, 0.06), (0.46, -0.06))
    return all(
        abs(x - cx) < 0.02 and abs(y - cy) < 0.02
        for (x, y), (cx, cy) in zip(((x1, y1), (x2, y2)), corners, strict=True)
    )


def game_faults(game: str) -> list[GameFault]:
    """Every fault of a game, early, in the middle and late in the run."""
    shared: list[tuple[str, dict[str, float]]] = [
        ("gripper_opens", {}),
        ("gripper_opens", {"after": 0.1, "seconds": 1.0}),
        ("slippery", {}),
        ("weak_grip", {}),
        ("seized_joint", {}),
        ("seized_joint", {"joint": 6}),
        ("toppled", {"item": 2} if game == RIVER else {"piece": 1}),
    ]
    own: dict[str, tuple[str, dict[str, float]]] = {
        RIVER: ("third_aboard", {"item": 1}),
        CHESS: ("beside", {"piece": 2}),
    }
    kinds = [*shared, own[game]]
    return [GameFault(name, at, given) for at in (0.5, 6.0, 21.0) for name, given in kinds]
