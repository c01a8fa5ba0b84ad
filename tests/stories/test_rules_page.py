"""A person writes rules, sees what they give, and lets the drawing follow them."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPlainTextEdit

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.front.approval_badge import GENERATED
from smsl_studio.studio.features.approval.badge import ApprovalBadge
from smsl_studio.studio.features.rules import feature as rules_feature
from smsl_studio.studio.features.rules.page import RulesPage
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
RIVER = SAMPLES / "rules" / "river.toml"


class AtRules:
    """The page Rules of a person's window."""

    def __init__(self, person: Person) -> None:
        self.person, self.feature = person, person.window.features.rules
        person.window.actions_table["rules_page"].trigger()
        self.told = person.window.toast.words
        self.until_followed()

    @property
    def page(self) -> RulesPage:
        return self.feature.part()

    def until_followed(self) -> None:
        page = self.page
        self.person.until(
            lambda: page.answer is not None and page.answer.text == page.text.toPlainText()
        )

    def write(self, text: str) -> None:
        self.page.text.replace_all(text)
        self.until_followed()

    @property
    def summed(self) -> str:
        return self.page.sum.text()

    def problems(self) -> list[str]:
        return [row.text for row in self.page.problems.rows.rows]

    def has_differences(self, many: int) -> bool:
        return len(self.differences()) == many

    def differences(self) -> list[str]:
        return [row.text for row in self.page.side.list.rows.rows]


@pytest.fixture
def at(sit: Sit, tmp_path: Path) -> AtRules:
    path = tmp_path / "river.rules.toml"
    path.write_text(RIVER.read_text("utf-8"), "utf-8")
    person = sit()
    person.window.open_path(path)
    return AtRules(person)


def test_a_file_of_rules_shows_what_it_gives(at: AtRules) -> None:
    window = at.person.window
    assert window.mode == "rules"
    assert at.summed == "40 states, 92 operations"
    assert at.page.canvas.sheet is not None
    assert len(at.page.canvas.sheet.picture.names) == 40
    assert at.problems() == []
    assert "no states" in at.page.side.why.text()
    assert not at.page.saving.isEnabled()


def test_every_keystroke_is_followed_and_a_rule_that_cannot_be_read_is_left_out(
    at: AtRules,
) -> None:
    text = at.page.text
    text.moveCursor(text.textCursor().MoveOperation.End)
    text.setFocus()
    for line in ("[[rule]]", 'operation = "call"', 'cases = [{when = "wolf = x", set = {}}]'):
        at.person.type(line)
        at.person.press(Key.Key_Return)
    at.until_followed()
    assert at.summed == "40 states, 92 operations, 1 part left out"
    (problem,) = at.problems()
    last = text.document().blockCount() - 1
    assert problem.startswith(f"Line {last}: ")
    text.moveCursor(text.textCursor().MoveOperation.Start)
    at.page.problems.setCurrentIndex(at.page.problems.rows.index(0))
    at.page.problems.activated.emit(at.page.problems.currentIndex())
    assert text.caret == (last, 1)
    at.person.ctrl(Key.Key_Z)
    assert at.person.blueprint.state_count == 0, "the drawing has no step of this"


def test_a_text_that_gives_nothing_keeps_the_last_picture_and_says_so(at: AtRules) -> None:
    at.write("facts = [")
    assert at.summed == "The text gives nothing yet. This is what it gave before."
    assert at.page.canvas.sheet is not None
    assert len(at.problems()) == 1
    assert not at.page.side.write.isEnabled()


def test_what_a_change_takes_away_is_counted(at: AtRules) -> None:
    whole = at.page.text.toPlainText()
    first = whole.index("[[rule]]")
    second = whole.index("[[rule]]", first + 1)
    at.write(whole[:first] + whole[second:])
    assert at.page.change.text().startswith("−")
    at.write(whole)
    assert at.page.change.text().startswith("+")


def test_the_rules_become_a_drawing_that_nobody_has_inspected(at: AtRules) -> None:
    at.person.click(at.page.side.write)
    window = at.person.window
    assert window.mode == "draw"
    assert at.person.blueprint.state_count == 40
    assert at.person.blueprint.fields["_origin"]["how"] == "rules"
    assert window.files.path is None
    assert "Nobody has inspected it" in window.toast.words


