"""Menus of files, filled when they open: the recent ones, and the samples."""

from __future__ import annotations

from collections import Counter
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import samples

WIDEST = 70
"""Characters of a recent file's name and folder; its tooltip has it all."""


def fill_recent(files: Files, menu: QMenu) -> None:
    """The files opened or saved last."""
    menu.clear()
    menu.setToolTipsVisible(True)
    names = Counter(path.name for path in files.recent)
    for path in files.recent:
        # Of two files with one name the folder tells which is which.
        said = path.name if names[path.name] == 1 else f"{path.name} in {path.parent}"
        room = menu.fontMetrics().averageCharWidth() * WIDEST
        shown = menu.fontMetrics().elidedText(plain_text(said), Qt.TextElideMode.ElideMiddle, room)
        menu.addAction(as_it_is(shown), partial(files.open, path)).setToolTip(tip_text(str(path)))
    if menu.isEmpty():
        menu.addAction("No file was opened yet").setEnabled(False)


def fill_samples(files: Files, menu: QMenu) -> None:
    """The samples; each is opened as a copy."""
    menu.clear()
    for path in samples():
        menu.addAction(as_it_is(path.name), partial(files.open_copy, path))
