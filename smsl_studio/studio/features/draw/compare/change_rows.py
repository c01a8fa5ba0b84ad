"""The rows of the list of changes."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import Change, ChangeKind, Difference
from smsl_studio.errors import Place
from smsl_studio.studio.base.rows import ListRow

ICONS = {ChangeKind.ADDED: "plus", ChangeKind.REMOVED: "minus"}
MOST_MOVED = 500


def rows_of(difference: Difference) -> list[ListRow]:
    """One row for each change.

    Then the other fields and the moved states, which change no meaning.
    """
    rows = [_row(difference, change) for change in difference.changes]
    if difference.fields:
        rows.append(ListRow("Fields without meaning, which are no change", kind="section"))
    rows.extend(replace(_row(difference, one), pale=True) for one in difference.fields)
    if difference.has_new_layout:
        rows.append(ListRow("Moved in the layout, which is no change of meaning", kind="section"))
    for address in difference.moved[:MOST_MOVED]:
        words = f"The state {address.state} of {address.branch} has another position."
        rows.append(ListRow(words, _moved(difference, address), "fit", pale=True))
    for address in difference.redrawn[:MOST_MOVED]:
        words = f"The line of {address.operation} in {address.state} is drawn in another way."
        rows.append(ListRow(words, _moved(difference, address), "fit", pale=True))
    for address in difference.pinned[:MOST_MOVED]:
        words = f"The state {address.state} of {address.branch} was pinned or unpinned."
        rows.append(ListRow(words, _moved(difference, address), "pin", pale=True))
    listed = (difference.moved, difference.redrawn, difference.pinned)
    left = sum(max(len(one) - MOST_MOVED, 0) for one in listed)
    if left > 0:
        rows.append(ListRow(f"and {left} more", kind="section"))
    return rows


def _row(difference: Difference, change: Change) -> ListRow:
    icon = ICONS.get(change.kind, "pencil")
    places = difference.place_before(change), difference.place_after(change)
    return ListRow(
        change.words,
        (change.before, change.after),
        icon,
        right=_lines(*places),
        accent=True,
        tip=change.words,
    )


def _lines(before: Place | None, after: Place | None) -> str:
    if before and after:
        return f"line {before.line} → {after.line}"
    if before:
        return f"line {before.line} before"
    return f"line {after.line} after" if after else ""


def _moved(difference: Difference, address: Address) -> tuple[Address | None, Address]:
    old_branch = next(
        (old for old, new in difference.branches.items() if new == address.branch), address.branch
    )
    renamed = difference.states.get(old_branch, {})
    state = next((old for old, new in renamed.items() if new == address.state), address.state)
    return Address(old_branch, state, address.operation), address
