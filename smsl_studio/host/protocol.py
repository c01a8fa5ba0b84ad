"""Where library code runs: the one interface of the local and the process host.

The dispatcher steps the host in lock: one ``tick`` is one step of the world, one resumption of the
running operation and the samples of the sensors that were due. Equal calls give equal answers,
whichever host carries them out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import NamedTuple, Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.reception import RemoteView
from smsl_studio.monitor.sample import Sample
from smsl_studio.world.protocol import Shape


class Outcome(Enum):
    """The state of the running call after a tick; a return value alone proves nothing."""

    IDLE = "idle"
    RUNNING = "running"
    RETURNED = "returned"
    FAILED = "failed"
    """The function returned False."""
    RAISED = "raised"


@dataclass(frozen=True, slots=True)
class Bound:
    """The library function bound to one edge, as the dispatcher needs to know it.

    ``exact`` says that it was bound to exactly this ``State/Operation`` (clause 5). ``timeout`` is
    in simulated seconds. ``stop`` is what a stop or pause does to it: abort, hold or finish.
    ``resumes`` says that it goes on after it was held. ``touches`` are facts that it may change
    besides those its edge changes: unknown, once it was cancelled, until they are sensed anew.
    """

    function: str
    exact: bool
    stop: str
    timeout: float
    resumes: bool = True
    touches: tuple[FactKey, ...] = ()


@dataclass(frozen=True, slots=True)
class SensorInfo:
    """One sensor of one fact: its name, its period and the age (s) after which it is stale.

    ``words`` say for people what values mean that no state has, such as ``h``: held. ``remote``
    says that it is elsewhere, and speaks over a network when it likes.
    """

    name: str
    branch: str
    digit: int
    period: float
    max_age: float
    aggregation: str = "single"
    words: Mapping[str, str] = field(default_factory=dict)
    remote: bool = False


class Elsewhere(Protocol):
    """Sensors that speak over a network when they like (see ``host.remote``)."""

    def clock(self) -> float:
        """This computer's monotonic seconds, on which their samples age."""
        ...

    def heard(self) -> tuple[Sample, ...]:
        """The newest sample of each of them since the last time."""
        ...

    def view(self) -> RemoteView:
        """The network as people want to see it; any thread may ask."""
        ...


@dataclass(frozen=True, slots=True)
class OpenedWorld:
    """What a host says once its world stands.

    ``bound`` has every edge of the blueprint that has a library function in this world.
    ``settle`` is the simulated time (s) for which a target's check must be let settle before it
    decides (clause 7). ``faults`` are the sentences about bindings that do not fit; their edges
    are not bound. ``rules`` say how facts are made of their sensors, where that is declared.
    ``world_faults`` are the names of what can be injected. ``remote`` are the sensors elsewhere.
    ``priced`` says whether cost functions are bound to edges.
    """

    world: str
    tick: float
    hardware: bool
    bound: Mapping[Address, Bound]
    sensors: tuple[SensorInfo, ...]
    shapes: tuple[Shape, ...]
    settle: float
    faults: tuple[str, ...] = ()
    rules: Mapping[FactKey, FactRule] = field(default_factory=dict)
    world_faults: tuple[str, ...] = ()
    remote: Elsewhere | None = None
    priced: bool = False


Happened = tuple[str, str]
"""An edge's address, and ``committed`` or ``failed``."""


@dataclass(frozen=True, slots=True)
class Priced:
    """What cost functions say: the edges that cost otherwise than when they were asked last (None:
    what is declared), and one sentence for each function whose answers do not count."""

    costs: Mapping[Address, float | None] = field(default_factory=dict)
    faults: tuple[str, ...] = ()


class Tick(NamedTuple):
    """The result of one tick: the time after it (simulated s), the running call, the samples."""

    time: float
    outcome: Outcome
    samples: tuple[Sample, ...]
    message: str = ""


class Host(Protocol):
    """A place where a world and library code run. HostError when it is gone or silent."""

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Build the world and put it into ``start`` (SB -> state)."""
        ...

    def sense(self) -> tuple[Sample, ...]:
        """Every sensor once, now, without moving the time."""
        ...

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge; it first moves at the next tick."""
        ...

    def tick(self) -> Tick:
        """Let the world and the running call go on for one tick."""
        ...

    def cancel(self, mode: str) -> None:
        """End the running call: ``abort`` and ``hold`` brake and drop it; it never resumes."""
        ...

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """From now on disturb a sensor, or all of one fact (``SB/digit``); ``none`` ends it.

        The sensors it meets. UsageError where nothing is called so, or there is no such kind: see
        ``monitor.disturbance``.
        """
        ...

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Let something go wrong in the world, from this instant on.

        UsageError where the world has no such fault (``OpenedWorld.world_faults``) or it cannot be
        done with these parameters; HostError where its code breaks.
        """
        ...

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions; ``scene`` has a value (None: unknown) for every fact that is
        sensed, written ``SB/digit``, ``happened`` what has happened since they were asked last."""
        ...

    def poses(self) -> tuple[float, ...]:
        """The newest poses for drawing (see ``World.poses``); never blocks on a running tick."""
        ...

    def status(self) -> Mapping[str, str]:
        """The world's short words for people; never blocks on a running tick."""
        ...

    def check(self) -> None:
        """HostError where it is gone or silent; nothing is asked of the world, nothing moves."""
        ...

    def close(self) -> None:
        """End everything, also a child that hangs; calling it twice is harmless."""
        ...
