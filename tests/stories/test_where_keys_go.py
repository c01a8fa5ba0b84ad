"""The keyboard focus is where the person looks, and the window shows where that is."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog

from smsl_studio.studio.base.overlays.name_line import NameLine
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.shell.frame.key_table import KeyTable
from tests.stories.at_outline import shown
from tests.stories.at_run import AtRun
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"


@pytest.mark.parametrize("key", [Key.Key_Tab, Key.Key_Slash])
def test_what_was_found_can_be_added_to_by_the_next_key(sit: Sit, key: Qt.Key) -> None:
    person = sit(HANOI)
    person.window.outline.tree.setFocus()
    person.ctrl(Key.Key_K)
    person.type("cbc")
    person.press(Key.Key_Return)
    person.press(key)
    assert isinstance(person.window.editor.field, ConnectCard)


def ring_is_painted(person: Person) -> bool:
    window = person.window
    corner = window.canvas.mapTo(window, QPoint(1, window.canvas.height() // 2))
    return window.grab().toImage().pixelColor(corner) == window.tokens.acc


def test_the_canvas_and_the_outline_show_which_of_them_has_the_keys(sit: Sit) -> None:
    person = sit(HFSM)
    tree = person.window.outline.tree
    person.window.canvas.setFocus()
    assert ring_is_painted(person)
    tree.setFocus()
    assert not ring_is_painted(person)
    row = tree.visualRect(tree.currentIndex())
    assert row.isValid()
    edge = tree.viewport().mapTo(person.window, QPoint(row.right() - 1, row.center().y()))
    assert person.window.grab().toImage().pixelColor(edge) == person.window.tokens.acc
    person.window.canvas.setFocus()
    assert person.window.grab().toImage().pixelColor(edge) != person.window.tokens.acc


@pytest.mark.parametrize("address", ["SB1/State100", "SB1/State100/Operation100A"])
def test_the_menu_key_opens_the_menu_of_what_is_selected(sit: Sit, address: str) -> None:
    person = sit(HFSM)
    canvas = person.window.canvas
    person.window.session.select([person.blueprint.resolve(address)])
    corner = QPoint(3, 3)
    asked = QContextMenuEvent(
        QContextMenuEvent.Reason.Keyboard, corner, canvas.viewport().mapToGlobal(corner)
    )
    QApplication.sendEvent(canvas.viewport(), asked)
    menu = QApplication.activePopupWidget()
    assert menu is not None
    try:
        assert menu.accessibleName() == f"Menu of {address.rpartition('/')[2]}"
    finally:
        menu.close()


def test_arrows_in_the_outline_take_the_canvas_along(sit: Sit) -> None:
    person = sit(HFSM)
    tree, session = person.window.outline.tree, person.window.session
    tree.setFocus()
    seen = {session.branch}
    for _ in shown(tree):
        QTest.keyClick(tree, Key.Key_Down)
        sheet = person.window.canvas.sheet
        assert sheet is not None
        assert sheet.picture.branch.name == session.branch
        assert tree.hasFocus()
        seen.add(session.branch)
    assert seen == set(session.blueprint.branches)


@pytest.mark.parametrize("mode", [Key.Key_2, Key.Key_3])
def test_after_f8_the_keys_go_to_what_is_watched(sit: Sit, mode: Qt.Key) -> None:
    person = sit(HANOI)
    run = AtRun(person)
    run.choose(world="table")
    person.press(Key.Key_F10)
    run.until_done(1)
    person.ctrl(mode)
    bar = person.window.features.supervise.pane.bar if mode == Key.Key_3 else run.pane.transport
    bar.play.setFocus()
    person.press(Key.Key_F8)
    run.until_phase("Stopped")
    focus = QApplication.focusWidget()
    assert focus is not None
    assert not person.window.mode_bar.segments.isAncestorOf(focus)
    assert focus.isVisible()
    assert focus.isEnabled()


def test_a_choice_that_is_locked_hands_the_keys_to_the_canvas(sit: Sit) -> None:
    person = sit(HANOI)
    run = AtRun(person)
    run.choose(world="table")
    run.pane.transport.world.setFocus()
    person.press(Key.Key_F10)
    run.until_done(1)
    assert run.pane.canvas.canvas.hasFocus()


@pytest.mark.parametrize("width", [560, 420])
def test_the_list_of_keys_is_not_scrolled_sideways(sit: Sit, width: int) -> None:
    person = sit()
    person.press(Key.Key_F1, [Qt.KeyboardModifier.ShiftModifier])
    dialog = next(d for d in person.window.findChildren(QDialog) if d.isVisible())
    dialog.resize(width, 620)
    QApplication.processEvents()
    table = dialog.findChild(KeyTable)
    assert table is not None
    assert sum(map(table.columnWidth, range(2))) <= table.viewport().width()
    dialog.close()
    person.come_back()


def test_the_legend_covers_no_state_wherever_one_looks(sit: Sit) -> None:
    person = sit(HFSM)
    canvas = person.window.canvas
    canvas.camera.motion = False
    legend = canvas.overlays.legend
    assert not legend.empty
    for zoom in (0.8, 1.3, 2.0):
        canvas.zoom_to(zoom)
        for dx in range(-900, 901, 300):
            for dy in (-300, 0, 300):
                canvas.fit(smooth=False)
                canvas.zoom_to(zoom)
                canvas.camera.pan(dx, dy)
                if legend.isHidden():
                    continue
                for name in canvas.positions:
                    rect = canvas.rect_of(person.blueprint.resolve(f"SB1/{name}"))
                    assert rect is not None
                    shown = canvas.mapFromScene(rect).boundingRect()
                    assert not shown.intersects(legend.geometry()), (zoom, dx, dy, name)


def test_a_key_that_shows_a_panel_puts_the_keys_there_and_back(sit: Sit) -> None:
    person = sit(HFSM)
    window = person.window
    person.ctrl(Key.Key_U)
    assert window.source.editor.hasFocus()
    person.press(Key.Key_End, [Qt.KeyboardModifier.ControlModifier])
    person.type(" ")
    person.until(lambda: window.session.edited)
    person.ctrl(Key.Key_U)
    assert window.canvas.hasFocus()
    shift, ctrl = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.ControlModifier
    for key, held, panel in (
        (Key.Key_P, ctrl | shift, window.properties),
        (Key.Key_I, ctrl, window.features.inspection.panel),
        (Key.Key_H, ctrl, window.history),
    ):
        person.press(key, [held])
        assert panel.isVisible()
        assert panel.hasFocus()
        person.press(key, [held])
        assert window.canvas.hasFocus()


def test_the_source_has_the_keys_also_where_its_side_was_hidden(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.actions_table["right_panel"].trigger()
    assert not person.window.source.isVisible()
    person.ctrl(Key.Key_U)
    assert person.window.source.editor.hasFocus()


def test_undo_takes_typed_letters_back_before_it_takes_a_step_back(sit: Sit) -> None:
    person = sit(HANOI)
    person.click_canvas(person.place("SB1/State_aaa"))
    person.press(Key.Key_F2)
    field = QApplication.focusWidget()
    assert isinstance(field, NameLine)
    before = field.text()
    person.type("xyz")
    assert field.text() != before
    person.ctrl(Key.Key_Z)
    assert field.text() == before
    assert field.hasFocus()
    assert person.steps() == []
    person.press(Key.Key_Escape)
    assert "State_aaa" in person.blueprint["SB1"].table
