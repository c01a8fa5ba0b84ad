"""The dialog in which a person signs: the key, the passphrase, and what the signature means."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QLineEdit,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ApprovalRefused, StudioError
from smsl_studio.front.signatures import ApprovalRequest, SignedApproval, approve, open_warnings
from smsl_studio.inspection.approval.key_store import StoredKey, stored_keys
from smsl_studio.inspection.approval.known_keys import name_of
from smsl_studio.inspection.approval.statement import APPROVED, CONDITIONS, MEANINGS, REJECTED
from smsl_studio.inspection.review.review_file import LONGEST
from smsl_studio.legible import plain_text, whole_text
from smsl_studio.smsl.files import read_content
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.controls import Combo, Switch, label, row, row_button
from smsl_studio.studio.base.room import Room
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import brief, capital
from smsl_studio.studio.features.review.key_dialog import KeyDialog

NO_KEY = "You have no key yet. New key… makes one."
WARNS = "The check warns. Write why all this may stay, and type the passphrase again."
CHANGED = "Close this dialog, and read what has changed before you sign."
BUSY = "The whole check runs, and then it is signed."
KINDS = (
    "It must be met before a run starts. Somebody of your role signs later that it is met.\n"
    "Asked by the program when a run starts: world = NAME, supervisor present,\n"
    "sensor SB/DIGIT at N Hz, until DATE."
)


class SignDialog(QDialog):
    """Signs the blueprint as it stands in the file. The passphrase is asked for here and is not
    kept."""

    signed = Signal(object)
    """SignedApproval: the record was written."""

    def __init__(
        self,
        blueprint: Blueprint,
        person: str,
        parent: QWidget,
        rejects: bool = False,
        open_conditions: Sequence[str] = (),
        role: str = "",
    ) -> None:
        """``open_conditions`` are those of the last records that a person may sign as met. ``role``
        is that of the person, for a new key."""
        super().__init__(parent)
        self._blueprint, self._rejects = blueprint, rejects
        self._person, self._role = person, role
        self.making: KeyDialog | None = None
        self.new_key = row_button("New key…", "Make a key to sign with, for a name and a role")
        self.new_key.setAutoDefault(False)
        self.new_key.clicked.connect(self._ask_key)
        self._beside = Beside(self)
        self.setWindowTitle("Reject this procedure" if rejects else "Sign this procedure")
        self.setMinimumWidth(460)
        self.key = Combo()
        self.key.setAccessibleName("Key")
        self._fill_keys()
        self.passphrase = QLineEdit()
        self.passphrase.setEchoMode(QLineEdit.EchoMode.Password)
        self.passphrase.setAccessibleName("Passphrase")
        self.passphrase.setPlaceholderText("Passphrase of the key")
        self.warnings = _field("Warnings of the check", 132)
        self.warnings.setReadOnly(True)
        self.note = _field("Why the warnings may stay", 72)
        self.warnings.hide()
        self.note.hide()
        self.met = [_met(text) for text in (() if rejects else open_conditions)]
        self.conditions = _field("Conditions, one a line; empty if there are none", 52)
        self.conditions.setToolTip(KINDS)
        self.conditions.setVisible(not rejects)
        self.conditions.textChanged.connect(self._show_meaning)
        self.refusal = label("", "refusal")
        self.meaning = label(MEANINGS[REJECTED if rejects else APPROVED], "")
        self.meaning.setWordWrap(True)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        verb = "Sign the rejection" if rejects else "Sign"
        self.sign = self.buttons.addButton(verb, QDialogButtonBox.ButtonRole.AcceptRole)
        self.sign.setDefault(True)
        self.buttons.accepted.connect(self._sign)
        self.buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setContentsMargins(20, 16, 20, 16)
        column.setSpacing(10)
        column.addWidget(self.meaning)
        column.addLayout(row(label("Key", "second"), None, self.new_key))
        parts: tuple[QWidget, ...] = (self.key, label("Passphrase", "second"), self.passphrase)
        met = (Room(_met_lines(self.met)),) if self.met else ()
        told = self.refusal, self.warnings, self.note
        for part in (*parts, *met, self.conditions, *told, self.buttons):
            column.addWidget(part)
        self._show_keys()

    def done(self, result: int) -> None:
        """Close, and forget the passphrase."""
        self.passphrase.clear()
        self._beside.stop()
        super().done(result)

    def _fill_keys(self) -> None:
        self.key.clear()
        for key in _keys(self._person):
            self.key.addItem(plain_text(f"{key.person}, {key.role} ({key.id})"), key.id)

    def _show_keys(self) -> None:
        """Let a person sign who has a key, and say what to do without one."""
        there = self.key.count() > 0
        self.refusal.setText("" if there else NO_KEY)
        for part in (self.key, self.passphrase, self.sign):
            part.setEnabled(there)
        (self.passphrase if there else self.new_key).setFocus()

    def _ask_key(self) -> None:
        """Ask for a new key, and choose it."""
        self.making = KeyDialog(self._person, self._role, self)
        self.making.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.making.made.connect(self._take_key)
        self.making.open()

    def _take_key(self, key: StoredKey) -> None:
        self._fill_keys()
        self.key.setCurrentIndex(max(0, self.key.findData(key.id)))
        self._show_keys()

    @property
    def _written(self) -> tuple[str, ...]:
        """The conditions that are written; none for a rejection."""
        lines = () if self._rejects else self.conditions.toPlainText().splitlines()
        return tuple(dict.fromkeys(line.strip() for line in lines if line.strip()))

    @property
    def _verdict(self) -> str:
        return REJECTED if self._rejects else CONDITIONS if self._written else APPROVED

    def _show_meaning(self) -> None:
        self.meaning.setText(MEANINGS[self._verdict])

    def _sign(self) -> None:
        request = ApprovalRequest(
            self._blueprint,
            self.key.currentData(),
            self.passphrase.text().encode(),
            verdict=self._verdict,
            conditions=self._written,
            met=tuple(one.property("condition") for one in self.met if one.isChecked()),
        )
        self.passphrase.clear()
        self._show_busy(True)
        note = self.note.toPlainText().strip()
        self._beside.do(partial(_signed, request, note), self._came)

    def _came(self, came: SignedApproval | StudioError) -> None:
        self._show_busy(False)
        if isinstance(came, StudioError):
            self._refuse(came)
            return
        self.signed.emit(came)
        self.accept()

    def _refuse(self, error: StudioError) -> None:
        warns = "has no disposition" in error.sentence
        self.warnings.setVisible(warns)
        if warns:
            self.refusal.setText(WARNS)
            self.warnings.setPlainText(whole_text(error.sentence))
            self.note.show()
        else:
            self.refusal.setText(f"{capital(error.sentence)}. {error.advice}".strip())
        (self.note if warns and not self.note.toPlainText() else self.passphrase).setFocus()
        self.adjustSize()

    def _show_busy(self, busy: bool) -> None:
        self.refusal.setText(BUSY if busy else "")
        for part in (self.key, self.passphrase, self.conditions, *self.met, self.sign):
            part.setEnabled(not busy)
        # While the button was off, Qt gave its part as the default one to Cancel.
        self.sign.setDefault(True)


def _field(name: str, height: int) -> QPlainTextEdit:
    field = QPlainTextEdit()
    field.setProperty("role", "field")
    field.setAccessibleName(name)
    field.setPlaceholderText(name)
    field.setTabChangesFocus(True)
    field.setFixedHeight(height)
    return field


def _met(condition: str) -> Switch:
    """A switch that says that a condition is met. It keeps the exact text, which is signed."""
    switch = Switch()
    switch.setAccessibleName(plain_text(f"Met: {condition}"))
    switch.setProperty("condition", condition)
    return switch


def _met_lines(switches: Sequence[Switch]) -> QWidget:
    """The switches, each with its words beside it; the tool tip has the whole condition."""
    lines = QWidget()
    column = QVBoxLayout(lines)
    column.setContentsMargins(0, 0, 0, 0)
    for switch in switches:
        condition = switch.property("condition")
        words = label(brief(plain_text(f"Met: {condition}")), "")
        words.setWordWrap(True)
        for part in (switch, words):
            part.setToolTip(tip_text(condition))
        line = row(switch, words, spacing=10)
        line.setStretch(1, 1)
        column.addLayout(line)
    return lines


def _signed(request: ApprovalRequest, note: str) -> SignedApproval | StudioError:
    try:
        _refuse_changed(request.blueprint)
        if note:
            warned = open_warnings(request)
            said = tuple(f"{one.rule}@{one.address}={note[:LONGEST]}" for one in warned)
            request = replace(request, dispositions=said)
        return approve(request)
    except StudioError as error:
        return error


def _refuse_changed(blueprint: Blueprint) -> None:
    """Raise ApprovalRefused if a file has changed since it was read, ReadError if it is gone."""
    for document in blueprint.documents:
        if read_content(document.file).raw != document.encoded():
            raise ApprovalRefused(f"{document.file} is not what was read", advice=CHANGED)


def _keys(person: str) -> list[StoredKey]:
    """The keys with which somebody here can sign, those of this person first."""
    keys = [key for key in stored_keys().values() if key.box is not None and not key.revoked]
    keys = [key for key in keys if not key.known.is_automatic]
    return sorted(keys, key=lambda key: (name_of(key.person) != name_of(person), key.id))
