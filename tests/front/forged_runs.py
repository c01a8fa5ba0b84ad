"""Forged runs: true logs whose story was changed, with a chain and a head made anew.

Nobody who reads the bytes alone can see the change. Some changed stories are still possible.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from copy import deepcopy
from random import Random
from typing import Any

from tests.runlog.impossible import Story

Json = Any
Forgery = Callable[[Story, Random], None]


def left_out(story: Story, random: Random) -> None:
    del story.events[random.randrange(len(story.events))]


def doubled(story: Story, random: Random) -> None:
    at = random.randrange(len(story.events))
    story.events.insert(at, deepcopy(story.events[at]))


def repeated_later(story: Story, random: Random) -> None:
    """An event happens again, at the time of another one."""
    first, second = sorted(random.choices(range(len(story.events)), k=2))
    again = {**deepcopy(story.events[first]), "t": story.events[second]["t"]}
    story.events.insert(second + 1, again)


def swapped(story: Story, random: Random) -> None:
    """Two neighbours change their places, and keep the times of the places."""
    events = story.events
    at = random.randrange(len(events) - 1)
    events[at], events[at + 1] = (
        {**events[at + 1], "t": events[at]["t"]},
        {**events[at], "t": events[at + 1]["t"]},
    )


def moved(story: Story, random: Random) -> None:
    """An event stands somewhere else, at the time of that place."""
    events = story.events
    one = events.pop(random.randrange(len(events)))
    at = random.randrange(len(events))
    events.insert(at, {**one, "t": events[at]["t"]})


def another_value(story: Story, random: Random) -> None:
    """A member has a value that it has elsewhere in the log, or one that is near."""
    pools: dict[str, list[Json]] = defaultdict(list)
    for event in story.events:
        for key, value in event.items():
            if key not in ("event", "t") and value not in pools[key]:
                pools[key].append(value)
    for _ in range(20):
        event = random.choice(story.events)
        key = random.choice([key for key in event if key not in ("event", "t")] or [""])
        others = [value for value in pools[key] if value != event.get(key)]
        if key and (others or _near(event[key], random) != event[key]):
            near = random.random() < 0.3 or not others
            event[key] = deepcopy(_near(event[key], random) if near else random.choice(others))
            return


def another_word(story: Story, random: Random) -> None:
    """One text inside of an event is replaced everywhere in it by another one of the log."""
    texts = sorted({text for event in story.events for text in _texts(event)})
    event = random.choice(story.events)
    own = sorted(set(_texts(event)))
    if own and len(texts) > 1:
        old = random.choice(own)
        new = random.choice([text for text in texts if text != old])
        at = story.events.index(event)
        story.events[at] = _replaced(event, old, new)


def another_time(story: Story, random: Random) -> None:
    """One event is told earlier or later, between its neighbours or beyond."""
    at = random.randrange(len(story.events))
    around = [one["t"] for one in story.events[max(0, at - 3) : at + 4]]
    story.events[at]["t"] = round(random.uniform(min(around) - 0.01, max(around) + 0.1), 3)


def later_from_here(story: Story, random: Random) -> None:
    """From one event on, everything is told later."""
    at = random.randrange(len(story.events))
    for event in story.events[at:]:
        event["t"] = round(event["t"] + 0.5, 6)


def two_at_once(story: Story, random: Random) -> None:
    """Two of the changes above, so that one may hide the other."""
    for change in random.choices(FORGERIES[:-1], k=2):
        if len(story.events) > 2:
            change(story, random)


FORGERIES: tuple[Forgery, ...] = (
    left_out,
    doubled,
    repeated_later,
    swapped,
    moved,
    another_value,
    another_word,
    another_time,
    later_from_here,
    two_at_once,
)


def forged(story: Story, forgery: Forgery, random: Random) -> Story | None:
    """A story as a forgery changes it. None where it changes nothing."""
    changed = deepcopy(story)
    if len(changed.events) > 1:
        forgery(changed, random)
    return changed if changed.events != story.events else None


def _near(value: Json, random: Random) -> Json:
    """A value of the same kind that is not the same."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + random.choice([-1, 1])
    if isinstance(value, str):
        return random.choice(["", "x", value + "1", value[:-1]])
    if isinstance(value, list):
        return value[:-1] if value and random.random() < 0.5 else [*value, *value[:1]]
    if isinstance(value, dict):
        kept = list(value.items())
        return dict(kept[:-1]) if kept and random.random() < 0.5 else dict(reversed(kept))
    return "0"


def _texts(value: Json) -> list[str]:
    if isinstance(value, str):
        return [value]
    if isinstance(value, dict):
        return [
            text for key, one in value.items() if key not in ("event", "t") for text in _texts(one)
        ]
    return [text for one in value for text in _texts(one)] if isinstance(value, list) else []


def _replaced(value: Json, old: str, new: str) -> Json:
    if isinstance(value, dict):
        return {k: v if k == "event" else _replaced(v, old, new) for k, v in value.items()}
    if isinstance(value, list):
        return [_replaced(one, old, new) for one in value]
    return new if value == old else value
