"""Whether a person wants less motion: then the view jumps where it would glide."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication

_NAME = "smsl less motion"


def is_calm() -> bool:
    """Whether nothing should glide."""
    application = QCoreApplication.instance()
    return application is not None and bool(application.property(_NAME))


def set_calm(on: bool) -> None:
    """Let the views of all windows jump, or glide again."""
    application = QCoreApplication.instance()
    if application is not None:
        application.setProperty(_NAME, on)
