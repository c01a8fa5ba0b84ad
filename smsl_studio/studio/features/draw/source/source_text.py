"""The text of a source pane, as the parts that mark it and repair it see it."""

from __future__ import annotations

from typing import Protocol

from smsl_studio.studio.features.draw.source.editor import Editor
from smsl_studio.studio.features.draw.source.elements import Elements
from smsl_studio.studio.features.draw.source.find_bar import FindBar
from smsl_studio.studio.features.draw.source.fold_verbs import FoldVerbs
from smsl_studio.studio.features.draw.source.typed_text import TypedText


class SourceText(Protocol):
    """The text of one file in its editor, and the parts around it. ``SourcePane`` implements it."""

    @property
    def editor(self) -> Editor:
        """The text widget."""

    @property
    def find_bar(self) -> FindBar:
        """The bar that finds and replaces in the text."""

    @property
    def folding(self) -> FoldVerbs:
        """Folds and unfolds lines of the text."""

    @property
    def typing(self) -> TypedText:
        """Turns typed text into steps of the history."""

    @property
    def file(self) -> str:
        """The file whose text is shown."""

    @property
    def current(self) -> bool:
        """Whether the shown file is the one that should be shown."""

    @property
    def elements(self) -> Elements:
        """Finds the elements in the text that is shown."""

    def isVisible(self) -> bool:
        """Whether the text is shown."""

    def settle(self) -> None:
        """Take over the typed text now, if there is any."""

    def show_fault(self) -> None:
        """Go to the first fault of the broken text."""

    def undo(self) -> None:
        """Undo the last step, wherever it was made."""

    def redo(self) -> None:
        """Redo the step that was undone last."""

    def leave(self, onwards: bool) -> None:
        """Give the keyboard focus to the widget after the text, or before it."""
