"""Brings a part into view in everything that scrolls around it."""

from __future__ import annotations

from PySide6.QtWidgets import QScrollArea, QWidget

MARGIN = 8
"""Pixels around the part that come into view, too."""


def scroll_to(part: QWidget) -> None:
    """Scroll every scroll area around a part so that the part is seen."""
    above = part.parentWidget()
    while above is not None:
        if isinstance(above, QScrollArea):
            above.ensureWidgetVisible(part, MARGIN, MARGIN)
        above = above.parentWidget()
