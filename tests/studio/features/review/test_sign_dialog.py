"""The dialog for a signature: all warnings, what is met, and only what still stands in the file."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QWidget
from pytestqt.qtbot import QtBot

from smsl_studio.front import read
from smsl_studio.front.key_ring import make_key
from smsl_studio.front.signatures import ApprovalRequest, approve
from smsl_studio.studio.base.controls import Switch
from smsl_studio.studio.features.review.sign_dialog import SignDialog
from tests.approval import PASSPHRASE, make_keys_cheap

STATES = [f"S{number:03b}" for number in range(8)]


def chain(word: str) -> dict[str, Any]:
    """Seven steps with titles."""
    steps: dict[str, Any] = {
        state: {f"go{number}": STATES[number + 1]} for number, state in enumerate(STATES[:-1])
    }
    titles = {f"go{number}": {"title": f"{word} {number}"} for number in range(7)}
    header = {"INITIAL": STATES[0], "ACTIVATING": STATES[-1], "NUM_FACTS": 3}
    return {"DOOR": {"HEADER": header, "_operations": titles, **steps, STATES[-1]: {}}}


class Signer:
    """A person with a key and a blueprint, at the dialog."""

    def __init__(self, qtbot: QtBot, folder: Path) -> None:
        self._qtbot, self._parent, self.file = qtbot, QWidget(), folder / "chain.json"
        qtbot.addWidget(self._parent)
        self.write("Step")
        make_key("Ada", "engineer", PASSPHRASE.encode(), "ada")

    @property
    def record(self) -> Path:
        return Path(f"{self.file}.record.json")

    def write(self, word: str) -> None:
        self.file.write_text(json.dumps(chain(word)), "utf-8")

    def open(self, *conditions: str) -> SignDialog:
        dialog = SignDialog(read(self.file), "Ada", self._parent, False, conditions)
        dialog.open()
        return dialog

    def sign(self, dialog: SignDialog) -> None:
        """Type the passphrase, and wait for the answer."""
        QTest.keyClicks(dialog.passphrase, PASSPHRASE)
        QTest.mouseClick(dialog.sign, Qt.MouseButton.LeftButton)
        assert not dialog.sign.isEnabled()
        self._qtbot.waitUntil(
            lambda: dialog.sign.isEnabled() or not dialog.isVisible(), timeout=60_000
        )


@pytest.fixture
def signer(qtbot: QtBot, tmp_path: Path, home: Path, monkeypatch: pytest.MonkeyPatch) -> Signer:
    make_keys_cheap(monkeypatch)
    return Signer(qtbot, tmp_path)


def test_all_warnings_that_one_note_answers_are_listed(signer: Signer) -> None:
    approve(ApprovalRequest(read(signer.file), "ada", PASSPHRASE.encode()))
    signer.write("Other")
    dialog = signer.open()
    assert not dialog.warnings.isVisible()
    signer.sign(dialog)
    listed = dialog.warnings.toPlainText()
    assert dialog.warnings.isVisible()
    assert [f"go{number} " in listed for number in range(7)] == [True] * 7
    dialog.note.setPlainText("the words are better")
    signer.sign(dialog)
    assert not dialog.isVisible()


def test_a_file_that_has_changed_since_it_was_read_is_not_signed(signer: Signer) -> None:
    dialog = signer.open()
    signer.write("Other")
    signer.sign(dialog)
    assert "is not what was read" in dialog.refusal.text()
    assert not signer.record.exists()


def test_a_condition_is_a_switch_with_its_words_beside_it(signer: Signer) -> None:
    """A very long one makes the dialog no wider."""
    long = "the drill is calibrated, and the certificate lies here; " * 40
    unbroken = "W" * 3_000
    usual = signer.open("the hinge is oiled").width()
    dialog = signer.open("the hinge is oiled", long, unbroken)
    assert all(isinstance(one, Switch) for one in dialog.met)
    names = [one.accessibleName() for one in dialog.met]
    assert names == ["Met: the hinge is oiled", f"Met: {long}", f"Met: {unbroken}"]
    assert [one.property("condition") for one in dialog.met] == [
        "the hinge is oiled",
        long,
        unbroken,
    ]
    words = [one for one in dialog.findChildren(QLabel) if one.text().startswith("Met: ")]
    assert [one.toolTip() for one in words] == ["the hinge is oiled", long, unbroken]
    assert len(words[1].text()) < len(long)
    assert dialog.width() <= 2 * usual
