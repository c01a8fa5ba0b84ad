"""The dialog for the persons of this account: names, roles, PINs, and who works at this window."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QDialog,
    QFrame,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, label
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.theme import CONTROL
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.persons import Person, Persons
from smsl_studio.studio.running.pin import SHORTEST

ABOUT = (
    "Name and role go into the record of a run with every command and answer. A PIN keeps others "
    "at this window from answering as you; it is no signature."
)
NOBODY = (
    'Nobody is named here yet: the record says "a person". A task that is asked of a role, such as '
    "a nurse, is answered by persons who have it."
)

INSET = 84


class PinField(QLineEdit):
    """A password field for a PIN. A new PIN must be typed into two of them."""

    def __init__(self, words: str) -> None:
        super().__init__()
        self.setEchoMode(QLineEdit.EchoMode.Password)
        self.setPlaceholderText(words)
        self.setAccessibleName(plain_text(words))


class PersonRow(QWidget):
    """One person: whether they work here, name, role and PIN.

    The row of a person with a PIN is locked until the PIN is typed.
    """

    given = Signal(object, object)
    """(person before, person after): None after means that the person was removed."""
    chosen = Signal(object)

    def __init__(self, person: Person, mine: bool) -> None:
        super().__init__()
        self._person = person
        self.mine = QToolButton()
        self.mine.setText("You" if mine else "Work as")
        self.mine.setToolTip(tip_text(f"Commands of this window are those of {person.name}"))
        self.mine.setProperty("role", "tool")
        self.mine.setCheckable(True)
        self.mine.setChecked(mine)
        self.mine.setFixedSize(76, CONTROL)
        self.mine.clicked.connect(lambda: self.chosen.emit(person))
        self.name, self.role = _field("Name", person.name), _field("Role", person.role)
        self.pin_button = QPushButton("Unlock" if person.has_pin else "Set PIN")
        self.remove = QPushButton("Remove")
        for button in (self.pin_button, self.remove):
            button.setProperty("role", "row")
            button.setAutoDefault(False)
        self.refusal = Sentence("refusal", INSET)
        across = QHBoxLayout()
        across.setSpacing(8)
        for part, share in ((self.mine, 0), (self.name, 3), (self.role, 2),
                            (self.pin_button, 0), (self.remove, 0)):  # fmt: skip
            across.addWidget(part, share)
        self._pins = self._pin_part()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(8)
        column.addLayout(across)
        column.addWidget(self._pins)
        column.addWidget(self.refusal)
        self.name.editingFinished.connect(self._typed)
        self.role.editingFinished.connect(self._typed)
        self.pin_button.clicked.connect(self._open_pin)
        self.remove.clicked.connect(lambda: self.given.emit(person, None))
        self._lock(person.has_pin)

    def _pin_part(self) -> QWidget:
        part = QWidget()
        across = QHBoxLayout(part)
        across.setContentsMargins(INSET, 0, 0, 0)
        across.setSpacing(8)
        self.old, self.new, self.again = map(PinField, ("PIN", "New PIN", "Again"))
        self.old.returnPressed.connect(self._unlock)
        self.new.returnPressed.connect(self.again.setFocus)
        self.again.returnPressed.connect(lambda: self._keep_pin())
        keep = QPushButton("Keep")
        keep.setToolTip("Leave both fields empty to remove the PIN")
        keep.setProperty("role", "row")
        keep.setAutoDefault(False)
        keep.clicked.connect(lambda: self._keep_pin())
        for widget in (self.old, self.new, self.again, keep):
            across.addWidget(widget)
        self.keep = keep
        part.hide()
        return part

    def _lock(self, locked: bool) -> None:
        """Lock or unlock the whole row.

        If only answers were guarded, anybody could remove the person and with it the PIN.
        """
        for part in (self.mine, self.name, self.role, self.remove):
            part.setEnabled(not locked)
        self.mine.setEnabled(not locked or self.mine.isChecked())
        for field in (self.new, self.again, self.keep):
            field.setVisible(not locked)
        self.old.setVisible(locked)

    def _open_pin(self) -> None:
        self._pins.setVisible(True)
        (self.new if self.old.isHidden() else self.old).setFocus()

    def _unlock(self) -> None:
        fits = self._person.opens_with(self.old.text())
        self.refusal.say("" if fits else "This is not the PIN. Type it again.")
        if fits:
            self._lock(False)
            self.new.setFocus()

    def settle(self) -> bool:
        """Take over what is typed; returns whether nothing is left, else the reason is shown."""
        if self.new.text() or self.again.text():
            return self._keep_pin()
        self._typed()
        return True

    def _keep_pin(self) -> bool:
        pin = self.new.text()
        if pin != self.again.text():
            self.refusal.say("The two new PINs differ. Type them again.")
        elif pin and len(pin) < SHORTEST:
            self.refusal.say(f"A PIN has {SHORTEST} characters or more. Type a longer one.")
        else:
            self.given.emit(self._person, self._person.with_pin(pin))
            return True
        return False

    def _typed(self) -> None:
        name, role = " ".join(self.name.text().split()), " ".join(self.role.text().split())
        if (name, role) != (self._person.name, self._person.role):
            self.given.emit(self._person, replace(self._person, name=name, role=role))


class PersonsDialog(QDialog):
    """The dialog. Every change takes effect at once, and closing it takes over what is typed.

    If that is not possible, the dialog says why and stays. Closing it once more, with the same
    text, leaves the text.
    """

    def __init__(self, persons: Persons, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._persons = persons
        self._told: tuple[str, ...] = ()
        self.setWindowTitle("Persons")
        self.setMinimumSize(560, 380)
        open_at(self, 560, 380)
        about = label(ABOUT, "hint")
        inner = QWidget()
        inner.setObjectName("persons")
        self._rows = QVBoxLayout(inner)
        self._rows.setContentsMargins(0, 0, 8, 0)
        self._rows.setSpacing(8)
        self.nobody = label(NOBODY, "hint")
        self._rows.addWidget(self.nobody)
        self._rows.addStretch(1)
        area = QScrollArea()
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setWidget(inner)
        self.rows: list[PersonRow] = []
        self.new_name, self.new_role = _field("Name", ""), _field("Role, such as surgeon", "")
        self.add = QPushButton("Add")
        self.add.setAutoDefault(False)
        self.add.clicked.connect(self._add)
        self.new_name.returnPressed.connect(self.new_role.setFocus)
        self.new_role.returnPressed.connect(self._add)
        self.refusal = Sentence("refusal")
        across = QHBoxLayout()
        across.setSpacing(8)
        across.addWidget(self.new_name, 3)
        across.addWidget(self.new_role, 2)
        across.addWidget(self.add)
        done = QPushButton("Close")
        done.setAutoDefault(False)
        done.clicked.connect(self.accept)
        column = QVBoxLayout(self)
        column.setContentsMargins(16, 16, 16, 16)
        column.setSpacing(12)
        column.addWidget(about)
        column.addWidget(area, 1)
        column.addLayout(across)
        column.addWidget(self.refusal)
        column.addWidget(done, 0, Qt.AlignmentFlag.AlignRight)
        self._rebuild()
        self.new_name.setFocus()

    def done(self, result: int) -> None:
        """Close, unless something typed could be lost that the person has not been told of."""
        if not self._settle() and self._told != self._texts:
            self._told = self._texts
            return
        super().done(result)

    @property
    def _texts(self) -> tuple[str, ...]:
        """What is typed and taken over nowhere."""
        fields: list[QLineEdit] = [self.new_name, self.new_role]
        for row in self.rows:
            fields += [row.name, row.role, row.new, row.again]
        return tuple(field.text() for field in fields)

    def _settle(self) -> bool:
        """Take over what is typed; returns whether nothing is left."""
        self.refusal.say("")
        for row in self.rows:
            if not row.settle() or self.refusal.text():
                return False
        if self.new_name.text().strip() or self.new_role.text().strip():
            self._add()
        return not self.refusal.text()

    def _rebuild(self) -> None:
        for row in self.rows:
            self._rows.removeWidget(row)
            row.hide()
            row.deleteLater()
        self.nobody.setVisible(not self._persons.all)
        me = self._persons.me
        self.rows = [PersonRow(person, person == me) for person in self._persons.all]
        for row in self.rows:
            self._rows.insertWidget(self._rows.count() - 1, row)
            row.given.connect(self._give)
            row.chosen.connect(self._choose)

    def _choose(self, person: Person) -> None:
        self._persons.choose(person)
        self._rebuild()

    def _give(self, before: Person, after: Person | None) -> None:
        if after is None:
            self._persons.remove(before)
        elif not self._fits(after, before):
            return
        else:
            self._persons.put(after, instead=before)
        self._rebuild()

    def _add(self) -> None:
        name, role = (" ".join(one.text().split()) for one in (self.new_name, self.new_role))
        if self._fits(Person(name, role), None):
            self._persons.put(Person(name, role))
            self.new_name.clear()
            self.new_role.clear()
            self.new_name.setFocus()
            self._rebuild()

    def _fits(self, person: Person, before: Person | None) -> bool:
        other = self._persons.named(person.name)
        said = ""
        if not person.name:
            said = "A person has a name. Type one."
        elif other is not None and other != before:
            said = f"There is a person {other.name} already. Add what tells them apart."
        self.refusal.say(said)
        return not said


def _field(words: str, text: str) -> Field:
    field = Field()
    field.settle(text)
    field.setPlaceholderText(words)
    field.setAccessibleName(plain_text(words))
    return field
