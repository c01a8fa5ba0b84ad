"""Who answers: a choice among the persons of this account, and a field for the PIN."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QHBoxLayout, QLineEdit, QWidget

from smsl_studio.studio.base.controls import Combo, label
from smsl_studio.studio.base.theme import CONTROL
from smsl_studio.studio.running.persons import SOMEBODY, Person, Persons

NOBODY = "Choose who you are"
MORE = "Persons…"


class PersonChoice(Combo):
    """The list of persons. Letters and digits select nobody here.

    In a usual combo box a letter selects the next entry that begins with it. Here the letter may be
    an answer or a command of Supervise, so a wrong person would be selected unnoticed.
    """

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Pass letters and digits on to the widget around it, unless the list is open."""
        text = event.text()
        if text.isprintable() and text.strip() and not self.view().isVisible():
            event.ignore()
            return
        super().keyPressEvent(event)


class Who(QWidget):
    """The choice of the person who answers."""

    changed = Signal()
    edit_wanted = Signal()
    """The person wants to edit the persons of this account."""

    def __init__(self, persons: Persons) -> None:
        super().__init__()
        self._persons = persons
        self._person: Person | None = persons.me
        self._open = False
        self.choice = PersonChoice()
        self.choice.setAccessibleName("Answer as")
        self.choice.setToolTip("Who answers; the record of the run has the name and the role")
        self.pin = QLineEdit()
        self.pin.setEchoMode(QLineEdit.EchoMode.Password)
        self.pin.setPlaceholderText("Your PIN")
        self.pin.setAccessibleName("Your PIN")
        self.pin.setFixedSize(104, CONTROL)
        self.pin.setToolTip("It keeps others at this window from answering as you")
        across = QHBoxLayout(self)
        across.setContentsMargins(0, 0, 0, 0)
        across.setSpacing(8)
        across.addWidget(label("Answer as", "small"))
        across.addWidget(self.choice, 1)
        across.addWidget(self.pin)
        self.choice.activated.connect(self._chosen)
        self.pin.textChanged.connect(self._typed)
        persons.changed.connect(self._refill)
        self._refill()

    @property
    def person(self) -> Person | None:
        """The chosen person; None until somebody says who they are."""
        return self._person

    def opens(self) -> bool:
        """Whether the chosen person may answer: the PIN is right, or none is needed."""
        return self._open

    @property
    def has_pin(self) -> bool:
        """Whether the chosen person needs a PIN."""
        return self._person is not None and self._person.has_pin

    def ask_again(self) -> None:
        """Clear the choice, because another person must answer next."""
        self._person = None
        self._refill()

    def start_with_me(self) -> None:
        """Choose the person who works at this window, for another task."""
        self._person = self._persons.me
        self._refill()

    def _refill(self) -> None:
        known = self._persons.all or (SOMEBODY,)
        if self._person is not None:
            # Who was nobody and enters a name now is that person, and need not say so again.
            nameless = self._person == SOMEBODY
            self._person = self._persons.me if nameless else self._persons.named(self._person.name)
            if self._person is None and known == (SOMEBODY,):
                self._person = SOMEBODY
        elif not self._persons.all:
            known = ()
        entries: list[tuple[str, Person | str]] = [(one.words, one) for one in known]
        if self._person is None:
            entries.insert(0, (NOBODY, ""))
        self.choice.clear()
        for words, entry in (*entries, (MORE, MORE)):
            self.choice.addItem(words, entry)
        at = next((i for i, (_, one) in enumerate(entries) if one == self._person), 0)
        self.choice.setCurrentIndex(at)
        self._show_pin()
        self.changed.emit()

    def _chosen(self, at: int) -> None:
        entry = self.choice.itemData(at)
        if entry == MORE:
            self._refill()
            self.edit_wanted.emit()
        elif isinstance(entry, Person):
            self._person = entry
            self._refill()

    def _show_pin(self) -> None:
        self.pin.clear()
        self.pin.setVisible(self.has_pin)
        self._look()

    def _typed(self) -> None:
        self._look()
        self.changed.emit()

    def _look(self) -> None:
        """Check the PIN once for each change, because checking the hash is slow."""
        self._open = self._person is not None and self._person.opens_with(self.pin.text())
