"""Forms, lists and actions follow an edit a moment later, once, and sooner if somebody asks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import add_state, delete, rename, retarget, set_layout
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.document import afterwards
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.facts.view import FactView
from smsl_studio.studio.features.draw.panels.file_form import FileForm
from smsl_studio.studio.features.draw.panels.header_form import HeaderForm
from smsl_studio.studio.features.draw.panels.library_list import LibraryList
from smsl_studio.studio.features.draw.panels.outline_tree import OutlineTree
from smsl_studio.studio.features.draw.panels.state_form import StateForm
from smsl_studio.studio.shell.frame.status_line import StatusLine
from tests.sequences.agreement import disagreements
from tests.stories.at_outline import texts
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, sample

NEVER = 10_000_000
"""Milliseconds that no test lasts: all that follows an edit follows because somebody asks."""
STATE, OPERATION = "SB1/State_0_0_0", "Op_1a"
PARTS = (
    (StateForm, "show_states"), (HeaderForm, "show_header"), (FileForm, "show_file"),
    (OutlineTree, "show_blueprint"), (LibraryList, "show_rows"), (StatusLine, "show_blueprint"),
    (Actions, "refresh"), (FactView, "show_lines"), (StatusLine, "show_place"),
)  # fmt: skip

Change = Callable[[Blueprint], Blueprint]
FIRST, SECOND = Address("SB1", "State_aaa"), Address("SB1", "State_baa")
EDITS: dict[str, Change] = {
    "rename a state": lambda bp: rename(bp, FIRST, "State_aad"),
    "rename an operation": lambda bp: rename(bp, Address("SB1", "State_aaa", "Op_1b"), "Op_9b"),
    "add": lambda bp: add_state(bp, "SB1", "State_aae", (40.0, 700.0)),
    "delete": lambda bp: delete(bp, (FIRST,)),
    "delete another": lambda bp: delete(bp, (SECOND,)),
    "move": lambda bp: set_layout(bp, "SB1", {"State_aaa": (900.0, 30.0)}),
    "retarget": lambda bp: retarget(bp, Address("SB1", "State_aaa", "Op_1b"), "State_aca"),
}


@pytest.fixture
def counts(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each part was shown, by its name."""
    counted: Counter[str] = Counter()
    for kind, name in PARTS:
        monkeypatch.setattr(kind, name, counting(getattr(kind, name), named(kind, name), counted))
    return counted


def named(kind: type, method: str) -> str:
    return f"{kind.__name__}.{method}"


def counting(show: Callable[..., object], part: str, counts: Counter[str]) -> Callable[..., object]:
    """The method of a part, which counts how often it is called."""

    def shown(self: object, *given: object) -> object:
        counts[part] += 1
        return show(self, *given)

    return shown


@pytest.fixture
def drawn(sit: Sit, tmp_path: Path, counts: Counter[str]) -> Person:
    """A person at the Tower of Hanoi with its first state selected, and all has come to rest."""
    path = tmp_path / "hanoi.json"
    path.write_bytes((SAMPLES / "hanoi-corrected.json").read_bytes())
    person = sit(path)
    person.until_inspected()
    person.window.session.select((FIRST,))
    QApplication.processEvents()
    counts.clear()
    return person


@pytest.fixture
def waits(drawn: Person, monkeypatch: pytest.MonkeyPatch) -> Person:
    """The same person. Nothing that waits for a moment comes by itself."""
    monkeypatch.setattr(afterwards, "MOMENT", NEVER)
    return drawn


def edit(person: Person, words: str = "rename a state") -> None:
    """Make an edit, and let Qt do all that it has to do now."""
    assert person.window.session.edit(words, EDITS[words])
    QApplication.processEvents()


def ask(person: Person) -> None:
    """Press a key that does nothing. Findings that come later are not waited for."""
    QTest.keyClick(person.window.canvas, Qt.Key.Key_Shift)


def wrong(person: Person) -> list[str]:
    """All in which the parts of the window disagree."""
    return list(disagreements(person.window, Path(person.window.session.blueprint.file)))


def test_the_drawing_follows_an_edit_and_each_other_part_once_when_somebody_asks(
    waits: Person, counts: Counter[str]
) -> None:
    session = waits.window.session
    for words in EDITS:
        edit(waits, words)
        assert not counts, words
        assert session.afterwards.pending
        sheet = waits.window.canvas.sheet
        assert sheet is not None
        assert sheet.picture.blueprint is session.blueprint
        assert waits.window.windowTitle().startswith("hanoi.json (edited)")
        ask(waits)
        assert not session.afterwards.pending
        once(counts, words, session)
        for verb in (session.history.undo, session.history.redo, session.history.undo):
            verb()
            QApplication.processEvents()
            assert not counts, words
            ask(waits)
            once(counts, words, session)
        assert not wrong(waits)
        session.select((FIRST,))
        QApplication.processEvents()
        counts.clear()


