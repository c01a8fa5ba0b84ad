"""What is bound: the code of every edge and the sensors of every fact, ready to be called."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import OperationNote
from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.errors import Place


@dataclass(frozen=True, slots=True)
class BoundOperation:
    """The code of one edge, ready to be called as ``function(world, **arguments)``.

    ``exact``: bound to exactly this ``State/Operation``. ``location``: the folder of the code.
    ``resumes`` and ``touches`` as in ``host.protocol.Bound``.
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


@dataclass(frozen=True, slots=True)
class BoundSensor:
    """One sensor of one fact, ready to be called as ``function(world, **arguments)``."""

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


@dataclass(frozen=True, slots=True)
class BoundCost:
    """The cost function of one edge: ``function(state, scene, history, **arguments)``."""

    name: str
    function: Callable[..., Any]
    arguments: Mapping[str, Any]
    location: str = ""


@dataclass(frozen=True, slots=True)
class BindingFault:
    """A binding that does not fit: what it is about, what is wrong, where it is written."""

    subject: str
    sentence: str
    place: Place | None = None

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else ""
        return f"{where}{self.subject} is not bound: {self.sentence}"


@dataclass(frozen=True)
class Bindings:
    """Everything that is bound in one world; an edge that is absent has no library function.

    ``named`` has the sensors a bindings file or ``_facts`` names for a fact, bound or not.
    """

    operations: Mapping[Address, BoundOperation]
    sensors: tuple[BoundSensor, ...]
    faults: tuple[BindingFault, ...] = ()
    named: Mapping[FactKey, tuple[str, ...]] = field(default_factory=dict)
    costs: Mapping[Address, BoundCost] = field(default_factory=dict)


def leaf_facts(blueprint: Blueprint) -> Iterator[tuple[StateBranch, int]]:
    """Every fact that is sensed rather than expanded by a sub-SB."""
    for branch in blueprint:
        for digit in range(branch.num_facts if branch.table else 0):
            if digit not in branch.subs:
                yield branch, digit


def noted_touches(branch: StateBranch, note: OperationNote) -> tuple[FactKey, ...]:
    """The facts that an annotation says an operation may leave anywhere when it is cancelled."""
    return tuple((branch.name, digit) for digit in note.touches if digit < branch.num_facts)
