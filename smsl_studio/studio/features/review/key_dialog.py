"""The dialog in which a person makes a key to sign with."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLineEdit, QVBoxLayout, QWidget

from smsl_studio.errors import StudioError
from smsl_studio.front.key_ring import make_key
from smsl_studio.inspection.approval.key_store import StoredKey
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import refusal_words

EXPLAINED = (
    "The key stays on this computer, encrypted with the passphrase. Nobody can bring a forgotten "
    "passphrase back. Name and role stand in every signature, so they are those of the person who "
    "signs."
)
DIFFER = "The two passphrases differ. Type them again."
EMPTY = "Name, role and passphrase are needed."


class KeyDialog(QDialog):
    """Makes a key for one person in one role. Passphrases are asked for here and are not kept."""

    made = Signal(object)
    """(StoredKey)"""

    def __init__(self, person: str, role: str, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowTitle("Make a key")
        self.setMinimumWidth(420)
        self._beside = Beside(self)
        self.person, self.role = _field("Name", person), _field("Role, such as surgeon", role)
        self.passphrase, self.again = _field("Passphrase"), _field("The same passphrase again")
        for field in (self.passphrase, self.again):
            field.setEchoMode(QLineEdit.EchoMode.Password)
        self.refusal = label("", "refusal")
        self.refusal.setMinimumHeight(20)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.make = self.buttons.addButton("Make the key", QDialogButtonBox.ButtonRole.AcceptRole)
        self.make.setDefault(True)
        self.buttons.accepted.connect(self._make)
        self.buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(10)
        fields = (self.person, self.role, self.passphrase, self.again)
        for part in (label(EXPLAINED, "hint"), *fields, self.refusal, self.buttons):
            column.addWidget(part)
        first = next((one for one in fields if not one.text()), self.passphrase)
        first.setFocus()

    def done(self, result: int) -> None:
        """Close, and forget the passphrases."""
        self.passphrase.clear()
        self.again.clear()
        self._beside.stop()
        super().done(result)

    def _make(self) -> None:
        person, role = self.person.text().strip(), self.role.text().strip()
        passphrase = self.passphrase.text()
        if not (person and role and passphrase):
            self.refusal.setText(EMPTY)
        elif passphrase != self.again.text():
            self.refusal.setText(DIFFER)
        else:
            self.make.setEnabled(False)
            self._beside.do(partial(_key, person, role, passphrase.encode()), self._came)

    def _came(self, came: StoredKey | StudioError) -> None:
        self.make.setEnabled(True)
        if isinstance(came, StudioError):
            self.refusal.setText(refusal_words(came))
            return
        self.made.emit(came)
        self.accept()


def _field(words: str, text: str = "") -> QLineEdit:
    field = QLineEdit(text)
    field.setPlaceholderText(words)
    field.setAccessibleName(words)
    field.setToolTip(tip_text(words))
    return field


def _key(person: str, role: str, passphrase: bytes) -> StoredKey | StudioError:
    try:
        return make_key(person, role, passphrase)
    except StudioError as error:
        return error
