"""What a person begins to write in Review is kept until it is kept or left, whatever happens."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.errors import SaveError
from smsl_studio.front import reviews
from smsl_studio.front.reviews import keep_answers, review_of
from smsl_studio.inspection.review.review_author import ReviewAuthor
from smsl_studio.studio.features.review.answer_field import AnswerField
from smsl_studio.studio.features.review.comment_dialog import CommentDialog
from smsl_studio.studio.features.review.line_card import LineCard
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_review import ENGINEER, SURGEON, Reader, door_at, sit_as


@pytest.fixture
def reader(sit: Sit, tmp_path: Path) -> Reader:
    """A surgeon who reads a copy of the sample with people."""
    file = tmp_path / "registration-people.json"
    shutil.copy(SAMPLES / file.name, file)
    made = sit_as(sit, SURGEON, file)
    made.person.window.resize(1432, 860)
    made.person.ctrl(Qt.Key.Key_4)
    made.wait_for_the_reading()
    return made


def line_two(reader: Reader) -> LineCard:
    card = next(c for c in reader.page.reading.cards if "People" in c.reviewed.line.heading)
    assert card.reviewed.line.key == reader.page.reading.cards[1].reviewed.line.key
    return card


def box(reader: Reader) -> AnswerField:
    field = line_two(reader).field
    assert field is not None
    return field


def written(reader: Reader) -> list[str]:
    return [one.kind for one in reader.feature.review.review.entries]


def test_a_comment_stays_while_the_page_is_built_anew_and_its_letters_are_no_keys(
    reader: Reader,
) -> None:
    person, page = reader.person, reader.page
    old = line_two(reader)
    person.click(old.ask)
    # Before a letter is typed: the lines are made again in another size of text.
    person.ctrl(Qt.Key.Key_Plus)
    assert line_two(reader) is not old
    for letter in "why":
        QTest.keyClicks(person._focus(), letter)
    old = line_two(reader)
    person.ctrl(Qt.Key.Key_0)
    assert line_two(reader) is not old
    person.window.resize(1000, 700)
    QTest.keyClicks(person._focus(), "?")
    # An answer of somebody else on this very line arrives.
    other = box(reader)
    line = line_two(reader).reviewed
    file = str(person.window.files.path)
    author = ReviewAuthor(ENGINEER.name, ENGINEER.role)
    keep_answers(file, author.approve(reader.feature.review.review, line))
    reader.feature.review.look()
    assert box(reader) is not other
    QTest.keyClicks(person._focus(), " yw")
    assert box(reader).text.toPlainText() == "why? yw"
    assert QApplication.focusWidget() is box(reader).text
    assert page.right.currentWidget() is page.side
    assert [(one.kind, one.person) for one in review_of(file).entries] == [
        ("approved", ENGINEER.name)
    ]
    assert page.reading.at == line.line.key
    person.ctrl(Qt.Key.Key_Return)
    assert written(reader) == ["approved", "comment"]
    assert line_two(reader).field is None


def test_what_is_begun_is_there_after_another_mode_and_in_the_next_window(
    reader: Reader, sit: Sit
) -> None:
    person = reader.person
    person.click(line_two(reader).ask)
    QTest.keyClicks(person._focus(), "Who watches?")
    person.ctrl(Qt.Key.Key_1)
    person.ctrl(Qt.Key.Key_4)
    assert box(reader).text.toPlainText() == "Who watches?"
    assert "is not kept yet" in reader.page.side.why.text()
    # A letter leads to the open field, and is neither an answer nor a part of the text.
    reader.page.setFocus()
    person.press(Qt.Key.Key_Y)
    assert QApplication.focusWidget() is box(reader).text
    assert written(reader) == []
    assert box(reader).text.toPlainText() == "Who watches?"
    file = person.window.files.path
    assert file is not None
    assert person.window.close()
    again = sit_as(sit, SURGEON, file)
    assert "begun in Review" in again.person.window.toast.words
    # It is nobody else's.
    again.person.windows.persons.put(ENGINEER)
    again.person.windows.persons.choose(ENGINEER)
    again.person.ctrl(Qt.Key.Key_4)
    again.wait_for_the_reading()
    assert line_two(again).field is None
    again.person.windows.persons.choose(SURGEON)
    assert box(again).text.toPlainText() == "Who watches?"
    again.person.click(box(again).keep)
    assert written(again) == ["comment"]
    assert again.person.window.close()
    third = sit_as(sit, SURGEON, file)
    third.person.ctrl(Qt.Key.Key_4)
    third.wait_for_the_reading()
    assert line_two(third).field is None


def test_a_draft_of_a_line_that_changed_or_went_is_shown_at_another_line(
    sit: Sit, tmp_path: Path
) -> None:
    file = door_at(tmp_path)
    reader = sit_as(sit, SURGEON, file)
    reader.enter()
    reader.go_to("Light the lamp")
    person = reader.person
    person.press(Qt.Key.Key_C)
    QTest.keyClicks(person._focus(), "Who?")
    edits = person.window.session
    for old, new in (("Light the lamp", "Light it"), ('"light"', '"lit"')):
        text = next(iter(edits.texts.values()))
        edits.write("Type", text.replace(old, new))
        reader.page.refresh()
        reader.wait_for_the_reading()
        (field,) = (one.field for one in reader.page.reading.cards if one.field is not None)
        assert field.text.toPlainText() == "Who?"
    QTest.keyClick(field.text, Qt.Key.Key_Escape)
    assert not reader.feature.drafts.begun(SURGEON.name)


def test_a_comment_that_cannot_be_kept_stays_in_its_field(
    reader: Reader, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = reader.person
    file = person.window.files.path
    assert file is not None
    person.click(line_two(reader).ask)
    QTest.keyClicks(person._focus(), "Why?")
    # Neither the file of the review nor the journal in the user's folder can be written.
    with monkeypatch.context() as patched:
        patched.setattr(reviews, "save_document", full)
        person.ctrl(Qt.Key.Key_Return)
        assert "full" in person.window.toast.words
        assert box(reader).text.toPlainText() == "Why?"
        # Comment again, and the approval of the line, take no text along.
        person.click(line_two(reader).ask)
        person.click(line_two(reader).approve)
        assert box(reader).text.toPlainText() == "Why?"
    person.click(box(reader).keep)
    assert written(reader) == ["comment"]


def full(*_: object) -> None:
    raise SaveError("The disk is full", advice="Make room.")


def test_the_answer_of_an_engineer_goes_along_to_the_line(sit: Sit, tmp_path: Path) -> None:
    file = door_at(tmp_path)
    surgeon = sit_as(sit, SURGEON, file)
    surgeon.enter()
    surgeon.person.press(Qt.Key.Key_C)
    surgeon.write("Which?")
    assert surgeon.person.window.close()
    engineer = sit_as(sit, ENGINEER, file)
    findings = engineer.person.window.findings
    engineer.person.until(lambda: any(one.rule == "ask" for one in findings.findings))
    engineer.person.click_row(findings.list, "Which?")
    dialog = engineer.person.window.findChild(CommentDialog)
    assert dialog is not None
    engineer.person.until(dialog.isVisible)
    QTest.keyClicks(dialog.field.text, "The first")
    QTest.mouseClick(dialog.line, Qt.MouseButton.LeftButton)
    engineer.wait_for_the_reading()
    fields = [one.field for one in engineer.page.reading.cards if one.field is not None]
    assert [one.text.toPlainText() for one in fields] == ["The first"]
