"""Who gives way in a row that is too narrow for all of its parts."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget


class Precedence:
    """Hides parts of a row, the first named first, until the others fit; those not named stay.

    The row must be laid out by its own layout. Whether a part is wanted at all is said to ``want``,
    not to the part, because a part that is wanted may still have no room.
    """

    def __init__(self, row: QWidget, *parts: QWidget) -> None:
        self._row, self._parts = row, parts
        self._unwanted: set[QWidget] = set()
        # The row never asks for more room than its window has.
        row.setMinimumWidth(1)

    def want(self, part: QWidget, wanted: bool) -> None:
        """Say whether a part belongs in the row just now; ``fit`` shows it where it has room."""
        if wanted:
            self._unwanted.discard(part)
        else:
            self._unwanted.add(part)

    def fit(self) -> None:
        """Show what is wanted and fits into the row as wide as it is."""
        layout = self._row.layout()
        if layout is None:
            return
        shown = {part: part not in self._unwanted for part in self._parts}
        needed = self._needed(shown)
        for part in self._parts:
            if needed <= self._row.width():
                break
            if shown[part]:
                shown[part] = False
                needed = self._needed(shown)
        for part, fits in shown.items():
            if part.isHidden() == fits:
                part.setVisible(fits)

    def _needed(self, shown: dict[QWidget, bool]) -> int:
        """Pixels of the row with these of the parts, and with all others that are in it."""
        layout = self._row.layout()
        assert layout is not None
        margins = layout.contentsMargins()
        wide, count = margins.left() + margins.right(), 0
        for at in range(layout.count()):
            item = layout.itemAt(at)
            part = item.widget() if item is not None else None
            if item is None:
                continue
            if part is None:
                wide += item.minimumSize().width()
            elif shown.get(part, not part.isHidden()):
                wide += _least(part)
                count += 1
        return wide + layout.spacing() * max(0, count - 1)


def _least(part: QWidget) -> int:
    """The narrowest that a part can be drawn without cutting it."""
    least = part.minimumWidth() or part.minimumSizeHint().width()
    return min(least, part.maximumWidth())
