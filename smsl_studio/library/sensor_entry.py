"""A sensor that a plugin registers: a function, or predicates on other sensors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from smsl_studio.library.pattern import Pattern
from smsl_studio.library.signature import Signature

NO_WORDS: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class SensorEntry:
    """A sensing function with the patterns of its sensors' names and of their facts.

    ``period`` and ``max_age`` are in simulated seconds. With a ``unit`` it measures: it returns a
    number, and the predicates of a blueprint decide what it means.
    """

    function: Callable[..., Any]
    pattern: Pattern
    fact: Pattern
    signature: Signature
    period: float
    max_age: float
    words: Mapping[str, str]
    unit: str = ""
    predicate: Mapping[str, str] = field(default_factory=dict)
    """With it the sensor has no function of its own: sensors that measure decide its value."""
    otherwise: str = ""
    """The value if every predicate is false, empty for no valid reading."""
