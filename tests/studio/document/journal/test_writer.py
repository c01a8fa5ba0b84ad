"""The journal while a window works: kept up to date, emptied, and never blocking."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from smsl_studio.studio.document.journal.entry import JournalEntry, KeptText, decode
from smsl_studio.studio.document.journal.leftovers import left_behind
from smsl_studio.studio.document.journal.writer import Journal


class Work:
    """Work that is unsaved while it has a text."""

    def __init__(self) -> None:
        self.text = ""

    def __call__(self, changes: int) -> JournalEntry | None:
        return (
            JournalEntry("a", "", "a", "", changes, (KeptText("a", self.text),))
            if self.text
            else None
        )


@pytest.fixture
def work() -> Work:
    return Work()


@pytest.fixture
def journal(qapp: QApplication, work: Work, tmp_path: Path) -> Journal:
    return Journal(work, tmp_path / "journal")


def change(journal: Journal, work: Work, text: str) -> None:
    work.text = text
    journal.changed()


def until_safe(qtbot: QtBot, journal: Journal) -> None:
    qtbot.waitUntil(lambda: journal.safe == journal.changes)


def held(journal: Journal) -> str:
    assert journal.path is not None
    return decode(journal.path.read_bytes()).texts[0].text


def test_where_nothing_is_unsaved_nothing_is_written(
    journal: Journal, work: Work, qtbot: QtBot, tmp_path: Path
) -> None:
    journal.changed()
    until_safe(qtbot, journal)
    journal.close()
    assert not (tmp_path / "journal").exists()


def test_the_latest_text_is_kept_until_it_is_saved(
    journal: Journal, work: Work, qtbot: QtBot
) -> None:
    for text in ("one", "two", "three"):
        change(journal, work, text)
    until_safe(qtbot, journal)
    assert held(journal) == "three"
    change(journal, work, "")
    until_safe(qtbot, journal)
    assert journal.path is not None
    assert not journal.path.exists()
    journal.close()
    assert list(journal.path.parent.iterdir()) == []


def test_changes_without_a_pause_do_not_put_the_writing_off(
    journal: Journal, work: Work, qtbot: QtBot
) -> None:
    written: list[int] = []
    journal.acknowledged.connect(written.append)

    def busy() -> bool:
        change(journal, work, f"text {journal.changes}")
        return len(written) >= 3

    qtbot.waitUntil(busy)
    assert written == sorted(set(written))
    assert journal.flush()
    assert held(journal) == work.text
    journal.close()


def test_a_window_that_ends_leaves_its_work_and_one_that_closes_does_not(
    journal: Journal, work: Work, tmp_path: Path
) -> None:
    change(journal, work, "unsaved")
    assert journal.leave_behind()
    journal.changed()
    journal.close()
    (left,) = left_behind(tmp_path / "journal")
    assert left.entry.texts[0].text == "unsaved"
    left.drop()
    other = Journal(work, tmp_path / "journal")
    assert other.flush()
    other.close()
    assert left_behind(tmp_path / "journal") == ()


def test_a_folder_that_cannot_be_written_is_told_once_and_tried_again(
    journal: Journal, work: Work, qtbot: QtBot, tmp_path: Path
) -> None:
    said: list[str] = []
    journal.failed.connect(said.append)
    (tmp_path / "journal").write_text("in the way")
    for text in ("one", "two"):
        change(journal, work, text)
        assert not journal.flush()
    assert len(said) == 1
    assert "cannot be kept" in said[0]
    (tmp_path / "journal").unlink()
    change(journal, work, "three")
    until_safe(qtbot, journal)
    assert held(journal) == "three"
    journal.close()


def test_a_disk_that_fills_up_keeps_what_it_had(journal: Journal, work: Work, qtbot: QtBot) -> None:
    change(journal, work, "one")
    until_safe(qtbot, journal)
    assert journal.path is not None
    journal.path.with_suffix(".part").mkdir()
    change(journal, work, "two")
    with qtbot.waitSignal(journal.failed):
        pass
    assert held(journal) == "one"
    journal.path.with_suffix(".part").rmdir()
    change(journal, work, "three")
    until_safe(qtbot, journal)
    assert held(journal) == "three"
    journal.close()
