"""Annotations: the ``_`` fields of an SB about facts, states, operations and the drawing.

Every SMSL reader skips them, so each is optional. Here each has a type and is checked. A field that
does not fit is left out of the meaning and reported (rule R29). Times are in seconds.

Notes are plain values. pydantic checks them. It is loaded only if there is a note to check.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, TypeVar

from annotated_types import Ge, Gt, Le, Lt, MaxLen

from smsl_studio.blueprint.continuum import levels_of
from smsl_studio.blueprint.edge_layout import FAR

if TYPE_CHECKING:
    from pydantic import TypeAdapter

Json = Any


class _AsWritten:
    """Marks a type whose values must be written as such: ``true`` is no number, ``"5"`` neither,
    and 1 is not ``true``. JSON tells them apart, and pydantic by itself does not.
    """

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Json]) -> Json:
        """Return the schema of the type, strict."""
        return {**handler(source), "strict": True}


AS_WRITTEN = _AsWritten()
Number = Annotated[float, AS_WRITTEN]
Whole = Annotated[int, AS_WRITTEN]
Switch = Annotated[bool, AS_WRITTEN]


class _Note:
    """The base of all notes. An entry with an unknown key does not fit."""

    __pydantic_config__: ClassVar = {"extra": "forbid"}


NoteT = TypeVar("NoteT", bound=_Note)


@dataclass(frozen=True)
class FactNote(_Note):
    """``_facts`` of an SB, by digit (``"0"``): the meaning of the fact, and its sensors."""

    name: str = ""
    values: dict[str, str] = field(default_factory=dict)
    on: str | None = None
    failure: tuple[str, ...] = ()
    critical: Switch = False
    sensors: tuple[str, ...] = ()
    unit: str = ""
    sources: dict[str, str] = field(default_factory=dict)
    """What measures the fact: sources by name, each with its unit (see ``predicates``)."""
    predicate: str | dict[str, str] = ""
    """For each value the condition on the sources under which the fact has it. A text is only for
    people."""
    range: dict[str, tuple[Number, Number]] = field(default_factory=dict)
    """The least and the largest number that a source can measure, in its unit."""
    log_rate: Annotated[Number, Gt(0), Le(100)] = 10.0
    """How often (Hz) the log of a run keeps what its sources measure, while its value stays."""
    aggregation: Literal["single", "all", "any", "k_of_n", "priority", "human"] = "single"
    k: Annotated[Whole, Ge(1)] | None = None
    max_age: Annotated[Number, Gt(0)] | None = None
    conflict_after: Annotated[Number, Ge(0), Le(60)] = 0.0
    """How long (s) its sensors may disagree before the fact is unknown."""
    question: str = ""
    """The question to a person who tells the fact. ``roles`` has one role for each person."""
    roles: tuple[str, ...] = ()
    answer_within: Annotated[Number, Gt(0)] | None = None
    escalates_to: str = ""


@dataclass(frozen=True)
class StateNote(_Note):
    """``_states`` of an SB, by state name."""

    title: str = ""
    note: str = ""
    safe: Switch | None = None
    facts: tuple[str, ...] = ()


@dataclass(frozen=True)
class Binding(_Note):
    """The library function an operation is bound to, with its arguments."""

    function: str
    arguments: dict[str, Json] = field(default_factory=dict)


@dataclass(frozen=True)
class ProcedureBinding(_Note):
    """The blueprint an operation runs to one of its states, one level down (see ``procedures``)."""

    blueprint: str
    """A file of the project, named from the file of the SB, or ``store:DIGEST``."""
    goal: str
    """The address of the state, such as ``SB1/State_cc``."""
    function: ClassVar[str] = ""
    arguments: ClassVar[dict[str, Json]] = {}


@dataclass(frozen=True)
class OperationNote(_Note):
    """``_operations`` of an SB, by operation name or by ``State/Operation`` (which wins)."""

    title: str = ""
    cost: Annotated[Number, Ge(0), Le(1e12)] | None = None
    """It has an upper bound, so that the cost of every route is finite."""
    risk: Literal["low", "medium", "high"] | None = None
    actor: Literal["human", "shared", "robot"] | None = None
    confirm: tuple[str, ...] = ()
    forecast: Literal["show", "ask", "hold"] | None = None
    """The least level of its forecast (see ``continuum.FORECAST_LEVELS``)."""
    duration: Annotated[Number, Ge(0)] | None = None
    timeout: Annotated[Number, Gt(0)] | None = None
    stop: Literal["abort", "hold", "finish"] | None = None
    resumes: Switch | None = None
    """Whether it goes on after a pause. None means as its library function declares."""
    touches: tuple[Annotated[Whole, Ge(0)], ...] = ()
    """Digits of its SB that are unknown after it was cancelled, besides those that its edge
    changes.
    """
    repeatable: Switch = False
    requires: dict[str, str] = field(default_factory=dict)
    """Facts of any SB that must hold before it begins: ``{"SB/digit": value}``."""
    subs: Literal["drive", "load"] = "drive"
    binding: Binding | ProcedureBinding | None = None
    question: str = ""
    """The request to the person who carries it out. ``roles`` says whose task that is."""
    roles: tuple[str, ...] = ()
    answer_within: Annotated[Number, Gt(0)] | None = None
    """The time (s) for every task about it. After half of it ``escalates_to`` is asked too."""
    escalates_to: str = ""


@dataclass(frozen=True)
class Hazard(_Note):
    """``_hazards`` of the file: facts (``"SB/digit": value``) that must never hold together."""

    name: str
    facts: dict[str, str]


PLAIN = OperationNote()
"""The note of an operation without annotations."""

LONGEST = 10_000
"""The largest number of characters of a text that is only drawn."""

_Coordinate = Annotated[Number, Gt(-FAR), Lt(FAR)]


@dataclass(frozen=True)
class DrawnNote(_Note):
    """``_notes`` of an SB, by key: a text that somebody put on the drawing. It has no meaning."""

    at: tuple[_Coordinate, _Coordinate]
    """Its upper left corner (pixels). If it hangs on a state, from the centre of the state."""
    text: Annotated[str, MaxLen(LONGEST)] = ""
    author: Annotated[str, MaxLen(LONGEST)] = ""
    date: Annotated[str, MaxLen(LONGEST)] = ""
    """The day on which it was written, such as ``2026-11-12``."""
    state: str = ""
    """The state that it hangs on, empty if it is free."""


@dataclass(frozen=True)
class Group(_Note):
    """``_groups`` in ``_layout`` of an SB, by key: states with a frame around them."""

    title: Annotated[str, MaxLen(LONGEST)] = ""
    states: tuple[str, ...] = ()


def read_hazards(raw: Json) -> tuple[tuple[Hazard, ...], tuple[tuple[tuple[str, ...], str], ...]]:
    """Return the hazards of a file, and the faults in them with their paths."""
    faults: list[tuple[tuple[str, ...], str]] = []
    if not isinstance(raw, list):
        return (), ((("_hazards",), "_hazards must be a list"),) if raw is not None else ()
    notes = [validated(Hazard, item, ("_hazards",), faults) for item in raw]
    return tuple(note for note in notes if note is not None), tuple(faults)


def read_levels(raw: Json) -> tuple[dict[str, str], tuple[tuple[tuple[str, ...], str], ...]]:
    """Return the levels in ``_levels`` of a file, and the faults in it with their paths."""
    if raw is None:
        return {}, ()
    if not isinstance(raw, dict):
        return {}, ((("_levels",), "_levels must be a map"),)
    found = {key: value for key, value in raw.items() if value in levels_of(key)}
    odd = (key for key in raw if key not in found)
    return found, tuple(
        (("_levels", key), f"a level is one of {', '.join(levels_of(key))}") for key in odd
    )


def validated(
    model: type[NoteT], raw: Json, path: tuple[str, ...], faults: list[Any]
) -> NoteT | None:
    """Return the note in ``raw``. A key that does not fit is added to ``faults``, and the others
    count.
    """
    return with_words(model, raw, path, faults)[0]


def with_words(
    model: type[NoteT], raw: Json, path: tuple[str, ...], faults: list[Any]
) -> tuple[NoteT | None, frozenset[str]]:
    """Return the note in ``raw``, and the keys that fit. The note is None if a required key is
    missing.
    """
    from pydantic import ValidationError

    kind: Any = model
    try:
        return _adapter(kind).validate_python(raw), frozenset(raw)
    except ValidationError as error:
        odd = set()
        for fault in error.errors(include_url=False):
            where = [str(part) for part in fault["loc"]]
            if _other_binding(raw) in where:
                continue
            inner = ".".join(part for part in where if part not in _BINDINGS)
            odd.add(inner.partition(".")[0])
            words = fault["msg"].replace("valid tuple", "list").replace("valid dictionary", "map")
            faults.append((path, f"{inner}: {words}" if inner else words))
    fitting = {} if not isinstance(raw, dict) else {k: v for k, v in raw.items() if k not in odd}
    if not fitting or len(fitting) == len(raw):
        return None, frozenset()
    return with_words(model, fitting, path, [])


_BINDINGS = ("Binding", "ProcedureBinding")


def _other_binding(raw: Json) -> str:
    """Return the kind of binding that a note does not mean. Faults in it are not told."""
    said = raw.get("binding") if isinstance(raw, dict) else None
    return _BINDINGS[not (isinstance(said, dict) and "blueprint" in said)]


@lru_cache(maxsize=8)
def _adapter(model: type[Any]) -> TypeAdapter[Any]:
    from pydantic import TypeAdapter

    return TypeAdapter(model)
