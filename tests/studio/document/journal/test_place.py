"""A journal's file and its lock tell whether its window still runs."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from smsl_studio.studio.document.journal.entry import JournalEntry, KeptText, encode
from smsl_studio.studio.document.journal.leftovers import MOST, left_behind
from smsl_studio.studio.document.journal.place import JournalFile


def entry(name: str = "a.json", when: str = "2026-01-01T00:00:00") -> JournalEntry:
    return JournalEntry(name, "", name, when, 1, (KeptText(name, "{}"),))


def leave(folder: Path, one: JournalEntry) -> Path:
    """What a window leaves that goes without closing."""
    place = JournalFile.take(folder)
    place.write(encode(one))
    place.let_go()
    return place.path


def test_a_living_window_is_not_offered(tmp_path: Path) -> None:
    place = JournalFile.take(tmp_path)
    place.write(encode(entry()))
    assert left_behind(tmp_path) == ()
    place.let_go()
    (left,) = left_behind(tmp_path)
    assert left.entry == entry()


def test_what_one_program_offers_no_other_offers(tmp_path: Path) -> None:
    leave(tmp_path, entry())
    (left,) = left_behind(tmp_path)
    assert left_behind(tmp_path) == ()
    left.keep()
    (again,) = left_behind(tmp_path)
    again.drop()
    assert list(tmp_path.iterdir()) == []


def test_what_another_user_left_is_not_offered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = leave(tmp_path, entry())
    me = os.geteuid()
    with monkeypatch.context() as patch:
        patch.setattr(os, "geteuid", lambda: me + 1)
        assert left_behind(tmp_path) == ()
    assert path.exists()
    (left,) = left_behind(tmp_path)
    left.drop()


def test_what_is_no_ordinary_file_is_neither_read_nor_written(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.journal")
    (tmp_path / "zero.journal").symlink_to("/dev/zero")
    (tmp_path / "folder.journal").mkdir()
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "x.lock").symlink_to(elsewhere / "made")
    leave(tmp_path, entry()).rename(tmp_path / "x.journal")
    assert left_behind(tmp_path) == ()
    assert list(elsewhere.iterdir()) == []


def test_the_lock_of_a_process_that_died_is_free(tmp_path: Path) -> None:
    code = (
        "import os, signal, sys\n"
        "from pathlib import Path\n"
        "from smsl_studio.studio.document.journal.place import JournalFile\n"
        "from smsl_studio.studio.document.journal.entry import *\n"
        "place = JournalFile.take(Path(sys.argv[1]))\n"
        "place.write(encode(JournalEntry('a', '', 'a', '', 1, (KeptText('a', '{}'),))))\n"
        "os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    subprocess.run([sys.executable, "-c", code, str(tmp_path)], check=False, timeout=30)
    (left,) = left_behind(tmp_path)
    assert left.entry.texts == (KeptText("a", "{}"),)
    left.drop()


def test_the_last_one_comes_first_and_no_more_than_a_person_reads(tmp_path: Path) -> None:
    for number in range(MOST + 2):
        leave(tmp_path, entry(f"{number}.json", f"2026-01-01T00:00:{number:02}"))
    found = left_behind(tmp_path)
    assert len(found) == MOST
    assert found[0].entry.name == f"{MOST + 1}.json"
    for left in found:
        left.drop()
    rest = left_behind(tmp_path)
    assert [left.entry.name for left in rest] == ["1.json", "0.json"]
    for left in rest:
        left.keep()


def test_what_cannot_be_read_is_put_aside_and_nothing_is_destroyed(tmp_path: Path) -> None:
    path = leave(tmp_path, entry())
    path.write_bytes(path.read_bytes()[:-1])
    whole = leave(tmp_path, entry("b.json"))
    (left,) = left_behind(tmp_path)
    assert left.place.path == whole
    assert path.with_suffix(".unreadable").exists()
    left.keep()


def test_locks_without_a_journal_are_swept(tmp_path: Path) -> None:
    (tmp_path / "1-2.lock").touch()
    living = JournalFile.take(tmp_path)
    assert left_behind(tmp_path) == ()
    assert [path.name for path in tmp_path.iterdir()] == [f"{living.path.stem}.lock"]
    living.let_go()
    assert list(tmp_path.iterdir()) == []


def test_a_missing_folder_is_no_error(tmp_path: Path) -> None:
    assert left_behind(tmp_path / "none") == ()
    odd = tmp_path / "odd.journal"
    odd.mkdir()
    assert left_behind(tmp_path) == ()


def test_a_write_that_fails_leaves_the_last_one(tmp_path: Path) -> None:
    place = JournalFile.take(tmp_path)
    place.write(b"old")
    place.path.with_suffix(".part").mkdir()
    try:
        place.write(b"new")
    except OSError:
        assert place.read() == b"old"
    else:
        raise AssertionError("a folder in the way was written to")
    place.let_go()
