"""What a world offers, as its answers to ``hello`` and ``open`` say it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.channel.fields import (
    LATEST,
    count_of,
    flag_of,
    number_of,
    objects_of,
    one_of,
    text_of,
    texts_of,
    words_of,
)
from smsl_studio.channel.frames import VERSION, ChannelError, Frame
from smsl_studio.legible import one_line

STOPS = ("abort", "hold", "finish")
MOST_OPERATIONS, MOST_EDGES, MOST_SENSORS, MOST_FAULTS = 10_000, 200_000, 10_000, 1000


@dataclass(frozen=True)
class WorldCard:
    """Who answers: the name of the world, whether it is hardware, whether it wants the text of the
    blueprint, and the word that each question repeats."""

    world: str
    hardware: bool
    wants_blueprint: bool
    session: str


@dataclass(frozen=True)
class OfferedOperation:
    """An operation, and what it serves: addresses ``SB/State/Operation``, or names of operations.

    ``stop`` is the effect of a stop: abort, hold or finish. ``timeout`` is in simulated seconds.
    ``touches`` are facts (``SB/digit``) that it may change besides those of its edge.
    """

    function: str
    serves: tuple[str, ...]
    stop: str
    timeout: float
    resumes: bool
    touches: tuple[str, ...] = ()


@dataclass(frozen=True)
class OfferedSensor:
    """A sensor of a fact (``SB/digit``). Period and largest age are in simulated seconds.

    ``words`` explain values that no state has. A sensor with a ``unit`` measures.
    """

    name: str
    fact: str
    period: float
    max_age: float
    words: Mapping[str, str] = field(default_factory=dict)
    unit: str = ""


@dataclass(frozen=True)
class WorldOffer:
    """What a world that was opened offers. ``tick`` and ``settle`` are in simulated seconds."""

    tick: float
    settle: float
    operations: tuple[OfferedOperation, ...]
    sensors: tuple[OfferedSensor, ...]
    faults: tuple[str, ...]


def read_card(frame: Frame) -> WorldCard:
    """Return the answer to ``hello``. ChannelError if it is not valid."""
    if count_of(frame, "version") != VERSION:
        raise ChannelError(f"version is {frame['version']}, not {VERSION}")
    return WorldCard(
        one_line(text_of(frame, "world", 100)),
        flag_of(frame, "hardware", False),
        flag_of(frame, "wants_blueprint", False),
        text_of(frame, "session", 100),
    )


def read_offer(frame: Frame) -> WorldOffer:
    """Return the answer to ``open``. ChannelError if it is not valid."""
    operations = [_operation(one) for one in objects_of(frame, "operations", MOST_OPERATIONS)]
    sensors = [_sensor(one) for one in objects_of(frame, "sensors", MOST_SENSORS)]
    _refuse_twice([one.function for one in operations], "operation")
    _refuse_twice([f"{one.fact} of {one.name}" for one in sensors], "sensor")
    if sum(len(one.serves) for one in operations) > MOST_EDGES:
        raise ChannelError(f"operations serve more than {MOST_EDGES:,} names")
    return WorldOffer(
        number_of(frame, "tick", 1e-6, 10.0, None),
        number_of(frame, "settle", 0.0, 1000.0, 0.0),
        tuple(operations),
        tuple(sensors),
        texts_of(frame, "faults", MOST_FAULTS),
    )


def offer_frame(offer: WorldOffer) -> Frame:
    """Return an offer as the fields of an answer."""
    return {
        "tick": offer.tick,
        "settle": offer.settle,
        "operations": [
            {
                "function": one.function,
                "serves": list(one.serves),
                "stop": one.stop,
                "timeout": min(one.timeout, LATEST),
                "resumes": one.resumes,
                "touches": list(one.touches),
            }
            for one in offer.operations
        ],
        "sensors": [
            {
                "name": one.name,
                "fact": one.fact,
                "period": one.period,
                "max_age": one.max_age,
                "words": dict(one.words),
                "unit": one.unit,
            }
            for one in offer.sensors
        ],
        "faults": list(offer.faults),
    }


def _operation(frame: Frame) -> OfferedOperation:
    return OfferedOperation(
        _name_of(frame, "function"),
        texts_of(frame, "serves", MOST_EDGES),
        one_of(frame, "stop", STOPS, "hold"),
        number_of(frame, "timeout", 0.0, LATEST, 20.0),
        flag_of(frame, "resumes", True),
        texts_of(frame, "touches", 10_000),
    )


def _sensor(frame: Frame) -> OfferedSensor:
    return OfferedSensor(
        _name_of(frame, "name"),
        text_of(frame, "fact"),
        number_of(frame, "period", 0.0, LATEST, 0.1),
        number_of(frame, "max_age", 0.0, LATEST, 0.3),
        words_of(frame, "words", 100),
        text_of(frame, "unit", 100, ""),
    )


def _name_of(frame: Frame, field_name: str) -> str:
    """Return a name that people see: one line, not empty."""
    name = text_of(frame, field_name)
    if not name or one_line(name) != name:
        raise ChannelError(f"{field_name} is {name[:40]!r}, not a name of one line")
    return name


def _refuse_twice(names: list[str], what: str) -> None:
    if len(set(names)) < len(names):
        raise ChannelError(f"two {what}s have the same name")
