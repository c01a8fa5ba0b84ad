"""Operations between the same two states as one line: its card, its choice, what opens it."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import QEvent, QPoint, Qt
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QApplication

from smsl_studio.studio.base.canvas.bundle_card import BundleCard
from smsl_studio.studio.base.overlays.dense_legend import DenseLegend
from smsl_studio.studio.shell.window import Window
from tests.stories.conftest import Sit
from tests.stories.crowded import crowded_file
from tests.stories.person import SAMPLES, Person

FILE, SB = SAMPLES / "registration.json", "REGISTRATION"
FAR = QPoint(8, 300)


def collapsed(sit: Sit) -> Person:
    person = sit(FILE)
    person.window.actions_table["bundle"].trigger()
    person.until(lambda: person.window.canvas.collapsed)
    return person


def card(person: Person) -> BundleCard:
    return person.window.canvas.overlays.bundle


def legend(person: Person) -> DenseLegend:
    return person.window.canvas.overlays.dense


def lines(person: Person) -> int:
    sheet = person.window.canvas.sheet
    assert sheet is not None
    return sheet.picture.line_count


def chip(person: Person, a: str, b: str) -> QPoint:
    """The middle of the chip between two states."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    pair = {sheet.picture.index[a], sheet.picture.index[b]}
    for edge in sheet.picture.bundles.members:
        if {int(sheet.picture.source[edge]), int(sheet.picture.target[edge])} == pair:
            left, top, right, bottom = sheet.geometry.label(edge) or sheet.geometry.fallback(edge)
            return person.on_canvas(((left + right) / 2, (top + bottom) / 2))
    raise AssertionError(f"{a} and {b} have no bundle")


def names(person: Person) -> list[str]:
    return [row.line.address.operation for row in card(person).rows]


def colours(image: QImage, at: QPoint) -> set[int]:
    return {image.pixel(at.x() + x, at.y() + y) for x in range(-8, 9) for y in range(-8, 9)}


def test_bundles_are_drawn_by_choice_and_change_no_file(sit: Sit) -> None:
    person = sit(FILE)
    assert lines(person) == 42
    assert not legend(person).isVisible()
    person.window.actions_table["bundle"].trigger()
    assert lines(person) == 26
    assert legend(person).bundles.text() == "Bundles 12"
    assert person.steps() == []
    assert not person.window.session.edited
    person.click(legend(person).all)
    assert (lines(person), legend(person).all.text()) == (42, "Collapse")
    person.click(legend(person).all)
    assert (lines(person), legend(person).all.text()) == (26, "Show all")


def test_the_pointer_opens_the_card_and_a_row_selects_its_operation(sit: Sit) -> None:
    person = collapsed(sit)
    at = chip(person, "State_1010", "State_1110")
    plain = person.window.canvas.viewport().grab().toImage()
    person.move_to(at)
    assert card(person).isVisible()
    assert card(person).title.text() == "1010 ↔ 1110"
    ends = {"State_1010", "State_1110"}
    own = [e.name for e in person.blueprint[SB].edges() if {e.source, e.target} == ends]
    assert sorted(names(person)) == sorted(own)
    assert {row.line.back for row in card(person).rows} == {False, True}
    assert not card(person).geometry().contains(at)
    lit = person.window.canvas.viewport().grab().toImage()
    assert colours(plain, at) != colours(lit, at), "the chip of the open card is filled"
    assert person.selected() == []
    row = card(person).rows[1]
    person.click(row)
    assert person.selected() == [str(row.line.address)]
    assert not card(person).isVisible()
    sheet = person.window.canvas.sheet
    assert sheet is not None
    assert sheet.picture.bundles.count(sheet.picture.edge(row.line.address)) == 0
    assert lines(person) == 27


