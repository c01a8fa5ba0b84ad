"""What is asked of a person about files, and what may be answered."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, Protocol

Answer = Literal["save", "discard", "cancel"]
Interrupted = Literal["finish", "undo", "cancel"]


class Asker(Protocol):
    """Who asks the person; the dialogs of the window, or a test."""

    def file_to_open(self, folder: Path) -> Path | None:
        """The file to open, None where it was called off."""

    def file_to_save(self, suggested: Path) -> Path | None:
        """Where to save, None where it was called off."""

    def unsaved(self, said: str) -> Answer:
        """What becomes of unsaved changes; ``said`` names the files."""

    def interrupted(self, names: str, when: str) -> Interrupted:
        """What becomes of a save of these files that was interrupted, before one is opened."""

    def may_overwrite(self, names: str) -> bool:
        """Whether to save over what another program has written."""

    def may_lose(self, said: str) -> bool:
        """Whether to save although the file loses something; ``said`` tells what."""

    def may_save_broken(self, name: str, faults: str) -> bool:
        """Whether to save a text that does not read as a blueprint."""

    def may_leave_comments(self, name: str, form: str) -> bool:
        """Whether to save in a form into which comments do not come along."""
