"""Watching files that are replaced, rewritten, deleted and created.

Untouched files are not read.
"""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.studio.document.files.on_disk import OnDisk
from smsl_studio.studio.features.draw.safety.watcher import Watcher


def test_every_way_to_change_a_file_stirs(qapp: QApplication, qtbot: QtBot, tmp_path: Path) -> None:
    path, late = tmp_path / "a.json", tmp_path / "late.json"
    path.write_text("{}")
    watcher = Watcher(qapp)
    watcher.watch([path, late, tmp_path / "none" / "b.json"])

    def replace() -> None:
        fresh = tmp_path / "fresh"
        fresh.write_text("{ }")
        fresh.replace(path)

    def append() -> None:
        with path.open("a") as stream:
            stream.write("\n")

    for change in (replace, append, replace, lambda: late.write_text("{}"), path.unlink):
        with qtbot.waitSignal(watcher.stirred, timeout=10_000):
            change()
    watcher.stop()
    watcher.deleteLater()


def test_a_folder_that_is_moved_stirs(qapp: QApplication, qtbot: QtBot, tmp_path: Path) -> None:
    path = tmp_path / "here" / "a.json"
    path.parent.mkdir()
    path.write_text("{}")
    watcher = Watcher(qapp)
    watcher.watch([path])
    with qtbot.waitSignal(watcher.stirred, timeout=10_000):
        path.parent.rename(tmp_path / "there")
    watcher.stop()
    watcher.deleteLater()


def test_constant_changes_beside_a_file_do_not_delay_looking_for_ever(
    qapp: QApplication, qtbot: QtBot
) -> None:
    watcher = Watcher(qapp)
    busy = QTimer(watcher)
    busy.timeout.connect(watcher.stir)
    busy.start(20)
    with qtbot.waitSignal(watcher.stirred, timeout=10_000):
        watcher.stir()
    busy.stop()
    watcher.stop()
    watcher.deleteLater()


def test_what_stands_on_the_disk_is_compared_by_its_text(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    file = str(path)
    on_disk = OnDisk()
    on_disk.saw(file, None)
    assert not on_disk.look(file).changed
    path.write_bytes(b"\xef\xbb\xbf{}\r\n")
    look = on_disk.look(file)
    assert (look.text, look.changed, look.gone) == ("\ufeff{}\r\n", True, False)
    on_disk.saw(file, look.text)
    assert not on_disk.look(file).changed
    path.write_bytes(b"\xff")
    look = on_disk.look(file)
    assert (look.text, look.changed, look.gone) == (None, True, False)
    path.unlink()
    look = on_disk.look(file)
    assert (look.text, look.changed, look.gone) == (None, True, True)


def test_texts_that_differ_are_named_in_order(tmp_path: Path) -> None:
    on_disk = OnDisk()
    on_disk.saw_if_new({"a": "1", "b": "2"})
    on_disk.saw_if_new({"a": "9", "c": "3"})
    assert on_disk.differing({"c": "3", "b": "x", "a": "1", "d": ""}) == ("b", "d")
    assert on_disk.digest("none") == ""
    first = on_disk.digest("a")
    on_disk.saw("a", "x")
    assert on_disk.digest("a") != first
    on_disk.forget()
    assert "a" not in on_disk
