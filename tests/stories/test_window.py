"""The window itself: palette, keys, themes, the drawer, the status line."""

from __future__ import annotations

import pytest
from PySide6.QtCore import QEvent, QObject, QPoint, Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QApplication,
    QComboBox,
    QDialog,
    QHeaderView,
    QLabel,
    QLineEdit,
    QToolButton,
    QWidget,
)

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.errors import EditRefused
from smsl_studio.studio.shell.frame.key_table import KeyTable
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES

Key = Qt.Key
DOWN = QPoint(40, 120)
HANOI, REGISTRATION = SAMPLES / "hanoi.json", SAMPLES / "registration.json"


def test_the_palette_goes_to_a_state(sit: Sit) -> None:
    person = sit(HANOI)
    person.ctrl(Key.Key_K)
    palette = person.window.command_palette
    assert palette.isVisible()
    person.type("cbc")
    person.press(Key.Key_Return)
    assert person.selected() == ["SB1/State_cbc"]
    assert not palette.isVisible()


def test_the_palette_runs_a_command(sit: Sit) -> None:
    person = sit(REGISTRATION)
    before = person.window.canvas.positions
    person.drag(first := person.place("REGISTRATION/" + next(iter(before))), first + DOWN)
    person.click(person.window.mode_bar.search)
    person.type("tidy")
    person.press(Key.Key_Return)
    assert person.steps()[1:] == ["Tidy REGISTRATION"]
    assert person.window.canvas.positions == before
    person.ctrl(Key.Key_Z)
    person.ctrl(Key.Key_Z)
    assert not person.blueprint["REGISTRATION"].notes.layout


def test_the_palette_opens_a_sample(sit: Sit) -> None:
    person = sit(HANOI)
    person.ctrl(Key.Key_K)
    person.type("three-roots")
    person.press(Key.Key_Return)
    assert person.window.menu_row.title == "three-roots.json"
    assert person.window.files.path is None


