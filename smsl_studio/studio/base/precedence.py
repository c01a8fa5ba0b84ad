"""Which parts of a row are hidden when the row is too narrow for all."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget


class Precedence:
    """Hides parts of a row, in the given order, until the others fit; parts not named stay.

    The row must have a layout. Tell ``want`` whether a part is wanted. Do not hide the part itself,
    because a wanted part may be hidden for lack of room.
    """

    def __init__(self, row: QWidget, *parts: QWidget, gaps: int = 0) -> None:
        """``gaps`` is the sum of the fixed gaps in the row (pixels)."""
        self._row, self._parts, self._gaps = row, parts, gaps
        self._unwanted: set[QWidget] = set()
        self.lacking: set[QWidget] = set()
        """The wanted parts that are hidden because they have no room."""
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
        self.lacking = {one for one, fits in shown.items() if not fits} - self._unwanted
        for part, fits in shown.items():
            if part.isHidden() == fits:
                part.setVisible(fits)

    def _needed(self, shown: dict[QWidget, bool]) -> int:
        """The width (pixels) of the row with these parts and all parts that are not named."""
        layout = self._row.layout()
        assert layout is not None
        margins = layout.contentsMargins()
        widgets = (one for one in self._row.children() if isinstance(one, QWidget))
        parts = (part for part in widgets if layout.indexOf(part) >= 0)
        wide = [_least(part) for part in parts if shown.get(part, not part.isHidden())]
        around = margins.left() + margins.right() + self._gaps
        return around + sum(wide) + layout.spacing() * max(0, len(wide) - 1)


def _least(part: QWidget) -> int:
    """The smallest width of a part at which nothing of it is cut (pixels)."""
    least = part.minimumWidth() or part.minimumSizeHint().width()
    return min(least, part.maximumWidth())
