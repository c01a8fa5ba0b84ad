"""The table of docs/gestures.md: each task is done with exactly as many gestures as it says."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QPoint, Qt

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.overlays.choices import ROW
from smsl_studio.studio.features.draw.canvas.rename_field import RenameField
from smsl_studio.studio.features.export.export_dialog import ExportDialog
from tests.stories.conftest import Sit
from tests.stories.counted import CountedHand
from tests.stories.person import SAMPLES

Key, Modifier = Qt.Key, Qt.KeyboardModifier
PAGE = Path(__file__).parents[2] / "docs" / "gestures.md"
OURS = "SMSL Studio"
NOT_SAID = "–"
THREE_TIMES = {
    "SB1": {"State0": {"go": "State1"}, "State1": {"go": "State2"}, "State2": {"go": "State0"}}
}

CLAMP = {"SB1": {"State0": {"close": "State1"}, "State1": {"open": "State0"}}}


def table() -> dict[str, dict[str, str]]:
    """The table of the page: task to product to what stands there."""
    lines = [line for line in PAGE.read_text("utf-8").splitlines() if line.startswith("| ")]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    head = next(row for row in rows if OURS in row)
    start = rows.index(head) + 1
    return {
        row[0]: dict(zip(head[1:], row[1:], strict=True))
        for row in rows[start:]
        if len(row) == len(head)
    }


def figure(cell: str) -> int:
    """The number that stands at the beginning of a cell."""
    found = re.match(r"\d+", cell)
    assert found is not None, cell
    return int(found[0])


# The tasks. Each begins as the page says, and ends with what has to be there.


def first_state(sit: Sit, folder: Path) -> int:
    person = sit()
    hand = CountedHand(person)
    hand.double_click(person.window.canvas.rect().center())
    hand.type("Home")
    hand.press(Key.Key_Return)
    assert list(person.blueprint["SB1"].table) == ["Home"]
    return hand.count


def operation_to_a_new_state(sit: Sit, folder: Path) -> int:
    person = sit()
    person.double_click_canvas(person.window.canvas.rect().center() - QPoint(200, 0))
    person.type("Home")
    person.press(Key.Key_Return)
    person.window.session.select(())
    hand = CountedHand(person)
    hand.drag_from_edge("SB1/Home", person.place("SB1/Home") + QPoint(240, 0))
    hand.type("Load")
    hand.press(Key.Key_Tab)
    hand.type("Loaded")
    hand.press(Key.Key_Return)
    assert dict(person.blueprint["SB1"].table["Home"]) == {"Load": "Loaded"}
    return hand.count


def chain_of_five(sit: Sit, folder: Path) -> int:
    person = sit()
    hand = CountedHand(person)
    hand.double_click(person.window.canvas.rect().center() - QPoint(300, 0))
    hand.names(["A", "One", "B", "Two", "C", "Three", "D", "Four", "E"], between=Key.Key_Tab)
    hand.press(Key.Key_Return)
    rows = {name: dict(row) for name, row in person.blueprint["SB1"].table.items()}
    assert rows == {"A": {"One": "B"}, "B": {"Two": "C"}, "C": {"Three": "D"}, "D": {"Four": "E"},
                    "E": {}}  # fmt: skip
    return hand.count


def inner_drawing(sit: Sit, folder: Path) -> int:
    path = folder / "clamp.json"
    path.write_text(json.dumps(CLAMP, indent=4))
    person = sit(path)
    hand, tabs = CountedHand(person), person.window.docks.left_tabs
    hand.click(tabs.bar, tabs.bar.tabRect(tabs.names.index("Library")).center())
    rows = person.window.library.list
    hand.drag_template(rows, "Sub-SB", "sub_sb", person.place("SB1/State0"))
    assert person.blueprint["SB1"].subs == {0: "SB2"}
    assert person.window.session.branch == "SB2"
    return hand.count


def rename_in_three_places(sit: Sit, folder: Path) -> int:
    path = folder / "go.json"
    path.write_text(json.dumps(THREE_TIMES, indent=4))
    person = sit(path)
    hand = CountedHand(person)
    hand.double_click(person.place("SB1/State0/go"))
    hand.type("move")
    field = person.window.editor.field
    assert isinstance(field, RenameField)
    hand.click(field.choices, QPoint(40, ROW + ROW // 2))
    assert [list(row) for row in person.blueprint["SB1"].table.values()] == [["move"]] * 3
    return hand.count


def retarget(sit: Sit, folder: Path) -> int:
    person = sit(SAMPLES / "hfsm.json")
    hand = CountedHand(person)
    operation = Address("SB1", "State000", "Operation000")
    hand.drag_arrowhead(operation, person.place("SB1/State110"))
    assert person.blueprint["SB1"].table["State000"]["Operation000"] == "State110"
    return hand.count


def another_source(sit: Sit, folder: Path) -> int:
    person = sit(SAMPLES / "hfsm.json")
    hand = CountedHand(person)
    operation = Address("SB1", "State000", "Operation000")
    hand.drag_tail(operation, person.place("SB1/State110"))
    assert person.blueprint["SB1"].table["State110"]["Operation000"] == "State100"
    return hand.count


def export(sit: Sit, folder: Path) -> int:
    person = sit(SAMPLES / "hfsm.json")
    hand = CountedHand(person)
    hand.press(Key.Key_E, Modifier.ControlModifier, Modifier.ShiftModifier)
    dialog = person.window.findChildren(ExportDialog)[-1]
    dialog.ask_file = lambda suggested: folder / suggested.name  # type: ignore[method-assign]
    written: list[Path] = []
    dialog.written.connect(written.append)
    hand.press(Key.Key_Return)
    person.qtbot.waitUntil(lambda: bool(written), timeout=60_000)
    assert written[0].read_text("utf-8").startswith("<svg")
    return hand.count


TASKS: dict[str, Callable[[Sit, Path], int]] = {
    "First state": first_state,
    "Operation to a new state": operation_to_a_new_state,
    "Chain of five states": chain_of_five,
    "Inner drawing of a state": inner_drawing,
    "Rename in three places": rename_in_three_places,
    "Another target": retarget,
    "Another source": another_source,
    "Export as a picture": export,
}


@pytest.mark.parametrize("task", TASKS)
def test_a_task_takes_as_many_gestures_as_the_page_says(
    sit: Sit, tmp_path: Path, task: str
) -> None:
    assert TASKS[task](sit, tmp_path) == figure(table()[task][OURS])


def test_no_other_product_needs_fewer_gestures_for_a_task() -> None:
    rows = table()
    assert list(rows) == list(TASKS)
    for task, row in rows.items():
        ours = figure(row[OURS])
        others = [figure(cell) for name, cell in row.items() if name != OURS and cell != NOT_SAID]
        assert others, task
        assert ours <= min(others), task
