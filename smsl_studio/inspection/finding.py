"""Finding: what a rule has to say about one place."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place

LISTED = 100
"""A rule lists so many findings of one SB, and says how many more there are."""


class Severity(Enum):
    """E blocks approval, W needs a written disposition, I is a note."""

    ERROR = "E"
    WARNING = "W"
    NOTE = "I"


@dataclass(frozen=True, slots=True)
class Fix:
    """A quick fix: the words on its button, and the edit it makes (undoable as one step)."""

    words: str
    apply: Callable[[Blueprint], Blueprint] = field(compare=False)


@dataclass(frozen=True, slots=True)
class Finding:
    """One finding: rule, severity, where (address and place), a sentence, an advice, a fix."""

    rule: str
    severity: Severity
    address: Address
    place: Place
    message: str
    advice: str = ""
    fix: Fix | None = None

    @classmethod
    def at(
        cls,
        blueprint: Blueprint,
        rule: str,
        severity: Severity,
        address: Address,
        message: str,
        *,
        advice: str = "",
        fix: Fix | None = None,
        below: tuple[str, ...] = (),
    ) -> Finding:
        """A finding at the key of ``address``, or at the key ``below`` it (HEADER, INITIAL)."""
        place = blueprint.place(address, *below)
        return cls(rule, severity, address, place, message, advice, fix)

    def __str__(self) -> str:
        advice = f"; {self.advice}" if self.advice else ""
        return f"{self.place} {self.rule} {self.address}: {self.message}{advice}"

    def as_json(self) -> dict[str, Any]:
        """The finding as the command line reports it."""
        return {
            "rule": self.rule,
            "severity": self.severity.value,
            "address": str(self.address),
            "line": self.place.line,
            "column": self.place.column,
            "message": self.message,
            "advice": self.advice,
            "fix": self.fix.words if self.fix else None,
        }
