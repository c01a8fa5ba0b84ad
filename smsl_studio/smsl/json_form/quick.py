"""A fast reader of JSON values, used only if it gives the same result as the exact one.

``orjson`` silently drops doubled keys. Every member has one colon, after a quote or a blank. If the
text has no more of these colons than the values have members, no key is doubled. In all other
cases, and if orjson refuses the text or may read a number differently, the exact reader decides.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

Json = Any

LONG = 1 << 16
"""Shorter texts are read by the exact reader, which is faster than loading orjson."""

_CONTAINERS = {dict, list}
_EXACT = float(2**63)
"""orjson turns larger whole numbers into floats."""


def quick_values(text: str, max_depth: int) -> dict[str, Json] | None:
    """Return the values of a text without doubled keys, None if the exact reader must decide."""
    import orjson

    try:
        values = orjson.loads(text if text.isascii() else text.encode())
    except ValueError:
        return None
    if type(values) is not dict:
        return None
    members = _counted(values, max_depth)
    if members is None or members not in _most_members(text):
        return None
    return values


def _most_members(text: str) -> Iterator[int]:
    """Yield upper bounds of the number of members in a text, the second one closer."""
    yield text.count(":")
    yield sum(text.count(f"{before}:") for before in '" \t\n\r')


def _counted(values: dict[str, Json], max_depth: int) -> int | None:
    """Return the number of members of all maps. None if they are nested too deep or a number is
    uncertain.

    It works layer by layer with built-in functions, because they are fast for texts and maps.
    """
    members = 0
    layer: list[Any] = [values]
    kinds: set[type] = {dict}
    for _ in range(max_depth):
        maps = layer if kinds == {dict} else [one for one in layer if type(one) is dict]
        lists = [] if maps is layer else [one for one in layer if type(one) is list]
        members += sum(map(len, maps))
        kinds = set(map(type, _inside(maps, lists)))
        if float in kinds and not _are_exact(_inside(maps, lists)):
            return None
        if not kinds & _CONTAINERS:
            return members
        below = _inside(maps, lists)
        if kinds <= _CONTAINERS:
            layer = list(below)
        else:
            layer = [one for one in below if type(one) in _CONTAINERS]
            kinds = set(map(type, layer))
    return None


def _inside(maps: list[dict[str, Json]], lists: list[list[Json]]) -> Iterator[Json]:
    return chain(chain.from_iterable(map(dict.values, maps)), chain.from_iterable(lists))


def _are_exact(values: Iterable[Any]) -> bool:
    return all(abs(one) < _EXACT for one in values if type(one) is float)
