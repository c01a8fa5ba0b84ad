"""Sets the order in which the key Tab goes through widgets that were made later."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget


def in_order(after: QWidget, widgets: Sequence[QWidget]) -> None:
    """Let the key Tab go from ``after`` through some widgets in their order.

    Qt places every new widget at the end of the window's order.
    """
    for widget in widgets:
        QWidget.setTabOrder(after, widget)
        after = widget


def put_before(part: QWidget, follower: QWidget) -> None:
    """Let the key Tab go through a part that was made last, and then to ``follower``."""
    widgets: list[QWidget] = []
    at = part.nextInFocusChain()
    while at is not None and part.isAncestorOf(at):
        widgets.append(at)
        at = at.nextInFocusChain()
    before = follower.previousInFocusChain()
    # Qt orders only widgets that take the focus.
    while before is not None and not _takes_keys(before):
        before = before.previousInFocusChain()
    if before is not None:
        in_order(before, [widget for widget in widgets if _takes_keys(widget)])


def go_on(widget: QWidget, forward: bool = True) -> None:
    """Move the keyboard focus from a widget to the next one, as Tab does, or to the one before.

    That is so for a widget too that has another use for Tab.
    """
    widget.setFocus(Qt.FocusReason.TabFocusReason)
    QWidget.focusNextPrevChild(widget, forward)


def _takes_keys(widget: QWidget) -> bool:
    return widget.focusPolicy() != Qt.FocusPolicy.NoFocus
