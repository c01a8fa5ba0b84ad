"""The menu of what can be deleted from a fact. Del on a fact in the outline opens it."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.words import as_it_is, counted
from smsl_studio.studio.document.session import Session


def fact_menu(session: Session, branch: str, digit: int, parent: QWidget) -> QMenu:
    """The ways to delete parts of a fact, each an undoable step.

    The fact itself is a digit in the name of every state. It goes when the states are renamed; the
    last line of the menu says so.
    """
    blueprint = session.blueprint
    shown = blueprint[branch]
    name, sub = shown.fact_name(digit), shown.subs.get(digit)
    menu = QMenu(parent)
    menu.setAccessibleName(plain_text(f"Delete digit {digit} of {branch}"))
    if sub is not None:
        detach = menu.addAction(as_it_is(f"Detach {sub} from {name}"))
        detach.triggered.connect(
            lambda: session.edit(
                f"Detach {sub} from digit {digit} of {branch}",
                lambda bp: editing.detach_sub(bp, branch, sub),
            )
        )
    if str(digit) in (shown.fields.get("_facts") or {}):
        clear = menu.addAction(as_it_is(f"Delete what is written about {name}"))
        clear.triggered.connect(
            lambda: session.edit(
                f"Delete what is written about digit {digit} of {branch}",
                lambda bp: editing.set_note(bp, branch, "_facts", str(digit), None),
            )
        )
    states = counted(len(shown.table), "state")
    why = menu.addAction(f"It is digit {digit} in the names of {states}: rename them to drop it")
    why.setEnabled(False)
    return menu
