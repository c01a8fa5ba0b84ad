"""Bundles in Run, Supervise, comparisons and exported pictures: as in the drawing, except what is
marked there."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.cli import main
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.features.draw.compare.dialog import CompareDialog
from smsl_studio.studio.features.export.export_dialog import ExportDialog
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.crowded import crowded_file
from tests.stories.person import LEFT, Person

STATES = [f"State_{at:03b}" for at in range(6)]
HIDDEN, OWN = 45, 10
"""How many operations have no line of their own if all are bundled; how many leave a state."""


@pytest.fixture
def crowded(tmp_path: Path) -> Path:
    """A file in which two operations lead from each state to each other, all with long names."""
    return crowded_file(tmp_path, STATES)


def bundled(canvas: Canvas) -> int:
    """How many operations have no line of their own."""
    assert canvas.sheet is not None
    return len(canvas.sheet.picture.bundles.hidden)


def alone(canvas: Canvas) -> set[Address]:
    """The operations that are in no bundle."""
    assert canvas.sheet is not None
    picture = canvas.sheet.picture
    every = range(len(picture.operations))
    return {picture.address(edge) for edge in every if not picture.bundles.count(edge)}


def chip(canvas: Canvas, a: str, b: str) -> QPoint:
    """The middle of the chip between two states, in pixels of the view."""
    assert canvas.sheet is not None
    picture, geometry = canvas.sheet.picture, canvas.sheet.geometry
    ends = {picture.index[a], picture.index[b]}
    for edge in picture.bundles.members:
        if {int(picture.source[edge]), int(picture.target[edge])} == ends:
            left, top, right, bottom = geometry.label(edge) or geometry.fallback(edge)
            return canvas.mapFromScene((left + right) / 2, (top + bottom) / 2)
    raise AssertionError(f"{a} and {b} have no bundle")


def point_at(canvas: Canvas, at: QPoint) -> None:
    """Move the pointer there."""
    none = Qt.MouseButton.NoButton
    where = canvas.viewport().mapToGlobal(at)
    move = QMouseEvent(
        QEvent.Type.MouseMove, QPointF(at), QPointF(where), none, none,
        Qt.KeyboardModifier.NoModifier,
    )  # fmt: skip
    QApplication.sendEvent(canvas.viewport(), move)


def by_hand(run: AtRun) -> None:
    """Begin a run by hand, in the initial state."""
    run.person.click(run.pane.transport.by_hand)
    run.person.press(Qt.Key.Key_F5)
    run.until_phase("Ready")


def test_a_run_is_bundled_as_the_drawing_and_shows_its_own_operations_alone(
    sit: Sit, crowded: Path
) -> None:
    person = sit(crowded)
    assert bundled(person.window.canvas) == HIDDEN
    run = AtRun(person)
    canvas = run.pane.canvas.canvas
    assert bundled(canvas) == HIDDEN
    by_hand(run)
    marks = canvas.marks
    marked = {*marks.trail, *marks.planned, *marks.possible}
    assert {one.state for one in marked} == {STATES[0]}
    assert alone(canvas) == marked, "each of these has a bundle, and two others stay in it"
    assert bundled(canvas) == HIDDEN - OWN
    # The choice in one view counts in the other.
    person.click(canvas.overlays.dense.all)
    assert (bundled(canvas), bundled(person.window.canvas)) == (0, 0)
    person.window.actions_table["bundle"].trigger()
    assert person.window.canvas.collapsed
    assert bundled(canvas) == HIDDEN - OWN


def test_the_card_of_a_bundle_stays_while_a_run_goes_on_and_a_row_asks_for_its_operation(
    sit: Sit, crowded: Path
) -> None:
    person = sit(crowded)
    run = AtRun(person)
    by_hand(run)
    canvas = run.pane.canvas.canvas
    canvas.camera.motion = False
    middle = canvas.rect_of(Address("SB", STATES[4]))
    assert middle is not None
    canvas.camera.go(middle.center(), 0.8)
    card = canvas.overlays.bundle
    at = chip(canvas, STATES[4], STATES[5])
    point_at(canvas, at)
    assert len(card.rows) == 4
    canvas.set_marks(replace(canvas.marks, goals=frozenset(STATES[:2])))
    assert card.isVisible()
    QTest.mouseClick(canvas.viewport(), LEFT, pos=at)
    assert card.pinned
    canvas.set_marks(replace(canvas.marks, goals=frozenset(STATES[:3])))
    assert card.isVisible()
    asked: list[Address] = []
    run.pane.canvas.chosen.connect(asked.append)
    person.click(card.rows[0])
    assert asked == [card.rows[0].line.address]
    assert not card.isVisible()


def test_the_full_map_of_supervise_is_bundled(sit: Sit, crowded: Path) -> None:
    person = sit(crowded)
    run = AtRun(person)
    by_hand(run)
    person.ctrl(Qt.Key.Key_3)
    pane = person.window.features.supervise.pane
    person.click(pane.head.map)
    person.qtbot.waitUntil(lambda: pane.pages.currentWidget() is pane.full_map)
    person.qtbot.waitUntil(lambda: pane.full_map.canvas.sheet is not None)
    assert bundled(pane.full_map.canvas) == bundled(run.pane.canvas.canvas) == HIDDEN - OWN


def compared(person: Person) -> CompareDialog:
    person.window.actions_table["compare_saved"].trigger()
    dialog = person.window.comparing.dialog
    assert dialog is not None
    person.qtbot.waitExposed(dialog)
    return dialog


def test_both_sides_of_a_comparison_bundle_what_did_not_change(sit: Sit, crowded: Path) -> None:
    person = sit(crowded)
    changed = Address("SB", STATES[0], "Op_PlanTheWholeWay0")
    person.window.session.edit("Delete", lambda b: edit.delete(b, [changed]))
    dialog = compared(person)
    before, after = dialog.before.canvas, dialog.after.canvas
    assert changed in alone(before)
    assert (bundled(before), bundled(after)) == (HIDDEN - 1, HIDDEN - 1)
    person.click(before.overlays.dense.all)
    assert (bundled(before), bundled(after)) == (0, 0)
    assert person.window.canvas.collapsed, "the drawing has a choice of its own"
    dialog.close()
    person.come_back()
    person.click(person.window.canvas.overlays.dense.all)
    dialog = compared(person)
    assert (bundled(dialog.before.canvas), bundled(dialog.after.canvas)) == (0, 0)


def test_a_side_with_few_operations_is_bundled_if_the_other_is_crowded(
    sit: Sit, crowded: Path
) -> None:
    person = sit(crowded)
    gone = [Address("SB", state) for state in STATES[4:]]
    person.window.session.edit("Delete", lambda b: edit.delete(b, gone))
    dialog = compared(person)
    assert dialog.before.canvas.collapsed
    assert dialog.after.canvas.collapsed
    assert bundled(dialog.after.canvas) == 18


def open_dialogs(person: Person) -> list[ExportDialog]:
    return [one for one in person.window.findChildren(ExportDialog) if one.isVisible()]


def exported(person: Person, path: Path, words: str = "") -> str:
    held = Qt.KeyboardModifier
    person.press(Qt.Key.Key_E, [held.ControlModifier, held.ShiftModifier])
    person.qtbot.waitUntil(lambda: bool(open_dialogs(person)))
    (dialog,) = open_dialogs(person)
    if words:
        dialog.what.setCurrentIndex(dialog.what.findText(words))
    person.qtbot.waitUntil(lambda: not dialog.bar.isVisible(), timeout=60_000)
    how = dialog.bundling.currentText()
    dialog.ask_file = lambda suggested: path  # type: ignore[method-assign]
    person.click(dialog.go)
    person.qtbot.waitUntil(lambda: not open_dialogs(person), timeout=60_000)
    person.come_back()
    return how


def test_a_picture_is_bundled_as_the_drawing(sit: Sit, crowded: Path, tmp_path: Path) -> None:
    person = sit(crowded)
    assert exported(person, tmp_path / "a.svg") == "Bundled"
    out = str(tmp_path / "b.svg")
    assert main(["render", str(crowded), "-o", out, "--collapse"]) == 0
    assert (tmp_path / "a.svg").read_bytes() == Path(out).read_bytes()
    # Of the bundle of two states an operation that was chosen alone is drawn alone.
    picked = [Address("SB", STATES[0], "Op_PlanTheWholeWay0"), Address("SB", STATES[4]),
              Address("SB", STATES[5])]  # fmt: skip
    person.window.session.select(tuple(picked))
    assert exported(person, tmp_path / "c.svg", "The selection") == "Bundled"
    text = (tmp_path / "c.svg").read_text("utf-8")
    assert text.count('stroke-width="4"') == 1
    assert ">PlanTheWholeWay0<" in text
    person.window.session.select(())
    person.click(person.window.canvas.overlays.dense.all)
    assert exported(person, tmp_path / "d.svg") == "Each by itself"
    assert main(["render", str(crowded), "-o", out]) == 0
    assert (tmp_path / "d.svg").read_bytes() == Path(out).read_bytes()


def test_keys_list_one_bundle_after_another_and_choose_an_operation(
    sit: Sit, crowded: Path
) -> None:
    person = sit(crowded)
    card = person.window.canvas.overlays.bundle
    person.press(Qt.Key.Key_L)
    first = [row.line.address for row in card.rows]
    assert {one.state for one in first} == set(STATES[:2])
    assert QApplication.focusWidget() is card.rows[0]
    person.press(Qt.Key.Key_L)
    assert {row.line.address.state for row in card.rows} == {STATES[0], STATES[2]}
    person.press(Qt.Key.Key_L, [Qt.KeyboardModifier.ShiftModifier])
    assert [row.line.address for row in card.rows] == first
    person.press(Qt.Key.Key_Down)
    assert QApplication.focusWidget() is card.rows[1]
    person.press(Qt.Key.Key_Return)
    assert person.selected() == [str(first[1])]
    assert not card.isVisible()
    assert person.window.canvas.hasFocus()
    person.press(Qt.Key.Key_L)
    person.press(Qt.Key.Key_Escape)
    assert not card.isVisible()
    assert person.window.canvas.hasFocus()
    person.click(person.window.canvas.overlays.dense.all)
    person.window.canvas.setFocus()
    person.press(Qt.Key.Key_L)
    assert not card.isVisible()
    assert "No operations are bundled" in person.window.canvas.overlays.word.text
