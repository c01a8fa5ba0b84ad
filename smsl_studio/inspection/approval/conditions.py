"""Conditions of an approval. Four kinds are asked when a run starts; all others are free text.

::

    world = NAME
    supervisor present
    sensor SB/DIGIT at N Hz
    until DATE
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from datetime import datetime

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.check import FactKey
from smsl_studio.inspection.approval.times import end_of

_WORLD = re.compile(r"world = (\S.*)")
_SENSOR = re.compile(r"sensor (.+/\d+) at (\d+(?:\.\d+)?) Hz", re.ASCII)
_UNTIL = re.compile(r"until (\S+)")


@dataclass(frozen=True, slots=True)
class Asking:
    """What is known at the moment at which conditions are checked. None means unknown.

    ``rates`` has for each fact the readings a second (Hz) of its quickest sensor.
    """

    now: datetime
    world: str | None = None
    supervised: bool | None = None
    rates: dict[FactKey, float] | None = None


@dataclass(frozen=True, slots=True)
class TypedCondition:
    """A condition that a program can check. ``kind`` is world, supervisor, sensor or until."""

    text: str
    kind: str
    world: str = ""
    fact: FactKey | None = None
    hertz: float = 0.0
    until: datetime | None = None

    def is_met(self, asking: Asking) -> bool | None:
        """Whether the condition is met. None if what it needs is not known here."""
        if self.kind == "world":
            return None if asking.world is None else asking.world == self.world
        if self.kind == "supervisor":
            return asking.supervised
        if self.until is not None:
            return asking.now <= self.until
        if asking.rates is None or self.fact is None:
            return None
        return asking.rates.get(self.fact, 0.0) >= self.hertz


def typed(text: str) -> TypedCondition | None:
    """Return the condition that a program can check. None if the text is free text."""
    if found := _WORLD.fullmatch(text):
        return TypedCondition(text, "world", world=found[1])
    if text == "supervisor present":
        return TypedCondition(text, "supervisor")
    if found := _SENSOR.fullmatch(text):
        fact = split_fact(found[1])
        if fact is not None:
            return TypedCondition(text, "sensor", fact=fact, hertz=float(found[2]))
    if found := _UNTIL.fullmatch(text):
        try:
            return TypedCondition(text, "until", until=end_of(found[1]))
        except ValueError:
            return None
    return None
