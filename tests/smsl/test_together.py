"""Several files are saved all together or not at all."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from smsl_studio.errors import ReadError, SaveError
from smsl_studio.smsl.disk import held
from smsl_studio.smsl.files import read_document, save_document
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.smsl.together import save_together
from smsl_studio.smsl.unfinished import finish_saves
from tests.smsl.killed import TEXTS, left_in, letter_in, save, targets
from tests.smsl.left_behind import left_unfinished

ROOT = Path(__file__).parents[2]
OLD, NEW = TEXTS["a"], TEXTS["b"]


def run(*words: str) -> Any:
    """What one of the programs of these tests has to say."""
    done = subprocess.run(
        [sys.executable, "-m", *words], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


MEMORY = Path("/dev/shm")
"""A disk in memory, where there is one: a slow disk makes hundreds of saves no more telling."""


@pytest.fixture
def quick() -> Iterator[Path]:
    with TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None) as folder:
        yield Path(folder)


@pytest.fixture
def three(quick: Path) -> list[Path]:
    files = targets(quick, 3)
    save(files, "a")
    return files


def stand(files: list[Path]) -> set[str]:
    return {path.read_text("utf-8") for path in files}


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*"))


def test_several_files_in_several_folders_are_saved(three: list[Path]) -> None:
    mode = three[1].stat().st_mode
    three[1].chmod(0o640)
    link = three[0].parent / "link.json"
    link.symlink_to(three[1].name)
    fresh = three[0].parent / "parts" / ("é" * 100 + ".json")
    save([three[0], link, three[2], fresh], "b")
    assert stand([*three, fresh]) == {NEW}
    assert link.is_symlink()
    assert three[1].stat().st_mode & 0o777 == 0o640 != mode
    assert left_in(three[0].parent) == left_in(three[2].parent) == []
    save_together([])
    save_together([(OLD, three[0]), (OLD, three[0])])
    assert stand(three[:1]) == {OLD}


@pytest.mark.parametrize("how", ["50", "steps"])
def test_a_kill_in_mid_save_leaves_all_old_or_all_new(quick: Path, how: str) -> None:
    counts = run("tests.smsl.killed", str(quick), how, "0")
    assert counts.pop("kills") >= 50
    unfinished = counts.pop("unfinished")
    assert how != "steps" or unfinished, "some files new and some old on the disk, and yet"
    assert set(counts.values()) == {0}


CALLS = ("open", "write", "fsync", "replace", "link", "fchmod", "fstat")


def fails_at(patch: pytest.MonkeyPatch, step: int, code: int) -> Callable[[], bool]:
    """Let the call of this number fail, and all of its kind after it; whether it came to that."""
    done = [0, ""]

    def failing(name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        def call(*args: Any, **more: Any) -> Any:
            done[0] += 1  # type: ignore[operator]
            if done[0] == step:
                done[1] = name
            if done[1] == name:
                raise OSError(code, os.strerror(code))
            return real(*args, **more)

        return call

    for name in CALLS:
        patch.setattr(os, name, failing(name, getattr(os, name)))
    return lambda: bool(done[1])


@pytest.mark.parametrize("fresh", [False, True], ids=["old", "new"])
def test_whatever_fails_nothing_is_half_done(
    three: list[Path], monkeypatch: pytest.MonkeyPatch, fresh: bool
) -> None:
    document = parse_json(NEW, "x")
    if fresh:
        three[1].unlink()
    before, step, refused = [path.exists() for path in three], 0, 0
    while True:
        step += 1
        with monkeypatch.context() as patch:
            failed = fails_at(patch, step, errno.ENOSPC)
            error = None
            try:
                save_together([(document, path) for path in three])
            except SaveError as caught:
                error = caught
            came = failed()
        if error is None or "cannot be replaced" in error.sentence:
            # Either no harm was done, or what stood there before cannot be brought back: then
            # the new bytes count, and take their places as soon as that is possible.
            assert {letter_in(read_document(path).text) for path in three} == {"b"}
            finish_saves(three[0].parent)
            finish_saves(three[2].parent)
            assert stand(three) == {NEW}
            save([path for path, there in zip(three, before, strict=True) if there], "a")
            for path, there in zip(three, before, strict=True):
                if not there:
                    path.unlink()
        else:
            refused += 1
            assert str(three[0].parent) in error.sentence
            assert "No space left on device" in error.sentence
            assert [path.exists() for path in three] == before
            assert stand([path for path in three if path.exists()]) == {OLD}
        assert left_in(three[0].parent) == left_in(three[2].parent) == []
        if not came:
            break
    assert refused > 10


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[tuple[Path, int]]:
    """A folder on a disk of 128 kB; where none can be made, the longest file that is allowed."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=128k", "none", str(folder)]
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        yield folder, 50_000
        return
    yield folder, 0
    subprocess.run(["umount", str(folder)], check=True)


def test_a_full_disk_leaves_the_old_files(small_disk: tuple[Path, int]) -> None:
    folder, limit = small_disk
    files = targets(folder, 3)
    save(files, "a")
    for count in (1, 3):
        said = run("tests.smsl.full", str(folder), str(limit), str(count))
        assert said["sentence"].startswith(f"{folder}")
        assert " was not saved: " in said["sentence"]
        assert "Free some room" in said["advice"]
        assert stand(files) == {OLD}
        assert [name for name in names(folder) if name.startswith(".")] == []


