"""Marks: what is lit on the canvas, as one frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from smsl_studio.blueprint.address import Address


@dataclass(frozen=True)
class Marks:
    """What the canvas shows about states and operations besides what they are.

    ``running`` is an operation and its share of time in 0..1, None where that is not known;
    ``running_words`` stands beside it ("2.9 of 4.9 s"). ``findings`` give the worst severity
    letter (E, W, I) of an address. ``facts`` give what was sensed of a state's digit: ``agrees``,
    ``differs``, ``unknown`` or ``transit``. ``goals`` are named below their node. ``dimmed`` says
    that everything no mark speaks of steps back, as in a run. ``changes`` give the sign of what a
    comparison tells of an address: ``+`` added, ``-`` removed, ``~`` changed. ``guards`` say how
    what an operation requires stands: ``true``, ``false`` or ``unknown``, and in words.
    """

    selection: tuple[Address, ...] = ()
    active: str | None = None
    running: tuple[Address, float | None] | None = None
    running_words: str = ""
    visited: frozenset[str] = frozenset()
    trail: tuple[Address, ...] = ()
    planned: tuple[Address, ...] = ()
    next_states: frozenset[str] = frozenset()
    pruned: frozenset[Address] = frozenset()
    risky: frozenset[Address] = frozenset()
    held_back: frozenset[Address] = frozenset()
    possible: frozenset[Address] = frozenset()
    """Operations that can be asked for now: they keep their colour where the rest is dimmed."""
    findings: Mapping[Address, str] = field(default_factory=lambda: MappingProxyType({}))
    facts: Mapping[tuple[str, int], str] = field(default_factory=lambda: MappingProxyType({}))
    changes: Mapping[Address, str] = field(default_factory=lambda: MappingProxyType({}))
    guards: Mapping[Address, tuple[str, str]] = field(default_factory=lambda: MappingProxyType({}))
    goals: frozenset[str] = frozenset()
    dimmed: bool = False
