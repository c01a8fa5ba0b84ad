"""The quick way to the values of a JSON text, for where it cannot differ from the exact one.

``orjson`` drops keys that are written twice in silence. Every member has one colon, behind a quote
or a blank: where the text has no more of these than the values have members, no key is written
twice. Where it has more, where orjson refuses the text, or reads a number otherwise, the exact way
decides.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

Json = Any

LONG = 1 << 16
"""Texts shorter than this are read before orjson is loaded."""

_CONTAINERS = {dict, list}
_EXACT = float(2**63)
"""Whole numbers beyond this become floats in orjson."""


def quick_values(text: str, max_depth: int) -> dict[str, Json] | None:
    """The values of a text without doubled keys; None where only the exact way is sure."""
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
    """Ever closer numbers that the members written in a text cannot exceed."""
    yield text.count(":")
    yield sum(text.count(f"{before}:") for before in '" \t\n\r')


def _counted(values: dict[str, Json], max_depth: int) -> int | None:
    """How many members all maps have together; None where it is too deep or a number is in doubt.

    Layer by layer, in the interpreter's own loops: only what is neither text nor map costs more.
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
