"""The properties panel: the selection or a fact, above the header of the SB that is shown."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QLabel, QPushButton, QScrollArea, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.controls import label, row, rule
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.tab_order import put_before
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.claims_line import ClaimsLine
from smsl_studio.studio.features.draw.panels.drawn_form import DrawnForm
from smsl_studio.studio.features.draw.panels.fact_form import FactForm
from smsl_studio.studio.features.draw.panels.file_form import FileForm
from smsl_studio.studio.features.draw.panels.frame import Panel
from smsl_studio.studio.features.draw.panels.header_form import HeaderForm
from smsl_studio.studio.features.draw.panels.last_change_form import LastChangeForm
from smsl_studio.studio.features.draw.panels.line_form import LineForm
from smsl_studio.studio.features.draw.panels.operation_form import OperationForm
from smsl_studio.studio.features.draw.panels.refused_text import RefusedText, refused_texts
from smsl_studio.studio.features.draw.panels.state_form import StateForm


class Properties(QScrollArea):
    """A form for the selection or a fact, then the branch header, the number of hazards, the file.

    The selection is one state, one operation, or what several elements share. The forms of a fact
    and of an operation are more than a quarter of the window's widgets; each is made when it is
    first shown.
    """

    ways_wanted = Signal()
    """Show the ways between the two selected states."""
    verb_wanted = Signal(str)
    """The id of a window action that a button of a form stands for."""
    text_lost = Signal(str, object)
    """(sentence, call): a typed text that was refused is not shown any more; the call brings it
    back."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._tokens, self._loaded = session, tokens, Loaded()
        self._fact, self._operation = LatePart(self._make_fact), LatePart(self._make_operation)
        self._drawn = LatePart(self._make_drawn)
        self._shown_drawn: DrawnKey | None = None
        self.setAccessibleName("Properties")
        FocusLine(self)
        self.setWidgetResizable(True)
        self.setFrameShape(QScrollArea.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._inner = inner = Panel("Properties")
        self.state = StateForm(session, tokens)
        self.line = LineForm()
        self.changed_by = LastChangeForm(session, inner)
        self.several = _Several(session)
        # It shows itself; without a parent it would be a window for a moment.
        self.header = HeaderForm(session, tokens, inner)
        self.claims = ClaimsLine(session)
        self.file = FileForm(session, tokens)
        self._rule = rule()
        above = (self.state, self.line, self.changed_by, self.several)
        for widget in (*above, self._rule, self.header, rule(), self.claims, rule(), self.file):
            inner.column.addWidget(widget)
        inner.column.addStretch(1)
        self.setWidget(inner)
        self._of: tuple[tuple[Address, ...], tuple[str, int] | None] = ((), None)
        self._connect()
        self._show()

    def _connect(self) -> None:
        session = self._session
        session.afterwards.follow(self._show, session.selection_changed, session.branch_changed,
                                  session.blueprint_changed)  # fmt: skip
        self.header.fact_wanted.connect(self.show_fact)
        self.several.ways.clicked.connect(self.ways_wanted)

    @property
    def fact(self) -> FactForm:
        """The form of a fact."""
        return self._fact()

    @property
    def operation(self) -> OperationForm:
        """The form of operations."""
        return self._operation()

    @property
    def drawn(self) -> DrawnForm:
        """The form of a note or a group."""
        return self._drawn()

    def _make_drawn(self) -> DrawnForm:
        form = DrawnForm(self._session, self._tokens)
        form.verb_wanted.connect(self.verb_wanted)
        self._insert(form, self.state)
        return form

    def _make_fact(self) -> FactForm:
        form = FactForm(self._session, self._tokens)
        form.left.connect(self._session.leave_fact)
        form.sub_wanted.connect(self._session.show_branch)
        self._insert(form, self.state)
        return form

    def _make_operation(self) -> OperationForm:
        form = OperationForm(self._session, self._tokens)
        form.set_plugins(self._loaded)
        self._insert(form, self.line)
        return form

    def _insert(self, form: QWidget, follower: QWidget) -> None:
        """Put a form, hidden, before another one, for the eye and for the key Tab."""
        form.hide()
        column = self._inner.column
        column.insertWidget(column.indexOf(follower), form)
        put_before(form, follower)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        made = self._fact.made, self._operation.made, self._drawn.made
        for form in (self.state, self.header, self.file, *made):
            if form is not None:
                form.set_tokens(tokens)

    def set_plugins(self, loaded: Loaded) -> None:
        """Take the functions that operations can be bound to."""
        self._loaded = loaded
        if self._operation.made is not None:
            self._operation.made.set_plugins(loaded)

    def stop(self) -> None:
        """End all work, because the window closes."""
        self.changed_by.stop()

    def show_fact(self, branch: str, digit: int) -> None:
        """Show a fact instead of the selection, until something else is selected."""
        self._session.select_fact(branch, digit)
        self.verticalScrollBar().setValue(0)

    def show_drawn(self, key: DrawnKey | None) -> None:
        """Show the note or the group that is selected; None for none."""
        if key != self._shown_drawn:
            self._shown_drawn = key
            self._session.afterwards.show(self._show)

    def _show(self) -> None:
        refused, of = refused_texts(self._inner), self._of
        self._fill()
        self._of = self._session.selection, self._session.fact
        for one in refused:
            if one.lost_in(self._inner):
                one.forget()
                self.text_lost.emit(one.sentence(_who(of[0])), partial(self._put_back, one, of))

    def _put_back(
        self, text: RefusedText, of: tuple[tuple[Address, ...], tuple[str, int] | None]
    ) -> None:
        """Show what a refused text was typed for, with the text in its line."""
        selection, fact = of
        if fact is not None:
            self._session.select_fact(*fact)
        elif selection:
            self._session.show_branch(selection[0].branch)
            self._session.select(selection)
        self._session.afterwards.catch_up()
        text.put_back()
        self.ensureWidgetVisible(text.line)

    def _fill(self) -> None:
        blueprint, selection = self._session.blueprint, self._session.selection
        selection = tuple(a for a in selection if a.state and _stands(blueprint, a))
        fact = self._session.fact
        states = [a for a in selection if not a.operation]
        edges = [a for a in selection if a.operation]
        # Fill a form before it is shown, so that nothing jumps.
        if fact:
            self.fact.show_fact(blueprint, *fact)
        if states and not edges:
            self.state.show_states(blueprint, states)
        if edges and not states:
            self.operation.show_operations(blueprint, edges)
            self.line.show_operations(blueprint, edges)
        if len(selection) > 1:
            self.several.show_selection(states, edges)
        branch, key = blueprint.branches.get(self._session.branch), self._shown_drawn
        drawn = False
        if key is not None and branch is not None and not (selection or fact):
            drawn = self.drawn.show_drawn(branch, key)
        if self._drawn.made is not None:
            self._drawn.made.setVisible(drawn)
        if self._fact.made is not None:
            self._fact.made.setVisible(fact is not None)
        self.state.setVisible(bool(states) and not edges)
        for form in (self._operation.made, self.line):
            if form is not None:
                form.setVisible(bool(edges) and not states)
        self.changed_by.show_element(selection[0] if len(selection) == 1 else None)
        self.several.setVisible(len(selection) > 1)
        self._rule.setVisible(bool(selection) or fact is not None or drawn)


class _Several(Panel):
    """How many elements are selected, the ways between two states, and a button to delete them."""

    def __init__(self, session: Session) -> None:
        super().__init__("Selection")
        self._session = session
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(8)
        self._count: QLabel = label("", "heading")
        self._ways: QLabel = label("", "small")
        self._ways.setWordWrap(True)
        self.ways = QPushButton("Show ways between")
        self.ways.setToolTip("Light the cheapest ways between the two states, there and back")
        self.delete = QPushButton("Delete")
        self.delete.setToolTip("Delete what is selected (Del)")
        self.delete.clicked.connect(self._delete)
        self.column.addWidget(self._count)
        self.column.addWidget(self._ways)
        self.column.addLayout(row(self.ways, None))
        self.column.addLayout(row(self.delete, None))
        self.show_ways("")

    def show_ways(self, words: str) -> None:
        """Tell the ways between the two selected states; empty for none."""
        self._ways.setText(words)
        self._ways.setVisible(bool(words))

    def show_selection(self, states: list[Address], edges: list[Address]) -> None:
        """Count the selected elements."""
        words = [counted(len(states), "state")] if states else []
        words += [counted(len(edges), "operation")] if edges else []
        self._count.setText(f"{' and '.join(words)} selected")
        # If all are of one kind, the heading of their form shows the count.
        self._count.setVisible(len(words) > 1)
        self.delete.setText(f"Delete {' and '.join(words)}")
        two = len(states) == 2 and not edges
        self.ways.setVisible(two and states[0].branch == states[1].branch)

    def _delete(self) -> None:
        chosen = self._session.selection
        self._session.edit(
            f"Delete {counted(len(chosen), 'element')}", lambda bp: editing.delete(bp, chosen)
        )


def _who(selection: tuple[Address, ...]) -> str:
    """What is selected, in a word or two; empty for nothing."""
    if len(selection) == 1:
        return selection[0].operation or selection[0].state
    return counted(len(selection), "element") if selection else ""


def _stands(blueprint: Blueprint, address: Address) -> bool:
    branch = blueprint.branches.get(address.branch)
    if branch is None or address.state not in branch.table:
        return False
    return not address.operation or address.operation in branch.table[address.state]
