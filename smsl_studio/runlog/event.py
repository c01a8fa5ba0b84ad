"""The base of all run events: a frozen value with a word, a simulated time and a line of JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar

from smsl_studio.legible import json_text

Json = Any


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """What every event has: its word and its simulated time."""

    event: ClassVar[str] = ""
    t: float

    def as_json(self) -> dict[str, Json]:
        """The event as plain values, its word first, times rounded to a microsecond."""
        values: dict[str, Json] = {"event": self.event}
        for item in fields(self):
            value = getattr(self, item.name)
            values[item.name] = _plain(value)
        return values

    def line(self) -> str:
        """The event as one line of JSON, in which what is hidden is spelled as an escape."""
        return json_text(json.dumps(self.as_json(), ensure_ascii=False, separators=(",", ":")))


def _plain(value: Json) -> Json:
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, float):
        return round(value, 6)
    return [_plain(item) for item in value] if isinstance(value, tuple) else value
