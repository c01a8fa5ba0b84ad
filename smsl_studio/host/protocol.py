"""The interface of a host: the place where a world and library code run.

The dispatcher and the host run in lockstep. One ``tick`` is one step of the world, one resumption
of the running operation, and the samples of the sensors that were due. The local host and the
process host give equal answers to equal calls.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import partial
from typing import NamedTuple, Protocol, runtime_checkable

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.reception import RemoteView
from smsl_studio.monitor.sample import Sample
from smsl_studio.runlog.event import Event
from smsl_studio.world.protocol import Shape


class Outcome(Enum):
    """The state of the running call after a tick.

    RETURNED is no proof of success: the state check of the target decides.
    """

    IDLE = "idle"
    RUNNING = "running"
    RETURNED = "returned"
    FAILED = "failed"
    """The function returned False."""
    RAISED = "raised"


IDLE, RUNNING, RETURNED = Outcome.IDLE, Outcome.RUNNING, Outcome.RETURNED
"""Some outcomes as plain names, because an attribute of an enumeration is slow to look up."""


@dataclass(frozen=True, slots=True)
class Bound:
    """The library function bound to one edge, without its code.

    ``exact`` says that the binding names exactly this ``State/Operation`` (clause 5). ``timeout``
    is in simulated seconds. ``stop`` is the effect of a stop or pause: abort, hold or finish.
    ``resumes`` says that the function can go on after it was held. ``touches`` are facts that the
    function may change besides the facts of its edge. After a cancel these facts are unknown until
    they are sensed anew. ``generated`` says that nobody has written the function by hand.
    """

    function: str
    exact: bool
    stop: str
    timeout: float
    resumes: bool = True
    touches: tuple[FactKey, ...] = ()
    generated: bool = False


@dataclass(frozen=True, slots=True)
class SensorInfo:
    """One sensor of one fact: its name, its period (s) and the age (s) after which it is stale.

    ``digit`` is the fact's number in the SB, counted from 0. ``words`` explain values that no
    state has, such as ``h``: held. A ``remote`` sensor sends its samples over a network, at its
    own times. A sensor with a ``unit`` measures, and predicates decide what its numbers mean.
    """

    name: str
    branch: str
    digit: int
    period: float
    max_age: float
    aggregation: str = "single"
    words: Mapping[str, str] = field(default_factory=dict)
    remote: bool = False
    unit: str = ""
    predicate: Mapping[str, str] = field(default_factory=dict)
    """The default predicates by which the plugin decides its value, if it does so."""


class Elsewhere(Protocol):
    """Sensors that send samples over a network, at their own times (see ``host.remote``)."""

    def clock(self) -> float:
        """Return this computer's monotonic time (s). The age of remote samples is measured on
        it."""
        ...

    def wait(self) -> None:
        """Wait a moment for further messages. HostError if the run is closed meanwhile."""
        ...

    def heard(self) -> tuple[Sample, ...]:
        """Return the newest sample of each sensor that has sent one since the last call."""
        ...

    def view(self) -> RemoteView:
        """Return the state of the network, for people. Any thread may call it."""
        ...


@dataclass(frozen=True, slots=True)
class OpenedWorld:
    """The description of a world that a host has opened.

    ``tick`` is the length of one tick in simulated seconds. ``bound`` has every edge of the
    blueprint that has a library function in this world. ``settle`` is the simulated time (s) after
    which the state check of a target decides (clause 7). ``faults`` are sentences about bindings
    that do not fit; their edges are not bound. ``rules`` say how facts are aggregated from their
    sensors, where that is declared. ``world_faults`` are the names of the faults that can be
    injected. ``remote`` are the sensors on a network. ``priced`` says whether cost functions are
    bound to edges, and ``guarded`` whether edges have guards of their plugin.
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
    guarded: bool = False


Happened = tuple[str, str]
"""An edge's address, and ``committed`` or ``failed``."""


@dataclass(frozen=True, slots=True)
class Priced:
    """The answers of cost functions: the edges whose cost has changed since the last call (None:
    the declared cost), and one sentence for each function with an invalid answer.

    ``closed`` has the answers of guards that have changed: why an edge cannot be used now, or the
    empty text if it can."""

    costs: Mapping[Address, float | None] = field(default_factory=dict)
    faults: tuple[str, ...] = ()
    closed: Mapping[Address, str] = field(default_factory=dict)


class Tick(NamedTuple):
    """The result of one tick: the time after it (simulated s), the running call, the samples."""

    time: float
    outcome: Outcome
    samples: tuple[Sample, ...]
    message: str = ""


tick_of: Callable[[tuple[float, Outcome, tuple[Sample, ...], str]], Tick] = partial(
    tuple.__new__, Tick
)
"""Return the tick with these fields. This is quicker than a call of ``Tick``."""


@runtime_checkable
class Telling(Protocol):
    """A host that tells events of its own: those of the procedures that it carries out."""

    def hear(self, tell: Callable[[Event], None]) -> None:
        """Tell events to ``tell`` from now on."""
        ...

    @property
    def holding(self) -> str:
        """Why a procedure holds and waits for a person. Empty if none does."""
        ...


@runtime_checkable
class Extending(Protocol):
    """A host that takes further edges while its world stands."""

    def extend(self, edge: Address, target: str) -> tuple[Bound | None, bool]:
        """Bind one more edge, from now on. Return its function, None if the library has none for
        it, and whether a guard of the plugin is asked about it. The blueprint can have this
        edge."""
        ...


class Host(Protocol):
    """A place where a world and library code run. Its methods raise HostError if the host is gone
    or does not answer."""

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Build the world and put it into the states ``start`` (SB -> state)."""
        ...

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor once. The simulated time does not move."""
        ...

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge; it first moves at the next tick."""
        ...

    def tick(self) -> Tick:
        """Advance the world and the running call by one tick."""
        ...

    def cancel(self, mode: str) -> None:
        """End the running call. ``abort`` and ``hold`` brake the world and drop the call, which
        never resumes. ``finish`` lets it run on."""
        ...

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb a sensor, or all sensors of one fact (``SB/digit``), from now on.

        The kind ``none`` ends the disturbance; ``monitor.disturbance`` lists the kinds. Return the
        names of the disturbed sensors. An unknown sensor, fact or kind raises UsageError.
        """
        ...

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Cause a fault of the world, from this instant on.

        A fault that the world does not have (``OpenedWorld.world_faults``), or parameters that do
        not fit, raise UsageError. An error in the code of the fault raises HostError.
        """
        ...

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions and the guards.

        ``scene`` has a value (None: unknown) for every sensed fact, whose key is ``SB/digit``.
        ``happened`` has the results of edges since the last call.
        """
        ...

    def suppose(self, edge: Address) -> None:
        """Make the guard of an edge agree in a world that was just opened. Nothing happens if the
        edge has no premise."""
        ...

    def poses(self) -> tuple[float, ...]:
        """Return the newest poses for drawing (see ``World.poses``). The call never waits for a
        running tick."""
        ...

    def status(self) -> Mapping[str, str]:
        """Return the world's short status texts for people. The call never waits for a running
        tick."""
        ...

    def check(self) -> None:
        """Raise HostError if the host is gone or silent. The world is not asked and does not
        move."""
        ...

    def close(self) -> None:
        """End everything, including a child process that hangs. A second call does nothing."""
        ...
