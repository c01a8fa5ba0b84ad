"""The elements of an SB as frozen values: header, state and operation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from smsl_studio.blueprint.address import Address

Json = Any
EMPTY: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Header:
    """The header as written. None means that a key has its default.

    ``sub_sbs`` are pairs (sub-SB, digit) in written order; a digit or a sub-SB may occur twice.
    ``num_states`` is only checked. ``unknown`` keys are kept. ``odd`` has known keys with a value
    of the wrong kind, as written. They count as missing, and inspection reports them, as it does
    entries of SUB_SBS whose digit is no whole number.
    """

    initial: str | None = None
    activating: str | None = None
    num_facts: int | None = None
    sub_sbs: tuple[tuple[str, int], ...] = ()
    num_states: int | None = None
    unknown: Mapping[str, Json] = field(default_factory=lambda: EMPTY)
    fields: Mapping[str, Json] = field(default_factory=lambda: EMPTY)
    present: bool = True
    subs_as_written: Json = None
    odd: Mapping[str, Json] = field(default_factory=lambda: EMPTY)


@dataclass(frozen=True, slots=True)
class Operation:
    """A permitted edge of ``branch``: from ``source`` by ``name`` to ``target``."""

    branch: str
    source: str
    name: str
    target: str

    @property
    def address(self) -> Address:
        """The address of this operation."""
        return Address(self.branch, self.source, self.name)


@dataclass(frozen=True, slots=True)
class State:
    """A node: its name, its fact values (digit 0 first) and its operations."""

    branch: str
    name: str
    facts: tuple[str, ...]
    operations: Mapping[str, Operation]

    @property
    def address(self) -> Address:
        """The address of this state."""
        return Address(self.branch, self.name)
