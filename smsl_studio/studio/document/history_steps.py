"""The steps of a session's history, and what is selected again when one is undone or redone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from PySide6.QtGui import QUndoCommand

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.smsl.document import Document
from smsl_studio.studio.document.aside import Aside
from smsl_studio.studio.document.broken import Broken


@dataclass(frozen=True)
class Stand:
    """What a step of the history comes from or leads to.

    ``blueprint`` is the last blueprint that could be read, ``broken`` the broken text typed since
    then (None if there is none). ``selection`` was selected when the history left this stand. Its
    addresses are those of ``blueprint``.
    """

    blueprint: Blueprint
    broken: Broken | None = None
    selection: tuple[Address, ...] = ()

    def left_with(self, selection: tuple[Address, ...]) -> Stand:
        """The same stand, with what is selected while the history leaves it.

        If nothing is selected, the former selection stays known.
        """
        return replace(self, selection=selection or self.selection)


Show = Callable[[Stand], tuple[Address, ...]]
"""Shows a stand, and returns what was selected before."""


class EditStep(QUndoCommand):
    """A step from one stand to another.

    Qt joins a step with the one before it if both have the same ``run``; -1 joins nothing.
    """

    def __init__(self, words: str, show: Show, before: Stand, after: Stand, run: int) -> None:
        super().__init__(words)
        self._show, self._before, self.after, self._run = show, before, after, run

    def id(self) -> int:
        """The run of steps to which this one belongs."""
        return self._run

    def mergeWith(self, other: QUndoCommand) -> bool:
        """Take over the result of the next step of the same run."""
        assert isinstance(other, EditStep)
        self.after = other.after
        return True

    def put(self, stand: Stand, before: bool) -> None:
        """Use another text of the same content, on one side of the step."""
        if before:
            self._before = stand.left_with(self._before.selection)
        else:
            self.after = stand.left_with(self.after.selection)

    def undo(self) -> None:
        """Show what was before the step."""
        self.after = self.after.left_with(self._show(self._before))

    def redo(self) -> None:
        """Show the result of the step."""
        self._before = self._before.left_with(self._show(self.after))


class GiveUpStep(QUndoCommand):
    """A step that gives up the unsaved text of a file that is no longer imported."""

    def __init__(
        self, words: str, aside: Callable[[], Aside], lay: Callable[[Aside], None], text: Document
    ) -> None:
        super().__init__(words)
        self._aside, self._lay, self._text = aside, lay, text

    def undo(self) -> None:
        """Keep the text again."""
        self._lay({**self._aside(), self._text.file: self._text})

    def redo(self) -> None:
        """Give up the text."""
        aside = self._aside()
        self._lay({file: aside[file] for file in aside.keys() - {self._text.file}})
