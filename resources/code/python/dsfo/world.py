"""Worlds: what moves and is sensed, in ticks. The table world keeps facts and has no physics.

A world of your own has the members of ``World``. Pass it to ``Dispatcher``.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping
from contextlib import suppress
from logging import getLogger
from typing import Any, NamedTuple, Protocol

from .elements import Blueprint, Configuration, Edge, FactKey
from .hierarchy import Hierarchy, standing

logger = getLogger(__name__)
NOTHING: Mapping[FactKey, str] = {}


class World(Protocol):
    """What the dispatcher needs of a world. Times are seconds.

    ``tick`` is the length of one step. ``settle`` is how long the world needs after an operation
    until a state check decides.
    """

    name: str
    tick: float
    settle: float

    def begin(self, start: Configuration) -> None:
        """Take the world to the start of a run, or check that it is there."""

    def step(self) -> None:
        """Let one tick pass."""

    def sense(self, fact: FactKey) -> str | None:
        """Return the value of a fact now, None if no sensor has one."""

    def brake(self) -> None:
        """Stop all that moves."""


class TableWorld:
    """A table of facts: an operation writes the facts of its target (clause 14)."""

    name, tick, settle = "table", 0.05, 0.0

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._facts: dict[FactKey, str] = {}
        self._fault, self._fault_facts, self._fault_at = "", NOTHING, ""

    def begin(self, start: Configuration) -> None:
        """Write the facts of the start."""
        self._facts = {}
        for name, state in start.items():
            self._facts.update(self.facts_of(name, state))

    def step(self) -> None:
        """Do nothing: a table does not move."""

    def brake(self) -> None:
        """Do nothing: there are no drives."""

    def sense(self, fact: FactKey) -> str | None:
        """Return the value of a fact."""
        return self._facts.get(fact)

    def carry_out(self, edge: Edge) -> Generator[None, None, bool | None]:
        """Write the facts of an edge's target, unless a fault was injected."""
        if self._fault and self._fault_at in ("", edge.address):
            fault, facts = self._fault, self._fault_facts
            self.spoil("")
            if fault == "raise":
                raise RuntimeError("it was made to raise")
            while fault == "hang":
                yield
            self._facts.update(facts)
            return False if fault == "fail" else None
        self._facts.update(self.facts_of(edge.branch, edge.target))
        if edge.load:
            self._facts.update(self._loaded(edge))
        return None

    def facts_of(self, branch: str, state: str) -> dict[FactKey, str]:
        """Return the facts of a state without those that sub-SBs expand."""
        own = self._blueprint[branch]
        values = enumerate(own.facts(state))
        return {(branch, digit): value for digit, value in values if not own.flags[digit].sub}

    def _loaded(self, edge: Edge) -> dict[FactKey, str]:
        """Return the facts of the sub-SBs that a ``load`` edge sets itself."""
        known, found = Hierarchy(self._blueprint), dict[FactKey, str]()
        subs = dict(known.subs[edge.branch])
        for digit in sorted((*edge.falls, *edge.rises)):
            sub = subs[digit]
            for name, state in standing(known, sub, known.rest(sub, digit in edge.rises)).items():
                found.update(self.facts_of(name, state))
        return found

    # faults, for trials --------------------------------------------------------------------------

    def set_fact(self, fact: FactKey, value: str) -> None:
        """Change one fact, as if somebody had done it."""
        self._facts[fact] = value

    def spoil(self, fault: str, facts: Mapping[FactKey, str] = NOTHING, at: str = "") -> None:
        """Set what befalls the next operation, or the one with this address."""
        self._fault, self._fault_facts, self._fault_at = fault, facts, at


class Tick(NamedTuple):
    """What one tick brought: the outcome of the running function, and its message.

    ``outcome`` is empty while it runs, or if none does; else returned, failed or raised.
    """

    outcome: str
    message: str = ""


class Host:
    """Runs one function at a time in a world, tick by tick."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.ticks = 0
        self._edge: Edge | None = None
        self._running: Generator[Any, Any, Any] | None = None

    @property
    def time(self) -> float:
        """Seconds since the start, counted in ticks."""
        return self.ticks * self.world.tick

    def begin(self, edge: Edge) -> None:
        """Start the function of an edge. It first moves at the next tick."""
        self._edge, self._running = edge, None

    def tick(self) -> Tick:
        """Let the function and the world go on for one tick."""
        found = self._resume() if self._edge is not None else Tick("")
        self.world.step()
        self.ticks += 1
        return found

    def cancel(self) -> None:
        """Drop the running function and brake the world."""
        self._drop()
        self.world.brake()

    def _drop(self) -> None:
        running, self._edge, self._running = self._running, None, None
        if running is not None:
            with suppress(Exception):
                running.close()

    def _resume(self) -> Tick:
        edge = self._edge
        assert edge is not None, "tick asks only while a function runs"
        try:
            if self._running is None:
                begun = edge.terms.run(self.world, edge, **edge.terms.arguments)
                if not isinstance(begun, Generator):
                    return self._ended(edge, begun)
                self._running = begun
            next(self._running)
        except StopIteration as end:
            return self._ended(edge, end.value)
        except Exception as error:
            logger.debug("%s raised an error", edge, exc_info=True)
            self._edge = self._running = None
            return Tick("raised", f"{type(error).__name__}: {error}")
        return Tick("")

    def _ended(self, edge: Edge, value: object) -> Tick:
        self._edge = self._running = None
        if value is False:
            return Tick("failed", f"{edge.terms.function} says that it failed")
        return Tick("returned", value[:1000] if isinstance(value, str) else "")