def test_the_card_goes_with_the_pointer_unless_a_click_pins_it(sit: Sit) -> None:
    person = collapsed(sit)
    at = chip(person, "State_1010", "State_1110")
    person.move_to(at)
    assert card(person).isVisible()
    person.move_to(FAR)
    person.until(lambda: not card(person).isVisible())
    person.move_to(at)
    person.click_canvas(at)
    assert card(person).pinned
    assert person.selected() == []
    person.move_to(FAR)
    assert card(person).edge >= 0
    assert not card(person).leaving
    person.move_to(at)
    QApplication.sendEvent(card(person), QEvent(QEvent.Type.Leave))
    assert not card(person).leaving
    # A drag of the view takes it along; Escape and a click elsewhere close it.
    before = card(person).pos()
    person.window.canvas.camera.pan(40.0, 30.0)
    assert card(person).pos() - before == QPoint(40, 30)
    person.window.canvas.setFocus()
    person.press(Qt.Key.Key_Escape)
    assert not card(person).isVisible()
    at = chip(person, "State_1010", "State_1110")
    person.double_click_canvas(at)
    assert card(person).pinned, "a double click renames nothing here"
    assert person.window.features.draw.editor.field is None
    person.click_canvas(FAR)
    assert not card(person).isVisible()


def test_a_selected_state_opens_its_bundles_and_closes_them_again(sit: Sit) -> None:
    person = collapsed(sit)
    far = chip(person, "State_0000", "State_0010")
    button = legend(person).all
    place = button.mapToGlobal(button.rect().center())
    person.select(f"{SB}/State_1010")
    sheet = person.window.canvas.sheet
    assert sheet is not None
    own = sheet.picture.edges_of(sheet.picture.index["State_1010"])
    assert not any(sheet.picture.bundles.count(edge) for edge in own)
    assert "open" in legend(person).bundles.text()
    assert button.mapToGlobal(button.rect().center()) == place, "no button moves by a selection"
    assert chip(person, "State_0000", "State_0010") == far, "other bundles stay as they are"
    person.click_canvas(FAR)
    assert (lines(person), legend(person).bundles.text()) == (26, "Bundles 12")


def test_an_edit_keeps_the_drawing_collapsed(sit: Sit) -> None:
    person = collapsed(sit)
    far = chip(person, "State_0000", "State_0010")
    start = person.place(f"{SB}/State_1111")
    person.drag(start, start + QPoint(48, 48))
    assert person.steps() == ["Move State_1111"]
    person.click_canvas(FAR)
    assert (lines(person), chip(person, "State_0000", "State_0010")) == (26, far)
    person.ctrl(Qt.Key.Key_Z)
    assert lines(person) == 26


def open_again(person: Person, path: Path) -> None:
    window: Window = person.window
    assert window.files.open(path)


def test_a_crowded_drawing_is_collapsed_by_itself_until_somebody_chooses(
    sit: Sit, tmp_path: Path
) -> None:
    path = crowded_file(tmp_path, [f"State_{at:03b}" for at in range(8)])
    person = sit(path)
    assert lines(person) == 28
    assert legend(person).all.text() == "Show all"
    open_again(person, FILE)
    assert (lines(person), legend(person).isVisible()) == (42, False)
    open_again(person, path)
    assert lines(person) == 28
    person.click(legend(person).all)
    assert lines(person) == 112
    open_again(person, FILE)
    open_again(person, path)
    assert lines(person) == 112, "the choice is kept for the file"


def resets(folder: Path) -> Path:
    """A file in which every state can be reset."""
    table = {f"State_{at}": {"Op_Next": f"State_{at + 1}"} for at in range(7)} | {"State_7": {}}
    for at in range(1, 8):
        table[f"State_{at}"]["Op_Reset"] = "State_0"
    path = folder / "resets.json"
    path.write_text(json.dumps({"SB": table}), encoding="utf-8")
    return path


def test_ways_back_to_the_start_share_a_lane_that_lists_them(sit: Sit, tmp_path: Path) -> None:
    person = sit(resets(tmp_path))
    person.window.actions_table["bundle"].trigger()
    sheet = person.window.canvas.sheet
    assert sheet is not None
    assert (lines(person), len(sheet.picture.stubs)) == (8, 6)
    assert legend(person).back.text() == "Back to start 6"
    person.click(legend(person).back)
    assert card(person).pinned
    assert card(person).title.text().startswith("6 to start")
    assert [row.line.address.state for row in card(person).rows] == [
        f"State_{at}" for at in range(2, 8)
    ]
    row = card(person).rows[3]
    person.click(row)
    assert person.selected() == ["SB/State_5/Op_Reset"]
    picture = sheet.picture
    lane, own = picture.bundles.lane, picture.edge(row.line.address)
    assert picture.bundles.count(lane) == 5
    assert sheet.geometry.shape(own).way == "lane", "its full way is drawn"
    # The whole lane is drawn from the farthest state, also while one operation is alone.
    before = sheet.geometry.shape(lane).bounds
    person.click_canvas(FAR)
    assert sheet.geometry.shape(sheet.picture.bundles.lane).bounds == before
    middle = sheet.geometry.label(sheet.picture.bundles.lane)
    assert middle is not None
    person.move_to(person.on_canvas(((middle[0] + middle[2]) / 2, (middle[1] + middle[3]) / 2)))
    assert card(person).isVisible()


