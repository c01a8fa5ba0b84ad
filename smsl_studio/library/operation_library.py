"""The Operation Library (paper, Generation of Operation Library): a plugin's ``register(library)``
fills it.

::

    def register(library):
        @library.world("hanoi")
        def build(world, blueprint, seed): ...

        @library.arrange("hanoi")
        def put(world, facts): ...

        @library.sensor("disk_{n}_peg", fact="{n}")
        def disk_peg(world, n: int): ...

        @library.operation("Op_{disk}{peg}", stop="hold", timeout=20.0)
        def move_disk(world, disk: int, peg: str):
            yield                                  # one tick

        @library.cost("Op_{disk}{peg}")
        def price(state, scene, history, disk: int, peg: str): ...

        @library.fault("hanoi", "disk_pushed")
        def push(world, disk: int): ...            # what goes wrong on purpose

        @library.supervisor("careful")
        def careful(view, limit: float = 0.5): ...

Every plugin fills a library of its own, which ``bindings`` reads. Times are in simulated seconds.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from smsl_studio.errors import PluginError, did_you_mean
from smsl_studio.library.arm_table import arm_names
from smsl_studio.library.entries import (
    CostEntry,
    FaultEntry,
    StationsEntry,
    SupervisorEntry,
    WorldEntry,
)
from smsl_studio.library.fact_default import default_entry
from smsl_studio.library.operation_entry import Availability, OperationEntry
from smsl_studio.library.pattern import Pattern, read_pattern
from smsl_studio.library.sensor_entry import NO_WORDS, SensorEntry
from smsl_studio.library.signature import Signature, signature_of
from smsl_studio.library.terms import (
    proper_name,
    seconds,
    truth,
    unit_of_measure,
    words_of_values,
)
from smsl_studio.world.bodies import Robot
from smsl_studio.world.engines import ENGINES, REMOTE, TABLE, USUAL

__all__ = ("STOP_MODES", "Availability", "OperationLibrary")

FunctionT = TypeVar("FunctionT", bound=Callable[..., Any])

_TERMS = ("name", "stop", "timeout", "resumes", "touches", "available", "recovery")
STOP_MODES = ("abort", "hold", "finish")


class OperationLibrary:
    """The entries that one plugin registers. ``name`` is the plugin's name; the full name of a
    function is ``name.function``. Every method raises PluginError for a value that does not fit."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.worlds: dict[str, WorldEntry] = {}
        self.arrangers: dict[str, Callable[..., Any]] = {}
        self.operations: list[OperationEntry] = []
        self.sensors: list[SensorEntry] = []
        self.costs: list[CostEntry] = []
        self.faults: dict[tuple[str, str], FaultEntry] = {}
        self.supervisors: dict[str, SupervisorEntry] = {}
        self.robots: dict[str, Robot] = {}
        self.reaching: dict[str, StationsEntry] = {}

    @property
    def serves(self) -> bool:
        """Whether the library has an entry that a run could use."""
        return any((self.worlds, self.operations, self.sensors, self.costs, self.robots))

    def world(
        self,
        name: str,
        engine: str = USUAL,
        hardware: bool = False,
        settle: float = 0.5,
        *,
        values: Sequence[str] = (),
        robots: Sequence[str] = (),
    ) -> Callable[[FunctionT], FunctionT]:
        """Register a world. The decorated ``build(world, blueprint, seed)`` furnishes it.

        ``engine`` is the engine's name. ``hardware`` says that real machines move. ``settle`` is
        in seconds (see ``WorldEntry``). ``values`` are those that its facts may have, for
        ``generate explore``. ``robots`` are names of robots, the usual one first: those of
        ``smsl_studio.world.arms``, and those that the plugin registers. With robots the decorated
        function is ``build(world, blueprint, seed, robot)``.
        """
        name = proper_name(name, "a world")
        _one_of(engine, ENGINES, "engine")
        hardware, settle = truth(hardware, "hardware"), seconds(settle, "settle", zero=True)
        known = tuple(proper_name(value, "a value") for value in values)
        arms = tuple(dict.fromkeys(proper_name(robot, "a robot") for robot in robots))
        if name in (TABLE, REMOTE) or name in self.worlds:
            raise PluginError(f"the name {name!r} cannot be given to a world: it is taken")

        def keep(function: FunctionT) -> FunctionT:
            """Register the function that builds the world."""
            self.worlds[name] = WorldEntry(name, engine, hardware, settle, function, known, arms)
            return function

        return keep

    def robot(self, robot: Robot) -> None:
        """Register a robot of the plugin's own (``smsl_studio.world.bodies.Robot``).

        The plugin's worlds can name it. If the plugin has no world, then every world that can be
        built with several robots can be built with it, too.
        """
        if not isinstance(robot, Robot):
            raise PluginError(f"a robot is of type {type(robot).__name__!r}, no Robot")
        name = proper_name(robot.name, "a robot")
        if name in self.robots or name in arm_names():
            raise PluginError(f"the name {name!r} cannot be given to a robot: it is taken")
        self.robots[name] = robot

    def stations(self, world: str, robot: Robot | None = None) -> Callable[[FunctionT], FunctionT]:
        """Register the places to which operations of a world bring the tool. The decorated
        ``stations(robot)`` returns them by a pattern of operations (``world.stations.Stations``).

        With them inspection says which operations a chosen robot does not reach (R24). ``robot`` is
        the robot of a world without a choice. For a robot of another plugin nothing is asked.
        """
        world = proper_name(world, "a world")
        if robot is not None and not isinstance(robot, Robot):
            raise PluginError(f"a robot is of type {type(robot).__name__!r}, no Robot")
        if world in self.reaching:
            raise PluginError(f"the stations of the world {world!r} are registered already")

        def keep(function: FunctionT) -> FunctionT:
            """Register the function that tells the stations."""
            self.reaching[world] = StationsEntry(world, function, robot)
            return function

        return keep

    def arrange(self, world: str) -> Callable[[FunctionT], FunctionT]:
        """Register the start of a world. The decorated ``put(world, facts)`` makes the facts true.

        ``facts`` maps (SB, digit) to a value. Digits count from 0. Facts that a sub-SB expands are
        left out.
        """

        world = proper_name(world, "a world")

        def keep(function: FunctionT) -> FunctionT:
            """Register the function that arranges the world."""
            self.arrangers[world] = function
            return function

        return keep

    def sensor(
        self,
        name: str,
        fact: str = "",
        period: float = 0.02,
        max_age: float = 0.3,
        words: Mapping[str, str] = NO_WORDS,
        *,
        unit: str = "",
    ) -> Callable[[FunctionT], FunctionT]:
        """Register a sensor (paper, Sensor Representation). The decorated ``f(world, ...) -> str |
        None`` reads facts. None means that there is no valid reading.

        ``fact`` is the pattern of the facts: ``"SB/{n}"``, or ``"{n}"`` for the only root of a
        file. Here facts count from 1. Without ``fact`` the sensor reads only the facts that are
        bound to it. ``period`` and ``max_age`` are in simulated seconds. ``words`` explain values
        that no state has, such as ``{"h": "held"}``. With a ``unit`` the function returns a number,
        or three for a position, in this unit. Such a sensor reads no fact by itself: predicates of
        a blueprint name it under ``sources``.
        """
        name = proper_name(name, "a sensor")
        fact = proper_name(fact, "a fact") if fact else ""
        period, max_age = seconds(period, "period"), seconds(max_age, "max_age")
        told, unit = words_of_values(words), unit_of_measure(unit, fact)

        def keep(function: FunctionT) -> FunctionT:
            """Register the sensor. PluginError if names and parameters do not fit."""
            signature = signature_of(function)
            pattern = read_pattern(name, signature.types)
            where = read_pattern(fact, signature.types)
            _must_name_all(pattern, signature)
            if fact and set(where.parameters) != set(pattern.parameters):
                raise PluginError(f"{name!r} and {fact!r} do not name the same parameters")
            entry = SensorEntry(function, pattern, where, signature, period, max_age, told, unit)
            self.sensors.append(entry)
            return function

        return keep

    def fact(
        self, name: str, fact: str, predicate: Mapping[str, str], otherwise: str = "", **terms: Any
    ) -> None:
        """Register the predicates that decide facts where the blueprint writes none (paper, Eq. 5).

        ``predicate`` has for each value a condition on sensors of this plugin that measure, with
        the parameters in braces that ``name`` and ``fact`` have. These sensors come first. A run
        sees one sensor called ``name``, as if a function had returned the value. ``otherwise`` is
        the value if every condition is false. ``terms`` are ``period``, ``max_age`` and ``words``,
        as those of a sensor.
        """
        self.sensors.append(
            default_entry(self.sensors, (name, fact), (predicate, otherwise), terms)
        )

    def operation(
        self,
        name: str = "",
        stop: str = "hold",
        timeout: float = 20.0,
        *,
        resumes: bool = True,
        touches: Sequence[str] = (),
        available: Availability | None = None,
        **marks: bool,
    ) -> Callable[[FunctionT], FunctionT]:
        """Register an operation (paper, Operation Representation). The decorated generator function
        carries out the operations that the pattern ``name`` matches.

        Each ``yield`` lets the world go on for one tick. A return of False reports a failure.
        A name ``"SB/Operation"`` matches in this SB only. Without a name the function is used only
        where a blueprint or a bindings file names it.
        ``stop`` is the effect of a stop or pause: abort, hold or finish. ``timeout`` is in
        simulated seconds. With ``resumes=False`` a pause cancels it. ``touches`` are patterns of
        the facts that may have any value after a cancel, besides the facts of its edge: ``"{n}"``
        for the SB of the edge, or ``"SB/{n}"``. Here facts count from 1, and names in braces are
        parameters of the function.
        ``available`` says whether it can be used now (see ``Availability``). The mark ``recovery``
        says that it leads out of a failure; ``generate explore`` does not try it.
        """
        name = proper_name(name, "an operation") if name else ""
        _one_of(stop, STOP_MODES, "stop")
        timeout, resumes = seconds(timeout, "timeout"), truth(resumes, "resumes")
        if odd := next((mark for mark in marks if mark != "recovery"), None):
            raise PluginError(f"an operation has no {odd!r}", advice=did_you_mean(odd, _TERMS))
        recovers = truth(marks.get("recovery", False), "recovery")
        touched = [proper_name(fact, "a fact") for fact in touches]
        if available is not None and not isinstance(available, Availability):
            raise PluginError(f"available is of type {type(available).__name__!r}, no Availability")

        def keep(function: FunctionT) -> FunctionT:
            """Register the operation. PluginError if the function is no generator, or if names do
            not fit."""
            if not inspect.isgeneratorfunction(function):
                raise PluginError(
                    f"{function.__name__} is no generator function",
                    advice="Write a yield wherever the world shall go on for one tick.",
                )
            signature = signature_of(function)
            pattern = read_pattern(name, signature.types) if name else None
            if pattern is not None:
                _must_name_all(pattern, signature)
            facts = tuple(read_pattern(text, signature.types) for text in touched)
            for fact in facts:
                _must_know_all(fact, signature)
            called = f"{self.name}.{proper_name(function.__name__, 'a function')}"
            entry = OperationEntry(function, called, pattern, signature, stop, timeout)
            self.operations.append(
                replace(
                    entry, resumes=resumes, touches=facts, available=available, recovery=recovers
                )
            )
            return function

        return keep

    def cost(self, name: str) -> Callable[[FunctionT], FunctionT]:
        """Register a cost function. The decorated ``f(state, scene, history, ...) -> float | None``
        returns the cost of an edge. None means the declared cost.

        The function is called for every edge whose operation's name matches, at every arrival and
        whenever facts change. ``state`` is the source state of the edge. ``scene`` maps
        ``SB/digit`` to a sensed value or None. ``history`` has a pair (address, ``committed`` or
        ``failed``) for each edge that was carried out, in order. The function gets no world, so it
        cannot change it.
        """

        name = proper_name(name, "a cost")

        def keep(function: FunctionT) -> FunctionT:
            """Register the cost function. PluginError if names and parameters do not fit."""
            signature = signature_of(function, ("state", "scene", "history"))
            pattern = read_pattern(name, signature.types)
            _must_name_all(pattern, signature)
            called = f"{self.name}.{proper_name(function.__name__, 'a function')}"
            self.costs.append(CostEntry(function, called, pattern, signature))
            return function

        return keep

    def fault(
        self, world: str, name: str, *, effect: Callable[..., Any] | None = None
    ) -> Callable[[FunctionT], FunctionT]:
        """Register a fault. The decorated ``f(world, ...)`` causes it when a user or a script asks.

        A plain function acts at once. A generator is resumed at every tick, after the running
        operation and before the world's step, until it ends or the world is opened again. The
        function raises a StudioError if the fault is not possible now.

        ``effect(facts, arguments)`` tells without a world what the fault does to an operation, as a
        ``FaultEffect`` of ``library.fault_effect``: ``facts`` are those of its source, digit 0
        first, ``arguments`` those of its function. Campaigns foresee with it how a run ends.
        """
        name, world = proper_name(name, "a fault"), proper_name(world, "a world")
        if not name.isidentifier() or (world, name) in self.faults:
            raise PluginError(f"the name {name!r} cannot be given to a fault of {world!r}")

        def keep(function: FunctionT) -> FunctionT:
            """Register the fault. PluginError for a parameter with a name that a script needs."""
            entry = FaultEntry(world, name, function, signature_of(function), effect)
            taken = next((one for one in ("fault", "by") if one in entry.signature.types), None)
            if taken is not None:
                raise PluginError(f"a parameter of the fault {name!r} cannot be called {taken!r}")
            self.faults[world, name] = entry
            return function

        return keep

    def supervisor(
        self,
        name: str,
        limit: float = 0.5,
        *,
        prepare: Callable[..., Any] | None = None,
        forecasts: bool = False,
    ) -> Callable[[FunctionT], FunctionT]:
        """Register an automatic supervisor. The decorated ``f(view, ...)`` gets a
        ``SupervisorView`` before each operation. It returns an answer of
        ``library.supervisor_view`` or a pair (answer, reason).

        Further parameters are options of the user; ``prepare(**options)`` is called once before the
        run, for files that an option names. ``limit`` is the wall time (s) that one answer may
        take; a supervisor that takes longer is ended, and a person is asked. It runs in a process
        of its own and gets no world. With ``forecasts`` a run with it tries each operation in a
        second world first (level ``show``), and ``view.forecast`` has what came out.
        """
        name, limit = proper_name(name, "a supervisor"), seconds(limit, "limit")
        if not name.isidentifier() or name in self.supervisors:
            raise PluginError(f"the name {name!r} cannot be given to a supervisor")

        def keep(function: FunctionT) -> FunctionT:
            """Register the supervisor."""
            signature = signature_of(function, ("view",))
            self.supervisors[name] = SupervisorEntry(
                function, name, signature, limit, prepare, forecasts is True
            )
            return function

        return keep


def _must_know_all(pattern: Pattern, signature: Signature) -> None:
    for name in sorted(set(pattern.parameters) - set(signature.types)):
        raise PluginError(f"{pattern.text!r} has {{{name}}}, the function has no {name!r}")


def _must_name_all(pattern: Pattern, signature: Signature) -> None:
    named = set(pattern.parameters)
    for name in sorted(named - set(signature.types)):
        if not signature.any_name:
            raise PluginError(f"{pattern.text!r} has {{{name}}}, the function has no {name!r}")
    for name in sorted(signature.required - named):
        raise PluginError(f"the function needs {name!r}, {pattern.text!r} does not give it")


def _one_of(value: str, known: tuple[str, ...], what: str) -> None:
    if type(value) is not str or value not in known:
        raise PluginError(f"{what} is {value!r}, not one of {', '.join(known)}")
