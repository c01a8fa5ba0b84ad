"""Finding and replacing."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

from smsl_studio.studio.features.draw.source.find import Match, TextSearch, find, replaced
from tests.studio.features.draw.source.conftest import CTRL, HFSM, NONE, SHIFT, Writer

At = Callable[..., Writer]


def spans(text: str, search: TextSearch) -> list[str]:
    return [text[one.start : one.end] for one in find(text, search).matches]


def test_plain_words_whole_words_case_and_expressions() -> None:
    text = "Op op Op_1 𝛼op a-op"
    assert spans(text, TextSearch("op")) == ["Op", "op", "Op", "op", "op"]
    assert spans(text, TextSearch("op", case=True)) == ["op", "op", "op"]
    assert spans(text, TextSearch("op", whole=True)) == ["Op", "op"]
    assert spans(text, TextSearch(r"op_\d", regular=True)) == ["Op_1"]
    assert spans("a.b", TextSearch(".")) == ["."]
    assert find(text, TextSearch("")).matches == ()


def test_an_invalid_or_endless_expression_is_reported() -> None:
    assert "expression" in find("a", TextSearch("(", regular=True)).fault
    assert "too long" in find("a" * 60 + "b", TextSearch("(a+)+$", regular=True)).fault
    for nothing in ("x*", "$", "^"):
        found = find("a\nb", TextSearch(nothing, regular=True))
        assert (found.matches, found.fault) == ((), "")
    assert spans("aab", TextSearch("a*", regular=True)) == ["aa"]


def test_groups_stand_in_the_replacement() -> None:
    match = find("State_12", TextSearch(r"State_(\d)(\d)", regular=True)).matches[0]
    assert replaced(match, r"S\2\1\\", TextSearch("", regular=True)) == "S21\\"
    assert replaced(Match(0, 1, ("a",)), r"\1", TextSearch("")) == r"\1"


def test_next_and_previous_go_from_match_to_match(at_text: At) -> None:
    writer = at_text()
    bar = writer.pane.find_bar
    writer.key(Qt.Key.Key_F, CTRL)
    assert bar.words.hasFocus()
    QTest.keyClicks(bar.words, "state_0")
    assert bar.count.text() == "1 of 3"
    QTest.keyClick(bar.words, Qt.Key.Key_Return)
    assert bar.count.text() == "2 of 3"
    writer.pane.editor.setFocus()
    writer.key(Qt.Key.Key_F3)
    writer.key(Qt.Key.Key_F3)
    assert bar.count.text() == "1 of 3"
    writer.key(Qt.Key.Key_F3, SHIFT)
    assert bar.count.text() == "3 of 3"
    writer.key(Qt.Key.Key_Escape)
    assert not bar.isVisible()
    assert writer.pane.editor.hasFocus()


def test_what_is_found_is_revealed_in_a_fold(at_text: At) -> None:
    writer = at_text()
    writer.pane.folding.fold_all()
    writer.key(Qt.Key.Key_F, CTRL)
    QTest.keyClicks(writer.pane.find_bar.words, "Back")
    assert not writer.pane.editor.folds.all


@pytest.mark.parametrize(("key", "held"), [(Qt.Key.Key_Return, NONE)])
def test_replacing_one_and_all(at_text: At, key: Qt.Key, held: Qt.KeyboardModifier) -> None:
    writer = at_text()
    bar = writer.pane.find_bar
    writer.key(Qt.Key.Key_H, CTRL)
    bar.regular.setChecked(True)
    QTest.keyClicks(bar.words, r"State_(\d)")
    bar.other.setFocus()
    QTest.keyClicks(bar.other, r"S_\1")
    QTest.keyClick(bar.other, key, held)
    assert writer.text.count("S_0") == 1
    assert writer.text.index('"S_0"') == HFSM.index('"State_0"')
    bar.every.click()
    assert "State_" not in writer.text
    assert writer.words == ["Replace", "Replace 6 places"]
    assert writer.states() == ["S_0", "S_1", "S_2"]
    writer.session.history.undo()
    writer.session.history.undo()
    assert writer.text == HFSM
    assert writer.lines == HFSM.split("\n")


def test_what_is_said_of_an_expression_does_not_widen_the_pane(at_text: At) -> None:
    bar = at_text().pane.find_bar
    bar.open_bar(replacing=False)
    width = bar.minimumSizeHint().width()
    bar.regular.setChecked(True)
    QTest.keyClicks(bar.words, "(?P<" + "a" * 40 + ">x)")
    assert "too long (maximum" in bar.count.text()
    assert bar.count.toolTip() == bar.count.text()
    QApplication.processEvents()
    assert bar.minimumSizeHint().width() == width


def test_what_was_replaced_is_told_until_one_looks_for_something_else(at_text: At) -> None:
    bar = at_text().pane.find_bar
    bar.open_bar(replacing=True)
    QTest.keyClicks(bar.words, "State_1")
    count = len(bar.found.matches)
    QTest.keyClicks(bar.other, "State_9")
    QTest.mouseClick(bar.every, Qt.MouseButton.LeftButton)
    assert bar.count.text() == f"{count} replaced"
    bar.look()
    assert bar.count.text() == f"{count} replaced"
    QTest.keyClicks(bar.words, "x")
    assert bar.count.text() == "Not found"


def focus() -> QWidget:
    found = QApplication.focusWidget()
    assert found is not None
    return found


def test_tab_leads_from_what_is_found_to_what_shall_stand_there(at_text: At) -> None:
    writer = at_text()
    bar = writer.pane.find_bar
    writer.key(Qt.Key.Key_H, CTRL)
    QTest.keyClicks(focus(), "State_1")
    QTest.keyClick(focus(), Qt.Key.Key_Tab)
    QTest.keyClicks(focus(), "State_9")
    assert (bar.words.text(), bar.other.text()) == ("State_1", "State_9")
    seen = []
    for _ in range(10):
        seen.append(focus())
        QTest.keyClick(focus(), Qt.Key.Key_Tab)
    assert seen[:3] == [bar.other, bar.one, bar.every]
    assert set(seen) >= {bar.back, bar.on, bar.case, bar.whole, bar.regular}
    bar.open_bar(replacing=False)
    QTest.keyClick(bar.words, Qt.Key.Key_Tab)
    assert focus() is bar.back
