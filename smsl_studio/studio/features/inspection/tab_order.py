"""Sets the order in which the key Tab goes through widgets that were made later."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QWidget


def in_order(after: QWidget, widgets: Sequence[QWidget]) -> None:
    """Let the key Tab go from ``after`` through some widgets in their order.

    Qt places every new widget at the end of the window's order.
    """
    for widget in widgets:
        QWidget.setTabOrder(after, widget)
        after = widget
