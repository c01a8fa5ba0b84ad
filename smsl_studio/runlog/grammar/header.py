"""The types of the values in a header. A value of another type could not be compared with the
events.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

Json = Any
Fits = Callable[[Json], bool]


def misshapen(header: Mapping[str, Json]) -> Iterator[str]:
    """Yield the values that no run writes in this form. A missing key is no fault here, because
    logs of earlier programs have fewer keys.
    """
    grounds, digests = header.get("grounds"), header.get("digests")
    yield from _wrong("", header, _HEADER)
    yield from _wrong("digests.", digests, _DIGESTS)
    yield from _wrong("grounds.", grounds, _GROUNDS)


def _wrong(place: str, value: Json, shapes: Mapping[str, Fits]) -> Iterator[str]:
    for key, fits in shapes.items() if isinstance(value, Mapping) else ():
        if key in value and not fits(value[key]):
            yield f"the header has a value of {place}{key} that no run writes"


def _is_text(value: Json) -> bool:
    return isinstance(value, str)


def _is_whole(value: Json) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _are_texts(value: Json) -> bool:
    return isinstance(value, list) and all(map(_is_text, value))


def _is_object(value: Json) -> bool:
    return isinstance(value, dict)


def _are_states(value: Json) -> bool:
    return _every(value, lambda table: _every(table, _are_values))


def _are_values(value: Json) -> bool:
    return isinstance(value, list) and all(one is None or _is_text(one) for one in value)


def _are_subs(value: Json) -> bool:
    return _every(value, lambda digits: _every(digits, _is_sub))


def _is_sub(value: Json) -> bool:
    named = isinstance(value, dict) and all(_is_text(value.get(key)) for key in _NAMES)
    return named and _are_texts(value.get("on"))


_NAMES = ("sub", "activating", "initial")


def _every(value: Json, fits: Fits) -> bool:
    return isinstance(value, dict) and all(map(fits, value.values()))


_HEADER: Mapping[str, Fits] = MappingProxyType(
    {
        "world": _is_text,
        "seed": _is_whole,
        "by_hand": lambda value: isinstance(value, bool),
        "start": _are_texts,
        "goals": _are_texts,
        "avoid": _are_texts,
        "digests": _is_object,
        "grounds": _is_object,
    }
)
_DIGESTS: Mapping[str, Fits] = MappingProxyType({"behaviour": _is_text})
_GROUNDS: Mapping[str, Fits] = MappingProxyType(
    {"states": _are_states, "sensed": _are_texts, "subs": _are_subs}
)
