"""Bindings: the code of every edge and the sensors of every fact, ready to be called."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import OperationNote
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import Place
from smsl_studio.library.fact_default import FactDefault
from smsl_studio.library.operation_library import Availability


class BoundOperation(NamedTuple):
    """The code of one edge, ready to be called as ``function(world, **arguments)``. It is a light
    value, because the table world makes one whenever an operation begins.

    ``exact`` says that the binding names exactly this ``State/Operation``. ``location`` is the
    folder of the code. ``timeout`` is in simulated seconds. ``resumes`` and ``touches`` have the
    same meaning as in ``host.protocol.Bound``. ``available`` says whether the code can be used now.
    """

    name: str
    function: Callable[..., Any]
    arguments: Mapping[str, Any]
    exact: bool
    stop: str
    timeout: float
    location: str = ""
    resumes: bool = True
    touches: tuple[FactKey, ...] = ()
    available: Availability | None = None
    generated: bool = False
    """Whether nobody has written the code by hand: it runs in a closed process alone."""


@dataclass(frozen=True, slots=True)
class BoundSensor:
    """One sensor of one fact, ready to be called as ``function(world, **arguments)``.

    ``period`` and ``max_age`` are in simulated seconds. ``digit`` counts from 0.
    """

    name: str
    branch: str
    digit: int
    period: float
    max_age: float
    aggregation: str
    function: Callable[..., Any]
    arguments: Mapping[str, Any]
    location: str = ""
    words: Mapping[str, str] = field(default_factory=dict)
    unit: str = ""
    scale: float = 1.0
    """A sensor with a ``unit`` measures. Its numbers times ``scale`` are in this unit."""
    default: FactDefault | None = None
    """The predicates that decide its value in place of ``function``."""


@dataclass(frozen=True, slots=True)
class BoundCost:
    """The cost function of one edge, called as ``function(state, scene, history, **arguments)``."""

    name: str
    function: Callable[..., Any]
    arguments: Mapping[str, Any]
    location: str = ""


@dataclass(frozen=True, slots=True)
class BindingFault:
    """A binding that does not fit: its subject, a sentence, and the place where it is written."""

    subject: str
    sentence: str
    place: Place | None = None

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else ""
        return f"{where}{self.subject} is not bound: {self.sentence}"


@dataclass(frozen=True)
class Bindings:
    """All bindings in one world. An edge without an entry has no library function.

    ``named`` has the names of the sensors that a bindings file or ``_facts`` gives to a fact, even
    if no such sensor exists.
    """

    operations: Mapping[Address, BoundOperation]
    sensors: tuple[BoundSensor, ...]
    faults: tuple[BindingFault, ...] = ()
    named: Mapping[FactKey, tuple[str, ...]] = field(default_factory=dict)
    costs: Mapping[Address, BoundCost] = field(default_factory=dict)


def joined(own: Bindings, parts: Sequence[Bindings]) -> Bindings:
    """Return the bindings of a blueprint with those of its procedures. Their SBs have other
    names.
    """
    every = (own, *parts)
    operations: dict[Address, BoundOperation] = {}
    costs: dict[Address, BoundCost] = {}
    named: dict[FactKey, tuple[str, ...]] = {}
    for one in every:
        operations.update(one.operations.items())
        costs.update(one.costs)
        named.update(one.named)
    sensors = tuple(sensor for one in every for sensor in one.sensors)
    faults = tuple(fault for one in every for fault in one.faults)
    return Bindings(operations, sensors, faults, named, costs)


def leaf_facts(blueprint: Blueprint) -> Iterator[tuple[StateBranch, int]]:
    """Yield every fact that sensors read, as SB and digit. Facts that a sub-SB expands are left
    out."""
    for branch in blueprint:
        for digit in range(branch.num_facts if branch.table else 0):
            if digit not in branch.subs:
                yield branch, digit


def noted_touches(branch: StateBranch, note: OperationNote) -> tuple[FactKey, ...]:
    """Return the facts that may have any value after an operation is cancelled, as an annotation
    declares them."""
    if not note.touches:
        return ()
    return tuple((branch.name, digit) for digit in note.touches if digit < branch.num_facts)
