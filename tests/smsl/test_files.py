"""A save writes the whole file or nothing."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier

import pytest

from smsl_studio.errors import FileChanged, SaveError
from smsl_studio.smsl.files import read_document, save_document
from smsl_studio.smsl.inputs import NOTHING
from smsl_studio.smsl.json_form import parse_json, write_json

NEW = parse_json(write_json({"SB1": {f"State{n}": {} for n in range(100)}}), "new.json")
OLD = b'{"SB1": {}}'


@pytest.fixture
def target(tmp_path: Path) -> Path:
    path = tmp_path / "procedure.json"
    path.write_bytes(OLD)
    return path


def test_what_is_saved_is_what_is_read(target: Path) -> None:
    save_document(NEW, target)
    assert read_document(target).text == NEW.text
    assert [path.name for path in target.parent.iterdir()] == [target.name]


def test_a_new_file_is_made(tmp_path: Path) -> None:
    save_document(NEW, tmp_path / "é.json")
    assert (tmp_path / "é.json").read_bytes() == NEW.encoded()


def test_short_writes_are_continued(target: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: write(handle, bytes(data)[:7]))
    save_document(NEW, target)
    assert target.read_bytes() == NEW.encoded()


def full_after(room: int) -> object:
    write, left = os.write, [room]

    def limited(handle: int, data: bytes) -> int:
        if not left[0]:
            raise OSError(errno.ENOSPC, "No space left on device")
        written = write(handle, bytes(data)[: left[0]])
        left[0] -= written
        return written

    return limited


def fails(*_: object) -> int:
    raise OSError(errno.EIO, "Input/output error")


def lies(_: int, data: bytes) -> int:
    return len(data)


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("write", full_after(0)),
        ("write", full_after(500)),
        ("write", lambda *_: 0),
        ("write", lies),
        ("fsync", fails),
        ("replace", fails),
        ("open", fails),
    ],
    ids=["full", "full in the middle", "nothing taken", "a lie", "fsync", "replace", "open"],
)
def test_where_saving_fails_the_old_file_stands_and_the_user_is_told(
    target: Path, monkeypatch: pytest.MonkeyPatch, name: str, fault: object
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(os, name, fault)
        with pytest.raises(SaveError, match="was not saved") as caught:
            save_document(NEW, target)
    assert "still stands" in caught.value.advice
    assert target.read_bytes() == OLD
    assert [path.name for path in target.parent.iterdir()] == [target.name]


def test_a_folder_and_a_file_without_a_folder_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "gone" / "a.json"):
        with pytest.raises(SaveError):
            save_document(NEW, path)


def test_a_file_that_may_only_be_read_is_not_replaced(
    target: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(SaveError, match="may only be read"):
        save_document(NEW, target)
    assert target.read_bytes() == OLD


def test_a_link_keeps_pointing_and_the_file_keeps_its_mode(target: Path) -> None:
    target.chmod(0o640)
    link = target.parent / "link.json"
    link.symlink_to(target.name)
    save_document(NEW, link)
    assert link.is_symlink()
    assert target.read_bytes() == NEW.encoded()
    assert target.stat().st_mode & 0o777 == 0o640


SAVER = """
import sys
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.json_form import parse_json, write_json
texts = [write_json({"SB": {f"State{n}": {"o": c * 40} for n in range(4000)}}) for c in "ab"]
while True:
    for text in texts:
        save_document(parse_json(text, "x"), sys.argv[1])
        print(flush=True)
"""


def test_a_kill_in_mid_save_loses_nothing(target: Path) -> None:
    for saves in (1, 2, 3):
        with subprocess.Popen(
            [sys.executable, "-c", SAVER, str(target)],
            stdout=subprocess.PIPE,
            cwd=Path(__file__).parents[2],
        ) as child:
            assert child.stdout is not None
            for _ in range(saves):
                child.stdout.readline()
            child.kill()
        values = read_document(target).values
        assert len(values["SB"]) == 4000
        assert len({str(state) for state in values["SB"].values()}) == 1


def test_of_several_writers_of_a_new_file_only_the_first_writes(tmp_path: Path) -> None:
    writers, start = 4, Barrier(4)

    def saved(path: Path, number: int) -> int | None:
        start.wait()
        try:
            save_document(f"{number}", path, NOTHING)
        except FileChanged:
            return None
        return number

    with ThreadPoolExecutor(writers) as pool:
        for count in range(40):
            path = tmp_path / f"{count}.json"
            tries = [pool.submit(saved, path, number) for number in range(writers)]
            done = [one.result() for one in tries]
            assert [f"{one}" for one in done if one is not None] == [path.read_text()]
    assert len(list(tmp_path.iterdir())) == 40, "nothing is left beside them"


def test_where_a_file_cannot_have_two_names_a_new_one_is_saved_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*names: object, **more: object) -> None:
        raise OSError(errno.EPERM, "no")

    monkeypatch.setattr(os, "link", refuse)
    path = tmp_path / "new.json"
    save_document("1", path, NOTHING)
    with pytest.raises(FileChanged):
        save_document("2", path, NOTHING)
    assert path.read_text() == "1"
