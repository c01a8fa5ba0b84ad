"""What a window has for people: who works here, what they are asked, how far they lead.

It is put together once for each window: card and continuum into the places of Supervise, a badge
for the other modes, and two dialogs.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

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
    """Whether people are asked anything is another than it was."""
    task_wanted = Signal()
    """The open task shall be shown, whatever is shown now."""

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
        # Everything that is commanded here goes in this name.
        run.who = lambda: persons.me.name
        self.continuum = Continuum(session, run, levels, tokens)
        self.badge.clicked.connect(self.task_wanted)
        self._asked = False
        self.editor: LevelEditor | None = None
        """The table of levels, while it is open."""
        self.card.changed.connect(self._tell)
        self.card.persons_wanted.connect(self.edit_persons)
        self.continuum.edit_wanted.connect(self.edit_levels)

    def set_tokens(self, tokens: Tokens) -> None:
        """Take the colours of another theme."""
        for part in (self.card, self.badge, self.continuum):
            part.set_tokens(tokens)

    def take_places(self, tasks: QVBoxLayout, levels: Callable[[QWidget], object]) -> None:
        """Stand where Supervise has room for what people are asked, and for how far they lead."""
        tasks.addWidget(self.card)
        levels(self.continuum)

    def hear(self, page: QWidget) -> None:
        """Let the letters of the answers act wherever in ``page`` the focus is."""
        page.installEventFilter(self)

    def has_task(self) -> bool:
        """Whether people are asked anything now."""
        return bool(self.card.tasks)

    def may_edit_levels(self) -> bool:
        """A run keeps the levels it began with."""
        return not self._run.exists

    def _tell(self) -> None:
        if self.has_task() != self._asked:
            self._asked = self.has_task()
            self.changed.emit()

    def edit_persons(self) -> None:
        """Open the dialog of the persons."""
        dialog = PersonsDialog(self.persons, self._window)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.open()

    def edit_levels(self) -> None:
        """Open the table of levels, before a run."""
        if self.may_edit_levels():
            editor = self.editor = LevelEditor(self._session, self.levels, self._window)
            editor.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
            editor.finished.connect(self._editor_closed)
            editor.open()

    def _editor_closed(self) -> None:
        self.editor = None

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """A letter that is an answer's, typed where nothing else is typed."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            plain = event.modifiers() == Qt.KeyboardModifier.NoModifier
            typing = isinstance(self._window.focusWidget(), QLineEdit)
            if plain and not typing and not event.isAutoRepeat() and self.card.isVisible():
                return self.card.press_letter(event.text())
        return super().eventFilter(watched, event)
