"""Templates of the library: dropped, by Enter, and from the menu; each is one step."""

from __future__ import annotations

import random

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.inspection.inspect import inspect
from smsl_studio.studio.features.draw.canvas.library_verbs import LibraryVerbs
from smsl_studio.studio.features.draw.canvas.template_drop import TEMPLATES
from tests.stories.at_canvas import Drawer
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES
from tests.stories.test_library_drop import Dragger

Key = Qt.Key


def drop(person: Drawer, template: str, at: QPoint) -> str:
    """Drop a template; returns what was said before."""
    hand = Dragger(person, "template")
    said = hand.over(template, at)
    hand.let_go(at)
    return said


def errors(person: Drawer) -> list[str]:
    return [one.rule for one in inspect(person.session.blueprint) if one.severity.value == "E"]


def test_a_recovery_is_sketched_and_then_stands_in_view_and_is_selected(hanoi: Drawer) -> None:
    text, hand = hanoi.session.blueprint.document.text, Dragger(hanoi, "template")
    at = hanoi.place("State_abc")
    said = hand.over("recovery", at)
    assert said == "State_abx, a failure of State_abc, and Op_Recover back"
    sketch = hanoi.canvas.gestures.sketch
    assert sketch is not None
    (rect, name), = sketch.states  # fmt: skip
    assert name == "State_abx"
    hand.let_go(at)
    assert hanoi.table()["State_abx"] == {"Op_Recover": "State_abc"}
    x, y = hanoi.canvas.positions["State_abx"]
    assert abs(rect.center().x() - x) < 0.1
    assert abs(rect.center().y() - y) < 0.1
    assert hanoi.selected() == ["State_abx", "State_abx/Op_Recover"]
    assert hanoi.hands_on.rect().contains(hanoi.place("State_abx"))
    assert errors(hanoi) == []
    assert hanoi.steps() == 1
    hanoi.session.history.undo()
    assert hanoi.session.blueprint.document.text == text


def test_a_confirmation_asks_before_one_operation_or_before_all_of_a_state(hfsm: Drawer) -> None:
    at = hfsm.label_of("State000", "Operation000")
    assert drop(hfsm, "confirmation", at) == "A supervisor confirms Operation000 before it begins"
    note = hfsm.session.blueprint["SB1"].operation_note("State000", "Operation000")
    assert note.confirm == ("supervisor",)
    assert note.question
    assert hfsm.selected() == ["State000/Operation000"]
    said = drop(hfsm, "confirmation", hfsm.place("State100"))
    assert said == "A supervisor confirms 2 operations before they begin"
    assert len(hfsm.selected()) == 2
    assert drop(hfsm, "confirmation", at) == "A person confirms it already."
    assert hfsm.steps() == 2


def test_a_time_limit_is_set_where_there_is_none(hfsm: Drawer) -> None:
    at = hfsm.label_of("State000", "Operation000")
    assert drop(hfsm, "timeout", at) == "Operation000 fails after 60 s"
    branch = hfsm.session.blueprint["SB1"]
    assert branch.operation_note("State000", "Operation000").timeout == 60
    assert drop(hfsm, "timeout", at) == "It has a time limit."
    assert hfsm.steps() == 1


def test_an_operation_is_tried_again_at_a_higher_cost(hfsm: Drawer) -> None:
    before = errors(hfsm)
    said = drop(hfsm, "retry", hfsm.label_of("State000", "Operation000"))
    assert said == "Operation000 is tried 2 more times, each at a higher cost"
    assert list(hfsm.table()["State000"]) == [
        "Operation000", "Operation000_try2", "Operation000_try3",
    ]  # fmt: skip
    assert hfsm.selected() == ["State000/Operation000_try2", "State000/Operation000_try3"]
    assert errors(hfsm) == before
    said = drop(hfsm, "retry", hfsm.place("State100"))
    assert said == "Choose the operation that is tried again."
    assert hfsm.steps() == 1


def test_a_sub_sb_expands_the_fact_on_which_it_is_dropped(hanoi: Drawer, hfsm: Drawer) -> None:
    above = QPoint(0, -16)
    said = drop(hfsm, "sub_sb", hfsm.place("State111") + above)
    assert said == "SB3, a new State Branch, expands Fact 1 (digit 0)"
    assert hfsm.session.branch == "SB3"
    assert hfsm.selected() == ["State0", "State1"]
    assert hfsm.session.blueprint["SB1"].subs == {0: "SB3", 1: "SB2"}
    assert hfsm.steps() == 1
    assert "expands a fact" in drop(hanoi, "sub_sb", hanoi.place("State_aaa"))
    assert hanoi.steps() == 0


@pytest.mark.parametrize("template", TEMPLATES)
def test_elsewhere_a_template_says_what_it_needs(qtbot: QtBot, template: str) -> None:
    empty = Drawer(qtbot)
    said = drop(empty, template, QPoint(300, 300))
    assert said.endswith(".")
    assert empty.canvas.overlays.word.text == said
    assert empty.steps() == 0


@pytest.mark.parametrize("seed", range(4))
def test_any_templates_are_undone_to_the_same_bytes(hfsm: Drawer, seed: int) -> None:
    chance, text = random.Random(seed), hfsm.session.blueprint.document.text
    using = LibraryVerbs(hfsm.editor)
    for _ in range(20):
        branch = hfsm.session.blueprint[hfsm.session.branch]
        state = chance.choice([*branch.table])
        operation = chance.choice(["", *branch.table[state]])
        hfsm.session.select((Address(branch.name, state, operation),))
        before = hfsm.steps()
        using.insert(chance.choice([*TEMPLATES]))
        assert hfsm.steps() - before in (0, 1)
        assert hfsm.session.selection, "what was added is selected"
    while hfsm.steps():
        hfsm.session.history.undo()
    assert hfsm.session.blueprint.document.text == text


# In the window


def test_a_template_is_a_line_of_the_library_and_enter_uses_it(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    library = person.window.library
    person.select("SB1/State111")
    library.list.setFocus()
    library.list.setCurrentIndex(person.row(library.list, "Recovery"))
    QTest.keyClick(library.list, Key.Key_Return)
    assert person.steps() == ["Add a recovery to State111"]
    assert person.selected()[0] == "SB1/State11x"
    person.ctrl(Key.Key_Z)
    person.window.session.select(())
    QTest.keyClick(library.list, Key.Key_Return)
    assert person.window.canvas.overlays.word.text.startswith("Recovery: choose the state")
    library.filter.setText("time-o")
    assert [row.text for row in library.list.rows.rows] == ["Templates · 1", "Time-out"]


def test_the_menu_inserts_a_template_at_what_is_selected(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.select("SB1/State000/Operation000")
    person.window.actions_table["template_timeout"].trigger()
    assert person.steps() == ["Limit the time of Operation000"]
    assert person.selected() == ["SB1/State000/Operation000"]
