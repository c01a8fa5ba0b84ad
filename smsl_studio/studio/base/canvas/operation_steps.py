"""Steps by keys: from a state to its operations, from an operation to its states."""

from __future__ import annotations

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.hidden_marks import hidden_tip


def step_operation(canvas: BranchView, step: int) -> bool:
    """Select the next (1) or the former (-1) operation of the selected state, or of the state that
    the selected operation leaves. After the last one comes the first.

    If names between its states have no room on the drawing, a sentence reads them. False if
    neither a state nor an operation is selected alone.
    """
    chosen, sheet = _chosen(canvas), canvas.sheet
    if chosen is None or sheet is None:
        return False
    branch = sheet.picture.branch
    names = list(branch.table[chosen.state])
    if not names:
        canvas.say(f"No operation leaves {chosen.state}.")
        return True
    if chosen.operation:
        at = (names.index(chosen.operation) + step) % len(names)
    else:
        at = 0 if step > 0 else len(names) - 1
    address = Address(branch.name, chosen.state, names[at])
    _select(canvas, address)
    hidden = hidden_tip(sheet, sheet.picture.edge(address))
    if hidden:
        canvas.say(f"{hidden}.")
    return True


def go_to_target(canvas: BranchView) -> bool:
    """Select the state that the selected operation leads to; False if none is selected alone."""
    chosen, sheet = _chosen(canvas), canvas.sheet
    if chosen is None or not chosen.operation or sheet is None:
        return False
    branch = sheet.picture.branch
    target = branch.table[chosen.state][chosen.operation]
    if target in branch.table:
        canvas.came_by = chosen
        _select(canvas, Address(branch.name, target))
    else:
        canvas.say(f"{chosen.operation} leads to {target}, which is no state of {branch.name}.")
    return True


def go_to_source(canvas: BranchView) -> bool:
    """Select the state that the selected operation leaves. From a state it leads back to the
    operation by which ``go_to_target`` came there. False if there is none."""
    chosen = _chosen(canvas)
    if chosen is None:
        return False
    if not chosen.operation:
        return _go_back(canvas, chosen)
    _select(canvas, Address(chosen.branch, chosen.state))
    return True


def _go_back(canvas: BranchView, state: Address) -> bool:
    by, sheet = canvas.came_by, canvas.sheet
    row = sheet.picture.branch.table.get(by.state, {}) if by is not None and sheet else {}
    if by is None or by.branch != state.branch or row.get(by.operation) != state.state:
        return False
    _select(canvas, by)
    return True


def _chosen(canvas: BranchView) -> Address | None:
    """The only selected state or operation of the SB that is shown."""
    selection, sheet = canvas.marks.selection, canvas.sheet
    if len(selection) != 1 or sheet is None:
        return None
    (address,) = selection
    operations = sheet.picture.branch.table.get(address.state)
    there = operations is not None and (not address.operation or address.operation in operations)
    return address if there and address.branch == sheet.picture.branch.name else None


def _select(canvas: BranchView, address: Address) -> None:
    canvas.selection_wanted.emit((address,))
    canvas.reveal(address)
