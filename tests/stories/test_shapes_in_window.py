"""Flatten, extract, put back and identify: shown on both sides, applied, undone, refused."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from smsl_studio.blueprint import editing
from smsl_studio.front.inputs import read
from smsl_studio.front.shapes import diff_behaviour, flatten
from smsl_studio.stop import heed
from smsl_studio.studio.features.draw.compare.linked_views import DOTS
from smsl_studio.studio.features.draw.shape import shape_edit
from smsl_studio.studio.features.draw.shape.identify_dialog import IdentifyDialog
from smsl_studio.studio.features.draw.shape.refused_shape import RefusedShape
from smsl_studio.studio.features.draw.shape.shape_preview import ShapePreview
from smsl_studio.studio.features.draw.shape.shape_verbs import ShapeVerbs
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
ROTMS = SAMPLES / "registration-digitization.json"


def shapes(person: Person) -> ShapeVerbs:
    return person.window.features.draw.shapes


def ask(person: Person, action: str) -> None:
    """Press a row of the Blueprint menu, and wait for what comes of it."""
    person.window.actions_table[action].trigger()
    person.until(lambda: shapes(person).card is None)


def preview(person: Person) -> ShapePreview:
    dialog = shapes(person).dialog
    assert isinstance(dialog, ShapePreview)
    person.until(dialog.isVisible)
    return dialog


def flat_file(folder: Path) -> Path:
    """The registration as one SB."""
    file = folder / "flat.json"
    file.write_text(flatten(read(ROTMS)).document.text, "utf-8")
    return file


def test_flatten_is_shown_on_both_sides_applied_and_undone(sit: Sit) -> None:
    person = sit(ROTMS)
    before, texts = person.blueprint, person.window.session.texts
    ask(person, "flatten")
    shown = preview(person)
    assert "It behaves as before, for this blueprint as written." in shown.said.text()
    assert shown.before.canvas.accessibleName() == "Canvas, Before"
    assert person.window.session.texts == texts
    person.click(shown.apply)
    assert shapes(person).dialog is None
    assert len(person.blueprint) == 1
    assert diff_behaviour(before, person.blueprint).equal
    assert person.steps() == ["Flatten"]
    person.come_back()
    person.ctrl(Key.Key_Z)
    assert person.window.session.texts == texts
    assert not person.window.session.edited


def test_flatten_keeps_the_written_form(sit: Sit, tmp_path: Path) -> None:
    from smsl_studio.front.outputs import convert

    file = tmp_path / "other.smsl"
    convert(read(SAMPLES / "hfsm.json"), file)
    person = sit(file)
    before = person.blueprint
    ask(person, "flatten")
    person.click(preview(person).apply)
    assert person.blueprint.document.form == before.document.form
    assert diff_behaviour(before, person.blueprint).equal


def test_a_sub_sb_is_put_back_into_its_base(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    before = person.blueprint
    assert not person.window.actions_table["inline"].isEnabled()
    person.window.session.show_branch("SB2")
    assert person.window.actions_table["inline"].isEnabled()
    ask(person, "inline")
    person.click(preview(person).apply)
    assert list(person.blueprint.branches) == ["SB1"]
    assert person.window.session.branch == "SB1"
    assert diff_behaviour(before, person.blueprint).equal is not None

    table = person.window.actions_table.table
    assert [table[name].menu for name in ("flatten", "extract", "inline", "identify")] == [
        "Blueprint"
    ] * 4
    assert table["extract"].pointer == ("state",)


def test_identify_lists_cuts_with_what_they_save_and_why(sit: Sit, tmp_path: Path) -> None:
    person = sit(flat_file(tmp_path))
    before = person.blueprint
    ask(person, "identify")
    dialog = shapes(person).dialog
    assert isinstance(dialog, IdentifyDialog)
    person.until(dialog.isVisible)
    words = str(dialog.rows.model().index(0, 0).data())
    assert words.startswith("REGISTRATION: 1 state becomes ")
    assert "is entered at State100+State0 and left through" in dialog.why.text()
    dialog.rows.setFocus()
    QTest.keyClick(dialog.rows, Key.Key_Return)
    shown = preview(person)
    person.until(lambda: min(one.canvas.zoom for one in (shown.before, shown.after)) > DOTS)
    person.click(shown.apply)
    assert len(person.blueprint) == 2
    assert person.window.session.history.count() == 1
    person.come_back()
    person.ctrl(Key.Key_Z)
    assert person.blueprint == before


def test_a_flat_hanoi_has_no_cut(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi-corrected.json")
    ask(person, "identify")
    assert shapes(person).dialog is None
    person.until(person.window.toast.isVisible)
    assert "No states could be a sub-SB" in person.window.toast.words


def test_selected_states_become_a_sub_sb(sit: Sit, tmp_path: Path) -> None:
    person = sit(flat_file(tmp_path))
    before = person.blueprint
    assert not person.window.actions_table["extract"].isEnabled()
    person.select("REGISTRATION/State100+State0")
    assert person.window.actions_table["extract"].isEnabled()
    ask(person, "extract")
    shown = preview(person)
    assert "becomes the sub-SB" in shown.said.text()
    person.click(shown.leave)
    assert person.blueprint is before, "Cancel changes nothing"
    ask(person, "extract")
    person.click(preview(person).apply)
    assert len(person.blueprint) == 2


def test_a_cut_that_cannot_be_is_refused_with_its_run(sit: Sit, tmp_path: Path) -> None:
    person = sit(flat_file(tmp_path))
    person.select("REGISTRATION/State100+State0", "REGISTRATION/State110+State1")
    before = person.blueprint
    ask(person, "extract")
    dialog = shapes(person).dialog
    assert isinstance(dialog, RefusedShape)
    person.until(dialog.isVisible)
    assert dialog.rows.model().rowCount() >= 1
    person.click(dialog.walk)
    page = person.window.features.inspection.panel.configuration
    person.until(page.run.isVisible)
    assert page.run.title.text() == "Run that shows why"
    assert len(page.run.lit.steps) == 1 + len(dialog_rows(page))
    person.until(lambda: not page.explorer.work)
    assert page.run.isVisible()
    assert person.blueprint is before


def dialog_rows(page: object) -> list[object]:
    """The operations of the run that is shown."""
    return [one for one in page.run.lit.steps if one.operation]  # type: ignore[attr-defined]


def test_undo_and_other_edits_close_the_preview(sit: Sit) -> None:
    person = sit(ROTMS)
    session = person.window.session
    session.edit("Add", lambda bp: editing.add_state(bp, "REGISTRATION", "State010"))
    ask(person, "flatten")
    shown = preview(person)
    QTest.keyClick(shown, Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    person.until(lambda: shapes(person).dialog is None)
    assert "State010" not in person.blueprint["REGISTRATION"].table
    assert len(person.blueprint) == 2
    assert "so the preview was closed" in person.window.toast.words
    assert not shown_now(person)
    person.come_back()

    ask(person, "flatten")
    preview(person)
    session.edit("Add", lambda bp: editing.add_state(bp, "REGISTRATION", "State010"))
    assert shapes(person).dialog is None
    assert not shown_now(person)
    assert len(person.blueprint) == 2


def shown_now(person: Person) -> list[ShapePreview]:
    """The previews that are open."""
    return [one for one in person.window.findChildren(ShapePreview) if one.isVisible()]


def test_a_search_that_lasts_is_called_off_or_ended_by_an_edit(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    def for_ever(*_: object) -> None:
        while True:
            heed()

    monkeypatch.setattr(shape_edit, "flatten", for_ever)
    person = sit(ROTMS)
    person.window.actions_table["flatten"].trigger()
    card = shapes(person).card
    assert card is not None
    assert card.cancel.hasFocus()
    person.press(Key.Key_Escape)
    assert shapes(person).card is None
    person.window.actions_table["flatten"].trigger()
    assert shapes(person).card is not None
    person.window.session.edit("Add", lambda bp: editing.add_state(bp, "REGISTRATION", "State010"))
    assert shapes(person).card is None
    assert len(person.blueprint) == 2


def test_shapes_are_changed_while_a_run_goes_on_and_stop_is_heard(sit: Sit) -> None:
    person = sit(ROTMS)
    pane = person.window.features.run.pane
    person.window.set_mode("run")
    pane.transport.by_hand.setChecked(True)
    person.press(Key.Key_F5)
    person.until(lambda: pane.run.exists and pane.run.status is not None)
    person.window.set_mode("draw")
    ask(person, "flatten")
    person.click(preview(person).apply)
    assert len(person.blueprint) == 1
    assert pane.run.blueprint is not None
    assert len(pane.run.blueprint) == 2, "the run keeps what it was begun with"
    person.come_back()
    ask(person, "identify")
    asked = shapes(person).dialog
    assert isinstance(asked, IdentifyDialog)
    QTest.keyClick(asked, Key.Key_F8)
    person.until(lambda: pane.run.phase == "stopped")
