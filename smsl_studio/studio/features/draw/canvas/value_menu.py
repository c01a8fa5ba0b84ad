"""The menu of a fact's values: a click on a chip gives the selected states another value."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QObject, QPoint, QPointF, QSize, QTimer, Signal
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.editing.digits import count_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.chips import fact_words, values_of
from smsl_studio.studio.base.paint.node_paint import chip_places
from smsl_studio.studio.base.passing_menu import passing_menu
from smsl_studio.studio.base.words import as_it_is, counted
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.free_places import place_near
from smsl_studio.studio.features.draw.canvas.name_field import NameField

GAP = 6
"""The room between a state and its menu (pixels)."""
MOST_VALUES, MOST_FACTS = 24, 32
"""A menu offers at most so many values, and so many facts. Any value can be typed."""


class ValueMenu(QObject):
    """Offers the values of a fact at its chip, and the facts of the selected states at the node.

    A click on a chip with a sub-SB may begin a double click, which shows the sub-SB. So the menu
    of such a fact waits until no second click has come.
    """

    fact_wanted = Signal(str, int)
    """(SB, digit): the person wants the form of this fact."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self._session, self._canvas = session, canvas
        self.field: NameField | None = None
        """The field for a value that no state has yet, while it is open."""
        self._digit = 0
        self._wait = QTimer(self)
        self._wait.setSingleShot(True)
        self._wait.timeout.connect(lambda: self.open(self._digit))
        canvas.fact_wanted.connect(self._clicked)
        canvas.pressed.connect(self.give_up)
        canvas.enter_wanted.connect(lambda _: self.give_up())
        session.selection_changed.connect(lambda _: self.give_up())

    def can_open(self) -> bool:
        """Whether states with facts are selected."""
        branch = self._branch
        return branch is not None and bool(self._states()) and count_of(branch) > 0

    @property
    def waiting(self) -> bool:
        """Whether a click waits for a second one before its menu opens."""
        return self._wait.isActive()

    def give_up(self) -> None:
        """Open no menu for a click that waits."""
        self._wait.stop()

    def open(self, digit: int, at: QPoint | None = None) -> None:
        """Open the menu of one fact, at a point of the screen or at its chip."""
        branch = self._branch
        if branch is None or not self._states():
            return
        if branch.shape.opaque:
            self.fact_wanted.emit(branch.name, digit)
        elif 0 <= digit < count_of(branch):
            menu = self._new(f"Values of {branch.fact_name(digit)}")
            self._fill(menu, branch, digit)
            menu.popup(at or self._beside(digit, menu.sizeHint()))

    def open_facts(self) -> None:
        """Open the menu of all facts of the selected states, each with its values."""
        branch = self._branch
        if branch is None or not self.can_open():
            return
        count = count_of(branch)
        if count == 1:
            self.open(0)
            return
        menu = self._new("Facts of the selected states")
        for digit in range(min(count, MOST_FACTS)):
            inner = menu.addMenu(as_it_is(f"{digit}  {self._told(branch, digit)}"))
            self._fill(inner, branch, digit)
        menu.popup(self._beside(0, menu.sizeHint()))

    @property
    def _branch(self) -> StateBranch | None:
        return self._session.blueprint.branches.get(self._session.branch)

    def _states(self) -> list[str]:
        branch = self._session.branch
        chosen = self._session.selection
        return [a.state for a in chosen if a.branch == branch and a.state and not a.operation]

    def _told(self, branch: StateBranch, digit: int) -> str:
        """A fact with its present value: ``Clamp: fixed (1)``, ``Clamp: several values``."""
        present = {branch.facts(state)[digit] for state in self._states()}
        if len(present) == 1:
            return fact_words(branch, digit, *present)
        return f"{branch.fact_name(digit)}: several values"

    def _clicked(self, digit: int) -> None:
        branch = self._branch
        if branch is not None and digit in branch.subs:
            self._digit = digit
            self._wait.start(QApplication.doubleClickInterval())
        else:
            self.open(digit)

    def _new(self, name: str) -> QMenu:
        menu = passing_menu(self._canvas.window(), name)
        menu.setToolTipsVisible(True)
        return menu

    def _fill(self, menu: QMenu, branch: StateBranch, digit: int) -> None:
        note = branch.fact_note(digit)
        meanings = note.values if note is not None else {}
        present = {branch.facts(state)[digit] for state in self._states()}
        values = values_of(branch, digit)
        for value in values[:MOST_VALUES]:
            words = as_it_is(f"{value}  {meanings.get(value, '')}".rstrip())
            entry = menu.addAction(words, partial(self._set, digit, value))
            entry.setCheckable(True)
            entry.setChecked(present == {value})
            if present == {value}:
                # Not before it opens: a reader would read the rows of closed menus.
                menu.aboutToShow.connect(partial(menu.setActiveAction, entry))
        menu.addAction("Another value…", partial(self._ask, digit))
        menu.addSeparator()
        sub = branch.subs.get(digit)
        if sub is not None:
            menu.addAction(as_it_is(f"Show {sub}"), partial(self._session.show_branch, sub))
        form = as_it_is(f"What {branch.fact_name(digit)} means…")
        menu.addAction(form, partial(self.fact_wanted.emit, branch.name, digit))

    def _set(self, digit: int, value: str) -> None:
        self._session.edit(*self._step(digit, value))

    def _step(self, digit: int, value: str) -> tuple[str, Callable[[Blueprint], Blueprint]]:
        """The words and the edit that give the selected states a value."""
        branch, states = self._session.branch, self._states()
        who = states[0] if len(states) == 1 else counted(len(states), "state")
        return (f"Set digit {digit} of {who} to {value}",
                lambda bp: editing.set_value(bp, branch, states, digit, value))  # fmt: skip

    def _ask(self, digit: int) -> None:
        """Ask for a value that is in no menu."""

        def commit(value: str) -> str:
            """Set the value. Returns why that was refused, or the empty text."""
            reasons: list[str] = []
            try_edit(self._session, *self._step(digit, value), reasons.append)
            return reasons[-1]

        canvas = self._canvas
        self.field = NameField(canvas, canvas.tokens, "", "Value", commit)
        self.field.closed.connect(self._field_closed)
        self.field.setMinimumWidth(110)
        self.field.adjustSize()
        at = self._beside(digit, self.field.size())
        place_near(self.field, canvas, canvas.mapFromGlobal(at))
        self.field.show()
        self.field.raise_()
        self.field.field.setFocus()

    def _field_closed(self) -> None:
        self.field = None

    def _beside(self, digit: int, size: QSize) -> QPoint:
        """The point of the screen below the state that was selected last, at its chip.

        It lies above the state if a card of this size has no room below.
        """
        canvas, sheet = self._canvas, self._canvas.sheet
        states, view = self._states(), self._canvas.viewport()
        state = sheet.picture.index.get(states[-1], -1) if sheet is not None and states else -1
        if sheet is None or state < 0:
            return view.mapToGlobal(view.rect().center())
        places = chip_places(sheet.picture.face(state), sheet.ink, float(sheet.full_widths[state]))
        corner = places[digit].bottomLeft() if digit < len(places) else QPointF()
        rect = canvas.rect_of(sheet.address_of_state(state))
        assert rect is not None
        node = canvas.mapFromScene(rect).boundingRect()
        x = canvas.mapFromScene(QPointF(*sheet.at[state]) + corner).x()
        at = view.mapToGlobal(QPoint(x, node.bottom() + GAP))
        if at.y() + size.height() <= view.screen().availableGeometry().bottom():
            return at
        return view.mapToGlobal(QPoint(x, node.top() - GAP - size.height()))
