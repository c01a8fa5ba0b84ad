"""Marks: what is highlighted on the canvas, as one frozen value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from smsl_studio.blueprint.address import Address


@dataclass(frozen=True)
class Marks:
    """What the canvas shows about states and operations besides the blueprint itself.

    ``running`` is an operation and the share of its time that has passed (0 to 1), None if this is
    not known. ``running_words`` stand beside it ("2.9 of 4.9 s"). ``findings`` has the worst
    severity (E, W or I) for each address. ``facts`` says how a state's digit and the sensed fact
    compare: ``agrees``, ``differs``, ``unknown`` or ``transit``. The names of ``goals`` stand below
    their nodes. If ``dimmed``, everything without a mark is pale, as in a run. ``changes`` has the
    sign of a comparison for each address: ``+`` added, ``-`` removed, ``~`` changed. In a merge
    the sides stand before it: ``M~``, ``T+``, ``MT~``. In a run ``?+`` is proposed. ``conflicts``
    has the number of each conflict of a merge, a tick if it is chosen, or of a difference to rules,
    behind ``+`` (missing) or ``-`` (odd). ``guards`` says whether the required facts of an
    operation are ``true``, ``false`` or ``unknown``, and why in words. ``found`` are the hits of a
    search, and ``hit`` is the one that is shown. ``ways`` are the operations on the ways between
    two selected states. If ``walked``, the marks of a run show
    steps that somebody looks at, and nothing runs.
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
    """Operations that can be asked for now. They keep their colour if the rest is dimmed."""
    findings: Mapping[Address, str] = field(default_factory=lambda: MappingProxyType({}))
    facts: Mapping[tuple[str, int], str] = field(default_factory=lambda: MappingProxyType({}))
    changes: Mapping[Address, str] = field(default_factory=lambda: MappingProxyType({}))
    conflicts: Mapping[Address, str] = field(default_factory=lambda: MappingProxyType({}))
    guards: Mapping[Address, tuple[str, str]] = field(default_factory=lambda: MappingProxyType({}))
    goals: frozenset[str] = frozenset()
    found: tuple[Address, ...] = ()
    hit: Address | None = None
    ways: tuple[Address, ...] = ()
    dimmed: bool = False
    walked: bool = False
    failing: frozenset[Address] = frozenset()
    """The operations with which a run that is shown comes to its bad end. They look like errors."""
