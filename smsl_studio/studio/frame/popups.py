"""Menus whose entries are only known when they open: recent files, samples, sub-SBs."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.studio.drawing import Drawing
from smsl_studio.studio.files.files import Files, samples
from smsl_studio.studio.session import Session

MOST = 64
"""So many facts are offered in a menu."""


def passing_menu(window: QWidget) -> QMenu:
    """A menu for one time; it goes when it is left."""
    menu = QMenu(window)
    menu.aboutToHide.connect(menu.deleteLater)
    return menu


def fill_recent(files: Files, menu: QMenu) -> None:
    """The files opened or saved last."""
    menu.clear()
    menu.setToolTipsVisible(True)
    for path in files.recent:
        menu.addAction(path.name, partial(files.open, path)).setToolTip(str(path))
    if menu.isEmpty():
        menu.addAction("No file was opened yet").setEnabled(False)


def fill_samples(files: Files, menu: QMenu) -> None:
    """The samples; each is opened as a copy."""
    menu.clear()
    for path in samples():
        menu.addAction(path.name, partial(files.open_copy, path))


def fill_sub_sbs(session: Session, drawing: Drawing, menu: QMenu) -> None:
    """The facts of the SB that is shown, and the SBs that could expand each."""
    branch = session.blueprint[session.branch]
    for digit in range(min(branch.num_facts, MOST)):
        inner = menu.addMenu(f"{digit}  {branch.fact_name(digit)}")
        taken = branch.subs.get(digit)
        if taken is not None:
            inner.addAction(f"Expanded by {taken}").setEnabled(False)
            continue
        for name in session.blueprint.branches:
            if name != branch.name and name not in branch.subs.values():
                inner.addAction(name, partial(drawing.attach, digit, name))
        inner.addAction("New State Branch", partial(drawing.attach, digit, None))
