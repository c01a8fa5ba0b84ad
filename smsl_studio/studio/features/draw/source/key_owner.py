"""Who answers the keys of an editor."""

from __future__ import annotations

from typing import Protocol

from PySide6.QtGui import QKeyEvent


class Keys(Protocol):
    """Who answers the keys of an editor before the text does."""

    def takes(self, event: QKeyEvent) -> bool:
        """Whether the key is for the text, whatever it means elsewhere in the window."""

    def answer(self, event: QKeyEvent) -> bool:
        """Do what the key asks for; False where it is an ordinary one."""

    def typed(self, event: QKeyEvent) -> None:
        """An ordinary key was typed."""