def test_what_cannot_be_saved_is_named(three: list[Path]) -> None:
    folder = three[0].parent
    for path, words in (
        (folder / "parts", "parts was not saved: it is no ordinary file"),
        (folder / "gone" / "a.json", "a.json was not saved: there is no such folder"),
        (folder / "nul\0", "was not saved: .*null byte"),
    ):
        with pytest.raises(SaveError, match=words) as caught:
            save_together([(NEW, three[0]), (NEW, path)])
        assert caught.value.advice.startswith("No file was changed.")
    with pytest.raises(SaveError, match=r"0.json was not saved: it is to be written twice"):
        save_together([(NEW, three[0]), (NEW, three[1]), (OLD, three[0])])
    for pairs in ([(NEW, three[0]), ("\ud800", three[1])], [("\ud800", three[1])]):
        with pytest.raises(SaveError, match=r"half a character \(U\+D800\)"):
            save_together(pairs)
    assert stand(three) == {OLD}
    assert left_in(folder) == []


# --- what others do with the same files ----------------------------------------------------------


def test_an_unfinished_save_is_finished_by_the_next(
    three: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    left_unfinished(three, monkeypatch)
    before = names(three[0].parent)
    assert {read_document(path).text for path in three} == {NEW}
    assert names(three[0].parent) == before, "reading writes nothing"
    save([three[0], three[1]], "a")
    assert [path.read_text("utf-8") == NEW for path in three] == [False, False, True]
    assert left_in(three[0].parent) == left_in(three[2].parent) == []


def test_finishing_says_what_it_brought_to_its_end(
    three: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    left_unfinished(three, monkeypatch)
    assert finish_saves(three[2].parent) == tuple(three[1:]), "from any of the folders"
    assert stand(three) == {NEW}
    assert finish_saves(three[0].parent) == ()
    assert finish_saves(three[0].parent / "gone") == ()
    assert finish_saves("nul\0") == ()


def test_what_others_have_written_since_is_not_overwritten(
    three: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    left_unfinished(three, monkeypatch)
    three[1].write_text('{"X": {}}')
    save_document(parse_json('{"Y": {}}', "y"), three[2])
    assert [len(read_document(path).values) for path in three] == [1, 1, 1]
    assert [*read_document(three[1]).values, *read_document(three[2]).values] == ["X", "Y"]
    assert finish_saves(three[0].parent) == ()
    assert [*read_document(three[1]).values, *read_document(three[2]).values] == ["X", "Y"]
    assert left_in(three[0].parent) == left_in(three[2].parent) == []


def test_a_save_that_is_being_made_is_left_alone(
    three: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    replace = os.replace
    seen: list[set[str]] = []

    def looks(source: Any, target: Any) -> None:
        if os.fspath(target).endswith(".json"):
            finish_saves(three[0].parent)
            finish_saves(three[2].parent)
            seen.append({read_document(path).text for path in three})
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", looks)
        save(three, "b")
    assert seen == [{NEW}] * 3
    monkeypatch.setattr("smsl_studio.smsl.together.PATIENCE", 0.0)
    with held([three[2].parent]), pytest.raises(SaveError, match="another program is saving"):
        save(three, "a")
    assert stand(three) == {NEW}


def test_a_part_that_cannot_take_its_place_brings_all_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = targets(tmp_path, 5)
    save(files[1:], "a")
    replace = os.replace
    seen: list[set[str]] = []

    def refuses(source: Any, target: Any) -> None:
        if os.fspath(target) == str(files[-1]):
            raise PermissionError(errno.EPERM, "Operation not permitted")
        moves = not os.fspath(target).endswith(".draft")
        if moves and (seen or os.fspath(target) == str(files[0])):
            seen.append({read_document(path).text for path in files})
        replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", refuses)
        with pytest.raises(SaveError, match=r"last.json was not saved: Operation not permitted"):
            save(files, "b")
    assert seen == [{NEW}] * 8, "four forth and four back, and who reads meanwhile sees no mixture"
    assert not files[0].exists()
    assert stand(files[1:]) == {OLD}
    assert left_in(tmp_path) == left_in(tmp_path / "parts") == []


def test_old_leftovers_of_saves_of_one_file_go(three: list[Path]) -> None:
    fresh, old = (three[0].with_name(f".0.json.{digit * 12}.part") for digit in "12")
    for path in (fresh, old):
        path.write_text("{")
    os.utime(old, (0, 0))
    others = [three[0].with_name(name) for name in (".0.json.saving", f".0.{'1' * 12}.part")]
    for path in others:
        path.write_text("{")
        os.utime(path, (0, 0))
    finish_saves(three[0].parent)
    assert fresh.exists()
    assert not old.exists()
    assert all(path.exists() for path in others), "what is none of ours stays"


def test_a_folder_that_was_taken_away_holds_up_nothing(
    three: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    left_unfinished(three, monkeypatch)
    shutil.rmtree(three[2].parent)
    save(three[:2], "a")
    assert stand(three[:2]) == {OLD}
    assert left_in(three[0].parent) == []


def test_a_file_without_end_and_a_pipe_are_read_as_far_as_is_sensible(tmp_path: Path) -> None:
    with (tmp_path / "long.json").open("wb") as stream:
        stream.truncate(10 << 30)
    with pytest.raises(ReadError, match="larger than 32 MB"):
        read_document(tmp_path / "long.json")
    os.mkfifo(tmp_path / "pipe.json")
    for odd in ("/dev/zero", "/dev/null", tmp_path / "pipe.json"):
        with pytest.raises(ReadError, match="cannot be read: it is no ordinary file"):
            read_document(odd)
    for odd in ("/", "", ".", "nul\0", tmp_path):
        with pytest.raises(ReadError, match="the file cannot be read: "):
            read_document(odd)
    script = f"{sys.executable} -m smsl_studio check <(echo '{{}}')"
    done = subprocess.run(["bash", "-c", script], cwd=ROOT, capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
