"""The protocol of an object that handles the keys of an editor."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtGui import QKeyEvent


class Keys(Protocol):
    """Handles the keys of an editor before the text does."""

    def takes(self, event: QKeyEvent) -> bool:
        """Whether the key is for the text, even if it is a shortcut of the window."""

    def answer(self, event: QKeyEvent) -> bool:
        """Do what the key asks for. Returns False for an ordinary key."""

    def typed(self, event: QKeyEvent) -> None:
        """Called after an ordinary key was typed."""
