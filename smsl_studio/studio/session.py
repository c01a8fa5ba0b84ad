"""Session: the blueprint being worked on, its history, the selection and the SB that is shown.

Nothing else: it knows no file dialog, no canvas and no panel. Panels and the canvas read it, listen
to its signals, and change the blueprint only through ``edit``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint


class _Edit(QUndoCommand):
    """The one undo command: the blueprint before and after."""

    def __init__(self, words: str, session: Session, before: Blueprint, after: Blueprint) -> None:
        super().__init__(words)
        self._session, self._before, self._after = session, before, after

    def undo(self) -> None:
        self._session._show(self._before)

    def redo(self) -> None:
        self._session._show(self._after)


class Session(QObject):
    """One open blueprint. ``branch`` names the SB that the canvas shows.

    ``selection`` holds addresses, never objects, so that it outlives every edit that leaves them
    standing. The unsaved mark is the undo stack's clean state.
    """

    opened = Signal()
    """Another file was opened: told before ``blueprint_changed``; nothing said of before holds."""
    blueprint_changed = Signal(object, object)
    """(before, after): after every edit, undo and redo, and when another file is opened."""
    selection_changed = Signal(object)
    """The new selection: a tuple of addresses."""
    branch_changed = Signal(str)
    """The SB that is shown now."""
    refused = Signal(object)
    """A StudioError: an edit that was refused; nothing was changed."""
    edited_changed = Signal(bool)
    """Whether there are unsaved changes."""

    def __init__(self, blueprint: Blueprint, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._blueprint = blueprint
        self._selection: tuple[Address, ...] = ()
        self._branch = _first_branch(blueprint)
        self.history = QUndoStack(self)
        # A method, not a lambda: it is disconnected before the history is deleted.
        self.history.cleanChanged.connect(self._clean_changed)

    @property
    def blueprint(self) -> Blueprint:
        return self._blueprint

    @property
    def branch(self) -> str:
        """The SB that is shown; the empty text where the blueprint has none."""
        return self._branch

    @property
    def selection(self) -> tuple[Address, ...]:
        return self._selection

    @property
    def edited(self) -> bool:
        """Whether there are changes that were not saved."""
        return not self.history.isClean()

    def edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> bool:
        """Carry out one undoable edit; False (and ``refused``) where it would leave nonsense.

        ``words`` name the step in the history, such as "Rename State_0 to State_1". An edit that
        changes nothing leaves no step.
        """
        from smsl_studio.errors import StudioError

        try:
            after = change(self._blueprint)
        except StudioError as error:
            self.refused.emit(error)
            return False
        if after is not self._blueprint:
            self.history.push(_Edit(words, self, self._blueprint, after))
        return True

    def open(self, blueprint: Blueprint) -> None:
        """Replace the blueprint by another file's; history and selection start anew."""
        before, self._blueprint = self._blueprint, blueprint
        # The history tells that it is empty now, and whoever hears it looks at all of this.
        self._branch = _first_branch(blueprint)
        self._selection = ()
        self.history.clear()
        self.opened.emit()
        self.blueprint_changed.emit(before, blueprint)
        self.branch_changed.emit(self._branch)
        self.selection_changed.emit(())

    def saved(self, blueprint: Blueprint) -> None:
        """What is shown was saved (perhaps under another name): the history is clean here."""
        self.history.setClean()
        before = self._blueprint
        # Under the same name nothing has changed, also for who still inspects what is shown.
        if before.file != blueprint.file:
            self._blueprint = blueprint
            self.blueprint_changed.emit(before, blueprint)

    def select(self, addresses: Iterable[Address]) -> None:
        """Select what stands at these addresses; others are left out."""
        found = tuple(dict.fromkeys(a for a in addresses if self._stands(a)))
        if found != self._selection:
            self._selection = found
            self.selection_changed.emit(found)

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

    def _clean_changed(self, clean: bool) -> None:
        self.edited_changed.emit(not clean)

    def _stands(self, address: Address) -> bool:
        branch = self._blueprint.branches.get(address.branch)
        if branch is None or not address.state:
            return branch is not None
        operations = branch.table.get(address.state)
        return operations is not None and (not address.operation or address.operation in operations)

    def _show(self, blueprint: Blueprint) -> None:
        before, file = self._blueprint, self._blueprint.file
        if blueprint.file != file:
            # A step from before a save under another name: the name stays the new one.
            document = replace(blueprint.document, file=file)
            blueprint = replace(blueprint, document=document)
        self._blueprint = blueprint
        moved = self._branch not in blueprint.branches
        if moved:
            self._branch = _renamed(before, blueprint, self._branch)
        self.blueprint_changed.emit(before, blueprint)
        if moved:
            self.branch_changed.emit(self._branch)
        kept = tuple(a for a in self._selection if self._stands(a))
        if kept != self._selection:
            self._selection = kept
            self.selection_changed.emit(kept)


def _first_branch(blueprint: Blueprint) -> str:
    return next(iter(blueprint.roots), next(iter(blueprint.branches), ""))


def _renamed(before: Blueprint, after: Blueprint, branch: str) -> str:
    """The SB that now stands where ``branch`` stood (it was renamed), else the first one."""
    names, now = list(before.branches), list(after.branches)
    if branch in names and len(names) == len(now):
        return now[names.index(branch)]
    return _first_branch(after)
