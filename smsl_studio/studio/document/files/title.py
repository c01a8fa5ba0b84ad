"""The words of the title bar."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Title:
    """The name of what is open, and words about unsaved changes (empty if there are none)."""

    name: str
    edited: str

    def __str__(self) -> str:
        return f"{self.name} ({self.edited})" if self.edited else self.name
