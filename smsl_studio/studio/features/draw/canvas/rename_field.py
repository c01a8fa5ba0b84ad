"""A name field for an operation whose name is used elsewhere too: it asks where to rename."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.card import tint
from smsl_studio.studio.base.overlays.choices import Choices
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.document.rename_scopes import RenameScope
from smsl_studio.studio.features.draw.canvas.name_field import NameField

WIDTH = 240


class RenameField(NameField):
    """A name field with the answers to "where?" below. The first one is chosen.

    The arrow keys choose another one, and Enter renames. A click on an answer renames at once.
    ``commit`` also takes the addresses of the chosen answer.
    """

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        text: str,
        scopes: Sequence[RenameScope],
        commit: Callable[[str, Sequence[Address]], str],
    ) -> None:
        super().__init__(
            parent, tokens, text, "Operation", lambda new: commit(new, self.scope.addresses)
        )
        self.scopes = tuple(scopes)
        self.choices = Choices(self, tokens)
        self.choices.show_names([scope.words for scope in scopes], 0)
        words = Label(f"Used in {len(scopes[-1].addresses):,} places. Rename", self)
        words.setFont(text_font(11, 500))
        words.setContentsMargins(7, 0, 7, 0)
        tint(words, tokens.tx3)
        self.setMinimumWidth(WIDTH)
        # Else a click on an answer would give the focus to the canvas, and the field would commit.
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)
        self.setFocusProxy(self.field)
        layout = self.layout()
        assert isinstance(layout, QVBoxLayout)
        layout.addWidget(words)
        layout.addWidget(self.choices)
        self.field.moved.connect(self._move)
        self.choices.chosen.connect(self._choose)
        self._tell()

    @property
    def scope(self) -> RenameScope:
        """The answer that is chosen."""
        return self.scopes[self.choices.at]

    def _move(self, step: int) -> None:
        self.choices.move_choice(step)
        self._tell()

    def _choose(self, _: str) -> None:
        self._tell()
        self.commit()

    def _tell(self) -> None:
        """Let a screen reader say which answer is chosen."""
        said = f"Rename {self.scope.words}. The arrow keys choose where."
        self.field.setAccessibleDescription(plain_text(said))
