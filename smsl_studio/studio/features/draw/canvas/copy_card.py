"""The card that proposes a copy of a state: its name, and its facts as chips."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.facts import fact_string
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.names import fresh_state_name, name_with_facts, next_free_facts
from smsl_studio.studio.base.controls import Elided
from smsl_studio.studio.base.overlays.card import PassingCard, tint
from smsl_studio.studio.base.overlays.name_line import NameLine, complain, error_label
from smsl_studio.studio.base.theme import Tokens, text_font
from smsl_studio.studio.features.draw.canvas.chip_choice import ChipChoice

HINT = "Enter adds it, Esc does not"


class CopyCard(PassingCard):
    """Name and facts of a copy that is not made yet. Enter makes it, Esc gives it up.

    The facts begin with the next free values. The name follows the chips, and the chips follow a
    typed name. ``commit`` takes the name and returns why it is refused, or the empty text.
    ``named`` tells every other name.
    """

    named = Signal(str)
    leaves_room = True
    """A new state is drawn where the card opens."""

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        branch: StateBranch,
        state: str,
        commit: Callable[[str], str],
    ) -> None:
        super().__init__(parent, tokens, 10.0)
        self._branch, self._state, self._commit = branch, state, commit
        self.untouched = True
        self.setAccessibleName("Copy of a state")
        facts = next_free_facts(branch, state)
        self.chips = ChipChoice(self, tokens, branch, facts) if facts else None
        self.name = NameLine(self, tokens, "Name of the copy")
        named = name_with_facts(branch, state, facts) if facts else fresh_state_name(branch)
        self.name.setText(named)
        self.name.selectAll()
        self.error = error_label(self, tokens)
        self.hint = self._words(HINT, 11)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(10, 8, 10, 8)
        layout.setSpacing(4)
        layout.addWidget(self._words(f"Copy of {state}", 12))
        if self.chips is not None:
            layout.addWidget(self.chips)
            self.chips.setFixedWidth(232)
            self.chips.setFixedHeight(self.chips.heightForWidth(232))
        layout.addWidget(self.name)
        layout.addWidget(self.error)
        layout.addWidget(self.hint)
        self.setFixedWidth(252)
        self._wire()

    def _words(self, text: str, size: int) -> Elided:
        words = Elided(text, self)
        words.setFont(text_font(size, 500))
        tint(words, self.tokens.tx3)
        return words

    def _wire(self) -> None:
        self.name.done.connect(self.commit)
        self.name.left.connect(self.close_field)
        self.name.textEdited.connect(self._typed)
        if self.chips is not None:
            self.chips.done.connect(self.commit)
            self.chips.left.connect(self.close_field)
            self.chips.changed.connect(self._chosen)
            self.chips.tabbed.connect(self.name.setFocus)
            self.name.tabbed.connect(self.chips.setFocus)
            self.name.tabbed_back.connect(self.chips.setFocus)

    def take_focus(self) -> None:
        """Give the keyboard to the chips, else to the name."""
        (self.chips or self.name).setFocus()

    def commit(self) -> None:
        """Make the copy. If that is refused, show why and keep what was chosen."""
        if self._closing or self._is_taken():
            return
        reason = self._commit(self.name.text().strip())
        if reason:
            complain(self.error, reason, self.width() - 20)
            self.adjustSize()
        else:
            self.close_field()

    def settle(self) -> None:
        """Make the copy if the person has chosen or typed something."""
        if not self.untouched:
            self.commit()

    @property
    def complaint(self) -> str:
        """What is wrong with the name; empty if nothing is."""
        said = self.hint.text() if self.hint.text() != HINT else ""
        return said if self.error.isHidden() else self.error.text()

    def _chosen(self) -> None:
        assert self.chips is not None
        self.name.setText(name_with_facts(self._branch, self._state, self.chips.values))
        self._changed()

    def _typed(self) -> None:
        shape, name = self._branch.shape, self.name.text().strip()
        fits = len(fact_string(name, shape.written)) == shape.num_facts * shape.width
        if self.chips is not None and fits:
            self.chips.show_values(shape.values(name))
        self._changed()

    def _changed(self) -> None:
        self.untouched = False
        self._is_taken()
        self.named.emit(self.name.text().strip())

    def _is_taken(self) -> bool:
        """Whether there is such a state already. It is told in the last line: a card that grew
        could cover the sketch.
        """
        name = self.name.text().strip()
        taken = name in self._branch.table
        self.error.hide()
        self.hint.setText(f"There is already a state {name}." if taken else HINT)
        tint(self.hint, self.tokens.bad if taken else self.tokens.tx3)
        return taken
