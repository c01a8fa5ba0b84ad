"""What a screen reader reads out at once, wherever the keyboard focus is."""

from __future__ import annotations

from PySide6.QtGui import QAccessible, QAccessibleAnnouncementEvent, QAccessibleEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.legible import plain_text


def announce(about: QWidget, words: str, urgent: bool = False) -> None:
    """Let a screen reader read a sentence. An ``urgent`` one interrupts what is being read."""
    said = plain_text(words).strip()
    if said and QAccessible.isActive():
        event = QAccessibleAnnouncementEvent(about, said)
        if urgent:
            event.setPoliteness(QAccessible.AnnouncementPoliteness.Assertive)
        QAccessible.updateAccessibility(event)


def tell_name(of: QWidget) -> None:
    """Let a screen reader know that a widget is called otherwise now, because it keeps names."""
    if QAccessible.isActive():
        QAccessible.updateAccessibility(QAccessibleEvent(of, QAccessible.Event.NameChanged))
