"""Properties: sentences about a blueprint that inspection shows to hold or to fail.

``_properties`` of a file is a list of objects with a ``name``, a ``severity`` (E or W), a ``why``
for people, and exactly one of the kinds below. docs/language.md says what each kind means.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.formula import Formula
from smsl_studio.blueprint.properties.formula_text import read_formula
from smsl_studio.errors import FormulaError, did_you_mean

Json = Any
KEY = "_properties"
SEVERITIES = ("E", "W")
MOST = 1e15
"""The largest number that a property may have."""


@dataclass(frozen=True, slots=True)
class Property:
    """One property. The fields that its kind does not use have their defaults.

    ``formulas`` are F, or F and G. ``within`` is the largest number of steps of ``way_back``, None
    for any. ``operation`` is the pattern of ``at_most``, and ``goal`` the address of ``cost``.
    """

    name: str
    kind: str
    severity: str = "E"
    why: str = ""
    formulas: tuple[Formula, ...] = ()
    within: int | None = None
    operation: str = ""
    times: int = 0
    goal: str = ""
    limit: float = 0.0


class PropertyFault(NamedTuple):
    """An entry that cannot be read: its path in the file, its name if it has one, and why."""

    path: tuple[str, ...]
    name: str
    sentence: str
    advice: str = ""


class _Unreadable(Exception):  # noqa: N818
    """A value does not fit. ``below`` are the keys inside the entry that lead to it."""

    def __init__(self, sentence: str, below: tuple[str, ...] = (), advice: str = "") -> None:
        super().__init__(sentence)
        self.sentence, self.below, self.advice = sentence, below, advice


def read_properties(raw: Json) -> tuple[dict[int, Property], tuple[PropertyFault, ...]]:
    """Return the properties in ``_properties`` by their place in the list, and the faults.

    A name that is used twice is a fault of the second one. Whether the names in formulas exist is
    not looked at here.
    """
    if raw is None:
        return {}, ()
    if not isinstance(raw, list):
        words = f"{KEY} must be a list"
        return {}, (PropertyFault((KEY,), "", words, "Write [ { ... } ]."),)
    found: dict[int, Property] = {}
    faults: list[PropertyFault] = []
    names: set[str] = set()
    for index, entry in enumerate(raw):
        name = entry.get("name") if isinstance(entry, dict) else None
        name = name if isinstance(name, str) else ""
        try:
            one = _read(entry)
            if one.name in names:
                raise _Unreadable("the name is used twice", ("name",), "Give it another name.")
        except _Unreadable as error:
            path = (KEY, str(index), *error.below)
            faults.append(PropertyFault(path, name, error.sentence, error.advice))
        else:
            found[index] = one
            names.add(one.name)
    return found, tuple(faults)


def properties_of(blueprint: Blueprint) -> tuple[Property, ...]:
    """Return the properties in all files of a blueprint that can be read."""
    read = (read_properties(one.values.get(KEY))[0] for one in blueprint.documents)
    return tuple(one for found in read for one in found.values())


def _read(entry: Json) -> Property:
    if not isinstance(entry, dict):
        raise _Unreadable("a property is an object", advice='Write { "name": ..., "never": ... }.')
    kinds = [key for key in entry if key in KINDS]
    for key in entry:
        if key not in KINDS and key not in ("name", "severity", "why") and not key.startswith("_"):
            known = (*KINDS, "name", "severity", "why")
            raise _Unreadable(f"{key} is no key of a property", (key,), did_you_mean(key, known))
    if len(kinds) != 1:
        said = " and ".join(kinds) if kinds else "none"
        raise _Unreadable(
            f"it has {said} of the kinds, and needs one", (), f"The kinds are {', '.join(KINDS)}."
        )
    (kind,) = kinds
    name, severity = _text(entry, "name"), entry.get("severity", "E")
    if severity not in SEVERITIES:
        raise _Unreadable("severity is E or W", ("severity",))
    why = _text(entry, "why") if "why" in entry else ""
    return KINDS[kind](entry[kind])(name=name, kind=kind, severity=severity, why=why)


def _text(entry: dict[str, Json], key: str, *above: str) -> str:
    value = entry.get(key)
    if not isinstance(value, str) or not value:
        at = (*above, key) if key in entry else above
        raise _Unreadable(f"{key} must be a text that is not empty", at)
    return value


def _number(entry: dict[str, Json], key: str, *above: str, whole: bool = True) -> float:
    value = entry.get(key)
    fits = isinstance(value, int if whole else int | float) and not isinstance(value, bool)
    if not fits or value is None or not 0 <= value <= MOST:
        kind = "a whole number" if whole else "a number"
        raise _Unreadable(
            f"{key} must be {kind} from 0 up, at most {MOST:g}",
            (*above, key) if key in entry else above,
        )
    return float(value) if not whole else int(value)


def _formula(value: Json, *below: str) -> Formula:
    if not isinstance(value, str):
        raise _Unreadable("a condition must be a text", below)
    try:
        return read_formula(value)
    except FormulaError as error:
        raise _Unreadable(error.sentence, below, error.advice) from None


def _keys(value: Json, kind: str, needed: Sequence[str], others: Sequence[str] = ()) -> None:
    """Check that a value is an object with the needed keys, and none besides ``others``."""
    if not isinstance(value, dict):
        raise _Unreadable(f"{kind} must be an object with {', '.join(needed)}", (kind,))
    for key in needed:
        if key not in value:
            raise _Unreadable(f"{kind} has no {key}", (kind,))
    for key in value:
        if key not in needed and key not in others:
            raise _Unreadable(f"{key} is no key of {kind}", (kind, key))


_Rest = Callable[..., Property]
"""A property without its name, kind, severity and reason."""


def _one(kind: str) -> Callable[[Json], _Rest]:
    return lambda value: partial(Property, formulas=(_formula(value, kind),))


def _two(kind: str) -> Callable[[Json], _Rest]:
    def read(value: Json) -> _Rest:
        """Return the kind with its two conditions."""
        if not isinstance(value, list) or len(value) != 2:
            raise _Unreadable(f"{kind} must be a list of two conditions", (kind,))
        formulas = tuple(_formula(text, kind, str(at)) for at, text in enumerate(value))
        return partial(Property, formulas=formulas)

    return read


def _way_back(value: Json) -> _Rest:
    kind = "way_back"
    _keys(value, kind, ("from", "to"), ("within",))
    formulas = tuple(_formula(value[key], kind, key) for key in ("from", "to"))
    within = int(_number(value, "within", kind)) if "within" in value else None
    return partial(Property, formulas=formulas, within=within)


def _at_most(value: Json) -> _Rest:
    kind = "at_most"
    _keys(value, kind, ("operation", "times"))
    operation, times = _text(value, "operation", kind), int(_number(value, "times", kind))
    return partial(Property, operation=operation, times=times)


def _cost(value: Json) -> _Rest:
    kind = "cost"
    _keys(value, kind, ("goal", "limit"))
    goal, limit = _text(value, "goal", kind), _number(value, "limit", kind, whole=False)
    return partial(Property, goal=goal, limit=limit)


KINDS: dict[str, Callable[[Json], _Rest]] = {
    "never": _one("never"),
    "before": _two("before"),
    "after": _two("after"),
    "way_back": _way_back,
    "reachable": _one("reachable"),
    "at_most": _at_most,
    "cost": _cost,
}
"""How the value of each kind is read."""


def texts_of(one: Property) -> Iterator[tuple[Formula, tuple[str, ...]]]:
    """Yield each condition of a property with the keys inside its entry that lead to its text."""
    below: tuple[tuple[str, ...], ...] = {
        "never": ((),),
        "reachable": ((),),
        "way_back": (("from",), ("to",)),
    }.get(one.kind, (("0",), ("1",)))
    for formula, keys in zip(one.formulas, below, strict=False):
        yield formula, (one.kind, *keys)
