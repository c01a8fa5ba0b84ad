"""What an assistive tool can do with a state or operation on a canvas.

Each act asks the canvas as a gesture or a key does, so it can do nothing that a person cannot.
"""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import SignalInstance

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.accessible_leaf import FOCUS, MENU, PRESS, Acts, Call
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.operation_steps import go_to_source, go_to_target

TARGET, SOURCE = "Go to target", "Go to source"
RENAME, DELETE, ADD = "Rename", "Delete", "Add operation"


def state_acts(canvas: Canvas, state: Address) -> Acts:
    """What can be done with a state: choose it, show the sub-SBs, its menu, and the edits."""
    found = _acts(canvas, state)
    if canvas.editing:
        add = partial(_then, canvas, state, canvas.quick_add_wanted)
        found[ADD] = ("Ask for an operation from here", add)
    subs = canvas.sheet.picture.branch.subs.values() if canvas.sheet is not None else ()
    for sub in dict.fromkeys(subs):
        found[f"Show {sub}"] = (f"Show the sub-SB {sub}", partial(canvas.enter_wanted.emit, sub))
    return found


def operation_acts(canvas: Canvas, operation: Address) -> Acts:
    """What can be done with an operation: choose it, follow it, its menu, and the edits."""

    def follow(end: Call) -> None:
        """Select the operation, and then the state at one of its ends."""
        canvas.selection_wanted.emit((operation,))
        end(canvas)

    found = _acts(canvas, operation)
    found[TARGET] = ("Select the state that it leads to", partial(follow, go_to_target))
    found[SOURCE] = ("Select the state that it leaves", partial(follow, go_to_source))
    return found


def _acts(canvas: Canvas, address: Address) -> dict[str, tuple[str, Call]]:
    choose = partial(_choose, canvas, address)
    found: dict[str, tuple[str, Call]] = {PRESS: ("Select it", choose)}
    # What the tools of Linux call grabbing the focus.
    found[FOCUS] = ("Select it, so that the keys are about it", choose)
    if canvas.editing:
        delete = partial(_then, canvas, address, canvas.delete_wanted)
        found[RENAME] = ("Edit its name in place", partial(canvas.rename_wanted.emit, address))
        found[DELETE] = ("Delete it", delete)
        found[MENU] = ("Open its menu", partial(_open_menu, canvas, address))
    return found


def _choose(canvas: Canvas, address: Address) -> None:
    """Select an element, as a click on it does."""
    canvas.setFocus()
    canvas.selection_wanted.emit((address,))
    canvas.reveal(address)
    if not canvas.editing:
        clicked = canvas.edge_clicked if address.operation else canvas.node_clicked
        clicked.emit(address)


def _then(canvas: Canvas, address: Address, wanted: SignalInstance) -> None:
    """Select an element, and then ask for what is done with the selection."""
    canvas.setFocus()
    canvas.selection_wanted.emit((address,))
    wanted.emit()


def _open_menu(canvas: Canvas, address: Address) -> None:
    canvas.reveal(address, smooth=False)
    canvas.context_wanted.emit(address, canvas.place_of(address).center())
