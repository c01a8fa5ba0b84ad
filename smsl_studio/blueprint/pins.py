"""Pins: the states that a person has fixed at their places. A tidy drawing leaves them there.

``_layout`` of an SB holds them under ``_pinned``, by the name of the state. A pin is no part of the
meaning.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping
from typing import Any

Json = Any
PINNED = "_pinned"
"""The key in ``_layout`` below which the pins stand."""
Fault = tuple[tuple[str, ...], str]


def written_pins(layout: Json) -> Mapping[str, Json]:
    """Return the map of pins in a ``_layout`` as it is written, an empty one if there is none."""
    found = layout.get(PINNED) if isinstance(layout, dict) else None
    return found if isinstance(found, dict) else {}


def pins_of(raw: Json, places: Container[str], faults: list[Fault]) -> frozenset[str]:
    """Return the pinned states in ``_pinned`` of a ``_layout``.

    ``places`` has the states with a place. What does not fit is added to ``faults`` and left out.
    """
    path = ("_layout", PINNED)
    if not isinstance(raw, dict):
        faults.append((path, f"{PINNED} must be a map"))
        return frozenset()
    found = set()
    for state, value in raw.items():
        if value is not True:
            faults.append(((*path, state), "a pin is true; a state without a pin is left out"))
        elif state not in places:
            faults.append(((*path, state), "a pinned state needs its place [x, y] in _layout"))
        else:
            found.add(state)
    return frozenset(found)


def renamed_pins(layout: Json, names: Mapping[str, str]) -> dict[str, Json]:
    """Return the pins of some states as they are written, under other names."""
    pins = written_pins(layout)
    return {names[state]: value for state, value in pins.items() if state in names}


def pinned_anew(base: Json, side: Json, other: Json) -> Iterator[str]:
    """Yield the states that one side alone has pinned since the base. All are ``_layout`` maps."""
    before, here, there = map(written_pins, (base, side, other))
    for state, value in here.items():
        if value is True and before.get(state) is not True and there.get(state) is not True:
            yield state
