"""The base of all run events: a frozen value with a word and a simulated time, written as a line of
JSON.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar

from smsl_studio.legible import json_text

Json = Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """A run event. ``event`` is its word and ``t`` the simulated time (s)."""

    event: ClassVar[str] = ""
    sparse: ClassVar[tuple[str, ...]] = ()
    """The fields that are left out of the line while they are empty."""
    t: float

    def as_json(self) -> dict[str, Json]:
        """Return the event as plain values. The word comes first, and numbers are rounded to six
        decimals.
        """
        values: dict[str, Json] = {"event": self.event}
        for item in fields(self):
            value = getattr(self, item.name)
            if not value and item.name in self.sparse:
                continue
            values[item.name] = _plain(value)
        return values

    def line(self) -> str:
        """Return the event as one line of JSON, with invisible characters as escapes."""
        return json_text(json.dumps(self.as_json(), ensure_ascii=False, separators=(",", ":")))


def _plain(value: Json) -> Json:
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, float):
        return round(value, 6)
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
