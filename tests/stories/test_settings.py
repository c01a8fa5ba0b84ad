"""The settings: what a person changes takes effect at once, is kept, and can be taken back."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from smsl_studio.studio.base.calm import is_calm, set_calm
from smsl_studio.studio.base.own_keys import read_keys, written_keys
from smsl_studio.studio.base.settings import Settings
from smsl_studio.studio.base.wheel_habit import wheel_scrolls
from smsl_studio.studio.document.files.auto_save import AutoSave
from smsl_studio.studio.features.settings.dialog import SettingsDialog
from tests.plugin_folder import write_plugin
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key = Qt.Key
SHIPPED = SAMPLES / "hfsm.json"


@pytest.fixture(autouse=True)
def _motion() -> Iterator[None]:
    yield
    set_calm(False)


def copy_of_sample(folder: Path) -> Path:
    path = folder / "mine.json"
    path.write_bytes(SHIPPED.read_bytes())
    return path


def settings_of(person: Person) -> SettingsDialog:
    """Open the settings by their key."""
    person.press(Key.Key_Comma, [Qt.KeyboardModifier.ControlModifier])
    person.until(lambda: bool(person.window.findChildren(SettingsDialog)))
    return person.window.findChildren(SettingsDialog)[-1]


def press_key(dialog: SettingsDialog, name: str, key: str) -> None:
    """Choose an action and press its new key in the field."""
    dialog.keys.choose(name)
    dialog.keys.field.setFocus()
    wanted = QKeySequence(key)[0]  # type: ignore[index]
    QTest.keyClick(dialog.keys.field, wanted.key(), wanted.keyboardModifiers())
    dialog.keys.field.editingFinished.emit()


def test_theme_and_motion_change_at_once_and_are_kept(sit: Sit) -> None:
    person = sit(SHIPPED)
    dialog = settings_of(person)
    contrast = next(one for one in dialog.themes.buttons() if one.text() == "High contrast")
    contrast.click()
    assert person.window.tokens.name == "contrast"
    dialog.switches["Less motion"].click()
    assert is_calm()
    camera = person.window.canvas.camera
    camera.go(QPointF(500.0, 300.0), 2.0)
    assert camera.zoom == 2.0, "it is there at once"
    assert (Settings().theme, Settings().calm) == ("contrast", True)
    dialog.switches["Less motion"].click()
    camera.go(QPointF(0.0, 0.0), 0.5)
    assert camera.zoom == 2.0, "it is on its way"


def test_what_the_wheel_does_changes_at_once_and_is_kept(sit: Sit) -> None:
    person = sit(SHIPPED)
    dialog = settings_of(person)
    assert not wheel_scrolls()
    dialog.switches["The mouse wheel scrolls"].click()
    assert wheel_scrolls()
    assert Settings().wheel_scrolls
    dialog.switches["The mouse wheel scrolls"].click()
    assert not wheel_scrolls()
    assert not Settings().wheel_scrolls


def test_the_size_says_that_it_waits_for_the_next_start(sit: Sit) -> None:
    person = sit(SHIPPED)
    dialog = settings_of(person)
    dialog.size_choice.setCurrentIndex(4)
    dialog.size_choice.activated.emit(4)
    assert Settings().size == 200
    words = " ".join(one.text() for one in dialog.findChildren(QLabel))
    assert "takes effect when Studio starts next" in words
    assert "Nothing leaves this machine." in words
    assert str(person.windows.settings.folder) in words


def test_a_key_is_changed_in_all_windows_and_given_back(sit: Sit) -> None:
    person = sit(SHIPPED)
    other = sit(SHIPPED)
    dialog = settings_of(other)
    press_key(dialog, "tidy", "Ctrl+Alt+K")
    for window in (person.window, other.window):
        assert window.actions_table["tidy"].shortcut() == QKeySequence("Ctrl+Alt+K")
        assert "Ctrl+Alt+K" in window.actions_table["tidy"].toolTip()
    assert "“Tidy the drawing”" in dialog.keys.told.text()
    third = sit(SHIPPED)
    assert third.window.actions_table["tidy"].shortcut() == QKeySequence("Ctrl+Alt+K")
    dialog.keys.shipped.click()
    assert other.window.actions_table["tidy"].shortcut() == QKeySequence("Ctrl+Shift+T")
    dialog.keys.clear.click()
    assert third.window.actions_table["tidy"].shortcut().isEmpty()
    assert read_keys(Settings().text_of("keys")) == {"tidy": ()}


REFUSED = {
    "Ctrl+S": "Ctrl+S belongs to “Save”.",
    "F8": "F8 belongs to “Stop”.",
    "X": "X is typed in fields",
    "Shift+X": "Shift+X is typed in fields",
}


def test_a_conflict_is_told_and_changes_nothing(sit: Sit) -> None:
    person = sit(SHIPPED)
    dialog = settings_of(person)
    for key, words in REFUSED.items():
        press_key(dialog, "tidy", key)
        assert words in dialog.keys.refusal.text()
        assert person.window.actions_table["tidy"].shortcut() == QKeySequence("Ctrl+Shift+T")
    assert "run_stop" not in dialog.keys.rows
    assert "rename" not in dialog.keys.rows, "keys of the canvas stay"


def test_shipped_keys_that_somebody_else_has_now_are_not_given_back(sit: Sit) -> None:
    person = sit(SHIPPED)
    dialog = settings_of(person)
    press_key(dialog, "tidy", "Ctrl+Alt+K")
    press_key(dialog, "add_branch", "Ctrl+Shift+T")
    dialog.keys.choose("tidy")
    dialog.keys.shipped.click()
    assert "belongs to “Add State Branch”" in dialog.keys.refusal.text()
    assert person.window.actions_table["tidy"].shortcut() == QKeySequence("Ctrl+Alt+K")


@pytest.mark.parametrize(
    "text", ["[", "[]", '{"tidy": 3}', '{"tidy": [3, null]}', "[" * 100_000, "null", '"x"']
)
def test_keys_in_a_damaged_settings_file_count_as_none(text: str) -> None:
    assert set(read_keys(text).values()) <= {()}
    assert read_keys(written_keys({"tidy": ("Ctrl+K",)})) == {"tidy": ("Ctrl+K",)}


def test_a_file_saves_itself_and_only_where_nothing_would_be_asked(
    sit: Sit, tmp_path: Path
) -> None:
    path = copy_of_sample(tmp_path)
    person = sit(path)
    window = person.window
    saver = AutoSave(window.session, window.files, person.windows.settings, wait=0)
    before = path.read_bytes()

    def change() -> None:
        person.select("SB1/State110/Operation110A")
        person.press(Key.Key_Delete)

    change()
    assert not saver.save(), "off unless somebody has chosen it"
    person.ctrl(Key.Key_Z)
    settings_of(person).switches["Save the file by itself"].click()
    assert Settings().autosave
    window.findChildren(SettingsDialog)[-1].accept()
    person.come_back()
    window.canvas.setFocus()
    change()
    person.until(lambda: path.read_bytes() != before)
    assert not window.session.edited
    # What another program wrote is never overwritten.
    theirs = SHIPPED.read_bytes() + b"\n"
    path.write_bytes(theirs)
    window.session.select(())
    person.select("SB1/State000/Operation000")
    person.press(Key.Key_Delete)
    assert not saver.save()
    assert path.read_bytes() == theirs


def test_a_plugin_folder_is_searched_at_once_and_at_the_next_start(
    sit: Sit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SMSL_PLUGIN_PATH", "")
    monkeypatch.setenv("SMSL_PLUGIN_PATH_GIVEN", "")
    write_plugin(tmp_path, "lamp", "def register(library): ...")
    person = sit(SHIPPED)
    dialog = settings_of(person)
    part = dialog.plugins
    part.ask = lambda: str(tmp_path / "nowhere")
    part.add.click()
    assert "is no folder" in part.refusal.text()
    part.ask = lambda: str(tmp_path)
    part.add.click()
    plugins = person.windows.plugins
    assert os.environ["SMSL_PLUGIN_PATH"] == str(tmp_path)
    person.until(lambda: not plugins.looking and "lamp" in str(plugins.loaded))
    assert Settings().plugin_folders == (str(tmp_path),)
    part.list.setCurrentRow(0)
    part.remove.click()
    assert Settings().plugin_folders == ()
    assert os.environ["SMSL_PLUGIN_PATH"] == ""
