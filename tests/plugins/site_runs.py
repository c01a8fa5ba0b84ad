"""Runs of the registration world, judged only by what is drawn and by the errors that are told.

The judge uses neither the plugin's sensors nor its navigation. A registration counts as true if the
error that was told at its fit is small, and if phantom and reference stand to each other as then.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.front.inputs import read
from smsl_studio.front.runs import open_run
from smsl_studio.runlog.events import (
    Event,
    Held,
    OperationEnded,
    OperationStarted,
    RunFinished,
)
from smsl_studio.shipped import samples_dir

FLAT, SUBBED = "registration.json", "registration-digitization.json"
LIMIT = 0.5
"""The largest error at a target (mm) of a registration that counts as true."""


@dataclass(frozen=True)
class SiteFault:
    """One fault, injected at a time (s of the run)."""

    fault: str
    at: float
    parameters: Mapping[str, float | str] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.fault} at {self.at:g} s"


@dataclass
class SiteStory:
    """One run: its events, the error told at the last fit (mm, infinite without one), and how far
    (mm) phantom and reference have moved against each other since then."""

    events: list[Event]
    error: float = math.inf
    moved: float = math.inf

    @property
    def end(self) -> RunFinished:
        last = self.events[-1]
        assert isinstance(last, RunFinished)
        return last

    @property
    def false_goal(self) -> bool:
        """Whether the run says that the patient is registered, and he is not."""
        return self.end.reason == "goal_reached" and (self.error >= LIMIT or self.moved >= LIMIT)

    @property
    def started(self) -> list[str]:
        return [
            event.address.rpartition("/")[2]
            for event in self.events
            if isinstance(event, OperationStarted)
        ]

    @property
    def holds(self) -> list[Held]:
        return [event for event in self.events if isinstance(event, Held)]


def run_site(
    file: str = FLAT, fault: SiteFault | None = None, seed: int = 0, most: float = 200.0
) -> SiteStory:
    """Run a procedure to its end, or for ``most`` simulated seconds."""
    dispatcher = open_run(read(samples_dir() / file), "registration", host="local", seed=seed)
    story = SiteStory(list(dispatcher.open()))
    due, fitted = (math.inf, None) if fault is None else (fault.at, None)
    between = None
    try:
        while not dispatcher.finished:
            if dispatcher.time > most:
                dispatcher.stop()
            new = dispatcher.tick()
            story.events += new
            for event in new:
                if isinstance(event, OperationEnded) and "TRE" in event.message:
                    fitted = re.search(r"TRE ([\d.]+) mm", event.message)
                    between = apart(dispatcher)
            if fault is not None and dispatcher.time >= due:
                dispatcher.inject(fault.fault, by="a test", **fault.parameters)
                due = math.inf
        if fitted is not None and between is not None:
            story.error = float(fitted[1])
            now = apart(dispatcher)
            story.moved = 1000 * math.dist(now, between)
    finally:
        dispatcher.close()
    return story


def apart(dispatcher: Dispatcher) -> list[float]:
    """The way (m) from the reference to the phantom, as they are drawn."""
    assert dispatcher.opened is not None
    names = [shape.name for shape in dispatcher.opened.shapes]
    poses = dispatcher.host.poses()
    one, other = (poses[7 * i : 7 * i + 3] for i in map(names.index, ("phantom", "reference")))
    return [a - b for a, b in zip(one, other, strict=True)]


def site_faults() -> list[SiteFault]:
    """Every fault of the site before, while and after the landmarks are touched."""
    kinds: list[tuple[str, dict[str, float | str]]] = [
        ("occluded", {"seconds": 1.5}),
        ("reference_bumped", {}),
        ("phantom_shifted", {}),
        ("phantom_shifted", {"millimetres": 0.7}),
        ("bent_pointer", {}),
        ("bent_pointer", {"millimetres": -1.0}),
        ("noisy_tracker", {}),
        ("seized_joint", {}),
        ("seized_joint", {"joint": 7}),
    ]
    return [
        SiteFault(name, at, given) for at in (0.1, 3.0, 20.0, 42.0, 43.0) for name, given in kinds
    ]
