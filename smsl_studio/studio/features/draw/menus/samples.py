"""The sample files as actions. The palette finds them by name; no menu of the table holds them."""

from __future__ import annotations

from functools import partial

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import samples
from smsl_studio.studio.document.files.sample_titles import TITLES


def sample_actions(files: Files) -> tuple[Action, ...]:
    """One action for each sample; it opens a copy of the sample."""
    return tuple(
        Action(f"sample_{path.name}", _words(path.name), partial(files.open_copy, path),
               icon="file", tip=f"Open a copy of the sample {path.name}")
        for path in samples()
    )  # fmt: skip


def _words(file: str) -> str:
    """The name of the file, and the title that the start page shows, so that both are found."""
    return f"Open sample {file}" + (f": {TITLES[file]}" if file in TITLES else "")