def test_what_rules_without_a_file_give_has_the_badge_of_quarantine(sit: Sit) -> None:
    at = AtRules(sit())
    at.person.click(at.page.side.write)
    window = at.person.window
    (badge,) = window.menu_row.findChildren(ApprovalBadge)
    assert (window.files.path, badge.isVisible()) == (None, True)
    assert badge.said.words == GENERATED


def test_differences_to_the_drawing_are_taken_refused_and_undone(at: AtRules) -> None:
    person, side = at.person, at.page.side
    person.click(side.write)
    name = next(iter(person.blueprint)).name
    states = list(person.blueprint[name].table)
    operation = next(iter(person.blueprint[name].table[states[0]]))
    person.window.session.select((Address(name, states[0], operation),))
    person.press(Key.Key_Delete)
    AtRules(person)
    person.until(lambda: len(at.differences()) == 1)
    assert at.differences()[0].startswith(f"1 Missing: {states[0]}")
    assert side.take.text() == "Take"
    before = person.blueprint.document.text
    person.click(side.take)
    person.until(lambda: not at.differences())
    assert "agree" in side.why.text()
    person.window.session.history.undo()
    assert person.blueprint.document.text == before
    person.until(lambda: len(at.differences()) == 1)
    person.click(side.refuse)
    assert at.differences() == []
    assert "1 difference refused" in side.why.text()


def test_what_was_refused_is_kept_with_the_drawing(sit: Sit, tmp_path: Path) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.window.actions_table["complete_drawing"].trigger()
    at = AtRules(person)
    person.until(lambda: at.has_differences(4))
    side, path = at.page.side, person.window.files.path
    assert path is not None
    person.click(side.refuse)
    assert at.has_differences(3)
    assert not side.again.isHidden()
    person.window.open_path(SAMPLES / "hanoi-2.json")
    person.until(lambda: side.refused == set())
    person.window.open_path(path)
    person.until(lambda: len(side.refused) == 1)
    person.until(lambda: at.has_differences(3))
    person.click(side.again)
    assert at.has_differences(4)
    person.window.open_path(SAMPLES / "hanoi-2.json")
    person.window.open_path(path)
    assert side.refused == set()


