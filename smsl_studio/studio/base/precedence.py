"""Which parts of a row are hidden when the row is too narrow for all."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget


class Precedence:
    """Hides parts of a row, in the given order, until the others fit; parts not named stay.

    The row must have a layout. Tell ``want`` whether a part is wanted. Do not hide the part itself,
    because a wanted part may be hidden for lack of room.
    """

    def __init__(self, row: QWidget, *parts: QWidget) -> None:
        self._row, self._parts = row, parts
        self._unwanted: set[QWidget] = set()
        # The row must not make the window wider.
        row.setMinimumWidth(1)

    def want(self, part: QWidget, wanted: bool) -> None:
        """Say whether a part is wanted; ``fit`` shows it if there is room."""
        if wanted:
            self._unwanted.discard(part)
        else:
            self._unwanted.add(part)

    def fit(self) -> None:
        """Show the wanted parts that fit into the present width of the row."""
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
        """The width (pixels) of the row with these parts and all parts that are not named."""
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
    """The smallest width of a part at which nothing of it is cut (pixels)."""
    least = part.minimumWidth() or part.minimumSizeHint().width()
    return min(least, part.maximumWidth())
