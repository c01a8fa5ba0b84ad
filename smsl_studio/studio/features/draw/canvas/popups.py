"""Menus whose entries are only known when they open: recent files, samples, sub-SBs."""

from __future__ import annotations

from collections import Counter
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.files.fresh import samples
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.draw_verbs import DrawVerbs

MOST = 64
"""So many facts are offered in a menu."""
WIDEST = 70
"""Characters of a recent file's name and folder; its tooltip has it all."""


def passing_menu(window: QWidget) -> QMenu:
    """A menu for one time; it goes when it is left."""
    menu = QMenu(window)
    menu.aboutToHide.connect(menu.deleteLater)
    return menu


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


def fill_sub_sbs(session: Session, drawing: DrawVerbs, menu: QMenu) -> None:
    """The facts of the SB that is shown, and the SBs that could expand each."""
    branch = session.blueprint[session.branch]
    for digit in range(min(branch.num_facts, MOST)):
        inner = menu.addMenu(as_it_is(f"{digit}  {branch.fact_name(digit)}"))
        taken = branch.subs.get(digit)
        if taken is not None:
            inner.addAction(as_it_is(f"Expanded by {taken}")).setEnabled(False)
            continue
        for name in session.blueprint.branches:
            if name != branch.name and name not in branch.subs.values():
                inner.addAction(as_it_is(name), partial(drawing.attach, digit, name))
        inner.addAction("New State Branch", partial(drawing.attach, digit, None))
