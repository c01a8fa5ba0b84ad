"""The verbs of folding, for keys, the gutter and the menu."""

from __future__ import annotations

from smsl_studio.studio.features.draw.source import regions
from smsl_studio.studio.features.draw.source.editor import Editor


class FoldVerbs:
    """Folds and unfolds the lines of one editor."""

    def __init__(self, editor: Editor) -> None:
        self._editor = editor
        editor.gutter.fold_wanted.connect(self.fold_line)

    def can_fold(self, line: int) -> bool:
        """Whether a line begins something that can be folded."""
        return regions.region(self._editor.sheet.pieces, line) is not None

    def fold_line(self, line: int) -> None:
        """Fold what a line begins, or unfold it if it is folded."""
        editor = self._editor
        hidden = regions.region(editor.sheet.pieces, line)
        fold = editor.folds.at(line) or editor.folds.at(line + 1)
        if fold is not None:
            editor.folds.unfold(fold)
        elif hidden is not None:
            editor.fold(*hidden)

    def fold(self) -> None:
        """Fold the selected lines after the first, or else the element around the caret."""
        editor = self._editor
        first, last = (editor.sheet.where(at)[0] for at in editor.marked)
        if last - first >= regions.LEAST:
            editor.fold(first + 1, max(last, regions.extent(editor.sheet.pieces, last)))
            return
        at = regions.enclosing(editor.sheet.pieces, first)
        if at is not None:
            self.fold_line(at)

    def unfold(self) -> None:
        """Unfold the fold at the caret."""
        folds, line = self._editor.folds, self._editor.caret[0]
        fold = folds.at(line) or folds.at(line + 1)
        if fold is not None:
            folds.unfold(fold)

    def fold_all(self) -> None:
        """Fold every SB."""
        editor = self._editor
        for line in regions.outermost(editor.sheet.pieces, editor.form):
            hidden = regions.region(editor.sheet.pieces, line)
            if hidden is not None:
                editor.fold(*hidden)

    def unfold_all(self) -> None:
        """Show all lines."""
        self._editor.folds.unfold_all()
