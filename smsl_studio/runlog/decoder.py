"""Events from the lines of a log. Every value is checked, because a log comes from outside."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields
from types import MappingProxyType, NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from smsl_studio.errors import did_you_mean
from smsl_studio.runlog import events
from smsl_studio.runlog.events import Event

Json = Any
LARGEST = 2.0**53
"""Times and costs are smaller than this. Larger numbers are not exact."""


def _known() -> Iterator[type[Event]]:
    for one in vars(events).values():
        if isinstance(one, type) and issubclass(one, Event) and one.event:
            yield one


EVENTS: Mapping[str, type[Event]] = MappingProxyType({one.event: one for one in _known()})
"""All events by their words."""

_HINTS = MappingProxyType({word: get_type_hints(kind) for word, kind in EVENTS.items()})


def event_of(values: Mapping[str, Json]) -> Event:
    """Return the event with these values. ValueError, with a sentence, if there is none.

    A field with a default may be missing, because the log may be older than the field.
    """
    word = values.get("event")
    if not isinstance(word, str):
        raise ValueError("the line tells of no event")
    if word not in EVENTS:
        near = did_you_mean(word[:80], EVENTS)
        raise ValueError(f"there is no event {word[:80]!r}. {near}".removesuffix(". "))
    kind, hints = EVENTS[word], _HINTS[word]
    wanted = fields(kind)
    odd = values.keys() - {"event", *(item.name for item in wanted)}
    if odd:
        raise ValueError(f"the event {word} has no {min(odd)[:80]!r}")
    given: dict[str, Json] = {}
    for item in wanted:
        if item.name in values:
            try:
                given[item.name] = _taken(hints[item.name], values[item.name])
            except ValueError as error:
                raise ValueError(f"{item.name} of the event {word} is no {error}") from None
        elif item.default is MISSING and item.default_factory is MISSING:
            raise ValueError(f"the event {word} lacks {item.name!r}")
    return kind(**given)


_WORDS: Mapping[Any, str] = MappingProxyType(
    {
        float: "number that a clock or a cost could show",
        int: "whole number",
        str: "text",
        bool: "yes or no",
    }
)


def _taken(hint: Any, value: Json) -> Json:
    """Return a value in the type of its field. ValueError names the type that it should have."""
    if hint is float:
        number = _is_whole(value) or isinstance(value, float)
        return _if(number and abs(value) < LARGEST, hint, value)
    if hint is int:
        return _if(_is_whole(value), hint, value)
    if hint in (str, bool):
        return _if(isinstance(value, hint), hint, value)
    kind, parts = get_origin(hint), get_args(hint)
    if kind is UnionType:
        return None if value is None and NoneType in parts else _taken(parts[0], value)
    if kind is tuple:
        if not isinstance(value, list):
            raise ValueError("list")
        return tuple(_taken(parts[0], one) for one in value)
    if not isinstance(value, dict):
        raise ValueError("map of names")
    return {name: _taken(parts[1], one) for name, one in value.items()}


def _is_whole(value: Json) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _if(good: bool, hint: Any, value: Json) -> Json:
    if not good:
        raise ValueError(_WORDS[hint])
    return value