def test_the_rules_of_a_drawing_are_learnt(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    at = AtRules(person)
    assert 'sb = "SB1"' in at.page.text.toPlainText()
    assert (at.problems(), at.summed[:21]) == ([], "2 states, 1 operation"), "it begins alive"
    person.click(at.page.learning)
    person.until(lambda: "These rules make the drawing" in person.window.toast.words)
    at.until_followed()
    kinds = {one.partition(":")[0].split(maxsplit=1)[1] for one in at.differences()}
    assert kinds == {"Missing", "Odd"}, "the misprints of the paper"
    assert at.summed.startswith("27 states, 78 operations")
    at.until_followed()
    assert at.page.change.text() == "", "another text is no change of the text before"


def test_unsaved_rules_come_back_with_the_next_window(sit: Sit, tmp_path: Path) -> None:
    at = AtRules(sit())
    at.write(RIVER.read_text("utf-8"))
    at.person.window.session.history.setClean()
    at.person.window.close()
    again = AtRules(sit())
    assert again.page.text.toPlainText() == RIVER.read_text("utf-8")
    assert "not saved" in again.told


def test_rules_are_saved_under_a_name(
    at: AtRules, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at.write("# nothing\n")
    assert at.page.saving.isEnabled()
    at.person.click(at.page.saving)
    assert (tmp_path / "river.rules.toml").read_text("utf-8") == "# nothing\n"
    assert not at.page.saving.isEnabled()
    other = tmp_path / "other"
    monkeypatch.setattr(rules_feature, "ask_to_save", lambda *_: (str(other), ""))
    at.page.file.path = None
    at.write("# more\n")
    at.person.click(at.page.saving)
    assert (tmp_path / "other.rules.toml").read_text("utf-8") == "# more\n"


def test_the_text_has_the_keys_of_a_text(at: AtRules) -> None:
    assert isinstance(at.page.text, QPlainTextEdit)
    at.page.text.setFocus()
    at.page.text.moveCursor(at.page.text.textCursor().MoveOperation.Start)
    at.person.type("f")
    assert at.page.text.toPlainText().startswith("f#")
    at.person.ctrl(Key.Key_Z)
    assert at.page.text.toPlainText().startswith("#")


def test_what_a_change_takes_away_stays_as_a_ghost_until_the_next(at: AtRules) -> None:
    whole = at.page.text.toPlainText()
    first = whole.index("[[rule]]")
    at.write(whole[:first] + whole[whole.index("[[rule]]", first + 1) :])
    sheet = at.page.canvas.sheet
    assert sheet is not None
    signs = sheet.looks.marks.changes
    assert set(signs.values()) == {"-"}
    gone = [one for one in signs if not one.operation]
    assert gone
    assert len(sheet.picture.names) == 40
    at.write(at.page.text.toPlainText() + "# more\n")
    assert at.page.canvas.sheet is not None
    assert len(at.page.canvas.sheet.picture.names) == 40 - len(gone)
    at.write(whole)
    assert at.page.canvas.sheet is not None
    assert set(at.page.canvas.sheet.looks.marks.changes.values()) == {"+"}


def test_words_are_offered_and_a_wrong_one_is_mended(at: AtRules) -> None:
    text = at.page.text
    text.moveCursor(text.textCursor().MoveOperation.End)
    text.setFocus()
    text.insertPlainText('[[rule]]\noperation = "call"\ncases = [{when = "')
    at.person.type("wolf = ")
    at.person.ctrl(Key.Key_Space)
    assert text.words.words == ["0", "B", "1"]
    at.person.press(Key.Key_Down)
    at.person.press(Key.Key_Return)
    at.person.type(" and gras")
    at.person.ctrl(Key.Key_Space)
    assert text.words.words == ["grass"]
    at.person.press(Key.Key_Tab)
    assert not text.words.isVisible()
    at.person.type(' = b", set = {grass = "0"}}]')
    at.until_followed()
    (problem,) = at.problems()
    assert "no value 'b'" in problem
    assert at.page.fixing.text() == "Write “B”"
    at.person.click(at.page.fixing)
    at.until_followed()
    assert at.problems() == []
    assert 'when = "wolf = B and grass = B"' in text.toPlainText()
    assert not at.page.fixing.isVisible()


def test_the_save_key_on_the_page_is_about_the_rules(at: AtRules, tmp_path: Path) -> None:
    at.write("# saved by a key\n")
    for part in (at.page.text, at.page.side.list):
        part.setFocus()
        at.person.ctrl(Key.Key_S)
    assert (tmp_path / "river.rules.toml").read_text("utf-8") == "# saved by a key\n"
    assert at.person.window.files.path is None


def test_suggestions_for_a_drawing_are_taken_one_by_one(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    person.window.actions_table["complete_drawing"].trigger()
    at = AtRules(person)
    person.until(lambda: "4 suggestions" in person.window.toast.words)
    at.until_followed()
    person.until(lambda: len(at.differences()) == 4)
    sheet = at.page.canvas.sheet
    assert sheet is not None
    assert sorted(sheet.looks.marks.conflicts.values()) == ["+1", "+2", "-3", "-4"]
    before = person.blueprint.document.text
    for left in (3, 2, 1, 0):
        person.click(at.page.side.take)
        person.until(partial(at.has_differences, left))
    assert "78 operations the same" in at.page.side.why.text()
    for _ in range(4):
        person.window.session.history.undo()
    assert person.blueprint.document.text == before


def test_a_drawing_without_rules_is_refused_until_it_changes(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    at = AtRules(person)
    person.click(at.page.learning)
    person.until(lambda: any("one State Branch" in one for one in at.problems()))
    at.page.text.insertPlainText("# typed\n")
    at.until_followed()
    assert any("one State Branch" in one for one in at.problems())
    session = person.window.session
    name = session.branch
    session.edit("Add a state", lambda blueprint: editing.add_state(blueprint, name, "State_more"))
    person.until(lambda: not any("one State Branch" in one for one in at.problems()))
