"""A field for one name, over the name on the canvas."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtWidgets import QWidget

from smsl_studio.studio.base.overlays.name_line import NameLine
from smsl_studio.studio.base.overlays.text_card import TextCard
from smsl_studio.studio.base.theme import Tokens


class NameField(TextCard):
    """A field that edits one name on the canvas.

    ``commit`` takes the text and returns why it is refused, or the empty text. Enter commits; Esc
    closes the field without an edit, and so does Tab while the name is as it was. A click elsewhere
    commits a changed name. A refused name stays in the field, with the reason below it.
    """

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        text: str,
        hint: str,
        commit: Callable[[str], str],
    ) -> None:
        super().__init__(parent, tokens, commit)
        self._before = text
        self._then: Callable[[], object] | None = None
        self.setAccessibleName("Name")
        self.field = NameLine(self, tokens, hint)
        self.field.setText(text)
        self.field.selectAll()
        self.hold(self.field)
        self.field.done.connect(self.commit)
        self.field.left.connect(self.close_field)
        self.field.tabbed.connect(self._tab)
        self.field.tabbed_back.connect(partial(self._tab, forward=False))
        self.field.textEdited.connect(lambda: self.complain(""))

    def take_focus(self) -> None:
        """Give the keyboard to the name."""
        self.field.setFocus()

    @property
    def complaint(self) -> str:
        """Why the name was refused; empty if it was not."""
        return self.error.text()

    def commit(self) -> None:
        """Take the name over. If that is refused, show why and keep what was typed."""
        if not self.take(self.field.text().strip()):
            self.field.setFocus()

    def go_on_with(self, then: Callable[[], object]) -> None:
        """From now on Tab accepts a typed name, as Enter does, and then calls ``then``."""
        self._then = then
        self.field.setAccessibleDescription(
            "Enter adds it; Tab adds it and asks for an operation from there."
            " Without a typed name Tab leaves, and adds nothing; so does Esc."
        )

    def settle(self) -> None:
        """Commit a changed name; close the field unless that is refused."""
        if self._is_blank:
            self.close_field()
        else:
            self.take(self.field.text().strip())

    @property
    def _is_blank(self) -> bool:
        """Whether no other name was typed."""
        return self.field.text().strip() in ("", self._before)

    def _tab(self, forward: bool = True) -> None:
        if self._is_blank:
            self.leave(forward)
        elif forward and self._then is not None and self.take(self.field.text().strip()):
            self._then()
