"""What a library keeps of worlds, faults, cost functions and automatic supervisors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from smsl_studio.library.pattern import Pattern
from smsl_studio.library.signature import Signature

if TYPE_CHECKING:
    from smsl_studio.world.bodies import Robot
    from smsl_studio.world.stations import RobotReach


@dataclass(frozen=True, slots=True)
class WorldEntry:
    """A world of a plugin: ``build(engine, blueprint, seed)`` furnishes a fresh engine.

    The result of ``build`` is the first argument of operations, sensors and ``arrange``. If
    ``build`` returns None, the engine is this argument. ``settle`` is the time (s) that the state
    check of a target may take to become true after an operation has ended. ``values`` are the
    values that facts of the world may have in a start, if the plugin says so. ``robots`` are the
    names of the robots that it can be built with, the usual one first. If there are some, ``build``
    gets the chosen one as a fourth argument.
    """

    name: str
    engine: str
    hardware: bool
    settle: float
    build: Callable[..., Any]
    values: tuple[str, ...] = ()
    robots: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class FaultEntry:
    """A fault that can be injected into a world by its name.

    ``effect`` tells what it does to an operation (see ``fault_effect``); None is not known, also
    where the code is elsewhere.
    """

    world: str
    name: str
    function: Callable[..., Any]
    signature: Signature
    effect: Callable[..., Any] | None = None


@dataclass(frozen=True, slots=True)
class StationsEntry:
    """The places to which the operations of a world bring the tool, for a robot.

    ``robot`` is that of a world without a choice. Where the code is elsewhere, ``known`` has what
    it told of each robot, by name (empty for a world without a choice).
    """

    world: str
    function: Callable[..., Any]
    robot: Robot | None = None
    known: Mapping[str, RobotReach] | None = None


@dataclass(frozen=True, slots=True)
class CostEntry:
    """A cost function, and the pattern of the operations whose edges it prices."""

    function: Callable[..., Any]
    name: str
    pattern: Pattern
    signature: Signature


@dataclass(frozen=True, slots=True)
class SupervisorEntry:
    """An automatic supervisor. ``limit`` is the wall time (s) that an answer may take. ``prepare``
    is called once with the options, before the run. ``forecasts`` says that it decides by
    forecasts, so that a run with it makes them.
    """

    function: Callable[..., Any]
    name: str
    signature: Signature
    limit: float
    prepare: Callable[..., Any] | None = None
    forecasts: bool = False
