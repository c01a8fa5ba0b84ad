"""The panels: outline, header, properties, findings, source, history."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from threading import Event

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QMenu

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.repair import Repair
from smsl_studio.stop import Stopped, heed
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from smsl_studio.studio.features.draw.canvas.sub_sb_menu import fill_sub_sbs
from smsl_studio.studio.features.draw.panels.finding_rows import FindingsView
from smsl_studio.studio.features.draw.panels.fix_list import FixList
from tests.stories.at_outline import click_line, texts
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person, sample

Key = Qt.Key
HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"
REGISTRATION = SAMPLES / "registration.json"


# Outline


def test_the_outline_shows_sub_sbs_below_their_fact_and_a_click_shows_them(sit: Sit) -> None:
    person = sit(HFSM)
    tree = person.window.outline.tree
    assert texts(tree) == ["SB1", "Fact 1", "Fact 2", "SB2", "Fact 1", "Fact 3"]
    click_line(tree, "SB2")
    assert person.window.session.branch == "SB2"
    assert person.window.canvas.rect_of(person.blueprint.resolve("SB2/State0")) is not None


def test_an_sb_is_renamed_in_the_outline_and_all_that_names_it_follows(sit: Sit) -> None:
    person = sit(HFSM)
    tree = person.window.outline.tree
    click_line(tree, "SB2")
    person.press(Key.Key_F2)
    person.type("Digits")
    person.press(Key.Key_Return)
    person.until(lambda: "Digits" in person.blueprint.branches)
    assert person.blueprint["SB1"].subs == {1: "Digits"}
    assert person.window.session.branch == "Digits"
    person.ctrl(Key.Key_Z)
    assert person.blueprint == sample("hfsm.json")


def test_an_sb_is_added_and_deleted_in_the_outline(sit: Sit) -> None:
    person = sit(HFSM)
    person.click(person.window.outline.add_button)
    person.press(Key.Key_Return)
    assert list(person.blueprint.branches) == ["SB1", "SB2", "SB3"]
    tree = person.window.outline.tree
    person.until(lambda: not tree.naming)
    QTest.keyClick(tree, Key.Key_Delete)
    assert list(person.blueprint.branches) == ["SB1", "SB2"]


# Header


def test_the_header_form_says_a_refusal_beside_the_field(sit: Sit) -> None:
    person = sit(HFSM)
    header = person.window.properties.header
    before = person.blueprint
    person.write(header.num_facts, "2")
    said = header.facts_line.refusal
    assert said.isVisible()
    assert "cannot be cut into 2" in said.text()
    assert person.blueprint is before
    person.write(header.num_facts, "three")
    assert "no number" in said.text()
    person.write(header.num_facts, "1.5")
    assert "no whole number" in said.text()
    assert not person.window.toast.words, "what the form says needs no second line"


def test_a_sub_sb_is_detached_and_attached_in_the_header_form(sit: Sit) -> None:
    person = sit(HFSM)
    header = person.window.properties.header
    assert "on exactly while SB2 stands in its activating state, State1" in header.sentence.text()
    person.choose(header.facts[0].sub, "New")
    assert person.blueprint["SB1"].subs == {0: "SB3", 1: "SB2"}
    assert person.steps()[-1] == "Attach SB3 to digit 0 of SB1"
    person.ctrl(Key.Key_Z)
    assert "SB3" not in person.blueprint.branches
    person.choose(header.facts[1].sub, "None")
    assert not person.blueprint["SB1"].subs
    person.choose(header.facts[2].sub, "SB2")
    assert person.blueprint["SB1"].subs == {2: "SB2"}
    assert len(person.steps()) == 2


def test_initial_and_activating_are_chosen_and_left_to_the_default(sit: Sit) -> None:
    person = sit(REGISTRATION)
    header = person.window.properties.header
    assert header.initial.currentText() == "Default (State_0000)"
    person.choose(header.initial, "State_1000")
    assert person.blueprint["REGISTRATION"].header.initial == "State_1000"
    person.choose(header.initial, "Default (State_0000)")
    assert person.blueprint["REGISTRATION"].header.initial is None
    assert person.blueprint == sample("registration.json")


def test_a_fact_gets_a_name_that_the_outline_shows(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.write(person.window.properties.header.facts[1].name, "Landmarks digitised")
    assert person.blueprint["REGISTRATION"].fact_name(1) == "Landmarks digitised"
    assert "Landmarks digitised" in texts(person.window.outline.tree)


# Properties


def test_a_state_is_renamed_titled_and_marked_safe_in_its_properties(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    form = person.window.properties.state
    person.write(form.name, "State010")
    assert person.selected() == ["SB1/State010"]
    assert person.blueprint["SB1"].table["State100"]["Operation100A"] == "State010"
    person.write(form.title, "Half way")
    person.click(form.safe)
    note = person.blueprint["SB1"].state_note("State010")
    assert note is not None
    assert (note.title, note.safe) == ("Half way", True)
    person.write(form.name, "State100")
    assert "already a state" in form.naming.refusal.text()


def test_a_click_on_an_operation_out_selects_it_and_it_is_led_elsewhere(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100")
    person.click_row(person.window.properties.state.operations, "Operation100B")
    assert person.selected() == ["SB1/State100/Operation100B"]
    form = person.window.properties.operation
    person.choose(form.target, "State000")
    assert person.blueprint["SB1"].table["State100"]["Operation100B"] == "State000"
    person.write(form.cost, "2.5")
    assert person.blueprint["SB1"].cost("State100", "Operation100B") == 2.5
    person.choose(form.actor, "Human")
    person.write(form.cost, "cheap")
    assert "no number" in form.line("cost").refusal.text()
    assert person.blueprint["SB1"].operation_note("State100", "Operation100B").actor == "human"


def test_what_is_being_typed_is_a_step_before_a_button_undoes_one(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100", "SB1/State110")
    person.click(person.window.properties.several.delete)
    person.select("SB1/State000")
    person.click(person.window.properties.state.title)
    person.type("Start")
    person.window.actions_table["undo"].trigger()
    assert person.steps() == ["Delete 2 elements", "Set title of State000 to “Start”"]
    assert "State100" not in person.blueprint["SB1"].table, "only the title is undone"


def test_several_are_deleted_as_one_step(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State100", "SB1/State110")
    several = person.window.properties.several
    assert several.delete.text() == "Delete 2 states"
    person.click(several.delete)
    assert list(person.blueprint["SB1"].table) == ["State000", "State111"]
    person.ctrl(Key.Key_Z)
    assert person.blueprint == sample("hfsm.json")


def test_without_a_selection_the_branch_header_stands_alone(sit: Sit) -> None:
    person = sit(HFSM)
    properties = person.window.properties
    person.select("SB1/State100")
    assert properties.state.isVisible()
    person.click_canvas(QPoint(20, 300))
    assert not properties.state.isVisible()
    assert properties.header.isVisible()


# Findings


def click_fix(person: Person, view: FindingsView, row: int) -> None:
    QTest.mouseClick(view.viewport(), LEFT, pos=view.button_rect(row).center())


def test_findings_jump_fix_and_are_undone(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    panel = person.window.findings
    first = panel.findings[0]
    assert (first.rule, str(first.address)) == ("R15", "SB1/State_cbb/Op_1c")
    person.click_row(panel.list, "SB1/State_cbb/Op_1c")
    assert person.selected() == ["SB1/State_cbb/Op_1c"]
    click_fix(person, panel.list, 0)
    assert "Op_1b" in person.blueprint["SB1"].table["State_cbb"]
    person.until_inspected()
    assert [f.rule for f in panel.findings].count("R15") == 1
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == HANOI.read_text()
    person.until_inspected()
    assert panel.summary.text() == "2 errors block approval"


def listed_fixes(person: Person) -> FixList:
    """Press "Fix all", and read what it will do."""
    person.click(person.window.findings.fix_all_button)
    person.until(lambda: isinstance(QApplication.activeModalWidget(), FixList))
    dialog = QApplication.activeModalWidget()
    assert isinstance(dialog, FixList)
    return dialog


@pytest.mark.parametrize("ends", ["by the button", "by an edit"])
def test_fixes_are_worked_out_beside_the_window_and_can_be_called_off(
    sit: Sit, monkeypatch: pytest.MonkeyPatch, ends: str
) -> None:
    called_off = Event()

    def long(blueprint: Blueprint, told: Callable[[int], object]) -> Repair:
        told(3)
        try:
            while not called_off.wait(0.001):
                heed()
        except Stopped:
            called_off.set()
            raise
        return Repair((), blueprint)

    monkeypatch.setattr("smsl_studio.studio.features.draw.panels.findings.mend_errors", long)
    person = sit(HANOI)
    person.until_inspected()
    button = person.window.findings.fix_all_button
    person.click(button)
    person.until(lambda: button.text() == "Computing the fixes, 3 so far. Cancel")
    if ends == "by the button":
        person.click(button)
        assert button.text() == "Fix both…"
    else:
        session = person.window.session
        session.edit("Add", lambda bp: editing.add_branch(bp, "SB2"))
    person.until(called_off.is_set)
    assert QApplication.activeModalWidget() is None
    monkeypatch.undo()
    person.until_inspected()
    person.click(listed_fixes(person).apply)
    assert "Op_1b" in person.blueprint["SB1"].table["State_cbb"]


def test_errors_with_a_certain_fix_are_listed_and_mended_as_one_step(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    assert person.window.findings.fix_all_button.text() == "Fix both…"
    dialog = listed_fixes(person)
    assert [f"{one.beside} {one.text}" for one in dialog.rows.rows.rows] == [
        "SB1/State_cbb/Op_1c Rename to Op_1b",
        "SB1/State_cbc/Op_2b Rename to Op_2a",
    ]
    assert not dialog.left.isVisible()
    assert person.steps() == []
    person.click(dialog.apply)
    assert person.blueprint == sample("hanoi-corrected.json")
    assert len(person.steps()) == 1


LOSSY = """{
  "SB1": {
    "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2, "NUM_STATES": 3},
    "State_00": {"go": "State_99", "on": "State_01"},
    "State_01": {"on": "State_11"},
    "State_11": {"back": "State_00"},
    "State_10": {"on": "State_11"}
  },
  "SB2": {
    "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1, "NUM_STATES": 7},
    "State_0": {"up": "State_1"},
    "State_1": {"down": "State_0"}
  }
}
"""


def test_what_is_deleted_or_guessed_is_left_to_a_person(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "lossy.json"
    path.write_text(LOSSY)
    person = sit(path)
    person.until_inspected()
    dialog = listed_fixes(person)
    assert "2 more errors have fixes that would delete something" in dialog.left.text()
    person.click(dialog.apply)
    table = person.blueprint["SB1"].table
    assert "State_10" in table
    assert table["State_00"]["go"] == "State_99"
    assert [person.blueprint[name].header.num_states for name in ("SB1", "SB2")] == [4, 2]
    person.until_inspected()
    person.come_back()
    person.ctrl(Key.Key_Period)
    assert len(person.steps()) == 1, "what is not certain is shown before it is done"
    assert person.selected() == ["SB1/State_00/go"]
    person.ctrl(Key.Key_Period)
    assert len(person.steps()) == 2
    assert person.blueprint["SB1"].table["State_00"]["go"] != "State_99"
    assert "State_10" in person.blueprint["SB1"].table


def test_a_fix_is_that_of_the_drawing_as_it_then_is(sit: Sit, tmp_path: Path) -> None:
    path = tmp_path / "lossy.json"
    path.write_text(LOSSY)
    person = sit(path)
    person.until_inspected()
    (alone,) = [f for f in person.window.findings.findings if f.rule == "R10"]
    session = person.window.session
    session.edit(
        "Connect", lambda bp: editing.add_operation(bp, "SB1", "State_00", "way", "State_10")
    )
    person.window.findings.fix(alone)
    assert "State_10" in person.blueprint["SB1"].table
    assert "has changed since this was found" in person.window.toast.words


def test_findings_by_keys_alone(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    person.press(Key.Key_F3)
    assert person.selected() == ["SB1/State_cbb/Op_1c"]
    person.press(Key.Key_F3)
    assert person.selected() == ["SB1/State_cbc/Op_2b"]
    person.ctrl(Key.Key_Period)
    assert "Op_2a" in person.blueprint["SB1"].table["State_cbc"]


def test_a_clean_blueprint_says_how_many_rules_were_checked(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json")
    person.until_inspected()
    assert [f.rule for f in person.window.findings.findings] == ["R04"]
    person.ctrl(Key.Key_Period)
    person.until_inspected()
    rules = person.window.inspector.rules
    assert person.window.findings.empty.isVisible()
    assert person.window.findings.empty.text() == f"No findings. {rules} rules checked."


# Source


def test_the_source_follows_the_selection_and_a_click_selects(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.actions_table["show_source"].trigger()
    source = person.window.source
    editor = source.editor
    person.until(source.isVisible)
    person.select("SB1/State_cbb")
    assert source.marked_lines == (72, 73, 74, 75, 76)
    cursor = editor.textCursor()
    assert cursor.blockNumber() == 71
    block = editor.document().findBlockByNumber(73)
    at = editor.blockBoundingGeometry(block).translated(editor.contentOffset())
    QTest.mouseClick(editor.viewport(), LEFT, pos=QPoint(110, int(at.center().y())))
    assert person.selected() == ["SB1/State_cbb/Op_1a"]
    assert editor.toPlainText() == HANOI.read_text()


def test_the_source_shows_the_exact_text_after_every_edit_and_undo(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.actions_table["show_source"].trigger()
    person.until(person.window.source.isVisible)
    person.select("SB1/State100")
    person.press(Key.Key_F2)
    person.type("State010")
    person.press(Key.Key_Return)
    shown = person.window.source.editor.toPlainText()
    assert shown == person.blueprint.document.text
    assert '"State010"' in shown
    person.ctrl(Key.Key_Z)
    assert person.window.source.editor.toPlainText() == HFSM.read_text()


# History


def test_a_click_in_the_history_goes_there(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    form = person.window.properties.state
    for name in ("State010", "State011", "State001"):
        person.write(form.name, name)
    person.window.actions_table["show_history"].trigger()
    history = person.window.history
    person.until(history.isVisible)
    person.click_row(history, "Rename State110 to State010")
    assert "State010" in person.blueprint["SB1"].table
    person.click_row(history, "Rename State011 to State001")
    assert "State001" in person.blueprint["SB1"].table
    person.click_row(history, "As it was opened")
    assert person.blueprint == sample("hfsm.json")


# Library


def test_the_library_counts_filters_and_selects(sit: Sit, tmp_path: Path) -> None:
    person = sit(HANOI)
    person.window.docks.show_tab("Library")
    library = person.window.library
    person.click_row(library.list, "Op_3a")
    assert set(person.selected()) == {"SB1/State_bbc/Op_3a", "SB1/State_ccb/Op_3a"}
    person.click(library.filter)
    person.type("op_2")
    names = [r.text for r in library.list.rows.rows if isinstance(r.payload, str)]
    assert names == ["Op_2a", "Op_2b", "Op_2c"]
    person.until(lambda: library.hint.text().startswith("Drag a line onto a state"))


# Beside the selected element


def test_the_card_repairs_the_selected_element(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    card = person.window.fix_card
    assert not card.isVisible()
    person.select("SB1/State_cbb/Op_1c")
    assert card.isVisible()
    assert card.fix.text() == "Rename to Op_1b"
    box = card.geometry()
    for name in person.blueprint["SB1"].table:
        assert not box.contains(person.place(f"SB1/{name}")), name
    person.click(card.fix)
    assert "Op_1b" in person.blueprint["SB1"].table["State_cbb"]
    person.until_inspected()
    assert not card.isVisible()
    assert person.window.canvas.hasFocus()


def test_the_card_goes_where_no_state_is(sit: Sit) -> None:
    person = sit(HANOI)
    canvas = person.window.canvas
    there = canvas.mapToScene(QPoint(120, 130))
    person.window.session.edit(
        "Move", lambda bp: editing.set_layout(bp, "SB1", {"State_aaa": (there.x(), there.y())})
    )
    person.until_inspected()
    person.select("SB1/State_cbb/Op_1c")
    card = person.window.fix_card
    assert card.isVisible()
    assert not card.geometry().contains(person.place("SB1/State_aaa"))


def test_the_menu_at_the_pointer_fits_what_lies_there(sit: Sit) -> None:
    person = sit(HFSM)
    window = person.window

    def words(address: str | None) -> list[str]:
        at = person.blueprint.resolve(address) if address else None
        menu = context_menu(
            window.session, window.editor, window.actions_table, window.clipping, at
        )
        found = [action.text().partition("\t")[0] for action in menu.actions() if action.text()]
        menu.deleteLater()
        return found

    assert words(None)[0] == "Add a state here"
    of_state = words("SB1/State100")
    # An edit adds its own row, so only the first and last rows are fixed.
    assert of_state[:6] == ["Add operation", "Rename", "Cut", "Copy", "Duplicate", "Delete"]
    assert {"Change a fact…", "Add note", "Group", "Insert template"} <= set(of_state)
    assert of_state[-2:] == ["Make initial", "Make activating"]
    assert person.selected() == ["SB1/State100"]
    of_operation = words("SB1/State100/Operation100A")
    assert of_operation[:5] == ["Rename", "Cut", "Copy", "Duplicate", "Delete"]
    assert {"Add bend", "Clear bends", "Insert template"} <= set(of_operation)
    assert not {"Make initial", "Extract as a sub-SB…", "Add operation"} & set(of_operation)
    state = person.blueprint.resolve("SB1/State100")
    shown = window.session, window.editor, window.actions_table, window.clipping
    menu = context_menu(*shown, state)
    next(a for a in menu.actions() if a.text() == "Make activating").trigger()
    assert person.blueprint["SB1"].activating == "State100"


def test_a_sub_sb_is_attached_from_the_mode_bar(sit: Sit) -> None:
    person = sit(REGISTRATION)
    menu = QMenu(person.window)
    fill_sub_sbs(person.window.session, person.window.drawing, menu)
    fact = menu.actions()[1].menu()
    assert isinstance(fact, QMenu)
    fact.actions()[-1].trigger()
    assert person.blueprint["REGISTRATION"].subs == {1: "SB1"}
    assert len(person.steps()) == 1
