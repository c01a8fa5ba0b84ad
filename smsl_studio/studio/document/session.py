"""Session: the blueprint being worked on, its history, what is selected, and where states stand.

Nothing else: it knows no file dialog, no canvas and no panel. Panels and the canvas read it, listen
to its signals, and change the blueprint only through ``edit``; what is typed in a text comes
through ``write`` or ``take``. A text that does not read is kept beside the last blueprint that did.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.smsl.document import Document
from smsl_studio.studio.document.aside import NOTHING, Aside, Unsaved, brought_back, put_aside
from smsl_studio.studio.document.broken import Broken, Reading, read_text, texts_of, under_name
from smsl_studio.studio.document.places import Places
from smsl_studio.studio.document.renamed import branch_now, first_branch, now_named

__all__ = ["Broken", "Fact", "Session"]

Fact = tuple[str, int]
"""A fact by its SB and digit."""

Stand = tuple[Blueprint, Broken | None]
"""The last blueprint that could be read, and the text typed since that cannot."""

Show = Callable[[Blueprint, Broken | None], None]


class _Edit(QUndoCommand):
    """The one undo command: how things stood before and after."""

    def __init__(self, words: str, show: Show, before: Stand, after: Stand) -> None:
        super().__init__(words)
        self._show, self._before, self._after = show, before, after

    def undo(self) -> None:
        """Show what was before."""
        self._show(*self._before)

    def redo(self) -> None:
        """Show what came of it."""
        self._show(*self._after)


class _GiveUp(QUndoCommand):
    """The text of a file that is imported no longer is not wanted, or wanted after all."""

    def __init__(
        self, words: str, aside: Callable[[], Aside], lay: Callable[[Aside], None], text: Document
    ) -> None:
        super().__init__(words)
        self._aside, self._lay, self._text = aside, lay, text

    def undo(self) -> None:
        """The text is wanted again."""
        self._lay({**self._aside(), self._text.file: self._text})

    def redo(self) -> None:
        """The text is given up."""
        aside = self._aside()
        self._lay({file: aside[file] for file in aside.keys() - {self._text.file}})


class Session(QObject):
    """One open blueprint. ``branch`` names the SB that the canvas shows.

    What is selected has one owner, and it is here: states and operations (``selection``), or one
    fact (``fact``), or nothing, and then the SB that is shown is what Properties speak of. Keys act
    on that and on nothing else. ``selection`` holds addresses, never objects, so that it outlives
    every edit that leaves them standing. The unsaved mark is the undo stack's clean state.
    """

    opened = Signal()
    """Another file was opened: told before ``blueprint_changed``; nothing said of before holds."""
    blueprint_changed = Signal(object, object)
    """(before, after): after every edit, undo and redo, and when another file is opened."""
    broken_changed = Signal()
    """A text does not read any more, reads again, or does not read in another way."""
    settling = Signal()
    """An edit is wanted: whoever holds what is being typed hands it over first."""
    selection_changed = Signal(object)
    """The new selection: a tuple of addresses; also where a fact is selected, or no longer."""
    jumped = Signal(object)
    """``jump`` was asked to show this address: whoever draws it brings it into view."""
    branch_changed = Signal(str)
    """The SB that is shown now."""
    refused = Signal(object)
    """A StudioError: an edit that was refused; nothing was changed."""
    aside_changed = Signal()
    """Other files than before are imported no longer and have unsaved text."""
    edited_changed = Signal(bool)
    """Whether there are unsaved changes."""

    def __init__(self, blueprint: Blueprint, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._blueprint = blueprint
        self._broken: Broken | None = None
        self._aside = NOTHING
        self.unsaved: Unsaved = lambda _: False
        """Whether a text stands nowhere else; who saves the texts knows, and says so here."""
        self._selection: tuple[Address, ...] = ()
        self._fact: Fact | None = None
        self._left: tuple[Address, ...] = ()
        self._branch = first_branch(blueprint)
        self._kept = _drawn(blueprint)
        """The SBs that the file had when it was opened or saved last, not those begun since."""
        self.places = Places()
        """Where the states stand that were not placed by hand, alike in every view of the file."""
        self.history = QUndoStack(self)
        # A method, not a lambda: it is disconnected before the history is deleted.
        self.history.cleanChanged.connect(self._clean_changed)

    @property
    def blueprint(self) -> Blueprint:
        """The blueprint as it is now; while a text does not read, the last one that did."""
        return self._blueprint

    @property
    def broken(self) -> Broken | None:
        """The text that does not read; ``blueprint`` is then the last one that did."""
        return self._broken

    @property
    def aside(self) -> Aside:
        """By their names, the documents that were imported and have text that was not saved."""
        return self._aside

    @property
    def texts(self) -> dict[str, str]:
        """The text of every file of the blueprint, as it is to be saved."""
        return texts_of(self._blueprint, self._broken)

    @property
    def branch(self) -> str:
        """The SB that is shown; the empty text where the blueprint has none."""
        return self._branch

    @property
    def selection(self) -> tuple[Address, ...]:
        """The selected states and operations."""
        return self._selection

    @property
    def fact(self) -> Fact | None:
        """The fact that is selected, as (SB, digit); then ``selection`` is empty."""
        return self._fact

    @property
    def extended(self) -> tuple[Address, ...]:
        """The selection to which a click with Shift adds: that from before the fact, if one is
        selected. Elements that were undone meanwhile are left out.
        """
        if self._fact is None:
            return self._selection
        return tuple(one for one in self._left if self._stands(one))

    @property
    def edited(self) -> bool:
        """Whether there are changes that were not saved."""
        return not self.history.isClean()

    def edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> bool:
        """Carry out one undoable edit; False (and ``refused``) where it would leave nonsense.

        ``words`` name the step in the history, such as "Rename State_0 to State_1". An edit that
        changes nothing leaves no step. What held without being written is written where the edit
        would turn it over: the places of states, and which one is activating. While a text does
        not read every edit is refused: it would be made in a text that is no longer the one that
        stands there.
        """
        self.settling.emit()
        try:
            if self._broken is not None:
                raise self._broken.refusal
            before = self._blueprint
            after = editing.keep_activating(before, change(before), self._kept)
            after = self.places.completed(before, after)
        except StudioError as error:
            self.refused.emit(error)
            return False
        self._push(words, after, None)
        return True

    def write(self, words: str, text: str, file: str | None = None) -> None:
        """One undoable step: ``text`` is what now stands in one of the files (else its own).

        Where it reads the blueprint follows, else it is ``broken``. Of several files only one may
        be broken at a time; writing in another one is refused.
        """
        name = file if file is not None else self._blueprint.file
        self.take(words, read_text(self._blueprint, name, text), name)

    def take(self, words: str, reading: Reading, file: str) -> None:
        """Like ``write``, for a text that was read elsewhere (``read_text`` of this blueprint)."""
        if self._broken is not None and self._broken.file != file:
            self.refused.emit(self._broken.refusal)
        elif isinstance(reading, Broken):
            self._push(words, self._blueprint, reading)
        elif texts_of(reading, None) == texts_of(self._blueprint, None):
            self._push(words, self._blueprint, None)
        else:
            self._push(words, reading, None)

    def give_up(self, words: str, file: str) -> None:
        """One undoable step: the text of a file that is imported no longer is not wanted."""
        self.history.push(_GiveUp(words, lambda: self._aside, self._lay_aside, self._aside[file]))

    def open(self, blueprint: Blueprint, broken: Broken | None = None) -> None:
        """Replace the blueprint by another file's; history and selection start anew.

        ``broken`` is the file's text where it does not read; then ``blueprint`` is what could be
        read of it.
        """
        before, self._blueprint = self._blueprint, blueprint
        self._kept = _drawn(blueprint)
        told = self._broken is not broken
        self._broken = broken
        self._aside = NOTHING
        # The history tells that it is empty now, and whoever hears it looks at all of this.
        self._branch = first_branch(blueprint)
        self._selection, self._fact = (), None
        self.places.clear()
        self.history.clear()
        self.opened.emit()
        self.blueprint_changed.emit(before, blueprint)
        if told:
            self.broken_changed.emit()
        self.branch_changed.emit(self._branch)
        self.selection_changed.emit(())

    def saved(self, blueprint: Blueprint) -> None:
        """What is shown was saved (perhaps under another name): the history is clean here."""
        self.history.setClean()
        self._kept = _drawn(blueprint)
        before = self._blueprint
        # Under the same name nothing has changed, also for who still inspects what is shown.
        if before.file != blueprint.file:
            self._replace(blueprint, under_name(before, self._broken, blueprint.file)[1])

    def select(self, addresses: Iterable[Address]) -> None:
        """Select what stands at these addresses; others are left out."""
        self._choose(tuple(dict.fromkeys(a for a in addresses if self._stands(a))), None)

    def select_fact(self, branch: str, digit: int) -> None:
        """Select a fact in place of states and operations; ``leave_fact`` takes them back."""
        self.show_branch(branch)
        if self._is_fact((branch, digit)):
            if self._fact is None:
                self._left = self._selection
            self._choose((), (branch, digit))

    def leave_fact(self) -> None:
        """Select what was selected before the fact was."""
        self.select(self._left)

    def show_branch(self, name: str) -> None:
        """Show another SB; the selection is dropped."""
        if name in self._blueprint.branches and name != self._branch:
            self._branch = name
            self.select(())
            self.branch_changed.emit(name)

    def jump(self, address: Address) -> None:
        """Show the SB an address lies in and select what stands there.

        A whole SB is shown, not selected: Del would take it away, and nothing would show that.
        """
        self.show_branch(address.branch)
        self.select((address,) if address.state else ())
        self.jumped.emit(address)

    def _choose(self, selection: tuple[Address, ...], fact: Fact | None) -> None:
        if (selection, fact) != (self._selection, self._fact):
            self._selection, self._fact = selection, fact
            self.selection_changed.emit(selection)

    def _is_fact(self, fact: Fact) -> bool:
        branch = self._blueprint.branches.get(fact[0])
        if branch is None:
            return False
        return 0 <= fact[1] < max(branch.num_facts, branch.header.num_facts or 0)

    def _clean_changed(self, clean: bool) -> None:
        self.edited_changed.emit(not clean)

    def _stands(self, address: Address) -> bool:
        branch = self._blueprint.branches.get(address.branch)
        if branch is None or not address.state:
            return branch is not None
        operations = branch.table.get(address.state)
        return operations is not None and (not address.operation or address.operation in operations)

    def _push(self, words: str, after: Blueprint, broken: Broken | None) -> None:
        if after is not self._blueprint or broken != self._broken:
            after = brought_back(after, self._aside, self.unsaved)
            before = (self._blueprint, self._broken)
            self.history.push(_Edit(words, self._show, before, (after, broken)))

    def _show(self, blueprint: Blueprint, broken: Broken | None) -> None:
        former = self._aside.keys()
        self._aside = put_aside(self._blueprint, blueprint, self._aside, self.unsaved)
        # A step from before a save under another name: the name stays the new one.
        self._replace(*under_name(blueprint, broken, self._blueprint.file))
        if self._aside.keys() != former:
            self.aside_changed.emit()

    def _lay_aside(self, aside: Aside) -> None:
        self._aside = aside
        self.aside_changed.emit()

    def _replace(self, blueprint: Blueprint, broken: Broken | None) -> None:
        before, self._blueprint = self._blueprint, blueprint
        told, self._broken = self._broken != broken, broken
        if before is not blueprint:
            self._follow(before)
        if told:
            self.broken_changed.emit()

    def _follow(self, before: Blueprint) -> None:
        """Tell of another blueprint, and show and select what of the former still stands.

        What was renamed stays selected under its new name, already while the blueprint is told of:
        a form that was empty for a moment would have lost the keys.
        """
        blueprint, former = self._blueprint, self._selection
        self._selection = tuple(now_named(before, blueprint, one) for one in former)
        moved = self._branch not in blueprint.branches
        if moved:
            self._branch = branch_now(before, blueprint, self._branch)
        self.blueprint_changed.emit(before, blueprint)
        if moved:
            self.branch_changed.emit(self._branch)
        kept = tuple(a for a in self._selection if self._stands(a))
        fact = self._fact
        if kept == self._selection != former:
            self.selection_changed.emit(kept)
        self._choose(kept, fact if fact is not None and self._is_fact(fact) else None)


def _drawn(blueprint: Blueprint) -> tuple[str, ...]:
    """The SBs that are more than begun."""
    return tuple(branch.name for branch in blueprint if len(branch.table) > 1)
