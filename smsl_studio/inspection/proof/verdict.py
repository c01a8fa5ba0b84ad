"""Verdicts: what was shown about one hazard or property."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address

Json = Any
HOLDS, FAILS, UNKNOWN = "holds", "fails", "unknown"
HAZARD = "hazard"
EXPLICIT = "explicit"
"""The engine that looks at configurations one by one."""


@dataclass(frozen=True)
class Counterexample:
    """A shortest run that shows why something fails.

    ``during`` is the edge that is carried out at the end, if the end is not committed.
    """

    start: Mapping[str, str]
    path: tuple[Address, ...]
    end: Mapping[str, str]
    during: Address | None = None

    def as_json(self) -> dict[str, Json]:
        """Return it as ``check`` writes it."""
        found: dict[str, Json] = {
            "start": dict(self.start),
            "path": [str(one) for one in self.path],
            "end": dict(self.end),
        }
        if self.during is not None:
            found["during"] = str(self.during)
        return found


@dataclass(frozen=True)
class PropertyVerdict:
    """Whether one hazard or property holds, with how much was looked at.

    ``kind`` is that of the property, or ``hazard``. ``configurations`` counts those that can be
    reached and are committed, None if they were not counted. ``bound`` says which limit was met.
    """

    name: str
    kind: str
    severity: str
    verdict: str
    configurations: int | None
    bound: str | None = None
    counterexample: Counterexample | None = None
    engine: str = EXPLICIT

    @property
    def address(self) -> Address:
        """``_hazards/NAME`` or ``_properties/NAME``."""
        return Address("_hazards" if self.kind == HAZARD else "_properties", self.name)

    def as_json(self) -> dict[str, Json]:
        """Return it as ``check`` writes it."""
        return {
            "name": self.name,
            "kind": self.kind,
            "verdict": self.verdict,
            "configurations": self.configurations,
            "engine": self.engine,
            "bound": self.bound,
        }
