"""Interrupted saves of several files. The person decides before one of the files is shown."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime
from typing import Literal

from smsl_studio.errors import SaveError
from smsl_studio.smsl.pending_saves import PendingSave
from smsl_studio.smsl.unfinished import finish, interrupted_saves, undo
from smsl_studio.studio.base.words import counted, series
from smsl_studio.studio.document.files.questions import Asker

MOST = 3
"""The most files that a question names."""
Settled = Literal["nothing", "changed", "called off"]


def settle_interrupted(files: Iterable[str], asker: Asker) -> Settled:
    """Ask about every interrupted save of these files, and do what the person chose.

    Raises SaveError if that is not possible. The files can then be read as before.
    """
    found = interrupted_saves(files)
    for save in found:
        names = _names(save)
        when = f"on {datetime.fromtimestamp(save.begun):%d %B %Y at %H:%M}"
        answer = asker.interrupted(names, when)
        if answer == "cancel":
            return "called off"
        if answer == "undo":
            undo(save)
        else:
            finish(save)
        if save.record.exists():
            raise SaveError(
                f"the interrupted save of {names} could not be settled",
                advice="Check the right to write in the folders of these files.",
            )
    return "changed" if found else "nothing"


def _names(save: PendingSave) -> str:
    names = [file.target.name for file in save.files]
    if len(names) > MOST:
        return f"{', '.join(names[:MOST])} and {counted(len(names) - MOST, 'more file')}"
    return series(names)
