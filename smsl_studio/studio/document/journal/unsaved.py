"""The unsaved work of a window: all texts that are not on the disk, also just typed ones."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from datetime import datetime

from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.journal.entry import JournalEntry, KeptText
from smsl_studio.studio.document.session import Session


class Unsaved:
    """Collects the unsaved work for the journal.

    ``pending`` returns the texts in which something is typed that is no step of the history yet.
    """

    def __init__(
        self, session: Session, files: Files, pending: Callable[[], Mapping[str, str]]
    ) -> None:
        self._session, self._files, self._pending = session, files, pending

    def __call__(self, changes: int) -> JournalEntry | None:
        """The work that exists only in this window; None if there is none."""
        files, own = self._files, self._session.blueprint.file
        texts = {**self._files.texts, **self._pending()}
        unsaved = files.unsaved_of(texts)
        if not unsaved:
            return None
        digest = files.on_disk.digest
        kept = (KeptText(self._named(file), texts[file], digest(file)) for file in unsaved)
        return JournalEntry(
            files.name,
            str(files.path or ""),
            self._named(own),
            datetime.now().isoformat(timespec="seconds"),
            changes,
            tuple(kept),
        )

    def _named(self, file: str) -> str:
        """The absolute path of a file, because the next start may have another working folder."""
        own = file == self._session.blueprint.file
        if own:
            return str(self._files.path or file)
        return os.path.abspath(file)  # noqa: PTH100
