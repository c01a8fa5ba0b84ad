"""The outline: the State Branches by level, their facts, and each sub-SB below its fact."""

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
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.key_menu import show_key
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import as_it_is
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.fact_menu import fact_menu
from smsl_studio.studio.features.draw.panels.fact_name import fact_name_step
from smsl_studio.studio.features.draw.panels.frame import Heading, Panel
from smsl_studio.studio.features.draw.panels.outline_lines import worst_of
from smsl_studio.studio.features.draw.panels.outline_tree import OutlineTree, line_of

VERBS = {"Ctrl+X": "cut", "Ctrl+C": "copy", "Ctrl+V": "paste", "Ctrl+D": "duplicate"}
"""The keys of the clipboard, which act on a whole SB."""

KEYS = {"F2": "rename", "Del": "delete", **VERBS}
"""Every key of the outline, and the id of the action for it if elements are selected."""

NO_BRANCH = EditRefused(
    "an import that failed is no State Branch",
    advice="Correct or delete its name under _imports in the source.",
)
"""The refusal if a key for SBs is pressed on a failed import."""

NO_ROW = EditRefused(
    "a fact is selected that has no line here, so nothing was deleted",
    advice="Click the State Branch to delete it.",
)
"""The refusal if Del or Ctrl+X is pressed while Properties show such a fact."""

DONE = {"cut": "cut", "copy": "copied", "paste": "pasted over", "duplicate": "duplicated"}


