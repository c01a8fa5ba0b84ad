"""A host for tests: facts on a table, and operations that fail in every possible way."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.configuration import Hierarchy, standing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import HostError
from smsl_studio.host.protocol import (
    Bound,
    Happened,
    OpenedWorld,
    Outcome,
    Priced,
    SensorInfo,
    Tick,
)
from smsl_studio.monitor.sample import Sample
from smsl_studio.world.protocol import Shape

TICK = 0.1


@dataclass
class Fault:
    """What an operation does instead: how it ends, and the facts it writes (None: its target's)."""

    outcome: Outcome = Outcome.RETURNED
    writes: Mapping[FactKey, str | None] | None = None
    hangs: bool = False


@dataclass
class FakeHost:
    """Every edge is bound but the ``unbound``; every leaf fact is sensed but the ``blind``.

    ``exact`` are edges bound to exactly them. ``lasts`` is how many ticks an operation takes.
    ``broken_at`` is the tick at which the host dies. ``calls`` tells what was asked of it.
    """

    blueprint: Blueprint
    faults: dict[str, Fault] = field(default_factory=dict)
    exact: Collection[str] = ()
    unbound: Collection[str] = ()
    blind: Collection[FactKey] = ()
    lasts: int = 1
    settle: float = 0.0
    stop: str = "hold"
    timeout: float = 1.0
    broken_at: int | None = None
    hardware: bool = False
    resumes: bool = True
    touches: tuple[FactKey, ...] = ()

    def __post_init__(self) -> None:
        self.facts: dict[FactKey, str | None] = {}
        self.calls: list[str] = []
        self.now = 0
        self._sequence = 0
        self._edge: Address | None = None
        self._left = 0
        self._hierarchy = Hierarchy(self.blueprint)

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        for name, state in start.items():
            self._write(name, state)
        edges = (edge.address for branch in self.blueprint for edge in branch.edges())
        bound = {
            edge: Bound(
                "fake",
                str(edge) in self.exact,
                self.stop,
                self.timeout,
                self.resumes,
                self.touches,
            )
            for edge in edges
            if str(edge) not in self.unbound
        }
        sensors = tuple(
            SensorInfo(f"{branch}_{digit}", branch, digit, TICK, 0.3)
            for branch, digit in self.facts
            if (branch, digit) not in self.blind
        )
        return OpenedWorld("fake", TICK, self.hardware, bound, sensors, (), self.settle)

    def sense(self) -> tuple[Sample, ...]:
        self._alive()
        return self._samples()

    def begin(self, edge: Address) -> None:
        self._alive()
        assert self._edge is None
        self.calls.append(str(edge))
        self._edge, self._left = edge, self.lasts

    def tick(self) -> Tick:
        self._alive()
        self.now += 1
        outcome = self._resume()
        return Tick(self.now * TICK, outcome, self._samples(), "")

    def cancel(self, mode: str) -> None:
        self.calls.append(f"cancel {mode}")
        self._edge = None

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        self.calls.append(f"disturb {target} {kind}")
        return (target,)

    def inject(self, fault: str, **parameters: float | str) -> None:
        self.calls.append(f"inject {fault}")

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        return Priced()

    def suppose(self, edge: Address) -> None:
        pass

    def poses(self) -> tuple[float, ...]:
        return ()

    def status(self) -> Mapping[str, str]:
        return {}

    def check(self) -> None:
        """It is always there."""

    def close(self) -> None:
        self.calls.append("close")

    def shapes(self) -> tuple[Shape, ...]:
        return ()

    def _alive(self) -> None:
        if self.broken_at is not None and self.now >= self.broken_at:
            raise HostError("the world's process was killed")

    def _resume(self) -> Outcome:
        if self._edge is None:
            return Outcome.IDLE
        fault = self.faults.get(str(self._edge), Fault())
        self._left -= 1
        if fault.hangs or self._left > 0:
            return Outcome.RUNNING
        if fault.writes is None:
            self._carry_out(self._edge)
        else:
            self.facts.update(fault.writes)
        self._edge = None
        return fault.outcome

    def _carry_out(self, edge: Address) -> None:
        branch = self.blueprint[edge.branch]
        target = branch.table[edge.state][edge.operation]
        self._write(edge.branch, target)
        if branch.operation_note(edge.state, edge.operation).subs == "load":
            for digit, sub in branch.subs.items():
                on = branch.is_on(target, digit)
                if on != branch.is_on(edge.state, digit):
                    below = self.blueprint[sub]
                    state = below.activating if on else below.initial
                    for name, there in standing(self._hierarchy, sub, state).items():
                        self._write(name, there)

    def _write(self, name: str, state: str) -> None:
        branch = self.blueprint[name]
        for digit, value in enumerate(branch.facts(state)):
            if digit not in branch.subs:
                self.facts[name, digit] = value

    def _samples(self) -> tuple[Sample, ...]:
        self._sequence += 1
        return tuple(
            Sample(branch, digit, f"{branch}_{digit}", value, self.now * TICK, self._sequence)
            for (branch, digit), value in self.facts.items()
        )
