"""The questions about files that a person is asked, and the possible answers."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, Protocol

Answer = Literal["save", "discard", "cancel"]
Interrupted = Literal["finish", "undo", "cancel"]


class Asker(Protocol):
    """Asks the person: the dialogs of the window, or a test."""

    def file_to_open(self, folder: Path) -> Path | None:
        """The file to open; None if the person cancels."""

    def file_to_save(self, suggested: Path) -> Path | None:
        """Where to save; None if the person cancels."""

    def unsaved(self, said: str) -> Answer:
        """What to do with unsaved changes; ``said`` names the files."""

    def interrupted(self, names: str, when: str) -> Interrupted:
        """What to do with an interrupted save of these files, before one is opened."""

    def may_overwrite(self, names: str) -> bool:
        """Whether to save over the changes of another program."""

    def may_lose(self, said: str) -> bool:
        """Whether to save although the file loses properties; ``said`` names them."""

    def may_save_broken(self, name: str, faults: str) -> bool:
        """Whether to save a text that cannot be read as a blueprint."""

    def may_drop(self, said: str) -> bool:
        """Whether to leave although something typed is nowhere else; ``said`` tells it."""

    def may_leave_comments(self, name: str, form: str) -> bool:
        """Whether to save in a form without the comments."""
