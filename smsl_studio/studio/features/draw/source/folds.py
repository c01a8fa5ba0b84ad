"""Folds: hidden lines of the text. One row says what each fold hides.

That row is the first line of the fold: it keeps its place in the widget, and a band with the words
is painted over it.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass

from PySide6.QtGui import QTextBlock
from PySide6.QtWidgets import QPlainTextEdit

from smsl_studio.studio.features.draw.source import regions
from smsl_studio.studio.features.draw.source.sheet import TextSheet


@dataclass(frozen=True, order=True)
class Fold:
    """Folded lines, counted from 0; first and last are included."""

    first: int
    last: int


class Folds:
    """The folds of one editor, in order; they do not overlap."""

    def __init__(self, edit: QPlainTextEdit) -> None:
        self._edit = edit
        self.all: list[Fold] = []

    def at(self, line: int) -> Fold | None:
        """The fold that holds a line, or None."""
        index = bisect_right(self.all, line, key=lambda fold: fold.first) - 1
        found = self.all[index] if index >= 0 else None
        return found if found and line <= found.last else None

    def fold(self, first: int, last: int) -> None:
        """Fold some lines; folds that overlap them become part of it."""
        inside = [one for one in self.all if one.last >= first and one.first <= last]
        first = min([first, *(one.first for one in inside)])
        last = max([last, *(one.last for one in inside)])
        self.all = sorted([*(one for one in self.all if one not in inside), Fold(first, last)])
        self._show(first + 1, last, False)

    def unfold(self, fold: Fold) -> None:
        """Show the lines of a fold and remove it."""
        self.all.remove(fold)
        self._show(fold.first, fold.last, True)

    def unfold_all(self) -> None:
        """Show all lines and remove all folds."""
        for fold in tuple(self.all):
            self.unfold(fold)

    def reveal(self, line: int) -> None:
        """Open the fold that hides a line, if any."""
        fold = self.at(line)
        if fold is not None:
            self.unfold(fold)

    def changed(self, first: int, before: int, after: int) -> None:
        """Move the folds after an edit: ``before`` lines from ``first`` on became ``after`` lines.

        Folds in which more than one line changed are opened, because their lines may be others now.
        """
        moved = after - before
        for fold in tuple(self.all):
            touched = fold.first < first + before and fold.last >= first
            if touched and (before > 1 or after > 1):
                self.all.remove(fold)
                # Only up to here: the next lines may belong to another fold.
                last = max(first + after - 1, fold.last + moved)
                self._show(min(fold.first, first), last, True)
        self.all = [
            Fold(fold.first + moved, fold.last + moved) if fold.first >= first + before else fold
            for fold in self.all
        ]

    def words(self, fold: Fold, sheet: TextSheet, form: str) -> str:
        """The words in the row of a fold: how many lines, and which elements they hold."""
        count = f"{fold.last - fold.first + 1} lines folded"
        above = regions.names_in(sheet.pieces, max(0, fold.first - 1), fold.first - 1, form)
        inside = regions.names_in(sheet.pieces, max(0, fold.first - 1), fold.last, form)
        first, last = inside if above[0] in ("", inside[0]) else above
        if not first:
            return count
        return f"{count}: {first}" if first == last else f"{count}: {first} to {last}"

    def _show(self, first: int, last: int, visible: bool) -> None:
        document = self._edit.document()
        start = block = document.findBlockByNumber(max(0, first))
        while block.isValid() and block.blockNumber() <= last:
            _set_visible(block, visible)
            block = block.next()
        if start.isValid():
            end = block.position() if block.isValid() else document.characterCount() - 1
            document.markContentsDirty(start.position(), max(1, end - start.position()))
            layout = document.documentLayout()
            layout.documentSizeChanged.emit(layout.documentSize())
            self._edit.viewport().update()


def _set_visible(block: QTextBlock, visible: bool) -> None:
    block.setVisible(visible)
    block.setLineCount(1 if visible else 0)
