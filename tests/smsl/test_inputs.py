"""Only regular files are opened, no pipe is waited for, and a part of a file is never read."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from smsl_studio.errors import FileChanged
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.inputs import NOTHING, open_ordinary, read_ordinary, seen_at

MOST = 1 << 20


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "x.json"
    path.write_bytes(b"a" * 1000)
    return path


def test_what_is_read_is_said_with_what_it_was(file: Path) -> None:
    seen, found = read_ordinary(file, MOST), file.stat()
    assert (seen.device, seen.inode, seen.raw) == (found.st_dev, found.st_ino, b"a" * 1000)
    assert len(read_ordinary(file, 10).raw) == 11, "one more than the most says that there is more"
    assert seen_at(file.with_name("gone"), MOST) == NOTHING
    os.utime(file)
    assert read_ordinary(file, MOST) == seen


def test_a_pipe_without_a_name_is_read_to_its_end() -> None:
    reader, writer = os.pipe()

    def feed() -> None:
        with os.fdopen(writer, "wb") as stream:
            stream.write(b"b" * 10)

    feeding = threading.Thread(target=feed)
    feeding.start()
    try:
        assert read_ordinary(f"/dev/fd/{reader}", MOST).raw == b"b" * 10
    finally:
        feeding.join()
        os.close(reader)


def test_a_pipe_with_a_name_is_refused_also_where_somebody_writes(tmp_path: Path) -> None:
    path = tmp_path / "pipe"
    os.mkfifo(path)
    both = os.open(path, os.O_RDWR)
    os.write(both, b"waiting")
    with pytest.raises(OSError, match="no ordinary file"):
        read_ordinary(path, MOST)
    os.close(both)


def while_reading(
    monkeypatch: pytest.MonkeyPatch, happens: Callable[[], object], often: int = 1
) -> None:
    """Let something happen after the first piece of a file was read."""
    read, left = os.read, [often]

    def slow(handle: int, length: int) -> bytes:
        part = read(handle, min(length, 100))
        if left[0] and part:
            left[0] -= 1
            happens()
        return part

    monkeypatch.setattr(os, "read", slow)


def test_a_file_that_is_written_while_it_is_read_is_read_again(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    while_reading(monkeypatch, lambda: file.write_bytes(b"b" * 900))
    assert read_ordinary(file, MOST).raw == b"b" * 900


def test_a_file_that_is_written_without_end_is_not_read(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    times = iter(range(10**9))
    while_reading(monkeypatch, lambda: os.utime(file, ns=(0, next(times))), 10**9)
    with pytest.raises(OSError, match="another program is writing it"):
        read_ordinary(file, MOST)


def test_a_file_that_is_replaced_while_it_is_compared_is_not_replaced_again(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is compared is the former file to its end; the name has another one by then."""
    over = read_ordinary(file, MOST)

    def replaced() -> None:
        fresh = file.with_name("fresh")
        fresh.write_bytes(b"theirs")
        fresh.replace(file)

    while_reading(monkeypatch, replaced)
    with pytest.raises(FileChanged):
        save_document(b"mine", file, over)
    assert file.read_bytes() == b"theirs"


def test_a_file_that_appears_is_not_replaced_by_a_new_one(tmp_path: Path) -> None:
    path = tmp_path / "new.json"
    save_document(b"first", path, NOTHING)
    with pytest.raises(FileChanged):
        save_document(b"second", path, NOTHING)
    assert path.read_bytes() == b"first"
    path.unlink()
    path.symlink_to(tmp_path / "goal.json")
    save_document(b"third", path, NOTHING)
    assert (tmp_path / "goal.json").read_bytes() == b"third"


@pytest.mark.parametrize("at", ["top", "way", "end"])
def test_below_a_folder_no_link_is_followed(tmp_path: Path, at: str) -> None:
    inner = tmp_path / "top" / "way"
    inner.mkdir(parents=True)
    (inner / "end").write_bytes(b"x")
    os.close(open_ordinary(inner / "end", str(tmp_path)))
    place = {"top": tmp_path / "top", "way": inner, "end": inner / "end"}[at]
    place.rename(tmp_path / "moved")
    place.symlink_to(tmp_path / "moved")
    os.close(open_ordinary(inner / "end"))
    with pytest.raises(OSError, match=r"no ordinary file|Not a directory|symbolic links"):
        open_ordinary(inner / "end", str(tmp_path))


def test_what_is_not_below_a_folder_is_not_opened(file: Path, tmp_path: Path) -> None:
    for path, folder in ((file, tmp_path / "inner"), (tmp_path, tmp_path)):
        with pytest.raises(OSError, match="does not lie in the folder"):
            open_ordinary(path, str(folder))
