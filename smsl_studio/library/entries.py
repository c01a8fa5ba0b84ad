"""What a library keeps of a fault, of a cost function, and of an automatic supervisor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from smsl_studio.library.pattern import Pattern
from smsl_studio.library.signature import Signature


@dataclass(frozen=True, slots=True)
class FaultEntry:
    """A fault that can be injected into a world by its name."""

    world: str
    name: str
    function: Callable[..., Any]
    signature: Signature


@dataclass(frozen=True, slots=True)
class CostEntry:
    """A cost function, and the pattern of the operations whose edges it prices."""

    function: Callable[..., Any]
    name: str
    pattern: Pattern
    signature: Signature


@dataclass(frozen=True, slots=True)
class SupervisorEntry:
    """An automatic supervisor. ``limit`` is the wall time (s) that an answer may take. ``prepare``
    is called once with the options, before the run.
    """

    function: Callable[..., Any]
    name: str
    signature: Signature
    limit: float
    prepare: Callable[..., Any] | None = None
