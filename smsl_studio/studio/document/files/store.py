"""Writing texts to the disk without overwriting changes of another program unasked."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from smsl_studio.errors import FileChanged
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.together import save_together
from smsl_studio.studio.document.files.on_disk import OnDisk

TRIES = 5
"""The most attempts, if another program writes a file again and again meanwhile."""

Pairs = Sequence[tuple[Document, Path]]
Ask = Callable[[list[str]], bool]
"""Asks whether to overwrite changes of another program in these files."""


def store(pairs: Pairs, on_disk: OnDisk, ask: Ask, chosen: Path | None = None) -> bool:
    """Write documents to their places, all or none; returns whether the person agreed.

    ``ask`` is called if another program has written one of the files since it was read. If that
    happens again after the answer, it is called again. ``chosen`` is a place that the person has
    agreed to overwrite already. Raises SaveError if nothing could be written.
    """
    given_up = str(chosen)
    tries = 0
    while True:
        tries += 1
        looks = {str(path): on_disk.look(document.file) for document, path in pairs}
        texts = {str(path): document.text for document, path in pairs}
        changed = [
            look.file
            for path, look in looks.items()
            if path != given_up and look.changed and not look.gone and look.text != texts[path]
        ]
        if changed and not ask(changed):
            return False
        over = {path: look.seen for path, look in looks.items() if look.seen is not None}
        try:
            save_together(pairs, over)
        except FileChanged as error:
            if tries == TRIES:
                raise
            given_up = "" if error.file == given_up else given_up
            continue
        for document, _ in pairs:
            on_disk.saw(document.file, document.text)
        return True
