"""Annotations: what the ``_`` fields of an SB say about facts, states and operations.

Every SMSL reader skips them, so each is optional; each is typed and checked here. A field that
does not fit is left out of the meaning and reported (rule R29), never guessed at. Units: seconds.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from smsl_studio.blueprint.address import note_key

Json = Any


class _Note(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)


NoteT = TypeVar("NoteT", bound=_Note)


class FactNote(_Note):
    """``_facts`` of an SB, by digit (``"0"``): what the fact is and where it comes from."""

    name: str = ""
    values: dict[str, str] = Field(default_factory=dict)
    on: str | None = None
    failure: tuple[str, ...] = ()
    critical: bool = False
    sensors: tuple[str, ...] = ()
    unit: str = ""
    predicate: str = ""
    aggregation: Literal["single", "all", "any", "k_of_n", "priority", "human"] = "single"
    k: int | None = Field(default=None, ge=1)
    max_age: float | None = Field(default=None, gt=0)


class StateNote(_Note):
    """``_states`` of an SB, by state name."""

    title: str = ""
    note: str = ""
    safe: bool | None = None
    facts: tuple[str, ...] = ()


class Binding(_Note):
    """The library function an operation is bound to, with its arguments."""

    function: str
    arguments: dict[str, Json] = Field(default_factory=dict)


class OperationNote(_Note):
    """``_operations`` of an SB, by operation name or by ``State/Operation`` (which wins)."""

    title: str = ""
    cost: float | None = Field(default=None, ge=0, allow_inf_nan=False)
    risk: Literal["low", "medium", "high"] | None = None
    actor: Literal["human", "shared", "robot"] | None = None
    confirm: tuple[str, ...] = ()
    duration: float | None = Field(default=None, ge=0)
    timeout: float | None = Field(default=None, gt=0)
    stop: Literal["abort", "hold", "finish"] | None = None
    repeatable: bool = False
    requires: dict[str, str] = Field(default_factory=dict)
    """Facts of any SB that must hold first: ``{"SB/digit": value}``."""
    subs: Literal["drive", "load"] = "drive"
    binding: Binding | None = None


class Hazard(_Note):
    """``_hazards`` of the file: facts (``"SB/digit": value``) that must never hold together."""

    name: str
    facts: dict[str, str]


class Notes(_Note):
    """The annotations of one SB, and what in them could not be understood."""

    facts: dict[int, FactNote] = Field(default_factory=dict)
    states: dict[str, StateNote] = Field(default_factory=dict)
    operations: dict[str, OperationNote] = Field(default_factory=dict)
    layout: dict[str, tuple[float, float]] = Field(default_factory=dict)
    faults: tuple[tuple[tuple[str, ...], str], ...] = ()

    def operation(self, state: str, operation: str) -> OperationNote:
        """The note of one edge: the one of its name, overridden by the one of the edge."""
        common = self.operations.get(note_key(operation))
        own = self.operations.get(note_key(operation, state))
        if common is None or own is None:
            return own or common or PLAIN
        return common.model_copy(update={k: getattr(own, k) for k in own.model_fields_set})


PLAIN = OperationNote()


def read_notes(fields: Mapping[str, Json]) -> Notes:
    """The typed annotations in an SB's ``_`` fields; faults carry the path and the reason."""
    faults: list[tuple[tuple[str, ...], str]] = []

    def table(key: str) -> dict[str, Json]:
        raw = fields.get(key, {})
        if isinstance(raw, dict):
            return raw
        faults.append(((key,), f"{key} must be a map"))
        return {}

    facts: dict[int, FactNote] = {}
    for digit, raw in table("_facts").items():
        fact = _validated(FactNote, raw, ("_facts", digit), faults)
        if fact is not None and digit.isdecimal() and digit.isascii():
            facts[int(digit)] = fact
        elif fact is not None:
            faults.append((("_facts", digit), f"{digit!r} is no digit of a fact"))
    states: dict[str, StateNote] = {}
    for name, raw in table("_states").items():
        state = _validated(StateNote, raw, ("_states", name), faults)
        if state is not None:
            states[name] = state
    operations: dict[str, OperationNote] = {}
    for name, raw in table("_operations").items():
        operation = _validated(OperationNote, raw, ("_operations", name), faults)
        if operation is not None:
            operations[name] = operation
    layout: dict[str, tuple[float, float]] = {}
    for name, at in table("_layout").items():
        if _is_point(at):
            layout[name] = (float(at[0]), float(at[1]))
        else:
            faults.append((("_layout", name), "a position is [x, y]"))
    return Notes(
        facts=facts, states=states, operations=operations, layout=layout, faults=tuple(faults)
    )


def read_hazards(raw: Json) -> tuple[tuple[Hazard, ...], tuple[tuple[tuple[str, ...], str], ...]]:
    """The hazards of a file, and what in them could not be understood."""
    faults: list[tuple[tuple[str, ...], str]] = []
    if not isinstance(raw, list):
        return (), ((("_hazards",), "_hazards must be a list"),) if raw is not None else ()
    notes = [_validated(Hazard, item, ("_hazards",), faults) for item in raw]
    return tuple(note for note in notes if note is not None), tuple(faults)


def _is_point(at: Json) -> bool:
    return (
        isinstance(at, list)
        and len(at) == 2
        and all(isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < 1e7 for v in at)
    )


def _validated(
    model: type[NoteT], raw: Json, path: tuple[str, ...], faults: list[Any]
) -> NoteT | None:
    try:
        return model.model_validate(raw)
    except ValidationError as error:
        for fault in error.errors(include_url=False):
            inner = ".".join(str(part) for part in fault["loc"])
            faults.append((path, f"{inner}: {fault['msg']}" if inner else fault["msg"]))
        return None
