"""What a mouse wheel does on a drawing: it zooms, or it scrolls up and down."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

_NAME = "smsl wheel scrolls"


def wheel_scrolls() -> bool:
    """Whether a wheel scrolls. Otherwise it zooms."""
    application = QCoreApplication.instance()
    return application is not None and bool(application.property(_NAME))


def set_wheel_scrolls(on: bool) -> None:
    """Let a wheel scroll the drawings of all windows, or zoom again."""
    application = QCoreApplication.instance()
    if application is not None:
        application.setProperty(_NAME, on)
