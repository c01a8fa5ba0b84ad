"""The card with the fields of a new operation: its name and, if it is open, its target."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import QPointF, Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.controls import Label
from smsl_studio.studio.base.overlays.card import PassingCard, tint
from smsl_studio.studio.base.overlays.choices import Choices
from smsl_studio.studio.base.overlays.name_line import NameLine, complain, error_label
from smsl_studio.studio.base.theme import Tokens, text_font

ROWS = 4
MARGIN = 8
"""What the card leaves free above and below (pixels)."""


class ConnectCard(PassingCard):
    """The fields of a new operation: its name, with names in use as choices, and its target.

    ``begun`` holds the texts at the start: (operation, target). A target of None is fixed by the
    caller and gets no field. Otherwise the second field names a state, which may be new. ``commit``
    takes (operation, target) and returns why they are refused, or the empty text. ``target_for``
    suggests the target for an operation name. ``target_picked`` says that a click chose it.
    Tab leads to the target, and from there adds the operation; then ``gone_on`` is emitted. While
    nothing was typed or chosen, Tab adds nothing: it leaves the card as Esc does.
    """

    target_picked = Signal(str)
    target_named = Signal(str)
    """The name of the target has changed: it was typed, suggested or clicked."""
    gone_on = Signal()

    def __init__(
        self,
        parent: QWidget,
        tokens: Tokens,
        names: Sequence[str],
        begun: tuple[str, str | None],
        commit: Callable[[str, str], str],
        target_for: Callable[[str], str] | None = None,
    ) -> None:
        super().__init__(parent, tokens, 10.0)
        operation, target = begun
        self.line: tuple[QPointF, QPointF] | None = None
        """Both ends of the line that is being named, as scene points. It stays in sight."""
        self.about: tuple[Address, ...] = ()
        """The states at both ends, which stay in sight, too."""
        self._names, self._commit, self._rows = list(names), commit, ROWS
        self._target_for, self._own_target, self._touched = target_for, False, False
        self.operation = NameLine(self, tokens, "Operation")
        self.operation.setText(operation)
        self.operation.selectAll()
        self.target = NameLine(self, tokens, "Target state")
        self._first = self.operation
        self.target.setText(target or "")
        self.target.setVisible(target is not None)
        self.choices = Choices(self, tokens)
        self.error = error_label(self, tokens)
        self._to = Label("to state: type or click one. Tab goes on", self)
        self._to.setFont(text_font(11, 500))
        tint(self._to, tokens.tx3)
        self._to.setVisible(target is not None)
        self._new = Label("New operation. Enter adds it", self)
        self._new.setFont(text_font(11, 500))
        tint(self._new, tokens.tx3)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(4)
        for widget in (self.operation, self.choices, self._new, self._to, self.target, self.error):
            layout.addWidget(widget)
        self._sought = ""
        self.setFixedWidth(252)
        self.setAccessibleName("New operation")
        self._describe()
        self._wire()
        self._filter("")

    def _wire(self) -> None:
        for field in (self.operation, self.target):
            field.done.connect(self.commit)
            field.left.connect(self.close_field)
            field.textEdited.connect(self._typed)
        self.operation.textEdited.connect(self._filter)
        self.operation.moved.connect(self.choices.move_choice)
        self.operation.tabbed.connect(self._tab)
        self.target.tabbed.connect(self._go_on)
        self.operation.tabbed_back.connect(self._tab_back)
        self.target.tabbed_back.connect(self.operation.setFocus)
        self.target.textEdited.connect(self._target_typed)
        self.target.textChanged.connect(self.target_named)
        self.choices.chosen.connect(self._choose)

    def commit(self) -> bool:
        """Add the operation. If that is refused, show why, keep what was typed and return False."""
        if self._closing:
            return False
        chosen = self.choices.current
        if chosen and self.operation.hasFocus():
            self._take(chosen)
        reason = self._commit(self.operation.text().strip(), self.target.text().strip())
        if reason:
            self._complain(reason)
        else:
            self.close_field()
        return not reason

    def settle(self) -> None:
        """Add the operation if something was typed.

        A card in which the person has typed nothing stays as it is.
        """
        if self._touched:
            self.commit()

    def offer_at_most(self, rows: int) -> None:
        """Offer at most so many names, so that the card is lower."""
        self._rows = rows
        self._filter(self._sought)

    def pick_target(self, state: str) -> bool:
        """Lead to this state, which was clicked. False if the target is fixed.

        If a name was typed, that adds the operation.
        """
        if self.target.isHidden():
            return False
        self.target.setText(state)
        self._own_target = True
        self.operation.setFocus()
        self.target_picked.emit(state)
        if self._touched:
            self.commit()
        return True

    def begin_with(self, name: str, whole: bool) -> None:
        """Begin with this name, or with the beginning of a name; what is missing gets the focus."""
        self.operation.setText(name)
        self._filter(name)
        self._touched = whole
        if whole and not self.target.isHidden():
            self._first = self.target
            self.target.selectAll()
        else:
            self.operation.end(False)

    def suggest(self, operation: str) -> None:
        """Offer another name, if none was typed."""
        if not self._touched:
            self.operation.setText(operation)
            self.operation.selectAll()

    @property
    def untouched(self) -> bool:
        """Whether nothing was typed or chosen yet."""
        return not self._touched

    @property
    def leaves_room(self) -> bool:
        """Whether a new state is drawn where the card opens."""
        return not self.target.isHidden()

    def take_focus(self) -> None:
        """Give the keyboard to the name of the operation, or to what else is missing."""
        self._first.setFocus()

    @property
    def complaint(self) -> str:
        """Why the operation was refused; empty if it was not."""
        return self.error.text()

    def _typed(self) -> None:
        self._touched = True
        self._complain("")

    def _target_typed(self) -> None:
        self._own_target = True

    def _tab(self) -> None:
        if self.choices.current:
            self._touched = True
            self._take(self.choices.current)
        if not self.target.isHidden():
            self.target.setFocus()
            self.target.selectAll()
        elif self._is_blank:
            self.leave()

    def _tab_back(self) -> None:
        if self._is_blank and not self.choices.current:
            self.leave(forward=False)
        else:
            self._tab()

    def _go_on(self) -> None:
        if self._is_blank:
            self.leave()
        elif self.commit():
            self.gone_on.emit()

    @property
    def _is_blank(self) -> bool:
        """Whether there is nothing that Tab could add: nothing typed, clicked or chosen."""
        return not (self._touched or self._own_target) or not self.operation.text().strip()

    def _describe(self) -> None:
        """Tell a screen reader what the fields are for, and what the keys do."""
        back = "Without a typed name Tab leaves, and adds nothing; so does Esc."
        chain = "Enter adds it; Tab adds it and asks for the next one."
        to = "Tab leads to its target." if not self.target.isHidden() else ""
        self.operation.setAccessibleDescription(f"New operation. Enter adds it. {to} {back}")
        self.target.setAccessibleDescription(f"To which state the operation leads. {chain} {back}")

    def _choose(self, name: str) -> None:
        self._take(name)
        self.operation.setFocus()
        self.commit()

    def _take(self, name: str) -> None:
        self.operation.setText(name)
        self._suggest_target(name)
        self.choices.show_names([])
        self.adjustSize()

    def _suggest_target(self, name: str) -> None:
        if self._target_for is not None and not self._own_target and not self.target.isHidden():
            wanted = self._target_for(name)
            if wanted:
                self.target.setText(wanted)

    def _filter(self, typed: str) -> None:
        self._sought, wanted = typed, typed.strip().casefold()
        found = [name for name in self._names if wanted in name.casefold()]
        found.sort(key=lambda name: not name.casefold().startswith(wanted))
        exact = typed.strip() in found
        self._new.setVisible(bool(wanted) and not found)
        self._offer([] if exact else found[: self._rows])
        if exact:
            self._suggest_target(typed.strip())
        self.adjustSize()

    def _offer(self, names: list[str]) -> None:
        """Offer as many of these names as leave room for the target; one or two in a small view."""
        self.choices.show_names(names)
        view = self.parentWidget()
        room = view.height() - 2 * MARGIN if view is not None else 0
        while names and self.sizeHint().height() > room:
            names = names[:-1]
            self.choices.show_names(names)

    def _complain(self, reason: str) -> None:
        complain(self.error, reason, self.width() - 16)
        self.adjustSize()