def once(counts: Counter[str], words: str, session: Session) -> None:
    """Each part was shown once; that of a state only if one is selected."""
    shown = [one for one in PARTS if one[0] is not StateForm or session.selection]
    assert counts == {named(*one): 1 for one in shown}, words
    counts.clear()


def test_several_edits_in_a_moment_are_shown_once(waits: Person, counts: Counter[str]) -> None:
    for words in ("rename a state", "delete another", "add"):
        assert waits.window.session.edit(words, EDITS[words])
    ask(waits)
    assert set(counts.values()) == {1}
    assert not wrong(waits)


def test_an_edit_and_what_it_selects_are_shown_together(
    waits: Person, counts: Counter[str]
) -> None:
    edit(waits, "add")
    waits.window.session.select((Address("SB1", "State_aae"),))
    assert not counts
    ask(waits)
    assert set(counts.values()) == {1}
    assert waits.window.properties.state.name.text() == "State_aae"


def test_a_selection_is_shown_at_once_if_all_rests(waits: Person) -> None:
    waits.window.session.select((SECOND,))
    assert waits.window.properties.state.name.text() == "State_baa"


def test_all_parts_follow_by_themselves(drawn: Person, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(afterwards, "MOMENT", 5)
    edit(drawn)
    drawn.until(lambda: not drawn.window.session.afterwards.pending)
    assert not wrong(drawn)
    field = QAccessible.queryAccessibleInterface(drawn.window.properties.state.name)
    assert field.text(QAccessible.Text.Value) == "State_aad"


def test_ctrl_z_right_after_the_first_edit_undoes_it(waits: Person) -> None:
    before = waits.blueprint
    edit(waits)
    waits.ctrl(Qt.Key.Key_Z)
    assert waits.blueprint.document.text == before.document.text
    ask(waits)
    assert not wrong(waits)


def test_a_click_right_after_an_edit_acts_on_what_is_true(waits: Person) -> None:
    edit(waits)
    line = waits.window.properties.state.operations
    QTest.mouseClick(line.viewport(), Qt.MouseButton.LeftButton, pos=line.visualRect(
        line.model().index(0, 0)).center())  # fmt: skip
    assert waits.selected() == ["SB1/State_aad/Op_1b"]
    assert not wrong(waits)


def test_a_name_typed_right_after_an_edit_is_given_to_what_is_true(waits: Person) -> None:
    waits.window.properties.state.name.setFocus()
    edit(waits)
    waits.window.properties.state.name.selectAll()
    waits.type("State_bbb")
    waits.press(Qt.Key.Key_Return)
    assert "State_bbb" in waits.blueprint["SB1"].table
    assert "State_aad" not in waits.blueprint["SB1"].table
    ask(waits)
    assert not wrong(waits)


def test_a_state_branch_that_was_just_added_gets_its_name_in_its_line(waits: Person) -> None:
    waits.window.outline.add_branch()
    assert "SB2" in texts(waits.window.outline.tree)
    assert waits.window.outline.tree.naming


def test_a_save_right_after_an_edit_writes_it(waits: Person) -> None:
    edit(waits)
    assert waits.window.files.save()
    assert "State_aad" in Path(waits.blueprint.file).read_text("utf-8")
    ask(waits)
    assert not wrong(waits)


def test_another_blueprint_right_after_an_edit_is_shown_at_once(waits: Person) -> None:
    edit(waits)
    waits.window.session.open(sample("hfsm.json"))
    assert "SB2" in texts(waits.window.outline.tree)
    assert not waits.window.session.afterwards.pending


def test_a_window_closed_right_after_an_edit_calls_nothing_later(
    drawn: Person, counts: Counter[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(afterwards, "MOMENT", 1)
    edit_ = drawn.window.session.edit
    assert edit_("Rename", EDITS["rename a state"])
    drawn.window.session.history.setClean()
    drawn.window.close()
    counts.clear()
    QTest.qWait(10)
    assert not counts


def test_the_cells_of_a_fact_are_new_right_after_one_was_typed(waits: Person) -> None:
    panel = waits.window.facts
    view = panel.view
    waits.until(lambda: not view.rect_of(0, "name").isEmpty())
    view.edit_cell(0, "name")
    waits.type("Peg")
    QTest.keyPress(view.field, Qt.Key.Key_Tab)
    assert view.looks.edited is not None
    assert "Peg" in view.facts.lines[0].words
    QTest.keyClick(view.field, Qt.Key.Key_Escape)
    panel.propose_addition()
    QTest.mouseClick(panel.card.agree, Qt.MouseButton.LeftButton)
    assert view.looks.edited == (3, ("name", ""))
