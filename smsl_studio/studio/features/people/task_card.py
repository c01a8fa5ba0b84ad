"""The task card: a question to people while a run waits, and how it ended.

It is hidden without a task and without an outcome to read. An answer takes two acts: select an
option (a click or its letter), then decide (Enter or the button).
"""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QHideEvent, QKeyEvent, QShowEvent
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QLineEdit,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.dispatch.people.task import Task
from smsl_studio.front.views.card_view import CardView, card_view
from smsl_studio.front.views.task_outcomes import Outcomes
from smsl_studio.runlog.events import Event
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.room import Room
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.people.answer_part import AnswerPart
from smsl_studio.studio.features.people.answers import Answers
from smsl_studio.studio.features.people.card_head import CardHead
from smsl_studio.studio.features.people.option_row import OptionRow
from smsl_studio.studio.features.people.outcome_lines import OutcomeLines
from smsl_studio.studio.features.people.places import PersonPlaces
from smsl_studio.studio.running.persons import Persons
from smsl_studio.studio.running.run_session import RunSession

PAD, ANY = 14, 16_777_215


class TaskCard(QWidget):
    """Shows one open task, at first the one that ends soonest; below it how others ended."""

    answered = Signal(str, str, str, str)
    """(task, option, name, role): a person decided."""
    changed = Signal()
    """The task or its time changed, or the card became visible or hidden."""
    persons_wanted = Signal()
    """The person wants to edit the persons of this account."""

    def __init__(self, persons: Persons, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.tasks: tuple[Task, ...] = ()
        self._time = 0.0
        self._shown = ""
        self._low, self._high = False, 0
        self.outcomes = Outcomes()
        self._build(persons, tokens)
        self.answer.who.changed.connect(self._refresh)
        self.answer.who.edit_wanted.connect(self.persons_wanted)
        self.answer.decided.connect(self._decide)
        self.answers.changed.connect(self._refresh)
        self.answers.changed.connect(self._see_button)
        self.answers.settled.connect(self._lead_to_button)
        self.head.turned.connect(self._turn)
        self._refresh()

    def follow(self, run: RunSession) -> None:
        """Show the tasks of this run, and send it the answers."""

        def look() -> None:
            """Show the present tasks of the run."""
            status = run.status
            if status is None:
                self.forget()
            self.show_tasks(status.tasks if status and run.exists else (), run.time)

        run.changed.connect(look)
        run.events_told.connect(self.tell)
        self.answered.connect(
            lambda task, option, name, role: run.answer(task, option, role, by=name)
        )
        look()

    # What is shown.

    @property
    def card(self) -> CardView | None:
        """What the card shows; None without an open task."""
        task = self._task()
        if task is None:
            return None
        person = self.answer.who.person
        name, role = (person.name, person.role) if person else ("", "")
        return card_view(task, self._time, name, role)

    @property
    def options(self) -> tuple[OptionRow, ...]:
        """The rows of the answers in order."""
        return tuple(self.answers.rows)

    def show_tasks(self, tasks: tuple[Task, ...], time: float) -> None:
        """Show the open tasks; ``time`` is the present in simulated seconds."""
        self.tasks, self._time = tasks, time
        self.outcomes.see(tasks)
        self._refresh()

    def tell(self, events: tuple[Event, ...]) -> None:
        """Take new events: refused answers and ended tasks."""
        self.outcomes.tell(events)
        self._refresh()

    def forget(self) -> None:
        """Forget the outcomes of the former run."""
        self.outcomes.clear()

    def set_low(self, low: bool) -> None:
        """In a low page, move the choice of the person, and the button to enter some, to the top.

        Nobody can answer before that. Below the answers one would have to scroll to it.
        """
        if low != self._low:
            self._low = low
            self.answer.put_who(self._first if low else None)

    def set_room(self, high: int) -> None:
        """Be at most so high (pixels), so that the button that decides is in view.

        The question scrolls if it has too little space. 0 means that there is no limit.
        """
        self._high = high
        self._bound()

    def _bound(self) -> None:
        """Never be lower than the parts that do not scroll."""
        rest = self._room.sizeHint().height() - self._room.minimumSizeHint().height()
        least = self.heightForWidth(max(self.width(), 1)) - rest
        most = max(self._high, least) if self._high else ANY
        if most != self.maximumHeight():
            self.setMaximumHeight(most)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.head, self.answers, self._places, self.lines):
            part.set_tokens(tokens)

    def take_focus(self) -> None:
        """Give the keyboard focus to the answers, or to the choice of persons if this one may
        not answer."""
        card = self.card
        if card is not None and (card.objection or self.answer.who.person is None):
            self.answer.who.choice.setFocus()
        else:
            self.answers.take_focus()

    def showEvent(self, event: QShowEvent) -> None:
        """Emit ``changed``, because the card became visible."""
        super().showEvent(event)
        self.changed.emit()

    def hideEvent(self, event: QHideEvent) -> None:
        """Emit ``changed``, because the card became hidden."""
        super().hideEvent(event)
        self.changed.emit()

    # Building.

    def _build(self, persons: Persons, tokens: Tokens) -> None:
        self.frame = QFrame()
        self.frame.setObjectName("taskCard")
        self.head, self.answers = CardHead(tokens), Answers(tokens)
        self._places, self.lines = PersonPlaces(tokens), OutcomeLines(tokens)
        self.lines.dismissed.connect(self._dismiss)
        self.answer = AnswerPart(persons)
        self._question, self._detail = label("", "question"), label("", "small")
        self._sentence = label("", "hint")
        inner = QWidget()
        asked = QVBoxLayout(inner)
        asked.setContentsMargins(PAD, 12, PAD, 4)
        asked.setSpacing(6)
        for text in (self._question, self._detail):
            text.setWordWrap(True)
            asked.addWidget(text)
        asked.addSpacing(4)
        for part in (self.answers, self._places, self._sentence):
            asked.addWidget(part)
        self._room = Room(inner)
        self._first = QVBoxLayout()
        self._first.setContentsMargins(PAD, 10, PAD, 0)
        self._first.setSpacing(8)
        below = QVBoxLayout()
        below.setContentsMargins(PAD, 6, PAD, 12)
        below.addWidget(self.answer)
        column = QVBoxLayout(self.frame)
        column.setContentsMargins(1, 1, 1, 1)
        column.setSpacing(0)
        column.addWidget(self.head)
        column.addLayout(self._first)
        column.addWidget(self._room, 1)
        column.addLayout(below)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(8)
        whole.addWidget(self.frame, 1)
        whole.addWidget(self.lines)
        self.setAccessibleName("Task")
        self.setFocusPolicy(Qt.FocusPolicy.ClickFocus)

    # How it goes on.

    def _task(self) -> Task | None:
        shown = next((task for task in self.tasks if task.name == self._shown), None)
        return shown or min(self.tasks, key=lambda task: task.deadline, default=None)

    def _turn(self, by: int) -> None:
        names = [task.name for task in self.tasks]
        if self._shown in names:
            self._show(names[(names.index(self._shown) + by) % len(names)])

    def _show(self, name: str) -> None:
        """Show another task, with no answer selected and the person who works here chosen."""
        self._shown = name
        self.answer.who.start_with_me()
        card = self.card
        self.answers.put(card.options if card else ())
        self._refresh()

    def _refresh(self) -> None:
        task = self._task()
        name = task.name if task else ""
        if name != self._shown:
            self._show(name)
            return
        card = self.card
        self.frame.setVisible(card is not None)
        self.lines.show_lines(self.outcomes.lines)
        self.setVisible(card is not None or bool(self.outcomes.lines))
        self.changed.emit()
        if card is None:
            self._bound()
            return
        at = [task.name for task in self.tasks].index(self._shown)
        self.head.show_card(card, at + 1, len(self.tasks))
        self._question.setText(card.question)
        self._detail.setText(card.detail)
        self._detail.setVisible(bool(card.detail))
        self._sentence.setText(card.sentence)
        self._places.show_persons(card.persons)
        self._places.setVisible(len(card.persons) > 1 or card.persons[0].place != "Anybody")
        self.answers.open(not card.objection)
        self.answer.show_card(card, self.answers.chosen, self.outcomes.refusals.get(name, ""))
        self._bound()

    def _lead_to_button(self) -> None:
        """Give the focus to the button that decides, or to what it waits for.

        That is the choice of who answers, or a PIN that is not typed yet. A tall card scrolls until
        the button is visible.
        """
        who = self.answer.who
        if who.person is None:
            who.choice.setFocus()
        else:
            (who.pin if who.has_pin and not who.opens() else self.answer.button).setFocus()
        self._see_button()

    def _see_button(self) -> None:
        """Scroll so far that the button is in view, if an answer is selected."""
        button, above = self.answer.button, self.parentWidget()
        while above is not None and self.answers.chosen is not None:
            if isinstance(above, QScrollArea):
                above.ensureWidgetVisible(button)
            above = above.parentWidget()

    def _decide(self) -> None:
        card, chosen, person = self.card, self.answers.chosen, self.answer.who.person
        if card is None or chosen is None or person is None or not self.answer.button.isEnabled():
            return
        # The next person must not see this answer.
        self.answers.clear()
        if len(card.persons) > 1:
            self.answer.who.ask_again()
        self.answer.who.pin.clear()
        self.answered.emit(card.task, chosen.value, person.name, person.role)
        # Qt would move the focus from the disabled button to the choice of persons, and letters
        # with it.
        self.setFocus()
        self._refresh()

    def _dismiss(self, line: object) -> None:
        self.outcomes.lines = tuple(one for one in self.outcomes.lines if one != line)
        self._refresh()

    # Keys.

    def press_letter(self, letter: str) -> bool:
        """Select the answer with this letter, without deciding; returns whether there is one."""
        return self.answers.press(letter)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape unselects, a letter selects an answer, and Enter does not leave the card."""
        if event.key() == Qt.Key.Key_Escape and self.answers.chosen is not None:
            self.answers.clear()
            return
        if event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            # If it went on to the page, the page would press the button. An Enter that has just
            # moved the focus to the button does not decide. One at the choice of persons, or at
            # the card, does, because the button says "press Enter".
            here = QApplication.focusWidget() in (self, self.answer.who.choice)
            if here and not event.isAutoRepeat():
                self.answer.button.click()
            return
        typing = isinstance(QApplication.focusWidget(), QLineEdit)
        plain = event.modifiers() == Qt.KeyboardModifier.NoModifier
        if not typing and plain and self.press_letter(event.text()):
            return
        super().keyPressEvent(event)
