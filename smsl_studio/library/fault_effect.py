"""What a fault does to an operation, as far as a plugin can tell without its world.

Campaigns foresee with it how a run goes on: ``library.fault(..., effect=function)``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class FaultEffect:
    """The facts after a disturbed operation, and what stays impossible.

    ``facts`` has the facts of the operation's SB that differ from those of its source, by digit
    from 0; None is an unknown fact. ``shut`` has arguments of operations: each operation that has
    all arguments of an entry stays impossible, and an entry without arguments means every one.
    ``why`` says what stays impossible, such as "the arm cannot move".
    """

    facts: Mapping[int, str | None] = field(default_factory=dict)
    shut: tuple[Mapping[str, Any], ...] = ()
    why: str = ""


FAILS = FaultEffect()
"""The operation fails, and nothing else changes."""
