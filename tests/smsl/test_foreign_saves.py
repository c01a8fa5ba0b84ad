"""An interrupted save is finished only if this program began it for this user.

``three`` are the files of an interrupted save: without its record they hold old and new texts.
"""

from __future__ import annotations

import json
import os
import shutil
import socket
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

import pytest

from smsl_studio.errors import SaveError
from smsl_studio.home import saving_folder
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.pending_saves import PendingSave, pending_saves
from smsl_studio.smsl.together import save_together
from smsl_studio.smsl.unfinished import finish, finish_saves, interrupted_saves, undo
from tests.smsl.killed import TEXTS, left_in, save, targets
from tests.smsl.left_behind import left_unfinished

OLD, NEW = TEXTS["a"], TEXTS["b"]
TOKEN = "0" * 12


@pytest.fixture
def three(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    files = targets(tmp_path, 3)
    save(files, "a")
    left_unfinished(files, monkeypatch)
    return files


def texts(files: list[Path]) -> list[str]:
    return [path.read_text("utf-8") for path in files]


def read(files: list[Path]) -> list[str]:
    return [read_document(path).text for path in files]


def pending() -> PendingSave:
    (found,) = pending_saves()
    return found


def test_what_counts_is_said(three: list[Path]) -> None:
    assert read(three) == [NEW] * 3
    documents = [read_document(path) for path in three]
    parts = [str(file.part) for file in pending().files]
    assert [one.stands_in for one in documents] == ["", *parts[1:]]
    assert interrupted_saves([three[1]]) == interrupted_saves(three) == (pending(),)
    assert interrupted_saves([three[0], three[0].with_name("other.json")]) == ()


def test_dot_files_beside_a_file_are_not_believed(tmp_path: Path) -> None:
    """Three files that anybody may put there, as an earlier version believed them."""
    file = tmp_path / "x.json"
    file.write_text('{"SB1": {"State_0": {}}}')
    before = sha256(file.read_bytes()).hexdigest()
    foreign = {
        ".x.json.smsl-studio-saving": json.dumps([f".smsl-studio.{TOKEN}.journal", 0, before]),
        f".smsl-studio.{TOKEN}.journal": '["x.json"]',
        f".x.json.{TOKEN}-0.part": '{"FOREIGN": {"State_0": {}}}',
        f".x.json.{TOKEN}-0.old": "{}",
        f".{TOKEN}.journal": json.dumps(
            {"smsl-studio": "saving", "files": [[str(file), before, before]]}
        ),
    }
    for name, text in foreign.items():
        (tmp_path / name).write_text(text)
    assert list(read_document(file).values) == ["SB1"]
    assert finish_saves(tmp_path) == ()
    save_together([('{"A": {}}', file), ('{"B": {}}', tmp_path / "y.json")])
    assert file.read_text() == '{"A": {}}'
    for name, text in foreign.items():
        assert (tmp_path / name).read_text() == text, "it is not ours to take away"


def link(record: Path) -> None:
    elsewhere = record.with_name("elsewhere")
    record.rename(elsewhere)
    record.symlink_to(elsewhere)


def second_name(record: Path) -> None:
    os.link(record, record.with_name("second"))


def pipe(record: Path) -> None:
    record.unlink()
    os.mkfifo(record)


def listener(record: Path) -> None:
    record.unlink()
    with socket.socket(socket.AF_UNIX) as heard:
        heard.bind(str(record))


def huge(record: Path) -> None:
    with record.open("ab") as stream:
        stream.truncate(5 << 20)


def folder(record: Path) -> None:
    record.unlink()
    record.mkdir()


def other_name(record: Path) -> None:
    record.rename(record.with_name("x" + record.name))


def folder_open(record: Path) -> None:
    record.parent.chmod(0o777)


def folder_link(record: Path) -> None:
    elsewhere = record.parent.with_name("elsewhere")
    record.parent.rename(elsewhere)
    record.parent.symlink_to(elsewhere)


SPOILT: dict[str, Callable[[Path], object]] = {
    "a link": link,
    "a second name": second_name,
    "a pipe": pipe,
    "a socket": listener,
    "a huge file": huge,
    "a folder": folder,
    "another name": other_name,
    "one that others may write": lambda record: record.chmod(0o602),
    "one that a group may write": lambda record: record.chmod(0o620),
    "in a folder that others may write": folder_open,
    "in a folder that is a link": folder_link,
}


@pytest.mark.parametrize("spoil", SPOILT.values(), ids=SPOILT)
def test_a_record_that_others_could_have_written_is_not_believed(
    three: list[Path], spoil: Callable[[Path], object]
) -> None:
    spoil(pending().record)
    before = texts(three)
    assert list(pending_saves()) == []
    assert read(three) == before == [NEW, OLD, OLD]
    assert finish_saves(three[0].parent) == ()
    assert texts(three) == before


def test_a_record_of_another_user_is_not_believed(
    three: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    me = os.geteuid()
    with monkeypatch.context() as patch:
        patch.setattr(os, "geteuid", lambda: me + 1)
        assert read(three) == [NEW, OLD, OLD]
        assert finish_saves(three[0].parent) == ()
        with pytest.raises(SaveError, match="can be written by others, or is no folder of yours"):
            save(three, "a")
    assert read(three) == [NEW] * 3


@pytest.mark.parametrize(
    "written",
    [
        "",
        "[",
        "[" * 99999,
        "null",
        "[]",
        '{"files": 5}',
        '{"files": [5]}',
        '{"files": []}',
        '{"files": [["x.json", null, "HASH"]]}',
        '{"files": [["/", null, "HASH"]]}',
        '{"files": [["/tmp/../x.json", null, "HASH"]]}',
        '{"files": [["/x\\u0000.json", null, "HASH"]]}',
        '{"files": [["/x.json", 5, "HASH"]]}',
        '{"files": [["/x.json", null, "hash"]]}',
        '{"files": [["/x.json", null]]}',
    ],
)
def test_a_record_that_makes_no_sense_is_no_trap(three: list[Path], written: str) -> None:
    pending().record.write_text(written.replace("HASH", "0" * 64))
    assert list(pending_saves()) == []
    assert read(three) == [NEW, OLD, OLD]
    assert finish_saves(three[0].parent) == ()


def test_in_another_home_nothing_is_believed_and_nothing_taken_away(
    three: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        patch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "another"))
        assert read(three) == [NEW, OLD, OLD]
        assert finish_saves(three[0].parent) == finish_saves(three[2].parent) == ()
    assert read(three) == [NEW] * 3
    assert finish_saves(three[0].parent) == tuple(three[1:])


def swapped(part: Path) -> None:
    part.write_text('{"FOREIGN": {}}')


def part_link(part: Path) -> None:
    other = part.parent / "same bytes"
    part.rename(other)
    part.symlink_to(other)


def part_pipe(part: Path) -> None:
    part.unlink()
    os.mkfifo(part)


@pytest.mark.parametrize("spoil", [swapped, part_link, part_pipe, Path.unlink])
def test_other_bytes_beside_a_file_than_were_saved_are_not_believed(
    three: list[Path], spoil: Callable[[Path], object]
) -> None:
    part = pending().files[1].part
    spoil(part)
    kept = os.path.lexists(part)
    assert read(three) == [NEW, OLD, NEW]
    assert finish_saves(three[0].parent) == (three[2],)
    assert texts(three) == [NEW, OLD, NEW]
    assert not kept or not os.path.lexists(part), "the name was ours, and goes"


def test_a_file_that_is_a_link_by_now_is_left_alone(three: list[Path], tmp_path: Path) -> None:
    other = tmp_path / "elsewhere.json"
    three[1].rename(other)
    three[1].symlink_to(other)
    assert read(three) == [NEW, OLD, NEW]
    assert finish_saves(tmp_path) == (three[2],)
    assert three[1].is_symlink()
    assert other.read_text() == OLD


def test_a_folder_that_is_a_link_by_now_is_left_alone(three: list[Path], tmp_path: Path) -> None:
    parts, moved = three[2].parent, tmp_path / "moved"
    parts.rename(moved)
    parts.symlink_to(moved)
    finish_saves(tmp_path)
    assert (moved / "last.json").read_text() == OLD


def test_a_save_left_behind_can_be_undone(three: list[Path]) -> None:
    fresh = three[0].with_name("fresh.json")
    assert undo(pending())
    assert texts(three) == read(three) == [OLD] * 3
    assert list(pending_saves()) == []
    assert left_in(three[0].parent) == left_in(three[2].parent) == []
    assert not fresh.exists()


def test_undoing_leaves_what_others_have_written_since(three: list[Path]) -> None:
    three[0].write_text('{"X": {}}')
    three[2].write_text('{"Y": {}}')
    assert undo(pending())
    assert texts(three) == ['{"X": {}}', OLD, '{"Y": {}}']


def test_a_save_that_has_ended_meanwhile_is_no_longer_finished_or_undone(
    three: list[Path],
) -> None:
    found = pending()
    assert finish(found) == tuple(three[1:])
    assert finish(found) == ()
    assert not undo(found)
    assert texts(three) == [NEW] * 3


def test_a_drive_that_is_away_does_not_end_its_save(three: list[Path], tmp_path: Path) -> None:
    parts = three[2].parent
    parts.rename(tmp_path / "away")
    assert read(three[:2]) == [NEW] * 2
    (tmp_path / "away").rename(parts)
    assert read(three) == [NEW] * 3


def test_the_records_are_nobody_elses_to_read(three: list[Path]) -> None:
    folder = saving_folder()
    assert folder.stat().st_mode & 0o777 == 0o700
    assert pending().record.stat().st_mode & 0o777 == 0o600


def test_where_no_record_can_be_kept_nothing_is_saved(tmp_path: Path, home: Path) -> None:
    files = targets(tmp_path, 3)
    home.write_text("no folder")
    with pytest.raises(SaveError, match=r"0.json was not saved: .*saving cannot be made"):
        save(files, "a")
    home.unlink()
    home.mkdir()
    saving_folder().mkdir()
    saving_folder().chmod(0o770)
    with pytest.raises(SaveError, match="saving can be written by others") as caught:
        save(files, "a")
    assert "SMSL_STUDIO_HOME" in caught.value.advice
    assert left_in(tmp_path) == []
    shutil.rmtree(home)
    save(files, "a")
    assert texts(files) == [OLD] * 3
