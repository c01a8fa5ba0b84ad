"""The local host: world and library code run in this process, tick by tick.

Tests and headless runs use it. The child of the process host uses it, too, so both hosts give the
same trace.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.editing.generated_edges import with_edge
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import HostError, RunRefused, StudioError
from smsl_studio.host.bound_edges import bounds_of
from smsl_studio.host.brief import finite, short_words
from smsl_studio.host.call import Call
from smsl_studio.host.call_context import HostErrors, prints_aside
from smsl_studio.host.cost_functions import CostFunctions
from smsl_studio.host.fact_rules import rules_of
from smsl_studio.host.guard_functions import GuardFunctions
from smsl_studio.host.injections import Injections
from smsl_studio.host.protocol import (
    IDLE,
    RUNNING,
    Bound,
    Happened,
    OpenedWorld,
    Priced,
    Tick,
    tick_of,
)
from smsl_studio.host.sensor_schedule import SensorSchedule
from smsl_studio.host.told_sensors import info_of
from smsl_studio.library.bindings import bind
from smsl_studio.library.bindings_file import BindingsFile, bindings_beside
from smsl_studio.library.bound import Bindings, joined
from smsl_studio.library.entries import FaultEntry, WorldEntry
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import discover
from smsl_studio.library.table import facts_of
from smsl_studio.library.table_faults import table_faults
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.sample import Sample
from smsl_studio.world.engines import TABLE, make_engine
from smsl_studio.world.protocol import World


class LocalHost:
    """A world, and the library code that is bound to a blueprint in it.

    ``plugin_paths`` are plugin folders that are searched before all others. ``loaded`` are plugins
    that were found before. ``file`` is the bindings file that was signed; None means the one
    beside the blueprint. The printed output of library code goes to standard error.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        world: str,
        seed: int = 0,
        plugin_paths: Sequence[Path] = (),
        loaded: Loaded | None = None,
        file: BindingsFile | None = None,
    ) -> None:
        self._robot = ""
        self._trial = False
        self._blueprint = blueprint
        self._parts: tuple[Blueprint, ...] = ()
        self._name = world
        self._seed = seed
        self._paths = tuple(plugin_paths)
        self._loaded = loaded
        self._file = file
        self._bindings: Bindings | None = None
        self._bound: Mapping[Address, Bound] = {}
        self._engine: World | None = None
        self._subject: Any = None
        self._location = ""
        self._settle = 0.0
        self._call: Call | None = None
        self._sensing = SensorSchedule((), 1.0, 0)
        self._injecting = Injections(world, {})
        self._offered: Mapping[str, FaultEntry] | None = None
        self._costing = CostFunctions({})
        self._guarding = GuardFunctions({})
        self._stepping = self._mending("broke")
        self._ticks = 0
        self._boot = 0
        self._poses: tuple[float, ...] = ()

    def carry(self, parts: Sequence[Blueprint]) -> None:
        """Let blueprints of procedures use the same world. This is said before it is built."""
        self._parts = tuple(parts)

    def choose(self, robot: str) -> None:
        """Build the world with a robot; empty means its usual one. This is said before it is
        built."""
        self._robot = robot

    def try_out(self) -> None:
        """Also bind generated functions that have not passed their sweep. This is said before it is
        built."""
        self._trial = True

    def is_generated(self, edge: Address) -> bool:
        """Whether nobody has written the function of an edge by hand."""
        bound = self._bindings.operations.get(edge) if self._bindings else None
        return bound is not None and bound.generated

    def prepare(self) -> None:
        """Find the code and build the world, so that ``open`` is quick. It raises the same errors
        as ``open``."""
        if self._engine is None:
            with prints_aside():
                engine = self._build()
                self._bind()
                with self._mending("cannot be drawn"):
                    engine.shapes()

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Build the world and put it into the states ``start`` (SB -> state).

        A second call starts again at time zero in the new states. WorldError: the world is unknown
        or does not suit the blueprint. RunRefused: the world cannot be put into the start states.
        HostError: its code raised an error. PluginError: the bindings file is invalid.
        """
        with prints_aside():
            engine, bindings = self._engine or self._build(), self._bind()
            self._drop()
            self._ticks, self._boot = 0, self._boot + 1
            self._arrange(engine, start)
            self._stepping = self._mending("broke")
            self._injecting = self._faults()
            self._costing = CostFunctions(bindings.costs)
            self._guarding = GuardFunctions(bindings.operations if self._name != TABLE else {})
            self._poses = ()
            with self._mending("cannot be drawn"):
                shapes = engine.shapes()
        self._sensing = SensorSchedule(
            bindings.sensors, engine.tick, self._boot, self._values, self._seed
        )
        return OpenedWorld(
            world=self._name,
            tick=engine.tick,
            hardware=self._entry.hardware if self._entry else engine.hardware,
            bound=self._bound,
            sensors=tuple(info_of(sensor) for sensor in bindings.sensors),
            shapes=shapes,
            settle=self._settle,
            faults=tuple(map(str, bindings.faults)),
            rules=self._rules(bindings),
            world_faults=self._injecting.names,
            priced=bool(bindings.costs),
            guarded=bool(self._guarding),
        )

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor once. The simulated time does not move."""
        engine = self._engine or self._standing()
        # As ``prints_aside``, without its calls: this is done at every tick.
        kept, sys.stdout = sys.stdout, sys.stderr
        try:
            return self._sensing.all(self._subject, self._ticks * engine.tick)
        finally:
            sys.stdout = kept

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge; it first moves at the next tick."""
        self._standing()
        if self._call is not None:
            raise HostError(f"{edge} cannot begin: another operation runs")
        bound = self._bindings.operations.get(edge) if self._bindings else None
        if bound is None:
            raise HostError(f"{edge} has no library function in the world {self._name!r}")
        self._call = Call(bound, self._subject)

    def tick(self) -> Tick:
        """Advance the world and the running call by one tick. HostError if the world's code raises
        an error."""
        engine = self._engine or self._standing()
        outcome, message = IDLE, ""
        kept, sys.stdout = sys.stdout, sys.stderr
        try:
            if self._call is not None:
                outcome, message = self._call.resume()
                if outcome is not RUNNING:
                    self._call = None
            if self._injecting.ongoing:
                self._injecting.resume()
            try:
                engine.step()
            except BaseException as error:
                self._stepping.mend(error)
                raise
            self._ticks += 1
            time = self._ticks * engine.tick
            samples = self._sensing.due(self._subject, self._ticks, time)
        finally:
            sys.stdout = kept
        return tick_of((time, outcome, samples, message))

    def cancel(self, mode: str) -> None:
        """End the running call. ``abort`` and ``hold`` brake the world and drop the call;
        ``finish`` lets it run on."""
        engine = self._standing()
        if mode == "finish":
            return
        with prints_aside(), self._mending("broke when it was braked"):
            self._drop()
            engine.brake()

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb a sensor, or all sensors of one fact, until the world is opened again."""
        self._standing()
        return self._sensing.disturb(target, kind, parameters)

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Cause a fault of the world. It lasts at most until the world is opened again."""
        self._standing()
        with prints_aside():
            self._injecting.inject(self._subject, fault, parameters)

    def extend(self, edge: Address, target: str) -> tuple[Bound | None, bool]:
        """Bind one more edge (see ``Extending``). Nothing of the library runs."""
        self._standing()
        self._blueprint, self._bindings = with_edge(self._blueprint, edge, target), None
        with prints_aside():
            found = self._bind().operations.get(edge)
        if found is None:
            return None, False
        guarded = found.available is not None
        if guarded:
            self._guarding.add(edge, found)
        return self._bound[edge], guarded

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions and the guards. Return the answers that have changed since the
        last call."""
        self._standing()
        with prints_aside():
            priced = self._costing.ask(scene, happened)
            closed = self._guarding.ask(self._subject)
            return replace(priced, closed=closed) if closed else priced

    def suppose(self, edge: Address) -> None:
        """Make the guard of an edge agree, if the edge has a premise. HostError if the premise
        raises an error."""
        self._standing()
        bound = self._bindings.operations.get(edge) if self._bindings else None
        if bound is None or bound.available is None or bound.available.premise is None:
            return
        with prints_aside(), self._mending(f"cannot be prepared for {edge.operation}"):
            bound.available.premise(self._subject, **bound.arguments)

    def poses(self) -> tuple[float, ...]:
        """Return the newest poses for drawing. The tuple is empty if no world is open."""
        if self._engine is None:
            return ()
        with self._mending("cannot be drawn"):
            self._poses = finite(self._engine.poses(), self._poses)
        return self._poses

    def status(self) -> Mapping[str, str]:
        """Return the world's short status texts for people."""
        if self._engine is None:
            return {}
        with self._mending("cannot tell how it stands"):
            return short_words(self._engine.status())

    def check(self) -> None:
        """Do nothing: the host runs in this process, so it cannot be gone."""

    def close(self) -> None:
        """Free the world. A second call does nothing."""
        self._drop()
        if self._engine is not None:
            self._engine.close()
        self._engine = self._subject = None

    def _standing(self) -> World:
        if self._engine is None:
            raise HostError("the host is not open")
        return self._engine

    def _rules(self, bindings: Bindings) -> dict[FactKey, FactRule]:
        if self._name == TABLE:
            return {}
        rules = rules_of(self._blueprint, bindings)
        for part in self._parts:
            rules |= rules_of(part, bindings)
        return rules

    def _values(self, fact: FactKey) -> tuple[str, ...]:
        return self._branch(fact[0]).alphabet[fact[1]]

    def _branch(self, name: str) -> StateBranch:
        """Return an SB of the blueprint or of one of its procedures."""
        own = (one for one in (self._blueprint, *self._parts) if name in one.branches)
        return next(own, self._blueprint)[name]

    def _drop(self) -> None:
        if self._call is not None:
            self._call.drop()
        self._call = None

    @property
    def _entry(self) -> WorldEntry | None:
        return None if self._name == TABLE else self._plugins().world(self._name)[1]

    def _plugins(self) -> Loaded:
        if self._loaded is None:
            self._loaded = Loaded() if self._name == TABLE else discover(self._paths)
        return self._loaded

    def _faults(self) -> Injections:
        if self._offered is None:
            table = self._name == TABLE
            found = table_faults(self._blueprint) if table else None
            self._offered = found or self._plugins().faults_of(self._name)
        return Injections(self._name, self._offered, "" if self._name == TABLE else self._location)

    def _bind(self) -> Bindings:
        if self._bindings is None:
            table = self._name == TABLE
            file = None if table else self._file or bindings_beside(self._blueprint.file)
            own = bind(self._blueprint, self._plugins(), self._name, file, trial=self._trial)
            self._bindings = joined(own, self._part_bindings()) if self._parts else own
            self._bound = bounds_of(self._bindings)
        return self._bindings

    def _part_bindings(self) -> list[Bindings]:
        table = self._name == TABLE
        files = [None if table else bindings_beside(part.file) for part in self._parts]
        pairs = zip(self._parts, files, strict=True)
        return [bind(part, self._plugins(), self._name, file) for part, file in pairs]

    def _build(self) -> World:
        if self._name == TABLE:
            self._engine = self._subject = make_engine(TABLE, TABLE)
            return self._engine
        plugin, entry = self._plugins().world(self._name)
        self._location, self._settle = plugin.location, entry.settle
        robot = self._plugins().robot(self._name, self._robot)
        given = () if robot is None else (robot,)
        engine = make_engine(entry.engine, self._name)
        try:
            with self._mending("broke while it was built", StudioError):
                built = entry.build(engine, self._blueprint, self._seed, *given)
        except StudioError:
            engine.close()
            raise
        self._engine, self._subject = engine, engine if built is None else built
        return engine

    def _arrange(self, engine: World, start: Mapping[str, str]) -> None:
        facts: dict[FactKey, str] = {}
        for name, state in start.items():
            if self._name == TABLE or name in self._blueprint.branches:
                facts |= facts_of(self._branch(name), state)
        if self._name == TABLE:
            self._engine = self._subject = make_engine(TABLE, TABLE)
            self._subject.set_facts(facts)
            return
        plugin, _ = self._plugins().world(self._name)
        arranger = plugin.library.arrangers.get(self._name)
        if arranger is None:
            return
        with self._mending("broke at the start", StudioError):
            try:
                arranger(self._subject, facts)
            except HostError:
                raise
            except StudioError as error:
                raise RunRefused(error.sentence, error.place, error.advice) from None

    def _mending(self, what: str, passes: type[BaseException] = KeyboardInterrupt) -> HostErrors:
        """Return a context that turns every error of library code into a HostError, except errors
        of the class ``passes``."""
        return HostErrors(f"the world {self._name!r} {what}", self._location, passes)
