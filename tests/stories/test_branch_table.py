"""The drawing as a table: it is read by cells, and its cells select, lead on and edit."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.words import BLANK
from smsl_studio.studio.features.draw.panels.branch_model import HEADS
from smsl_studio.studio.features.draw.panels.branch_table import BranchTable
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
OP_1B = Address("SB1", "State_aaa", "Op_1b")
CTRL_SHIFT = [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]


def at_table(person: Person) -> BranchTable:
    """Go to the table by its key."""
    person.press(Key.Key_L, CTRL_SHIFT)
    table = person.window.docks.panel("Table")
    assert isinstance(table, BranchTable)
    person.until(table.hasFocus)
    return table


def cells(table: BranchTable) -> list[list[str]]:
    """What a screen reader reads, row by row."""
    read, model = QAccessible.queryAccessibleInterface(table), table.lines
    wide = model.columnCount() + 1
    # The first row and the first column are the heads.
    return [
        [
            read.child((row + 1) * wide + column).text(QAccessible.Text.Name)
            for column in range(1, wide)
        ]
        for row in range(model.rowCount())
    ]


def focused(table: BranchTable) -> list[str]:
    """The words of the cells that say that they have the keyboard focus."""
    read = QAccessible.queryAccessibleInterface(table)
    found = [read.child(at) for at in range(read.childCount())]
    return [one.text(QAccessible.Text.Name) for one in found if one.state().focused]


def first(table: BranchTable) -> str:
    """The words of the first cell."""
    return str(table.lines.index(0, 0).data())


def test_every_state_and_operation_has_its_row(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.until_inspected()
    table = at_table(person)
    read = cells(table)
    branch = person.blueprint["SB1"]
    expected = [(s, o, t) for s, out in branch.table.items() for o, t in out.items() or [("", "")]]
    assert len(read[0]) == len(HEADS)
    found = [(row[0].split(" (")[0], row[2], row[3]) for row in read]
    assert found == [(s, o or BLANK, t or BLANK) for s, o, t in expected]
    assert read[0][0] == "State000 (initial)"
    assert read[0][1] == "Fact 1: 0, Fact 2: 0, Fact 3: 0"
    assert "Cost 1." in read[0][4]
    warned = [row for row in read if row[2] == "Operation100B"]
    told = [f for f in person.window.findings.findings if f.address.operation == "Operation100B"]
    assert told
    assert all(finding.rule in warned[0][5] for finding in told)


def test_a_row_tells_whose_task_an_operation_is(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-people.json")
    person.window.session.show_branch("HEAD")
    rows = {row[2]: row[4] for row in cells(at_table(person))}
    fix = next(words for name, words in rows.items() if name.startswith("Op_FixHead"))
    assert "Done by human (nurse)." in fix


def test_a_finding_of_several_places_says_which_place_its_words_are_about(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-digitization.json")
    person.until_inspected()
    rows = {(row[0].split(" (")[0], row[2]): row for row in cells(at_table(person))}
    own, other = rows["State100", "ClearLandmarks"][5], rows["State110", "Registered"][5]
    said = "ClearLandmarks and ReinitState lead to State000"
    assert f"Note R18: {said}" in own
    assert f"Note R18, as at State100/ClearLandmarks: {said}" in other
    assert "Note R18: " not in other
    # What an operation does to the fact of a sub-SB is told, as the marks show it.
    assert "Turns Landmarks digitized off together with" in rows["State110", "ClearLandmarks"][4]
    assert "DIGITIZATION moves first." in rows["State110", "ClearLandmarks"][4]


def test_a_row_of_the_findings_names_the_further_places(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-digitization.json")
    person.until_inspected()
    read = QAccessible.queryAccessibleInterface(person.window.findings.list)
    rows = [read.child(at).text(QAccessible.Text.Name) for at in range(read.childCount())]
    (row,) = [one for one in rows if one.startswith("Note R17, REGISTRATION/")]
    assert row.endswith(
        "Also at State100/LandmarksPlanned, State110/LandmarksDigitized"
        " and State111/UsePrevRegister."
    )


def test_enter_comes_to_the_name_of_the_target(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    table = at_table(person)
    table.setCurrentIndex(table.lines.index(table.lines.row_of(OP_1B), 2))
    person.press(Key.Key_Return)
    assert table.currentIndex().data() == "State_baa"
    person.press(Key.Key_Right)
    person.press(Key.Key_Return)
    assert table.currentIndex().column() == 1, "from the facts to the facts"


def test_cells_select_and_enter_leads_on(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    table = at_table(person)
    person.press(Key.Key_Down)
    person.press(Key.Key_Home, [Qt.KeyboardModifier.ControlModifier])
    assert person.selected() == ["SB1/State000"]
    for _ in range(3):
        person.press(Key.Key_Right)
    assert person.selected() == ["SB1/State000/Operation000"]
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/State100"]
    assert table.hasFocus()
    # What is selected elsewhere is chosen here.
    person.select("SB1/State110/Operation110B")
    person.window.canvas.setFocus()
    assert [table.lines.rows[at.row()].operation for at in table.selectedIndexes()] == [
        "Operation110B"
    ]
    assert not focused(table), "the drawing has the focus"
    # The key leads back to the drawing, and a hidden table has no rows.
    table.setFocus()
    assert table.lines.rows[table.currentIndex().row()].operation == "Operation110B"
    assert focused(table) == ["Operation110B"]
    assert person.selected() == ["SB1/State110/Operation110B"]
    person.press(Key.Key_L, CTRL_SHIFT)
    assert person.window.canvas.hasFocus()
    person.window.show_tab("Findings")
    assert not table.lines.rows


def test_a_row_is_renamed_deleted_and_follows_undo(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    table = at_table(person)
    table.setCurrentIndex(table.lines.index(0, 0))
    person.press(Key.Key_F2)
    person.type("State010")
    person.press(Key.Key_Return)
    assert first(table) == "State010 (initial)"
    assert person.selected() == ["SB1/State010"]
    rows = len(table.lines.rows)
    table.setFocus()
    table.setCurrentIndex(table.lines.index(1, 2))
    person.press(Key.Key_Delete)
    assert len(table.lines.rows) == rows - 1
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert first(table) == "State000 (initial)"
    assert len(table.lines.rows) == rows
