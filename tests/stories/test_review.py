"""Review: two people on two computers read, ask, answer, change, read again, sign and run."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog

from smsl_studio.front import read
from smsl_studio.front.key_ring import make_key
from smsl_studio.front.reviews import keep_answers, review_of
from smsl_studio.front.verdicts import verify_approval
from smsl_studio.inspection.review.entry import COMMENT
from smsl_studio.studio.features.people.persons_dialog import PersonsDialog
from smsl_studio.studio.features.review.comment_dialog import CommentDialog
from smsl_studio.studio.features.review.comment_view import CommentView
from smsl_studio.studio.features.review.feature import CHANGED, ReviewFeature
from smsl_studio.studio.features.review.page import ReviewPage
from smsl_studio.studio.running.persons import Person as Somebody
from tests.approval import make_keys_cheap
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

DOOR: dict[str, Any] = {
    "_hazards": [{"name": "Open at the end", "facts": {"DOOR/0": "1", "DOOR/1": "1"}}],
    "DOOR": {
        "HEADER": {"INITIAL": "S00", "ACTIVATING": "S11", "NUM_FACTS": 2},
        "_facts": {
            "0": {"name": "Door", "values": {"0": "shut", "1": "open"}},
            "1": {"name": "Lamp", "values": {"0": "off", "1": "on"}},
        },
        "_states": {"S00": {"title": "Closed"}, "S11": {"title": "Ready"}},
        "_operations": {
            "open": {"title": "Open the door"},
            "light": {"title": "Light the lamp"},
        },
        "S00": {"open": "S10"},
        "S10": {"light": "S11"},
        "S11": {},
    },
}
SURGEON, ENGINEER = Somebody("M. Reyes", "surgeon"), Somebody("J. Lindqvist", "engineer")
PASSPHRASE = b"correct horse"


def door_at(folder: Path, hazards: bool = False) -> Path:
    folder.mkdir(exist_ok=True)
    values = {key: one for key, one in DOOR.items() if hazards or key != "_hazards"}
    file = folder / "door.json"
    file.write_text(json.dumps(values, indent=1), "utf-8")
    return file


class Reader:
    """A person in Review, with the keyboard alone."""

    def __init__(self, person: Person) -> None:
        self.person = person

    @property
    def feature(self) -> ReviewFeature:
        return self.person.window.features.review

    @property
    def page(self) -> ReviewPage:
        return self.feature.page

    def enter(self) -> None:
        self.person.ctrl(Qt.Key.Key_4)
        self.wait_for_the_reading()
        self.person.press(Qt.Key.Key_Up)

    def wait_for_the_reading(self) -> None:
        self.person.qtbot.waitUntil(lambda: self.feature.review.seen is not None, timeout=60_000)

    def answer_all(self) -> None:
        """Approve every line, an open point with a note."""
        seen = self.feature.review.seen
        assert seen is not None
        for _ in range(3 * len(seen.lines)):
            self.person.press(Qt.Key.Key_Right)
            line = self.page.line
            assert line is not None
            if line.is_answered:
                return
            self.person.press(Qt.Key.Key_Y)
            if line.line.open_point:
                self.write("It is watched by the nurse.")
        raise AssertionError("there is always another open line")

    def write(self, text: str) -> None:
        QTest.keyClicks(self.person._focus(), text)
        self.person.ctrl(Qt.Key.Key_Return)

    def go_to(self, heading: str) -> None:
        seen = self.feature.review.seen
        assert seen is not None
        for _ in range(len(seen.lines)):
            line = self.page.line
            assert line is not None
            if line.line.heading == heading:
                return
            self.person.press(Qt.Key.Key_Down)
        raise AssertionError(heading)

    def sign(self, conditions: str = "", met: str = "") -> None:
        self.person.click(self.page.side.sign)
        dialog = self.feature.signing
        assert dialog is not None
        self.person.qtbot.waitUntil(dialog.isVisible)
        for line in conditions.splitlines():
            QTest.keyClicks(dialog.conditions, line)
            QTest.keyClick(dialog.conditions, Qt.Key.Key_Return)
        assert not conditions or "if the conditions are met" in dialog.meaning.text()
        for switch in dialog.met if met else ():
            assert switch.accessibleName() == f"Met: {met}"
            QTest.keyClick(switch, Qt.Key.Key_Space)
            assert switch.isChecked()
        QTest.keyClicks(dialog.passphrase, PASSPHRASE.decode())
        QTest.keyClick(dialog.passphrase, Qt.Key.Key_Return)
        self.person.qtbot.waitUntil(lambda: not dialog.isVisible(), timeout=120_000)
        self.person.come_back()
        review = self.feature.review
        self.person.qtbot.waitUntil(lambda: not review.is_making, timeout=60_000)


def sit_as(sit: Sit, who: Somebody, file: Path) -> Reader:
    person = sit(file)
    if person.windows.persons.named(who.name) is None:
        person.windows.persons.put(who)
    person.windows.persons.choose(who)
    return Reader(person)


def test_two_people_review_ask_answer_change_review_again_sign_and_run(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    theirs, mine = door_at(tmp_path / "surgeon"), door_at(tmp_path / "engineer")
    key = make_key(SURGEON.name, SURGEON.role, PASSPHRASE)

    # The surgeon reads and asks.
    surgeon = sit_as(sit, SURGEON, theirs)
    surgeon.enter()
    assert not surgeon.page.side.sign.isEnabled()
    surgeon.answer_all()
    assert surgeon.page.side.sign.isEnabled()
    surgeon.go_to("Light the lamp")
    surgeon.person.press(Qt.Key.Key_C)
    surgeon.write("Who sees that it is lit?")
    assert not surgeon.page.side.sign.isEnabled()
    assert "1 comment is open, of M. Reyes." in surgeon.page.side.why.text()
    assert theirs.read_text("utf-8") == mine.read_text("utf-8")

    # The engineer, on another computer, gets the answers and finds the question in Draw.
    shutil.copy(f"{theirs}.review.json", f"{mine}.review.json")
    engineer = sit_as(sit, ENGINEER, mine)
    findings = engineer.person.window.findings
    engineer.person.qtbot.waitUntil(
        lambda: any(one.rule == "ask" for one in findings.findings), timeout=30_000
    )
    engineer.person.click_row(findings.list, "Who sees that it is lit?")
    dialog = engineer.person.window.findChild(CommentDialog)
    assert dialog is not None
    engineer.person.qtbot.waitUntil(dialog.isVisible)
    QTest.keyClicks(dialog.field.text, "The nurse sees it.")
    QTest.keyClick(dialog.field.text, Qt.Key.Key_Return, Qt.KeyboardModifier.ControlModifier)
    assert "(answered)" in str(engineer.person.row(findings.list, "Who sees").data())

    # The engineer also changes the step.
    values = json.loads(mine.read_text("utf-8"))
    values["DOOR"]["_operations"]["light"]["title"] = "Light the lamp, seen by the nurse"
    mine.write_text(json.dumps(values, indent=1), "utf-8")
    shutil.copy(mine, theirs)
    keep_answers(str(theirs), review_of(str(mine)).entries)

    # The surgeon reads again: the changed line has no answer, and its comment went along.
    again = sit_as(sit, SURGEON, theirs)
    again.enter()
    again.go_to("Light the lamp, seen by the nurse")
    line = again.page.line
    assert line is not None
    assert line.approval is None
    (comment,) = line.open_comments
    assert [one.text for one in comment.replies] == ["The nurse sees it."]
    again.answer_all()
    assert not again.feature.review.review.open_comments
    again.sign()
    verdict = verify_approval(read(str(theirs)))
    assert (verdict.verdict, verdict.signers[0].key.person) == ("approved", key.person)

    # What was signed runs: a step is played beside the text.
    again.go_to("Open the door")
    again.person.press(Qt.Key.Key_W)
    run = again.person.window.features.run.pane.run
    again.person.qtbot.waitUntil(lambda: run.status is not None and not run.exists, timeout=120_000)
    assert run.status is not None
    assert run.status.configuration["DOOR"] == "S10"


def test_the_keys_of_the_page_lead_through_all_lines_and_change_the_text(
    sit: Sit, tmp_path: Path
) -> None:
    reader = sit_as(sit, SURGEON, door_at(tmp_path, hazards=True))
    reader.enter()
    seen = reader.feature.review.seen
    assert seen is not None
    first = reader.page.line
    visited = {reader.page.reading.at}
    for _ in seen.lines:
        reader.person.press(Qt.Key.Key_Down)
        visited.add(reader.page.reading.at)
    assert visited == {one.line.key for one in seen.lines}
    for _ in seen.lines:
        reader.person.press(Qt.Key.Key_Up)
    assert reader.page.line == first
    for key, size in ((Qt.Key.Key_Plus, 1.25), (Qt.Key.Key_Minus, 1.0)):
        reader.person.ctrl(key)
        assert reader.page.reading.size_factor == size
    # An open point asks for a note, and Escape leaves it.
    hazards = [one for one in seen.lines if one.section.key == "hazards"]
    assert [one.line.open_point for one in hazards] == [True]
    reader.go_to(hazards[0].line.heading)
    reader.person.press(Qt.Key.Key_Y)
    card = reader.page.reading.card(reader.page.reading.at)
    assert card is not None
    assert card.field is not None
    reader.person.press(Qt.Key.Key_Escape)
    assert card.field is None
    assert reader.page.line == hazards[0]
    assert not review_of(str(tmp_path / "door.json")).entries


def test_an_undo_takes_the_approval_back(sit: Sit, tmp_path: Path) -> None:
    file = door_at(tmp_path)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.go_to("Open the door")
    for approved in (True, False):
        reader.person.press(Qt.Key.Key_Y)
        line = reader.page.line
        assert line is not None
        assert (line.approval is not None) == approved
        # The keyboard stays at the line.
        card = reader.page.reading.card(line.line.key)
        assert card is not None
        assert QApplication.focusWidget() is card
    assert len(review_of(str(file)).entries) == 2


def test_nothing_to_review_is_said(sit: Sit) -> None:
    person = sit()
    person.ctrl(Qt.Key.Key_4)
    page = person.window.features.review.page
    assert "Nothing to review yet" in page.reading.hint.text()
    assert page.reading.hint.isVisible()
    assert not page.side.sign.isEnabled()
    person.press(Qt.Key.Key_Y)
    person.press(Qt.Key.Key_C)


def test_errors_are_told_before_somebody_reads_all_lines(sit: Sit, tmp_path: Path) -> None:
    text = (SAMPLES / "hanoi-corrected.json").read_text("utf-8")
    broken = tmp_path / "broken.json"
    broken.write_text(text.replace('"Op_1b": "State_baa"', '"Op_1b": "State_nowhere"', 1), "utf-8")
    person = sit(broken)
    person.until_inspected()
    person.ctrl(Qt.Key.Key_4)
    side = person.window.features.review.page.side
    person.until(lambda: "approval. Findings in Draw" in side.why.text())
    assert not side.sign.isEnabled()
    fixed = person.blueprint.document.text.replace("State_nowhere", "State_baa")
    person.window.session.write("Type", fixed)
    person.until(lambda: "Findings in Draw" not in side.why.text())


def test_a_file_of_answers_that_is_no_review_is_told_and_kept(sit: Sit, tmp_path: Path) -> None:
    file = door_at(tmp_path)
    answers = Path(f"{file}.review.json")
    answers.write_text("{}", "utf-8")
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.person.press(Qt.Key.Key_Y)
    assert answers.read_text("utf-8") == "{}"
    assert "not of the form" in reader.page.side.why.text()
    assert not reader.page.side.sign.isEnabled()


def test_answers_of_another_computer_are_added(sit: Sit, tmp_path: Path) -> None:
    theirs, mine = door_at(tmp_path / "theirs"), door_at(tmp_path / "mine")
    reader = sit_as(sit, SURGEON, theirs)
    reader.enter()
    reader.person.press(Qt.Key.Key_C)
    reader.write("What is this for?")
    other = sit_as(sit, ENGINEER, mine)
    other.feature.add_from(f"{theirs}.review.json")
    assert "1 answer added" in other.person.window.toast.words
    assert [one.kind for one in review_of(str(mine)).entries] == [COMMENT]


def test_who_has_no_key_makes_one_in_the_dialog_and_signs_with_it(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_keys_cheap(monkeypatch)
    reader = sit_as(sit, SURGEON, door_at(tmp_path))
    reader.enter()
    reader.feature.sign(rejects=True)
    dialog, person = reader.feature.signing, reader.person
    assert dialog is not None
    assert not dialog.sign.isEnabled()
    person.click(dialog.new_key)
    making = dialog.making
    assert making is not None
    assert (making.person.text(), making.role.text()) == (SURGEON.name, SURGEON.role)
    words = PASSPHRASE.decode()
    QTest.keyClicks(making.passphrase, words)
    QTest.keyClicks(making.again, f"{words}!")
    person.click(making.make)
    assert "differ" in making.refusal.text()
    making.again.clear()
    QTest.keyClicks(making.again, words)
    person.click(making.make)
    person.until(lambda: dialog.sign.isEnabled())
    assert dialog.key.currentText() == "M. Reyes, surgeon (m-reyes-surgeon)"
    QTest.keyClicks(dialog.passphrase, words)
    QTest.keyClick(dialog.passphrase, Qt.Key.Key_Return)
    person.qtbot.waitUntil(lambda: not dialog.isVisible(), timeout=120_000)
    verdict = verify_approval(read(str(tmp_path / "door.json")))
    assert verdict.signers[0].key.person == SURGEON.name


def test_a_condition_is_set_with_the_signature_and_met_with_the_next_one(
    sit: Sit, tmp_path: Path
) -> None:
    file = door_at(tmp_path)
    make_key(SURGEON.name, SURGEON.role, PASSPHRASE)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.answer_all()
    reader.sign(conditions="the hinge is oiled\n\n world = table \n")
    told = verify_approval(read(str(file)))
    assert (told.verdict, len(told.refusals)) == ("conditions", 2)
    badge = reader.person.window.features.approval.badge
    reader.person.until(lambda: badge.text() == "Approved with conditions")
    reader.sign(met="the hinge is oiled")
    (still,) = verify_approval(read(str(file))).refusals
    assert "world = table" in still.sentence, "only a run can tell that"
    assert verify_approval(read(str(file)), world="table").signers[0].said.met == [
        "the hinge is oiled"
    ]


def test_the_keys_go_to_the_line_again_after_the_persons_were_chosen(
    sit: Sit, tmp_path: Path
) -> None:
    reader = sit_as(sit, SURGEON, door_at(tmp_path))
    reader.enter()
    reader.person.click(reader.page.bar.change)
    dialog = reader.person.window.findChild(PersonsDialog)
    assert dialog is not None
    reader.person.qtbot.waitUntil(dialog.isVisible)
    dialog.accept()
    reader.person.come_back()
    reader.person.press(Qt.Key.Key_Y)
    line = reader.page.line
    assert line is not None
    assert line.is_answered


def test_a_rejection_has_no_conditions(sit: Sit, tmp_path: Path) -> None:
    file = door_at(tmp_path)
    make_key(SURGEON.name, SURGEON.role, PASSPHRASE)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.feature.sign(rejects=True)
    dialog = reader.feature.signing
    assert dialog is not None
    reader.person.qtbot.waitUntil(dialog.isVisible)
    assert not dialog.conditions.isVisible()
    dialog.reject()


def test_a_wrong_passphrase_signs_nothing(sit: Sit, tmp_path: Path) -> None:
    file = door_at(tmp_path)
    make_key(SURGEON.name, SURGEON.role, PASSPHRASE)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.answer_all()
    reader.person.click(reader.page.side.sign)
    dialog = reader.feature.signing
    assert dialog is not None
    QTest.keyClicks(dialog.passphrase, "wrong")
    QTest.keyClick(dialog.passphrase, Qt.Key.Key_Return)
    reader.person.qtbot.waitUntil(lambda: dialog.sign.isEnabled(), timeout=60_000)
    assert dialog.refusal.text()
    assert not dialog.passphrase.text()
    assert not Path(f"{file}.record.json").exists()
    dialog.reject()
    assert isinstance(dialog, QDialog)


def test_the_dialog_for_a_signature_closes_when_the_procedure_changes(
    sit: Sit, tmp_path: Path
) -> None:
    """What would be signed is no longer what the window shows."""
    file = door_at(tmp_path)
    make_key(SURGEON.name, SURGEON.role, PASSPHRASE)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.feature.sign(rejects=True)
    dialog, window = reader.feature.signing, reader.person.window
    assert dialog is not None
    reader.person.qtbot.waitUntil(dialog.isVisible)
    file.write_text(file.read_text("utf-8").replace("Open the door", "Break the door"), "utf-8")
    reader.person.qtbot.waitUntil(lambda: not dialog.isVisible(), timeout=30_000)
    reader.person.qtbot.waitUntil(lambda: window.toast.words.startswith(CHANGED))
    assert window.toast.isVisible()
    assert not Path(f"{file}.record.json").exists()


def test_a_comment_on_a_line_that_is_gone_is_shown_and_can_be_closed(
    sit: Sit, tmp_path: Path
) -> None:
    file = door_at(tmp_path)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.go_to("Lamp")
    reader.person.press(Qt.Key.Key_C)
    reader.write("Which lamp?")
    values = json.loads(file.read_text("utf-8"))
    values["DOOR"]["_facts"]["1"]["name"] = "Signal"
    file.write_text(json.dumps(values, indent=1), "utf-8")
    again = sit_as(sit, SURGEON, file)
    again.enter()
    (view,) = again.page.reading.findChildren(CommentView)
    again.person.click(view.close_button)
    assert not again.feature.review.review.open_comments


def test_the_contents_of_a_narrow_window_are_a_drawer(sit: Sit, tmp_path: Path) -> None:
    person = sit(door_at(tmp_path))
    reader = Reader(person)
    person.window.resize(1280, 800)
    reader.enter()
    page = reader.page
    assert page.contents.isVisible()
    assert not page.bar.contents.isVisible()
    person.window.resize(900, 700)
    person.qtbot.waitUntil(page.bar.contents.isVisible)
    assert not page.contents.isVisible()
    person.click(page.bar.contents)
    assert page.contents.isVisible()
    assert page.drawer.geometry().left() == 0
    last = list(page.contents.buttons)[-1]
    person.click(page.contents.buttons[last])
    assert not page.contents.isVisible()
    assert not page.bar.contents.isChecked()
    line = page.line
    assert line is not None
    assert line.section.key == last
    person.click(page.bar.contents)
    QTest.keyClick(page.contents, Qt.Key.Key_Escape)
    assert not page.contents.isVisible()
    person.window.resize(1280, 800)
    person.qtbot.waitUntil(page.contents.isVisible)
    assert not page.bar.contents.isVisible()


def test_the_drawing_beside_the_text_is_that_of_the_step(sit: Sit) -> None:
    person = sit(SAMPLES / "femoroplasty.json")
    reader = Reader(person)
    reader.enter()
    reader.go_to("Approve the plan")
    line = reader.page.line
    assert line is not None
    branch = line.line.about[0].branch
    assert branch != next(iter(person.blueprint.branches))
    person.press(Qt.Key.Key_W)
    column = reader.feature.watching()
    person.until(lambda: column.plays)
    assert column.canvas.branch == branch
    person.press(Qt.Key.Key_F8)


def test_a_line_is_shown_in_the_notation_of_the_paper(sit: Sit, tmp_path: Path) -> None:
    reader = Reader(sit(door_at(tmp_path / "door")))
    reader.enter()
    page, seen = reader.page, reader.feature.review.seen
    assert seen is not None
    key = next(one.line.key for one in seen.lines if one.line.about)
    page.show_line(key)
    card = page.reading.card(key)
    assert card is not None
    reader.person.click(card.notation.button)
    lines = card.notation.words.text().splitlines()
    assert lines
    assert all(" = λs. " in line for line in lines)
    assert sum(one.notation.isVisible() for one in page.reading.cards) == 1
