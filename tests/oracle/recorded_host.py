"""A table world that records, in plain values, every call to it and every answer.

The oracle judges by this record of samples and calls, not by the events of the dispatcher. A case
may also ask for features that the table world does not have: a second sensor, operations that last,
edges without a function, functions bound to one edge, facts that nobody senses, and a time to
settle.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import (
    Bound,
    Happened,
    OpenedWorld,
    Outcome,
    Priced,
    SensorInfo,
    Tick,
)
from smsl_studio.monitor.aggregate import FactRule
from smsl_studio.monitor.sample import GOOD, Sample
from smsl_studio.world.protocol import Shape

EYE_AGE = 0.3
"""Seconds after which a reading of the second sensor is stale."""


class RecordedHost:
    """The table world of a blueprint, as a case wants it.

    ``world`` has ``settle`` (s), ``unbound`` and ``exact`` (edges), ``blind`` (facts without a
    sensor), ``eyes`` (fact -> what its second sensor does: lists of first tick, last tick, word,
    value) and ``lasts`` (edge -> ticks before its function moves anything). ``calls`` is the
    record: lists of a word and plain values.
    """

    def __init__(self, blueprint: Blueprint, world: Mapping[str, Any], seed: int = 0) -> None:
        self.calls: list[list[Any]] = []
        self._inner = LocalHost(blueprint, "table", seed)
        self._blueprint = blueprint
        self._world = world
        self._now = 0
        self._spoken = 0
        self._waits: tuple[Address, int] | None = None
        self._blind = {_key(fact) for fact in world.get("blind", ())}
        self._eyes = {_key(fact): acts for fact, acts in world.get("eyes", {}).items()}
        self._tables: list[tuple[str, int]] = []

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Open the table world, with the sensors and functions that the case wants."""
        opened = self._inner.open(start)
        sensors = [one for one in opened.sensors if (one.branch, one.digit) not in self._blind]
        for branch, digit in self._eyes:
            sensors.append(SensorInfo(_eye(branch, digit), branch, digit, opened.tick, EYE_AGE))
        unbound, exact = set(self._world.get("unbound", ())), set(self._world.get("exact", ()))
        bound: dict[Address, Bound] = {}
        for edge, function in opened.bound.items():
            if str(edge) not in unbound:
                bound[edge] = replace(function, exact=str(edge) in exact)
        self._tables = [(one.branch, one.digit) for one in opened.sensors]
        return replace(
            opened,
            bound=bound,
            sensors=tuple(sensors),
            settle=float(self._world.get("settle", 0.0)),
            rules={key: self._rule(key) for key in self._eyes},
        )

    def sense(self) -> tuple[Sample, ...]:
        samples = self._all(self._inner.sense(), self._now * 0.05)
        self.calls.append(["sense", _plain(samples)])
        return samples

    def begin(self, edge: Address) -> None:
        self.calls.append(["begin", str(edge)])
        lasts = self._world.get("lasts", {}).get(str(edge), 0)
        if lasts:
            self._waits = (edge, lasts)
        else:
            self._inner.begin(edge)

    def tick(self) -> Tick:
        waits = self._waits
        if waits is not None:
            edge, left = waits
            self._waits = (edge, left - 1)
            if left == 0:
                self._waits = None
                self._inner.begin(edge)
        told = self._inner.tick()
        self._now += 1
        outcome = Outcome.RUNNING if self._waits is not None else told.outcome
        samples = self._all(told.samples, told.time)
        table = {f"{name}/{digit}": self._fact(name, digit) for name, digit in self._tables}
        self.calls.append(["tick", told.time, outcome.value, _plain(samples), table])
        return Tick(told.time, outcome, samples, told.message)

    def cancel(self, mode: str) -> None:
        self.calls.append(["cancel", mode])
        if mode != "finish":
            self._waits = None
        self._inner.cancel(mode)

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        met = self._inner.disturb(target, kind, **parameters)
        self.calls.append(["disturb", target, kind, dict(parameters)])
        return met

    def inject(self, fault: str, **parameters: float | str) -> None:
        self._inner.inject(fault, **parameters)
        self.calls.append(["inject", fault, dict(parameters)])

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        return self._inner.costs(scene, happened)

    def suppose(self, edge: Address) -> None:
        self._inner.suppose(edge)

    def poses(self) -> tuple[float, ...]:
        return self._inner.poses()

    def status(self) -> Mapping[str, str]:
        return self._inner.status()

    def check(self) -> None:
        self._inner.check()

    def close(self) -> None:
        self._inner.close()

    def shapes(self) -> tuple[Shape, ...]:
        return ()

    def _rule(self, key: tuple[str, int]) -> FactRule:
        note = self._blueprint[key[0]].fact_note(key[1])
        if note is None:
            return FactRule()
        return FactRule(note.aggregation, note.k, note.critical, note.conflict_after)

    def _all(self, samples: tuple[Sample, ...], time: float) -> tuple[Sample, ...]:
        """What the sensors say that the case leaves, and its second sensors."""
        kept = [one for one in samples if one.fact not in self._blind]
        self._spoken += 1
        for (branch, digit), acts in self._eyes.items():
            says = self._fact(branch, digit)
            silent = False
            for first, last, word, value in acts:
                if first <= self._now <= last:
                    silent = word == "silent"
                    says = value
            if not silent:
                eye = _eye(branch, digit)
                kept.append(Sample(branch, digit, eye, says, time, self._spoken, 1, "", GOOD))
        return tuple(kept)

    def _fact(self, branch: str, digit: int) -> str | None:
        engine: Any = self._inner._engine  # the table itself, for the record
        found: str | None = engine.fact(branch, digit)
        return found


def _eye(branch: str, digit: int) -> str:
    return f"eye_{branch}_{digit}"


def _key(fact: str) -> tuple[str, int]:
    name, _, digit = fact.rpartition("/")
    return name, int(digit)


def _plain(samples: Sequence[Sample]) -> list[list[Any]]:
    return [
        [f"{s.branch}/{s.digit}", s.source, s.value, s.quality, s.boot, s.sequence, s.time]
        for s in samples
    ]
