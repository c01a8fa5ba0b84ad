"""The order in which Tab goes through widgets that are made anew."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtWidgets import QWidget


def in_order(after: QWidget, widgets: Sequence[QWidget]) -> None:
    """Let Tab go from ``after`` through some widgets, and then to what followed it.

    Qt puts a new widget behind all others of its window.
    """
    for widget in widgets:
        QWidget.setTabOrder(after, widget)
        after = widget
