"""What a blueprint is made of: State Branches (SBs), states, operations and flags."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

FactKey = tuple[str, int]
"""A fact: the name of its SB, and its digit, counted from 0 from the left."""
Configuration = Mapping[str, str]
"""The active state of every SB."""
Function = Callable[..., Any]
"""Code of an operation: it gets the world, the edge and its arguments. A generator moves once a
tick.
"""
Reader = Callable[[Any, FactKey], "str | None"]
"""Code of a sensor: it gets the world and the fact, and returns its value, None if it has none."""

HUMAN, SHARED, AUTOMATIC = LEVELS = ("human", "shared", "automatic")


def escape(name: str) -> str:
    """Return a name as one part of an address: ``~`` is ``~0``, ``/`` is ``~1``."""
    return name.replace("~", "~0").replace("/", "~1")


def address(*names: str) -> str:
    """Return the address of an SB, a state or an operation."""
    return "/".join(map(escape, names))


def unescape(part: str) -> str:
    """Return the name that a part of an address stands for."""
    return part.replace("~1", "/").replace("~0", "~")


def parts(text: str) -> tuple[str, ...]:
    """Return the names in an address."""
    return tuple(map(unescape, text.split("/")))


def fact_text(key: FactKey) -> str:
    """Return a fact as ``SB/digit``."""
    return f"{escape(key[0])}/{key[1]}"


def split_fact(text: str) -> FactKey | None:
    """Return the fact that a text names, or None."""
    branch, slash, digit = text.rpartition("/")
    if not (slash and branch and digit.isascii() and digit.isdecimal() and len(digit) < 7):
        return None
    return unescape(branch), int(digit)


@dataclass(frozen=True)
class Flag:
    """A fact as the dispatcher believes it: one digit of the states of an SB.

    ``sub`` is the SB that expands it. ``on`` and ``off`` are its values while the sub-SB is in
    ACTIVATING, and while it is not. ``failure`` has the values that mean a failure.
    """

    name: str = ""
    values: tuple[str, ...] = ()
    sub: str = ""
    on: str = "1"
    off: str = "0"
    read: Reader | None = None
    failure: tuple[str, ...] = ()
    critical: bool = False
    told_by_people: bool = False
    max_age: float | None = None
    meanings: Mapping[str, str] = field(default_factory=dict)
    unit: str = ""
    question: str = ""
    roles: tuple[str, ...] = ()
    answer_within: float | None = None
    escalates_to: str = ""


@dataclass(frozen=True)
class State:
    """A state: the values of its facts, and the target of each operation that is permitted."""

    facts: tuple[str, ...]
    operations: Mapping[str, str]
    title: str = ""


@dataclass(frozen=True)
class Operation:
    """What an operation runs, and the terms on which it may. Times are seconds."""

    run: Function
    title: str = ""
    cost: float = 1.0
    risk: str = ""
    actor: str = ""
    confirm: tuple[str, ...] = ()
    timeout: float = 20.0
    stop: str = "hold"
    resumes: bool = True
    touches: tuple[int, ...] = ()
    requires: Mapping[str, str] = field(default_factory=dict)
    load: bool = False
    question: str = ""
    roles: tuple[str, ...] = ()
    answer_within: float | None = None
    escalates_to: str = ""
    arguments: Mapping[str, Any] = field(default_factory=dict)

    @property
    def function(self) -> str:
        """The name of its function, for the log."""
        return self.run.__name__


@dataclass(frozen=True)
class Branch:
    """A State Branch: one finite state machine of the blueprint.

    ``operations`` has each operation by its name, and by ``State/Operation`` where one edge has
    terms of its own.
    """

    name: str
    initial: str
    activating: str
    flags: tuple[Flag, ...]
    states: Mapping[str, State]
    operations: Mapping[str, Operation]

    def facts(self, state: str) -> tuple[str, ...]:
        """Return the values of the facts of a state."""
        return self.states[state].facts

    def is_on(self, state: str, digit: int) -> bool:
        """Return whether a digit that a sub-SB expands is on in a state."""
        return self.facts(state)[digit] == self.flags[digit].on

    def operation(self, state: str, name: str) -> Operation:
        """Return the terms of one edge."""
        own = self.operations.get(f"{escape(state)}/{escape(name)}")
        return own or self.operations[escape(name)]

    def fact_name(self, digit: int) -> str:
        """Return the name of a fact, or ``Fact 1`` (counted from 1)."""
        return self.flags[digit].name or f"Fact {digit + 1}"

    @cached_property
    def failing(self) -> Mapping[str, str]:
        """Every failure state, with the facts that make it one."""
        found: dict[str, str] = {}
        for name, state in self.states.items():
            words = [
                f"{self.fact_name(digit)} would be {value}"
                for digit, value in enumerate(state.facts)
                if value in self.flags[digit].failure
            ]
            if words:
                found[name] = " and ".join(words)
        return found


@dataclass(frozen=True)
class Hazard:
    """Facts that must never hold together (``_hazards`` of the blueprint)."""

    name: str
    facts: tuple[tuple[FactKey, str], ...]

    @property
    def words(self) -> dict[str, str]:
        """Its facts with their values, as the log tells them."""
        return {fact_text(key): value for key, value in self.facts}


@dataclass(frozen=True)
class Blueprint:
    """The whole blueprint, and what the log of a run says about it.

    ``levels`` say who acts, senses and supervises where the blueprint declares it. ``left_out`` are
    annotations that nobody can read, with the reasons. ``findings`` is what inspection found when
    this code was generated. ``digests`` are those of behaviour, meaning and closure. ``record`` is
    that of the inspection record with which it was generated. ``identity`` is the part of the log's
    header that is always the same.
    """

    branches: Mapping[str, Branch]
    hazards: tuple[Hazard, ...]
    levels: Mapping[str, str]
    left_out: tuple[tuple[str, str], ...]
    findings: str
    behaviour: str
    digests: tuple[str, str, str]
    record: str
    identity: Mapping[str, Any]

    def __getitem__(self, branch: str) -> Branch:
        return self.branches[branch]

    def __iter__(self) -> Iterator[Branch]:
        return iter(self.branches.values())

    @cached_property
    def state_count(self) -> int:
        """The number of states of all SBs."""
        return sum(len(branch.states) for branch in self)

    @cached_property
    def edge_count(self) -> int:
        """The number of edges of all SBs."""
        return sum(len(state.operations) for branch in self for state in branch.states.values())

    def meets(self, hazard: Hazard, configuration: Configuration) -> bool:
        """Return whether all facts of a hazard hold in a configuration."""
        return all(
            self[name].facts(configuration[name])[digit] == value
            for (name, digit), value in hazard.facts
        )

    def sensed(self) -> Iterator[FactKey]:
        """Yield every fact that no sub-SB expands."""
        for branch in self:
            for digit, flag in enumerate(branch.flags):
                if not flag.sub:
                    yield branch.name, digit

    def flag(self, key: FactKey) -> Flag:
        """Return the flag of a fact."""
        return self[key[0]].flags[key[1]]


@dataclass(frozen=True)
class Edge:
    """One permitted step: an operation from one state of an SB to another.

    ``kind`` is its effect on digits that sub-SBs expand: pure, rise, fall or mixed. ``crossing`` is
    1 if it enters ACTIVATING of a sub-SB, -1 if it leaves it. ``acts`` says that its own function
    runs. ``cost`` is its own part of the cost of a route, ``price`` what was declared for it.
    ``fails`` names the failure that it leads into.
    """

    branch: str
    source: str
    name: str
    target: str
    terms: Operation = field(compare=False, repr=False)
    kind: str = "pure"
    falls: tuple[int, ...] = ()
    rises: tuple[int, ...] = ()
    crossing: int = 0
    load: bool = False
    acts: bool = True
    cost: float = 1.0
    price: float = 1.0
    requires: tuple[tuple[str, int, str], ...] = ()
    fails: str = ""
    address: str = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "address", address(self.branch, self.source, self.name))

    def __hash__(self) -> int:
        return hash(self.address)

    def __str__(self) -> str:
        return self.address

    @property
    def leaves_its_state(self) -> bool:
        """Whether it leads to another state."""
        return self.source != self.target
