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


def _is_truth(value: Json) -> bool:
    return isinstance(value, bool)


def _is_map_of_texts(value: Json) -> bool:
    return _every(value, _is_text)


def _are_tables(value: Json) -> bool:
    return _every(value, _is_map_of_texts)


def _are_costs(value: Json) -> bool:
    return _every(value, lambda table: _every(table, _is_cost))


def _is_cost(value: Json) -> bool:
    return value is None or (isinstance(value, int | float) and not _is_truth(value) and value >= 0)


def _is_script(value: Json) -> bool:
    return value is None or _has_texts(value, ("file", "digest"))


def _is_mqtt(value: Json) -> bool:
    if value is None:
        return True
    return _has_texts(value, ("broker", "site", "run")) and _every(value.get("facts"), _are_texts)


def _is_policy(value: Json) -> bool:
    """Return whether a value is a valid entry about the approval, or null."""
    if value is None:
        return True
    if not isinstance(value, dict) or not _has_texts(value, ("verdict", "keys")):
        return False
    digests = (value.get(key) for key in ("policy", "record", "register"))
    serial, signers = value.get("serial"), value.get("signers")
    return (
        all(one is None or _is_text(one) for one in digests)
        and (serial is None or _is_whole(serial))
        and isinstance(signers, list)
        and all(map(_is_object, signers))
        and _are_texts(value.get("met"))
    )


def _has_texts(value: Json, keys: tuple[str, ...]) -> bool:
    return isinstance(value, dict) and all(_is_text(value.get(key)) for key in keys)


_HEADER: Mapping[str, Fits] = MappingProxyType(
    {
        "wall_time": _is_text,
        "node": _is_text,
        "process": _is_whole,
        "world": _is_text,
        "seed": _is_whole,
        "host": _is_text,
        "on_mismatch": _is_text,
        "by_hand": _is_truth,
        "attended": _is_truth,
        "start": _are_texts,
        "goals": _are_texts,
        "avoid": _are_texts,
        "levels": _is_map_of_texts,
        "script": _is_script,
        "supervisor": _is_text,
        "policy": _is_policy,
        "mqtt": _is_mqtt,
        "file": _is_text,
        "digests": _is_object,
        "versions": _is_map_of_texts,
        "names": _are_tables,
        "grounds": _is_object,
        "procedures": _is_map_of_texts,
        "badge": _is_text,
    }
)
_DIGESTS: Mapping[str, Fits] = MappingProxyType(
    {
        **dict.fromkeys(("file", "behaviour", "meaning", "closure"), _is_text),
        "imported": _is_map_of_texts,
    }
)
_GROUNDS: Mapping[str, Fits] = MappingProxyType(
    {
        "states": _are_states,
        "sensed": _are_texts,
        "subs": _are_subs,
        "functions": _are_tables,
        "costs": _are_costs,
        "priced": _is_truth,
    }
)