class Outline(Panel):
    """The tree of SBs. A click or an arrow key shows an SB or a fact.

    Keys act on the selected states and operations (see ``action_wanted``) if there are any, else on
    the selected fact if it has a line, else on the SB of the current line.
    """

    action_wanted = Signal(str)
    """str: a key was pressed while elements are selected; the id of its action."""
    branch_deleted = Signal(str, int)
    """(SB, how many states it had): the person deleted this SB."""
    fact_wanted = Signal(str, int)
    """(SB, digit): the person clicked this fact and wants its properties."""
    verb_wanted = Signal(str, str)
    """(“copy”, “cut”, “paste” or “duplicate”, SB): the person asked for it on a whole SB."""
    file_wanted = Signal(str)
    """str: the person asked to open this file, which holds an imported SB."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Outline", parent)
        self._session, self._tokens = session, tokens
        self._drawn = session.blueprint
        self._opened = False
        self._active: Mapping[str, str] = {}
        self._running = ""
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
        self._heading.right.setAccessibleName("Level, at the right of each State Branch")
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
        session.afterwards.follow(self._show, session.blueprint_changed)
        session.afterwards.follow(self._mark, session.branch_changed, session.selection_changed)
        self.set_tokens(tokens)
        self._show()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.add_button.setIcon(icon("plus", tokens, 14))
        self.tree.set_tokens(tokens)

    def set_run(self, active: Mapping[str, str], running: str) -> None:
        """Show the active state of every SB, and highlight the SB in which an operation runs.

        A run goes on with the blueprint that it began with. A state that is no longer drawn is left
        out.
        """
        self._active, self._running = active, running
        self._show_run()

    def _show_run(self) -> None:
        drawn = self._session.blueprint
        there = {
            branch: state
            for branch, state in self._active.items()
            if branch in drawn.branches and state in drawn[branch].table
        }
        self.tree.set_run(there, self._running)

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Mark every SB with the worst severity of its findings."""
        self.tree.show_marks(worst_of(findings))

    # The verbs of the tree.

    def add_branch(self) -> None:
        """Add an empty SB and edit its name."""
        name = fresh_branch_name(self._session.blueprint)
        if self._session.edit(f"Add State Branch {name}", lambda bp: editing.add_branch(bp, name)):
            self._session.show_branch(name)
            self.rename_branch()

    def rename_branch(self) -> None:
        """Edit the name of the current SB in its line."""
        self._session.afterwards.catch_up()
        self._name(self.tree.index_of(self._current_branch()))

    def _name(self, index: QModelIndex) -> None:
        if index.isValid():
            self.tree.setFocus()
            self.tree.mark(index)
            self.tree.edit(index)

    def delete_branch(self) -> None:
        """Delete the SB of the current line and emit ``branch_deleted``."""
        name = self._current_branch()
        branch = self._session.blueprint.branches.get(name)
        if branch is None:
            return
        states = len(branch.table)
        words = f"Delete State Branch {name}"
        if self._session.edit(words, lambda bp: editing.delete(bp, [Address(name)])):
            self.branch_deleted.emit(name, states)

    def _press(self, key: str) -> None:
        verb, fact = KEYS[key], self._listed_fact()
        if self._session.selection:
            self.action_wanted.emit(verb)
        elif fact is not None:
            self._press_on_fact(verb, *fact)
        elif self._on_fault():
            self._session.refused.emit(NO_BRANCH)
        elif verb in ("delete", "cut") and self._session.fact is not None:
            # Properties show the fact, so nobody has chosen the State Branch that is marked.
            self._session.refused.emit(NO_ROW)
        elif verb == "rename":
            self.rename_branch()
        elif verb == "delete":
            self.delete_branch()
        else:
            self._ask(verb)

    def _press_on_fact(self, verb: str, branch: str, digit: int) -> None:
        """Act on a fact.

        It can be neither cut nor deleted alone, because it is a digit of every state.
        """
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

    def _listed_fact(self) -> tuple[str, int] | None:
        """The selected fact if its line is the current one, None also if it has no line."""
        fact, index = self._session.fact, self.tree.currentIndex()
        return fact if fact is not None and index.isValid() and _is_at(index, *fact) else None

    def _current_branch(self) -> str:
        index = self.tree.currentIndex()
        return line_of(index).branch if index.isValid() else self._session.branch

    def _clicked(self, index: QModelIndex) -> None:
        line = line_of(index)
        if line.fault:
            # The fault stays the current line: Del must not delete an SB that nobody chose.
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
        """Follow an arrow key to another line, on the canvas and in the properties."""
        if index.isValid() and self.tree.hasFocus():
            self._clicked(index)

    def _renamed(self, branch: str, digit: int | None, new: str) -> None:
        # Edit at once, because the file may be saved or closed next. The tree shows the new name
        # when the field has closed (see ``closeEditor``).
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
        line = self.tree.currentIndex()
        menu.setAccessibleName(
            plain_text(f"Menu of {line_of(line).text}") if line.isValid() else "Menu of the outline"
        )
        menu.addAction(icon("plus", self._tokens), "Add State Branch", self.add_branch)
        if self._listed_fact() is not None:
            # As the keys do on this line: on the fact, not on its SB.
            name = as_it_is(line_of(self.tree.currentIndex()).text)
            rename, delete = partial(self._press, "F2"), partial(self._press, "Del")
            show_key(menu.addAction(icon("pencil", self._tokens), f"Rename {name}", rename), "F2")
            words = f"Delete from {name}…"
            show_key(menu.addAction(icon("trash", self._tokens), words, delete), "Del")
        elif self._current_branch():
            name = as_it_is(self._current_branch())
            pencil, trash = icon("pencil", self._tokens), icon("trash", self._tokens)
            show_key(menu.addAction(pencil, f"Rename {name}", self.rename_branch), "F2")
            for key, verb in VERBS.items():
                show_key(menu.addAction(verb.capitalize(), partial(self._ask, verb)), key)
            show_key(menu.addAction(trash, f"Delete {name}", self.delete_branch), "Del")
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
            self._show_run()
        self._mark()

    def _mark(self) -> None:
        """Make the line of the selected fact or of the shown SB the current one.

        An edit can leave a selected fact without a line, as names of states that are words show no
        facts. Then it is the line of its SB.
        """
        branch, digit = self._session.fact or (self._session.branch, None)
        index = self.tree.currentIndex()
        if not index.isValid() or not _is_at(index, branch, digit):
            index = self.tree.index_of(branch, digit)
            if digit is not None and not index.isValid():
                index = self.tree.index_of(branch)
        self.tree.mark(index)


def _is_at(index: QModelIndex, branch: str, digit: int | None) -> bool:
    line = line_of(index)
    return line.branch == branch and line.digit == digit and not line.fault
