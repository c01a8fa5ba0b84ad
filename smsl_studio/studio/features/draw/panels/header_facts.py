"""The facts of the SB that is shown, one row each: digit, plain name, sub-SB."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGridLayout, QWidget

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.legible import plain_text
from smsl_studio.picture.chip_kinds import VALUE
from smsl_studio.studio.base.controls import Combo, Field, label
from smsl_studio.studio.base.tag import Tag
from smsl_studio.studio.base.theme import CONTROL_ROW, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text

MOST = 64
"""At most this many facts have a row; a typing error in NUM_FACTS must not add thousands."""
NEW = ""
"""Stands for “New” in the list of sub-SBs: a new SB shall be made."""


@dataclass
class HeaderFactRow:
    """The widgets of one fact."""

    chip: Tag
    name: Field
    sub: Combo
    names: tuple[str, ...] = ()
    """The SBs in the list, kept to see whether it must be filled again (slow with thousands)."""

    def choice(self, at: int) -> str | None:
        """What the line ``at`` of the list means: None (no sub-SB), the name of an SB, or
        ``NEW``."""
        return (None, *self.names, NEW)[at]


class HeaderFacts(QWidget):
    """The rows of the facts. It changes nothing itself.

    ``named``: the person typed a name (digit, name). ``wanted``: the person clicked the chip of
    this digit.
    """

    named = Signal(int, str)
    sub_chosen = Signal(int, object)
    """(digit, SB): the person chose this sub-SB; None for none, ``NEW`` for a new one."""
    wanted = Signal(int)

    def __init__(self, tokens: Tokens, after: QWidget) -> None:
        """``after`` stands above: Tab goes from it to the first name."""
        super().__init__()
        self._tokens, self._after = tokens, after
        self.rows: list[HeaderFactRow] = []
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(0, 8, 0, 0)
        self._grid.setHorizontalSpacing(6)
        self._grid.setVerticalSpacing(8)
        self._grid.setColumnStretch(1, 1)
        self._grid.addWidget(label("Fact", "small"), 0, 0, 1, 2)
        self._grid.addWidget(label("Sub-SB", "small"), 0, 2)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for fact in self.rows:
            fact.chip.set_tokens(tokens)

    def show_facts(self, blueprint: Blueprint, branch: StateBranch) -> None:
        """Show a row for each fact (see ``told_facts``)."""
        count = min(told_facts(branch), MOST)
        while len(self.rows) > count:
            gone = self.rows.pop()
            for widget in (gone.chip, gone.name, gone.sub):
                self._grid.removeWidget(widget)
                widget.hide()
                widget.deleteLater()
        if len(self.rows) < count:
            self.rows += [self._new_row(digit) for digit in range(len(self.rows), count)]
            self._order_keys()
        self.setVisible(count > 0)
        others = [name for name in blueprint.branches if name != branch.name]
        for digit, fact in enumerate(self.rows):
            self._show_fact(branch, digit, fact, others)

    def _order_keys(self) -> None:
        """Let Tab go through all names first, because people name all facts one after the other."""
        order: list[QWidget] = [self._after, *(fact.name for fact in self.rows)]
        order += [widget for fact in self.rows for widget in (fact.chip, fact.sub)]
        for before, after in pairwise(order):
            QWidget.setTabOrder(before, after)

    def _show_fact(
        self, branch: StateBranch, digit: int, fact: HeaderFactRow, others: list[str]
    ) -> None:
        sub = branch.subs.get(digit)
        fact.chip.show_tag(str(digit), VALUE, sub is not None)
        name = branch.fact_name(digit)
        fact.chip.setToolTip(tip_text(f"Edit what {name} (digit {digit}) means and who reads it"))
        fact.chip.setAccessibleName(plain_text(f"Edit {name}, digit {digit}"))
        fact.name.setAccessibleName(plain_text(f"Name of {name}, digit {digit}"))
        fact.sub.setAccessibleName(plain_text(f"Sub-SB of {name}, digit {digit}"))
        fact.name.settle(name)
        fact.name.setToolTip(tip_text(f"{name}. Type to name this fact."))
        fact.sub.accent = sub is not None
        fact.sub.setProperty("pale", sub is None)
        names = (*others, sub) if sub and sub not in others else tuple(others)
        if not fact.sub.count() or names != fact.names:
            fact.names = names
            fact.sub.clear()
            fact.sub.addItems(["None", *names, "New"])
        fact.sub.setCurrentIndex(names.index(sub) + 1 if sub else 0)
        fact.sub.setToolTip(tip_text(f"Sub-SB of {name}: {sub or 'none'}"))
        fact.sub.update()

    def _new_row(self, digit: int) -> HeaderFactRow:
        fact = HeaderFactRow(Tag(self._tokens), Field(), Combo(height=28))
        fact.chip.press_with_keys(f"Edit digit {digit}")
        fact.chip.clicked.connect(lambda: self.wanted.emit(digit))
        fact.name.setProperty("role", "flat")
        fact.name.setAccessibleName(plain_text(f"Name of digit {digit}"))
        fact.name.editingFinished.connect(lambda: self._typed(digit))
        fact.sub.setAccessibleName(plain_text(f"Sub-SB of digit {digit}"))
        fact.sub.setFixedWidth(108)
        fact.sub.setFont(text_font(12))
        fact.sub.activated.connect(lambda at: self.sub_chosen.emit(digit, fact.choice(at)))
        for place, widget in enumerate((fact.chip, fact.name, fact.sub)):
            self._grid.addWidget(widget, digit + 1, place)
        self._grid.setRowMinimumHeight(digit + 1, CONTROL_ROW)
        return fact

    def _typed(self, digit: int) -> None:
        # A field that had the keys ends its editing while its row is taken away.
        field = self.rows[digit].name if digit < len(self.rows) else None
        if field is not None and field.changed:
            self.named.emit(digit, field.text().strip())
