"""The menu of what can be deleted from a fact. Del on a fact in the outline opens it."""

from __future__ import annotations

from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.fact_changes import deletion
from smsl_studio.studio.document.session import Session


def fact_menu(session: Session, branch: str, digit: int, parent: QWidget) -> QMenu:
    """The ways to delete parts of a fact, each an undoable step.

    The last line deletes the fact itself, from all states. It tells how many change, or why the
    fact cannot be deleted.
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
    whole = deletion(shown, digit)
    words = f"Delete the fact: {whole.sentence}" if whole.ready else whole.sentence
    drop = menu.addAction(as_it_is(words))
    drop.setEnabled(whole.ready)
    drop.triggered.connect(lambda: session.edit(whole.step, whole.change))
    return menu
