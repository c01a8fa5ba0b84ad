"""Bends in the whole window: Properties, menus, pictures, comparison, and files."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.picture.svg import as_svg, draw_blueprint
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, sample
from tests.stories.test_compare import asked, at

HFSM = SAMPLES / "hfsm.json"
OP = Address("SB1", "State100", "Operation100B")


def bends(person: Person) -> int:
    edges = person.blueprint["SB1"].notes.edges
    return sum(len(layout.bends) for layout in edges.values())


def svg(person: Person) -> str:
    """The picture as it is rendered."""
    return as_svg(draw_blueprint(person.blueprint, ["SB1"])[0], "bent")


def test_properties_tell_bends_and_clear_them(sit: Sit) -> None:
    person = sit(HFSM)
    form = person.window.properties.line
    person.select("SB1/State100")
    assert form.isHidden()
    person.select(str(OP))
    assert (form.bends.text(), form.label.text()) == ("None", "Where there is room")
    assert form.clear.isHidden()
    person.click(form.add)
    assert form.bends.text() == "1 in Operation100B"
    assert form.bends.accessibleName() == "Bends: 1 in Operation100B"
    assert form.add.isHidden()
    assert person.window.canvas.hand.line.chosen == 0, "arrows move the new bend"
    person.press(Qt.Key.Key_Down)
    person.window.editor.bends.settle()
    session = person.window.session
    session.edit("Move", lambda b: editing.place_label(b, OP, (0.5, 0, 20)))
    assert form.label.text() == "Moved by hand"
    other = Address("SB1", "State100", "Operation100A")
    session.edit("Bend", lambda b: editing.set_bends(b, other, [(0.0, 0.0), (9.0, 9.0)]))
    person.select(str(OP), str(other))
    assert form.bends.text() == "3 in 2 operations"
    assert form.label.text() == "1 moved by hand"
    person.click(form.clear)
    assert bends(person) == 0
    person.click(form.reset)
    assert person.blueprint["SB1"].notes.edges == {}
    assert person.steps()[-2:] == ["Clear bends of 2 operations", "Reset label of 2 operations"]
    while session.history.canUndo():
        session.history.undo()
    assert person.blueprint.document.text == HFSM.read_text("utf-8")


def test_the_menu_at_the_pointer_offers_what_can_be_done(sit: Sit) -> None:
    person = sit(HFSM)
    window = person.window

    def offered() -> dict[str, bool]:
        menu = context_menu(
            window.session, window.editor, window.actions_table, window.clipping, OP
        )
        rows = ("Add bend", "Clear bends", "Reset label")
        found = {one.text().partition("\t")[0]: one.isEnabled() for one in menu.actions()}
        menu.deleteLater()
        return {words: found[words] for words in rows}

    assert offered() == {"Add bend": True, "Clear bends": False, "Reset label": False}
    person.window.actions_table["add_bend"].trigger()
    assert offered() == {"Add bend": True, "Clear bends": True, "Reset label": False}
    person.window.actions_table["clear_bends"].trigger()
    assert bends(person) == 0
    person.select("SB1/State100")
    for name in ("add_bend", "next_bend", "clear_bends", "reset_label"):
        assert not person.window.actions_table[name].isEnabled()


@pytest.mark.parametrize("suffix", [".json", ".smsl", ".yaml"])
def test_a_saved_drawing_opens_with_its_bends_and_is_rendered_with_them(
    sit: Sit, tmp_path: Path, suffix: str
) -> None:
    path = tmp_path / f"bent{suffix}"
    values = sample("hfsm.json").document.values
    path.write_text(form_named(suffix[1:]).write(values), encoding="utf-8")
    person = sit(path)
    before = svg(person)
    person.select(str(OP))
    person.window.actions_table["add_bend"].trigger()
    person.press(Qt.Key.Key_Down)
    person.press(Qt.Key.Key_Down)
    person.window.editor.bends.settle()
    canvas = person.window.canvas
    assert canvas.sheet is not None
    edge = canvas.sheet.picture.edge(OP)
    line = canvas.sheet.geometry.shape(edge)
    assert person.window.files.save()
    after = svg(person)
    assert after != before
    again = sit(path)
    assert again.blueprint["SB1"].notes.edges == person.blueprint["SB1"].notes.edges
    there = again.window.canvas.sheet
    assert there is not None
    assert there.geometry.shape(edge).is_like(line)
    assert svg(again) == after


def test_a_comparison_tells_a_redrawn_operation(sit: Sit, tmp_path: Path) -> None:
    person = sit(at(tmp_path, "hfsm.json"))
    person.select(str(OP))
    person.window.actions_table["add_bend"].trigger()
    dialog = asked(person, "compare_saved")
    assert "1 operation was redrawn" in dialog.summary
    assert dialog.changes.model().rowCount() == 2


def test_a_run_shows_the_line_as_it_is_drawn(sit: Sit) -> None:
    person = sit(HFSM)
    session = person.window.session
    session.edit("Bend", lambda b: editing.set_bends(b, OP, [(300.0, 200.0)]))
    person.window.set_mode("run")
    canvas = person.window.features.run.pane.canvas.canvas
    assert canvas.sheet is not None
    edge = canvas.sheet.picture.edge(OP)
    assert canvas.sheet.geometry.shape(edge).distance(300.0, 200.0) < 5.0
    assert canvas.gestures.line is None
