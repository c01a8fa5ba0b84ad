"""The menus of recent files and of samples, filled when they open."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import samples

WIDEST = 70
"""The width of an entry, in average characters; the tooltip has the whole path."""


def fill_recent(files: Files, menu: QMenu) -> None:
    """Fill a menu with the files opened or saved last."""
    menu.clear()
    menu.setToolTipsVisible(True)
    names = Counter(path.name for path in files.recent)
    for path in files.recent:
        # Two files with the same name are shown with their folders.
        said = path.name if names[path.name] == 1 else f"{path.name} in {path.parent}"
        room = menu.fontMetrics().averageCharWidth() * WIDEST
        shown = menu.fontMetrics().elidedText(plain_text(said), Qt.TextElideMode.ElideMiddle, room)
        menu.addAction(as_it_is(shown), partial(files.open, path)).setToolTip(tip_text(str(path)))
    if menu.isEmpty():
        menu.addAction("No file was opened yet").setEnabled(False)


def fill_samples(open_copy: Callable[[Path], object], menu: QMenu) -> None:
    """Fill a menu with the samples; each opens as a copy."""
    menu.clear()
    for path in samples():
        menu.addAction(as_it_is(path.name), partial(open_copy, path))
