"""The menu at the pointer: the actions for the element there or for the empty canvas."""

from __future__ import annotations

from functools import partial

from PySide6.QtGui import QCursor
from PySide6.QtWidgets import QMenu, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.passing_menu import passing_menu
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.align_verbs import fill_align
from smsl_studio.studio.features.draw.canvas.clipboard import ClipboardVerbs
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.library_verbs import fill_templates

ON_CANVAS = ("add_branch", "tidy", "", "select_all", "fit")
ON_OPERATION = ("rename", "", "cut", "copy", "duplicate", "")
ON_STATE = ("add_operation", *ON_OPERATION)
"""The first lines. Below them stand the actions that name the kind of element as ``pointer``."""


def context_menu(
    session: Session,
    editor: CanvasEditor,
    actions: Actions,
    clipping: ClipboardVerbs,
    address: Address | None,
) -> QMenu:
    """The menu for an element, which gets selected, or for the empty canvas (None)."""
    name = address.path[-1] if address is not None else "the drawing"
    menu = passing_menu(_window(editor), f"Menu of {name}")
    if address is None:
        at = editor.canvas.mapToScene(editor.canvas.mapFromGlobal(QCursor.pos()))
        add = menu.addAction("Add a state here", partial(editor.add_state_at, at))
        add.setIcon(actions["add_state"].icon())
        menu.addAction("Paste here", partial(clipping.paste, at))
        note = menu.addAction("Add a note here", partial(editor.canvas.note_wanted.emit, at))
        note.setIcon(actions["add_note"].icon())
        _add(menu, actions, ON_CANVAS)
        _add_home(menu, session, actions)
        return menu
    if address not in session.selection:
        session.select((address,))
    actions.refresh()
    if address.operation:
        _add(menu, actions, (*ON_OPERATION, *_at_pointer(actions, "operation")))
        fill_templates(actions, menu.addMenu("Insert template"))
        return menu
    _add(menu, actions, (*ON_STATE, *_at_pointer(actions, "state")))
    if actions["align"].isEnabled():
        inner = menu.addMenu("Align")
        inner.setIcon(actions["align"].icon())
        fill_align(actions, inner)
    fill_templates(actions, menu.addMenu("Insert template"))
    menu.addSeparator()
    for key, words in (("INITIAL", "Make initial"), ("ACTIVATING", "Make activating")):
        chosen = getattr(session.blueprint[address.branch], key.lower()) == address.state
        mark = menu.addAction(words, partial(_set, session, key, address))
        mark.setCheckable(True)
        mark.setChecked(chosen)
    _add_home(menu, session, actions)
    return menu


def _add_home(menu: QMenu, session: Session, actions: Actions) -> None:
    """Offer to open the file of an SB that is imported."""
    if session.branch in session.blueprint.imported:
        menu.addSeparator()
        menu.addAction(actions["open_home"])


def _set(session: Session, key: str, address: Address) -> None:
    session.edit(
        f"Set {key} to {address.state}",
        lambda bp: editing.set_header(bp, address.branch, key, address.state),
    )


def _at_pointer(actions: Actions, kind: str) -> tuple[str, ...]:
    return tuple(name for name, action in actions.table.items() if kind in action.pointer)


def _add(menu: QMenu, actions: Actions, names: tuple[str, ...]) -> None:
    for name in names:
        if name:
            menu.addAction(actions[name])
        else:
            menu.addSeparator()


def _window(editor: CanvasEditor) -> QWidget:
    return editor.canvas.window()
