"""Session: the open blueprint, its history, the selection, and the places of states.

It knows no dialogs, no canvas and no panels. They read it, listen to its signals, and change the
blueprint only through ``edit``. Typed text comes through ``write`` or ``take``. A text that cannot
be read (``broken``) is kept beside the last blueprint that could be read.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoStack

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.studio.document.afterwards import Afterwards
from smsl_studio.studio.document.aside import NOTHING, Aside, Unsaved, brought_back, put_aside
from smsl_studio.studio.document.broken import Broken, Reading, read_text, texts_of, under_name
from smsl_studio.studio.document.history_steps import EditStep, GiveUpStep, Stand
from smsl_studio.studio.document.places import Places
from smsl_studio.studio.document.renamed import branch_now, first_branch, now_named, same_branch
from smsl_studio.studio.document.unwritten import Unwritten

__all__ = ["Broken", "Fact", "Session"]

Fact = tuple[str, int]
"""A fact: (SB, digit)."""


class Session(QObject):
    """One open blueprint. ``branch`` is the SB that the canvas shows.

    The session owns the selection. Either states and operations are selected (``selection``), or
    one fact (``fact``), or nothing; then Properties show the SB. Keys act on the selection only.
    ``selection`` has addresses and not objects, so it stays valid after edits that keep the
    elements. The unsaved mark is the clean state of the undo stack. After an undo or redo that is
    selected again which was selected there before, unless something was selected or left since.
    """

    opened = Signal()
    """Another file was opened.

    Emitted before ``blueprint_changed``; messages about the former file are obsolete.
    """
    blueprint_changed = Signal(object, object)
    """(before, after): emitted after every edit, undo and redo, and after another file was
    opened."""
    broken_changed = Signal()
    """``broken`` changed: a text became broken, can be read again, or is broken in another way."""
    settling = Signal()
    """An edit comes next: take over what is still being typed."""
    selection_changed = Signal(object)
    """tuple[Address]: the new selection. Also emitted when a fact is selected or left."""
    jumped = Signal(object)
    """Address: ``jump`` was called, so views should bring this element into view."""
    branch_changed = Signal(str)
    """str: the SB that is shown now."""
    refused = Signal(object)
    """A StudioError: an edit was refused, and nothing changed."""
    aside_changed = Signal()
    """The files in ``aside`` changed."""
    edited_changed = Signal(bool)
    """bool: whether there are unsaved changes."""
    stepped = Signal(int)
    """int: the place in the history after a new step, an undo or a redo."""

    def __init__(self, blueprint: Blueprint, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._blueprint = blueprint
        self._broken: Broken | None = None
        self._aside = NOTHING
        self.unsaved: Unsaved = lambda _: False
        """Tells whether a document's text exists nowhere else. ``Files`` sets this."""
        self.chosen_instead: Callable[[], bool] = lambda: False
        """Tells whether a note or group is selected, instead of what a session can select.
        ``DrawnEditor`` sets this."""
        self._selection: tuple[Address, ...] = ()
        self._fact: Fact | None = None
        self._left: tuple[Address, ...] = ()
        self._remembered: tuple[Address, ...] = ()
        """What was selected when the history was here last."""
        self._newly_chosen = False
        """Whether the selection is newer than the last step of the history."""
        self._branch = first_branch(blueprint)
        self.places = Places()
        """The automatic places of states, the same in every view of the file."""
        self.unwritten = Unwritten(self.places, blueprint)
        """What holds by default, and what an edit therefore writes."""
        self.afterwards = Afterwards(self)
        """What is shown a moment after an edit: forms, lists and the enabled actions."""
        self.history = QUndoStack(self)
        # A method and a signal of this object, because Qt disconnects them before it deletes the
        # history, which tells of its own end.
        self.history.cleanChanged.connect(self._clean_changed)
        self.history.indexChanged.connect(self.stepped)
        self.adds_step = False
        """Whether the step that is carried out is new, and no undo or redo."""

    @property
    def blueprint(self) -> Blueprint:
        """The present blueprint; while a text is broken, the last one that could be read."""
        return self._blueprint

    @property
    def broken(self) -> Broken | None:
        """The text that cannot be read, or None; ``blueprint`` is then the last one that could."""
        return self._broken

    @property
    def aside(self) -> Aside:
        """The documents that are no longer imported but have unsaved text, by file name."""
        return self._aside

    @property
    def texts(self) -> dict[str, str]:
        """The text of every file of the blueprint as it would be saved."""
        return texts_of(self._blueprint, self._broken)

    @property
    def branch(self) -> str:
        """The SB that is shown; empty if the blueprint has none."""
        return self._branch

    @property
    def selection(self) -> tuple[Address, ...]:
        """The selected states and operations."""
        return self._selection

    @property
    def fact(self) -> Fact | None:
        """The selected fact as (SB, digit), or None. With a fact ``selection`` is empty."""
        return self._fact

    @property
    def extended(self) -> tuple[Address, ...]:
        """The selection that a click with Shift extends.

        While a fact is selected, this is the selection before it, without elements that no longer
        exist.
        """
        if self._fact is None:
            return self._selection
        return tuple(one for one in self._left if self._stands(one))

    @property
    def edited(self) -> bool:
        """Whether there are unsaved changes."""
        return not self.history.isClean()

    def edit(self, words: str, change: Callable[[Blueprint], Blueprint], run: int = -1) -> bool:
        """Carry out one undoable edit; False (and ``refused``) if it is refused.

        ``words`` name the step in the history, such as "Rename State_0 to State_1". An edit that
        changes nothing makes no step. What holds without being written is written if the edit would
        change it (``Unwritten``). While a text is broken every edit is refused, because its result
        would replace the broken text. Edits of the same ``run`` right after each other become one
        step.
        """
        self.settling.emit()
        try:
            if self._broken is not None:
                raise self._broken.refusal
            before = self._blueprint
            after = self.unwritten.written(before, change(before))
        except StudioError as error:
            self.refused.emit(error)
            return False
        self._push(words, after, None, run)
        return True

    def write(self, words: str, text: str, file: str | None = None) -> None:
        """Replace the text of one file as one undoable step.

        Without ``file`` the blueprint's own text.

        If the text can be read, the blueprint follows. Otherwise it is kept as ``broken``. Only one
        file may be broken at a time, so writing in another one is then refused.
        """
        name = file if file is not None else self._blueprint.file
        self.take(words, read_text(self._blueprint, name, text), name)

    def take(self, words: str, reading: Reading, file: str) -> None:
        """Like ``write``, for a text that was already read with ``read_text`` from this
        blueprint."""
        if self._broken is not None and self._broken.file != file:
            self.refused.emit(self._broken.refusal)
        elif isinstance(reading, Broken):
            self._push(words, self._blueprint, reading)
        elif texts_of(reading, None) == texts_of(self._blueprint, None):
            self._push(words, self._blueprint, None)
        else:
            self._push(words, reading, None)

    def give_up(self, words: str, file: str) -> None:
        """Give up the unsaved text of a file that is no longer imported, as one undoable step."""
        text = self._aside[file]
        self.history.push(GiveUpStep(words, lambda: self._aside, self._lay_aside, text))

    def open(self, blueprint: Blueprint, broken: Broken | None = None) -> None:
        """Replace the blueprint by that of another file. History and selection start anew.

        ``broken`` is the file's text if it cannot be read. ``blueprint`` then has what could be
        read of it.
        """
        self.afterwards.catch_up()
        before, self._blueprint = self._blueprint, blueprint
        self.unwritten.follow(blueprint)
        told = self._broken is not broken
        self._broken = broken
        self._aside = NOTHING
        # Clearing the history emits signals whose listeners read all of the state above.
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
        """Mark the history as clean after a save, perhaps under another name."""
        self.history.setClean()
        self.unwritten.follow(blueprint)
        before = self._blueprint
        # Under the same name nothing changed, so an inspection in progress stays valid.
        if before.file != blueprint.file:
            broken = self._broken and under_name(before, self._broken, blueprint.file)[1]
            self._replace(blueprint, broken)
            self._note_form(Stand(blueprint, broken or None))

    def _note_form(self, saved: Stand) -> None:
        """Let the history come back to the text that was saved, byte for byte.

        A step keeps the form in which it was made, and another form of it is made anew. What is
        made from a third form may be written otherwise.
        """
        at = self.history.index()
        for place, former in ((at - 1, False), (at, True)):
            step = self.history.command(place) if 0 <= place < self.history.count() else None
            if isinstance(step, EditStep):
                step.put(saved, former)

    def select(self, addresses: Iterable[Address]) -> None:
        """Select the elements at these addresses. Addresses without an element are left out."""
        self._choose_newly(tuple(dict.fromkeys(a for a in addresses if self._stands(a))), None)

    def give_way(self) -> None:
        """Select nothing, because a note or group is selected instead."""
        self._choose((), None)

    def select_again(self) -> None:
        """Select what was selected when the history was here last, if that is in the SB that is
        shown."""
        there = tuple(a for a in self._remembered if a.branch == self._branch and self._stands(a))
        if there:
            self._choose(there, None)
            self._newly_chosen = False

    def select_fact(self, branch: str, digit: int) -> None:
        """Select a fact instead of states and operations; ``leave_fact`` restores these."""
        self.show_branch(branch)
        if self._is_fact((branch, digit)):
            if self._fact is None:
                self._left = self._selection
            self._choose_newly((), (branch, digit))

    def leave_fact(self) -> None:
        """Restore the selection from before the fact was selected."""
        self.select(self._left)

    def show_branch(self, name: str) -> None:
        """Show another SB and clear the selection."""
        if name in self._blueprint.branches and name != self._branch:
            self._branch = name
            self.select(())
            self.branch_changed.emit(name)

    def jump(self, address: Address) -> None:
        """Show the SB of an address and select its element.

        The address of a whole SB selects nothing. Otherwise Del would delete the SB, although
        nothing looks selected.
        """
        self.show_branch(address.branch)
        self.select((address,) if address.state else ())
        self.jumped.emit(address)

    def _choose_newly(self, selection: tuple[Address, ...], fact: Fact | None) -> None:
        self._newly_chosen |= (selection, fact) != (self._selection, self._fact)
        self._choose(selection, fact)

    def _choose(self, selection: tuple[Address, ...], fact: Fact | None) -> None:
        if (selection, fact) != (self._selection, self._fact):
            self._selection, self._fact = selection, fact
            self.selection_changed.emit(selection)

    def _fact_now(self, before: Blueprint) -> Fact | None:
        """Return the selected fact with the name that its SB has now, None if it is gone."""
        if self._fact is None:
            return None
        name, digit = self._fact
        fact = same_branch(before, self._blueprint, name), digit
        return fact if self._is_fact(fact) else None

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

    def _push(self, words: str, after: Blueprint, broken: Broken | None, run: int = -1) -> None:
        if after is not self._blueprint or broken != self._broken:
            after = brought_back(after, self._aside, self.unsaved)
            before = Stand(self._blueprint, self._broken)
            self.adds_step = True
            with self.afterwards.change():
                self.history.push(EditStep(words, self._step, before, Stand(after, broken), run))
            self.adds_step = False

    def _step(self, stand: Stand) -> tuple[Address, ...]:
        with self.afterwards.change():
            return self._show(stand)

    def _show(self, stand: Stand) -> tuple[Address, ...]:
        """Show what a step of the history comes from or leads to; returns the former selection."""
        selection, kept = self._selection, self._aside.keys()
        self._aside = put_aside(self._blueprint, stand.blueprint, self._aside, self.unsaved)
        # After a save under another name, older steps have the new name and form.
        self._replace(*under_name(stand.blueprint, stand.broken, self._blueprint.file))
        self._remembered = stand.selection
        if not (self.adds_step or self._chose_since(selection)):
            self.select_again()
        self._newly_chosen = False
        if self._aside.keys() != kept:
            self.aside_changed.emit()
        return selection

    def _chose_since(self, former: tuple[Address, ...]) -> bool:
        """Whether the person has chosen something since the step before, and it still exists.

        That can be a fact or a note, and also that nothing is selected. ``former`` was selected
        before the undo or redo.
        """
        if self._fact is not None or self.chosen_instead():
            return True
        return self._newly_chosen and bool(self._selection or not former)

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
        """Announce another blueprint, and keep what is shown and selected if it still exists.

        The selection has the new names before the signal is emitted. Otherwise a form would be
        empty for a moment and lose the keyboard focus, or show a fact that no longer exists.
        """
        blueprint, former, fact = self._blueprint, self._selection, self._fact
        self._selection = tuple(now_named(before, blueprint, one) for one in former)
        self._fact = self._fact_now(before)
        moved = self._branch not in blueprint.branches
        if moved:
            self._branch = branch_now(before, blueprint, self._branch)
        self.blueprint_changed.emit(before, blueprint)
        if moved:
            self.branch_changed.emit(self._branch)
        kept = tuple(a for a in self._selection if self._stands(a))
        if (kept == self._selection != former) or self._fact != fact:
            self.selection_changed.emit(kept)
        self._choose(kept, self._fact)
