"""Outline: the State Branches by level, their facts as chips, sub-SBs below their fact."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QModelIndex, QPoint, Qt, QTimer, Signal
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.errors import EditRefused
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.fact_menu import fact_menu
from smsl_studio.studio.features.draw.panels.fact_name import fact_name_step
from smsl_studio.studio.features.draw.panels.frame import Heading, Panel
from smsl_studio.studio.features.draw.panels.outline_lines import worst_of
from smsl_studio.studio.features.draw.panels.outline_tree import OutlineTree, line_of

VERBS = {"Ctrl+X": "cut", "Ctrl+C": "copy", "Ctrl+V": "paste", "Ctrl+D": "duplicate"}
"""What is done to a whole SB by the clipboard's keys."""

KEYS = {"F2": "rename", "Del": "delete", **VERBS}
"""Every key of the outline, and the action it means while something on the canvas is selected."""

NO_BRANCH = EditRefused(
    "an import that failed is no State Branch",
    advice="Correct or delete its name under _imports in the source.",
)
"""What is said to the keys that mean a whole SB."""

DONE = {"cut": "cut", "copy": "copied", "paste": "pasted over", "duplicate": "duplicated"}


class Outline(Panel):
    """The tree of SBs. A click or an arrow key shows an SB or a fact.

    Keys act on what the session says is selected: on states and operations (told by
    ``action_wanted``), on a fact, and only where neither is selected on the SB of the marked line.
    """

    action_wanted = Signal(str)
    """The id of an action that a key means for what is selected on the canvas."""
    branch_deleted = Signal(str, int)
    """(SB, how many states it had): it was deleted as a whole."""
    fact_wanted = Signal(str, int)
    """(SB, digit): a fact was clicked, and its properties are wanted."""
    verb_wanted = Signal(str, str)
    """(copy, cut, paste or duplicate; SB): a whole SB is meant."""
    file_wanted = Signal(str)
    """The file in which an imported SB stands is to be opened."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Outline", parent)
        self._session, self._tokens = session, tokens
        self._drawn = session.blueprint
        self._opened = False
        self._heading = Heading("Outline", "Level")
        self.column.addWidget(self._heading)
        self.add_button = QToolButton(self._heading)
        self.add_button.setProperty("role", "small")
        self.add_button.setFixedSize(24, 24)
        self.add_button.setToolTip("Add a State Branch")
        self.add_button.setAccessibleName("Add a State Branch")
        self.add_button.clicked.connect(self.add_branch)
        layout = self._heading.layout()
        assert layout is not None
        layout.removeWidget(self._heading.right)
        layout.addWidget(self.add_button)
        layout.addWidget(self._heading.right)
        self.tree = OutlineTree(tokens, session.blueprint, self)
        self.column.addWidget(self.tree, 1)
        self.tree.clicked.connect(self._clicked)
        self.tree.activated.connect(self._clicked)
        self.tree.named.connect(self._renamed)
        self.tree.itemDelegate().closeEditor.connect(
            lambda *_: QTimer.singleShot(0, self, self._show)
        )
        self.tree.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.tree.customContextMenuRequested.connect(self._menu)
        self.tree.moved.connect(self._moved)
        for key in KEYS:
            action = QAction(self.tree)
            action.setShortcut(QKeySequence(key))
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
            action.triggered.connect(partial(self._press, key))
            self.tree.addAction(action)
        session.opened.connect(self._note_opened)
        session.blueprint_changed.connect(lambda *_: self._show())
        session.branch_changed.connect(lambda *_: self._mark())
        session.selection_changed.connect(lambda *_: self._mark())
        self.set_tokens(tokens)
        self._show()

    def set_tokens(self, tokens: Tokens) -> None:
        """Take the colours of another theme."""
        self._tokens = tokens
        self.add_button.setIcon(icon("plus", tokens, 14))
        self.tree.set_tokens(tokens)

    def set_run(self, active: Mapping[str, str], running: str) -> None:
        """Show the active state of every SB, and let the one glow in which an operation runs."""
        self.tree.set_run(active, running)

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Mark every SB with the gravest of its findings."""
        self.tree.show_marks(worst_of(findings))

    # The verbs of the tree, on the SB that is shown.

    def add_branch(self) -> None:
        """Add an empty SB and start naming it."""
        name = fresh_branch_name(self._session.blueprint)
        if self._session.edit(f"Add State Branch {name}", lambda bp: editing.add_branch(bp, name)):
            self._session.show_branch(name)
            self.rename_branch()

    def rename_branch(self) -> None:
        """Edit the name of the current SB in place."""
        self._name(self.tree.index_of(self._current_branch()))

    def _name(self, index: QModelIndex) -> None:
        if index.isValid():
            self.tree.setFocus()
            self.tree.mark(index)
            self.tree.edit(index)

    def delete_branch(self) -> None:
        """Delete the whole SB of the marked line; ``branch_deleted`` tells it."""
        name = self._current_branch()
        branch = self._session.blueprint.branches.get(name)
        if branch is None:
            return
        states = len(branch.table)
        words = f"Delete State Branch {name}"
        if self._session.edit(words, lambda bp: editing.delete(bp, [Address(name)])):
            self.branch_deleted.emit(name, states)

    def _press(self, key: str) -> None:
        verb, fact = KEYS[key], self._session.fact
        if self._session.selection:
            self.action_wanted.emit(verb)
        elif fact is not None:
            self._press_on_fact(verb, *fact)
        elif self._on_fault():
            self._session.refused.emit(NO_BRANCH)
        elif verb == "rename":
            self.rename_branch()
        elif verb == "delete":
            self.delete_branch()
        else:
            self._ask(verb)

    def _press_on_fact(self, verb: str, branch: str, digit: int) -> None:
        """A fact is a digit of every state, so it can be neither cut out nor deleted alone."""
        index = self.tree.currentIndex()
        if verb == "rename":
            self._name(index)
        elif verb == "delete" and index.isValid():
            corner = self.tree.visualRect(index).bottomLeft()
            menu = fact_menu(self._session, branch, digit, self)
            menu.aboutToHide.connect(menu.deleteLater)
            menu.popup(self.tree.viewport().mapToGlobal(corner))
        else:
            refusal = EditRefused(
                f"a fact cannot be {DONE.get(verb, verb)} by itself",
                advice="Select its State Branch in the outline, or states on the canvas.",
            )
            self._session.refused.emit(refusal)

    def _ask(self, verb: str) -> None:
        self.verb_wanted.emit(verb, self._current_branch())

    def _on_fault(self) -> bool:
        index = self.tree.currentIndex()
        return index.isValid() and bool(line_of(index).fault)

    def _current_branch(self) -> str:
        index = self.tree.currentIndex()
        return line_of(index).branch if index.isValid() else self._session.branch

    def _clicked(self, index: QModelIndex) -> None:
        line = line_of(index)
        if line.fault:
            # It stays the marked line: Del must not mean an SB that nobody chose.
            self._session.select(())
            self.tree.mark(index)
            return
        if line.digit is not None:
            self.fact_wanted.emit(line.branch, line.digit)
        else:
            self._session.show_branch(line.branch)
            self._session.select(())
        self._mark()

    def _moved(self, index: QModelIndex) -> None:
        """An arrow key went to another line: the canvas and the properties follow."""
        if index.isValid() and self.tree.hasFocus():
            self._clicked(index)

    def _renamed(self, branch: str, digit: int | None, new: str) -> None:
        # Now, not in a moment: it may be saved or closed by then. The tree, to which the
        # editor still belongs, takes the new name when the editor has gone.
        if digit is None and new != branch:
            words = f"Rename {branch} to {new}"
            self._session.edit(words, lambda bp: editing.rename(bp, Address(branch), new))
        elif digit is not None and new != self._session.blueprint[branch].fact_name(digit):
            self._session.edit(*fact_name_step(branch, digit, new))

    def _menu(self, at: QPoint) -> None:
        index = self.tree.indexAt(at)
        if index.isValid():
            self.tree.setCurrentIndex(index)
        menu = QMenu(self)
        menu.addAction(icon("plus", self._tokens), "Add State Branch", self.add_branch)
        if self._session.fact is not None:
            # What the keys mean on this line, and not what they would mean on its SB.
            name = as_it_is(line_of(self.tree.currentIndex()).text)
            rename, delete = partial(self._press, "F2"), partial(self._press, "Del")
            menu.addAction(icon("pencil", self._tokens), f"Rename {name}\tF2", rename)
            menu.addAction(icon("trash", self._tokens), f"Delete from {name}…\tDel", delete)
        elif self._current_branch():
            name = as_it_is(self._current_branch())
            menu.addAction(icon("pencil", self._tokens), f"Rename {name}\tF2", self.rename_branch)
            for key, verb in VERBS.items():
                menu.addAction(f"{verb.capitalize()}\t{key}", partial(self._ask, verb))
            menu.addAction(icon("trash", self._tokens), f"Delete {name}\tDel", self.delete_branch)
            home = self._session.blueprint.imported.get(self._current_branch())
            if home is not None:
                opening = partial(self.file_wanted.emit, home.file)
                menu.addAction(
                    icon("folder", self._tokens), as_it_is(f"Open {Path(home.file).name}"), opening
                )
        menu.exec(self.tree.viewport().mapToGlobal(at))
        menu.deleteLater()

    def _note_opened(self) -> None:
        self._opened = True

    def _show(self) -> None:
        if self.tree.naming:
            return
        before, blueprint = self._drawn, self._session.blueprint
        if blueprint is not before:
            another = self._opened and blueprint.file != before.file
            self._drawn, self._opened = blueprint, False
            self.tree.show_blueprint(blueprint, another)
        self._mark()

    def _mark(self) -> None:
        """Put the current row on the fact that is selected, else on the SB that is shown."""
        branch, digit = self._session.fact or (self._session.branch, None)
        index = self.tree.currentIndex()
        if not index.isValid() or not _is_at(index, branch, digit):
            index = self.tree.index_of(branch, digit)
        self.tree.mark(index)


def _is_at(index: QModelIndex, branch: str, digit: int | None) -> bool:
    line = line_of(index)
    return line.branch == branch and line.digit == digit and not line.fault