def looks_of(person: Person, state: str) -> dict[str, bool]:
    """For each other state whether it is dimmed."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    return {name: sheet.node_look(at).dimmed for at, name in enumerate(sheet.picture.names)}


def test_what_does_not_touch_the_selected_state_dims_in_a_collapsed_drawing(sit: Sit) -> None:
    person = collapsed(sit)
    sheet, table = person.window.canvas.sheet, person.blueprint[SB].table
    assert sheet is not None
    person.select(f"{SB}/State_0000")
    joined = {a for a, row in table.items() for b in row.values() if "State_0000" in (a, b)}
    joined |= set(table["State_0000"].values())
    assert {name for name, dim in looks_of(person, "State_0000").items() if not dim} == joined
    for edge, name in enumerate(sheet.picture.operations):
        ends = sheet.picture.names[sheet.picture.source[edge]], name
        touches = "State_0000" in (ends[0], table[ends[0]][name])
        look = sheet.edge_look(edge)
        assert (look.joined, look.dimmed and not look.lit) == (touches, not touches)
    person.click_canvas(FAR)
    assert not any(looks_of(person, "State_0000").values())
    person.click(legend(person).all)
    person.select(f"{SB}/State_0000")
    assert not any(looks_of(person, "State_0000").values()), "only a collapsed drawing dims"


def test_mixed_operations_dim_by_choice_and_stay_so_in_the_next_file(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-digitization.json")
    sheet = person.window.canvas.sheet
    assert sheet is not None
    branch, count = sheet.picture.branch, len(sheet.picture.operations)
    addresses = [sheet.picture.address(edge) for edge in range(count)]
    loads = {
        edge
        for edge, at in enumerate(addresses)
        if branch.operation_note(at.state, at.operation).subs == "load"
    }
    mixed = {edge for edge in range(count) if sheet.picture.kind(edge) == "mixed"}
    assert mixed - loads
    assert loads - mixed
    mixed |= loads
    at = person.place(str(addresses[min(mixed)]))
    plain = person.window.canvas.viewport().grab().toImage()
    person.window.actions_table["dim_mixed"].trigger()
    assert {edge for edge in range(count) if sheet.edge_look(edge).dimmed} == mixed
    assert colours(person.window.canvas.viewport().grab().toImage(), at) != colours(plain, at)
    person.window.actions_table["bundle"].trigger()
    assert legend(person).mixed.text() == f"Load and mixed {len(mixed)}, dimmed"
    person.click(legend(person).mixed)
    assert legend(person).mixed.text() == f"Load and mixed {len(mixed)}"
    person.click(legend(person).mixed)
    open_again(person, SAMPLES / "three-levels.json")
    assert person.window.canvas.quiet
    assert person.steps() == []


def test_the_pointer_on_a_state_shows_its_way_back(sit: Sit, tmp_path: Path) -> None:
    person = sit(resets(tmp_path))
    person.window.actions_table["bundle"].trigger()
    canvas = person.window.canvas
    sheet = canvas.sheet
    assert sheet is not None
    person.move_to(person.place("SB/State_4"))
    way = canvas.lit_layer.lane.way(sheet)
    assert way is not None
    state = sheet.picture.index["State_4"]
    x, y, w, h = sheet.geometry.boxes[state].tolist()
    assert abs(way.points[0, 0] - x) < w
    assert abs(way.points[0, 1] - y) <= h + 1.0
    lane = sheet.geometry.shape(sheet.picture.bundles.lane)
    assert abs(way.bounds[3] - lane.bounds[3]) < 1.0, "it lies on the lane"
    assert way.tip == lane.tip
    at = person.on_canvas(way.at(40.0 * sheet.unit))
    shown = colours(canvas.viewport().grab().toImage(), at)
    person.move_to(FAR)
    assert canvas.lit_layer.lane.way(sheet) is None
    assert colours(canvas.viewport().grab().toImage(), at) != shown
