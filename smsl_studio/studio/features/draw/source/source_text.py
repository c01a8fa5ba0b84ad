"""SourceText: the text that a pane shows, as those know it who mark it and repair it."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.studio.features.draw.source.editor import Editor
from smsl_studio.studio.features.draw.source.elements import Elements
from smsl_studio.studio.features.draw.source.find_bar import FindBar
from smsl_studio.studio.features.draw.source.fold_verbs import FoldVerbs
from smsl_studio.studio.features.draw.source.typed_text import TypedText


class SourceText(Protocol):
    """One file's text in its editor, and what is done with it."""

    @property
    def editor(self) -> Editor:
        """The text in its widget."""

    @property
    def find_bar(self) -> FindBar:
        """The bar that finds and replaces in the text."""

    @property
    def folding(self) -> FoldVerbs:
        """What folds and unfolds lines of the text."""

    @property
    def typing(self) -> TypedText:
        """What makes steps of the history of what is typed."""

    @property
    def file(self) -> str:
        """The file whose text is shown."""

    @property
    def current(self) -> bool:
        """Whether what is shown is the file that is to be shown."""

    @property
    def elements(self) -> Elements:
        """Where the elements of the shown text stand."""

    def isVisible(self) -> bool:
        """Whether the text is shown."""

    def settle(self) -> None:
        """Take over what was typed, if anything was."""

    def show_fault(self) -> None:
        """Show the first place at which the text does not read."""

    def undo(self) -> None:
        """Undo the last step, wherever it was made."""

    def redo(self) -> None:
        """Do the step again that was undone last."""

    def leave(self, onwards: bool) -> None:
        """Give the focus to what comes after the text, or before it."""
