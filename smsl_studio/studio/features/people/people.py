"""The parts for people in one window: task card, badge, continuum, dialogs.

Card and continuum stand in Supervise mode. The badge shows an open task in other modes.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

from smsl_studio.studio.base.announcement import announce
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.people.continuum import Continuum
from smsl_studio.studio.features.people.level_editor import LevelEditor
from smsl_studio.studio.features.people.persons_dialog import PersonsDialog
from smsl_studio.studio.features.people.task_badge import TaskBadge
from smsl_studio.studio.features.people.task_card import TaskCard
from smsl_studio.studio.running.next_levels import NextLevels
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.run_session import RunSession


class People(QObject):
    """Card, badge, continuum and dialogs of one window."""

    changed = Signal()
    """A task opened while there was none, or the last one ended."""
    task_wanted = Signal()
    """The person wants to see the open task, from any mode."""

    def __init__(
        self,
        session: Session,
        run: RunSession,
        levels: NextLevels,
        persons: Persons,
        tokens: Tokens,
        window: QWidget,
    ) -> None:
        super().__init__(window)
        self._session, self._run, self._window = session, run, window
        self.persons, self.levels = persons, levels
        self.card = TaskCard(persons, tokens)
        self.card.follow(run)
        self.badge = TaskBadge(self.card, tokens)
        # All commands of this window have the name of this person.
        run.who = lambda: persons.me.name
        self.continuum = Continuum(session, run, levels, tokens)
        self.badge.clicked.connect(self.task_wanted)
        self._asked, self._told = False, ""
        self.editor: LevelEditor | None = None
        """The dialog for levels while it is open."""
        self.card.changed.connect(self._tell)
        self.card.persons_wanted.connect(self.edit_persons)
        self.continuum.edit_wanted.connect(self.edit_levels)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.card, self.badge, self.continuum):
            part.set_tokens(tokens)

    def take_places(self, tasks: QVBoxLayout, levels: Callable[[QWidget], object]) -> None:
        """Put the card and the continuum into their places in Supervise mode."""
        tasks.addWidget(self.card)
        levels(self.continuum)

    def hear(self, page: QWidget) -> None:
        """Let the letters of the answers work anywhere in ``page``."""
        page.installEventFilter(self)

    def has_task(self) -> bool:
        """Whether a task is open for people."""
        return bool(self.card.tasks)

    def may_edit_levels(self) -> bool:
        """Whether the levels can be edited now. A run keeps those it began with."""
        return not self._run.exists

    def _tell(self) -> None:
        if self.has_task() != self._asked:
            self._asked = self.has_task()
            self.changed.emit()
        self._announce()

    def _announce(self) -> None:
        """Let a screen reader read a question that has just come up, in whichever mode."""
        card = self.card.card
        task = card.task if card is not None else ""
        if card is not None and task != self._told:
            words = f"{card.heading}: {card.question} {card.left} left."
            announce(self._window, words, urgent=True)
        self._told = task

    def edit_persons(self) -> None:
        """Open the dialog for persons."""
        dialog = PersonsDialog(self.persons, self._window)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

    def edit_levels(self) -> None:
        """Open the dialog for levels, unless there is a run."""
        if self.may_edit_levels():
            editor = self.editor = LevelEditor(self._session, self.levels, self._window)
            editor.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
            editor.finished.connect(self._editor_closed)
            editor.open()

    def _editor_closed(self) -> None:
        self.editor = None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Select the answer of a typed letter, unless a text field has the focus."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            plain = event.modifiers() == Qt.KeyboardModifier.NoModifier
            typing = isinstance(self._window.focusWidget(), QLineEdit)
            if plain and not typing and not event.isAutoRepeat() and self.card.isVisible():
                return self.card.press_letter(event.text())
        return super().eventFilter(watched, event)