def test_escape_closes_the_palette_and_gives_the_focus_back(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.canvas.setFocus()
    person.ctrl(Key.Key_K)
    person.press(Key.Key_Escape)
    assert not person.window.command_palette.isVisible()
    assert person.window.canvas.hasFocus()


def test_every_action_has_words_and_a_tip_and_no_key_means_two_things(sit: Sit) -> None:
    window = sit().window
    seen: dict[str, str] = {}
    for action in window.actions_table:
        assert action.words[:1].isupper(), action.id
        assert window.actions_table[action.id].toolTip(), action.id
        for key in action.keys:
            assert key not in seen, f"{key}: {seen.get(key)} and {action.id}"
            seen[key] = action.id
    buttons = window.mode_bar.findChildren(QToolButton)
    ours = [button for button in buttons if button.defaultAction() is not None]
    assert ours
    assert all(button.toolTip() and button.accessibleName() for button in ours)


def test_the_list_of_keys_names_every_key(sit: Sit) -> None:
    person = sit()
    person.press(Key.Key_F1, [Qt.KeyboardModifier.ShiftModifier])
    dialog = next(d for d in person.window.findChildren(QDialog) if d.isVisible())
    table = dialog.findChild(KeyTable)
    assert table is not None
    words = set(table.words)
    for action in person.window.actions_table:
        if action.keys:
            assert action.words.rstrip("…") in words
    dialog.close()
    person.come_back()


def test_a_theme_dresses_everything_and_is_remembered(sit: Sit) -> None:
    person = sit(REGISTRATION)
    window = person.window
    window.actions_table["theme_dark"].trigger()
    assert window.canvas.tokens.dark
    assert window.actions_table["theme_dark"].isChecked()
    assert person.windows.theme == "dark"
    picture = window.grab().toImage()
    assert picture.pixelColor(1100, 16) == window.tokens.win
    window.actions_table["theme_light"].trigger()
    assert not window.canvas.tokens.dark


def test_below_1280_the_left_panel_is_a_drawer(sit: Sit) -> None:
    person = sit(REGISTRATION, (1100, 760))
    docks = person.window.docks
    assert not docks.left.isVisible()
    person.click(person.window.mode_bar.left_button)
    assert docks.drawer.isVisible()
    assert person.window.outline.isVisible()
    person.click_canvas(person.window.canvas.rect().center())
    assert not docks.drawer.isVisible()
    person.window.resize(1440, 900)
    person.until(docks.left.isVisible)
    assert person.window.outline.isVisible()


def test_the_status_line_counts_and_places(sit: Sit) -> None:
    person = sit(HANOI)
    person.until_inspected()
    status = person.window.status_line
    assert status.words == "1 State Branch | 27 states | 78 operations | 2 errors, 1 note"
    person.select("SB1/State_cbb")
    assert status.place.text() == "Line 72, column 9"
    assert status.form.text() == "JSON, UTF-8"
    assert status.ending.text() == "Not a medical device"


def test_a_hint_and_the_status_line_are_never_in_one_place(sit: Sit) -> None:
    person = sit(HANOI)
    status = person.window.status_line
    status.showMessage("Run the blueprint in a world")
    person.ctrl(Key.Key_2)
    person.ctrl(Key.Key_1)
    assert not any(part.isVisible() for part in status.counts)
    status.clearMessage()
    assert all(part.isVisible() for part in status.counts)
    assert not any(part.isVisible() for part in status.run)


def test_a_long_reason_leaves_the_standing_notice_whole(sit: Sit) -> None:
    person = sit(HANOI)
    window, status = person.window, person.window.status_line
    window.resize(1280, 800)
    person.ctrl(Key.Key_2)
    reason = "Nothing permitted leads from SB1/State_aaa to SB1/State_zzz. " * 3
    left = ("World hanoi", "Seed 0", "Simulated 3.2 s", "Paced at real time", "Frozen", reason)
    status.show_run((left, ("Alive, 0.8 ms", "Simulation only")))
    person.until(lambda: status.ending.geometry().right() < status.width())
    assert status.ending.width() >= status.ending.sizeHint().width()
    assert window.width() == 1280


def test_a_count_that_grows_leaves_the_name_of_its_tab_whole(sit: Sit) -> None:
    person = sit(HANOI)
    tabs = person.window.docks.bottom_tabs
    tabs.set_count("Findings", 1)
    narrow = tabs.bar.tabRect(0).width()
    tabs.set_count("Findings", 2900)
    assert tabs.bar.tabRect(0).width() > narrow


def test_what_is_refused_is_a_line_and_no_dialog(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.session.refused.emit(EditRefused("that cannot be", advice="Do this."))
    assert person.window.toast.words == "That cannot be. Do this."
    person.click(person.window.toast)
    assert not person.window.toast.isVisible()


def test_undo_and_redo_follow_the_buttons(sit: Sit) -> None:
    person = sit(REGISTRATION)
    undo = person.window.actions_table["undo"]
    assert not undo.isEnabled()
    person.window.actions_table["add_branch"].trigger()
    assert undo.isEnabled()
    undo.trigger()
    person.press(
        Key.Key_Z, [Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier]
    )
    assert len(person.blueprint) == 2


def test_a_mode_changes_the_body_and_back(sit: Sit) -> None:
    person = sit(HANOI)
    person.ctrl(Key.Key_2)
    window = person.window
    shown = window.body.pages.currentWidget()
    assert shown is not None
    assert shown.isAncestorOf(window.features.run.pane)
    assert window.features.run.pane.isVisible()
    assert not window.docks.left.isVisible()
    assert window.focusWidget() is window.features.run.pane.canvas.canvas
    person.ctrl(Key.Key_1)
    assert window.canvas.isVisible()
    assert not window.features.run.pane.isVisible()
    assert window.focusWidget() is window.canvas
    assert window.docks.left.isVisible()
    assert window.docks.bottom.isVisible()


def test_stop_keeps_its_place_in_every_mode_while_a_run_exists(sit: Sit) -> None:
    person = sit(HANOI)
    window, pane = person.window, person.window.features.run.pane
    stop = window.mode_bar.stop
    assert not stop.isVisible()
    person.ctrl(Key.Key_2)
    person.choose(pane.transport.world, "table")
    place = pane.transport.stop.mapTo(window, pane.transport.stop.rect().center())
    person.press(Key.Key_F10)
    person.until(lambda: pane.run.phase == "paused")
    person.ctrl(Key.Key_1)
    assert stop.isVisible()
    assert stop.size() == pane.transport.stop.size()
    assert abs(stop.mapTo(window, stop.rect().center()).x() - place.x()) <= 2
    person.press(Key.Key_F8)
    person.until(lambda: pane.run.phase == "stopped")
    assert stop.isVisible()
    person.ctrl(Key.Key_3)
    bar = window.features.supervise.pane.bar
    assert bar.stop.size() == stop.size()
    assert abs(bar.stop.mapTo(window, bar.stop.rect().center()).x() - place.x()) <= 2
    person.ctrl(Key.Key_1)
    pane.run.end()
    person.until(lambda: not pane.run.exists)
    assert not stop.isVisible()


@pytest.mark.parametrize("mode", ["draw", "run", "supervise", "review"])
def test_everything_has_a_name_and_nothing_is_cut_at_1280(sit: Sit, mode: str) -> None:
    person = sit(REGISTRATION, (1280, 800))
    window = person.window
    window.set_mode(mode)
    person.until(lambda: window.size().width() == 1280)
    # What the check says comes by itself, and its words are given room in the next turn.
    person.until(lambda: all(one.text() != "Checking" for one in window.findChildren(QLabel)))
    QApplication.sendPostedEvents()
    window.repaint()
    for widget in window.findChildren(QWidget):
        part_of_qt = isinstance(widget.parent(), QLineEdit | QComboBox | QHeaderView)
        if widget.isVisible() and not part_of_qt and not widget.objectName().startswith("qt_"):
            check_named(widget)
            check_whole(widget)


def check_named(widget: QWidget) -> None:
    if isinstance(widget, QHeaderView):
        return
    if isinstance(widget, QLineEdit | QComboBox | QAbstractItemView):
        assert widget.accessibleName(), f"{widget} has no name"
    if isinstance(widget, QAbstractButton):
        assert widget.accessibleName() or widget.text(), f"{widget} has no name"
        assert widget.toolTip() or widget.text(), f"{widget.accessibleName()} has no tip"


def check_whole(widget: QWidget) -> None:
    if isinstance(widget, QAbstractButton):
        name = widget.accessibleName() or widget.text()
        assert widget.width() >= widget.minimumSizeHint().width(), f"{name} is cut"
    elif isinstance(widget, QLabel) and not widget.wordWrap() and widget.text():
        assert widget.width() >= widget.sizeHint().width() - 1, f"“{widget.text()}” is cut"


def test_panels_keep_their_widths_when_the_window_grows_and_shrinks(sit: Sit) -> None:
    person = sit(HANOI)
    docks = person.window.docks
    for size in ((1280, 800), (1920, 1080), (1280, 800)):
        person.window.resize(*size)
        person.until(lambda: person.window.body.width() > 0)
        assert (docks.left.width(), docks.right.width()) == (232, 304), size


def test_the_palette_over_a_name_being_edited_gives_the_focus_to_what_is_left(sit: Sit) -> None:
    person = sit(SAMPLES / "hfsm.json")
    person.select("SB1/State100")
    person.press(Key.Key_F2)
    assert person.window.editor.field is not None
    person.ctrl(Key.Key_K)
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    person.press(Key.Key_Escape)
    assert not person.window.command_palette.isVisible()


def test_the_canvas_of_run_is_drawn_when_it_is_seen(sit: Sit) -> None:
    person, fresh = sit(SAMPLES / "hfsm.json"), Address("SB1", "State011")
    session, canvas = person.window.session, person.window.features.run.pane.canvas.canvas
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State011"))
    assert canvas.sheet is None, "an edit in Draw waits for one canvas only"
    person.ctrl(Key.Key_2)
    assert canvas.rect_of(fresh) is not None
    session.edit("Delete", lambda bp: editing.delete(bp, [fresh]))
    assert canvas.rect_of(fresh) is None


class Opened(QObject):
    """Notes every window that comes up."""

    def __init__(self) -> None:
        super().__init__()
        self.windows: list[str] = []

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        if event.type() == QEvent.Type.Show and isinstance(watched, QWidget) and watched.isWindow():
            self.windows.append(type(watched).__name__)
        return False


def test_no_part_comes_up_as_a_window_of_its_own(sit: Sit, qapp: QApplication) -> None:
    opened = Opened()
    qapp.installEventFilter(opened)
    sit(SAMPLES / "hfsm.json")
    qapp.removeEventFilter(opened)
    assert opened.windows == ["Window"]
