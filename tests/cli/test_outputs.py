"""A command never writes over a file that it has read, or that it has not seen."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from smsl_studio.smsl.pending_saves import pending_saves
from smsl_studio.smsl.together import save_together
from tests.cli.calls import calls, filled
from tests.cli.shell import Shell

TEXT = '{"_imports": ["inner.json"], "SB1": {"HEADER": {"SUB_SBS": {"SB2": 0}}, "State_0": {}}}'
INNER = '{"SB2": {"State_0": {"Up": "State_1"}, "State_1": {}}}'
TIDY = "laid out anew"


@pytest.fixture
def outer(tmp_path: Path) -> Path:
    path = tmp_path / "outer.json"
    path.write_text(TEXT)
    (tmp_path / "inner.json").write_text(INNER)
    return path


@pytest.fixture
def log(shell: Shell, outer: Path) -> Path:
    path = outer.with_name("log.html")
    shell("run", str(outer), "--world", "table", "--log", str(path))
    assert path.exists()
    return path


def same(file: Path) -> Path:
    return file


def spelt(file: Path) -> Path:
    return file.parent / "." / ".." / file.parent.name / file.name


def link(file: Path) -> Path:
    return linked(file, Path.symlink_to)


def hard_link(file: Path) -> Path:
    return linked(file, Path.hardlink_to)


def by_folder(file: Path) -> Path:
    folder = file.parent / "here"
    folder.symlink_to(file.parent)
    return folder / file.name


def linked(file: Path, make: Callable[[Path, Path], None]) -> Path:
    other = file.with_name(f"other{file.suffix}")
    make(other, file)
    return other


@pytest.mark.parametrize("name", [same, spelt, link, hard_link, by_folder])
@pytest.mark.parametrize("read", ["outer.json", "inner.json"])
def test_a_blueprint_is_not_converted_into_itself(
    shell: Shell, outer: Path, name: Callable[[Path], Path], read: str
) -> None:
    target = name(outer.with_name(read))
    answer = shell("convert", str(outer), "-o", str(target))
    assert answer.status == 2
    assert f"{target} is the same file as {outer.with_name(read)}" in answer.err
    assert "Name another file." in answer.err
    assert (outer.read_text(), outer.with_name("inner.json").read_text()) == (TEXT, INNER)


@pytest.mark.parametrize("make", [Path.symlink_to, Path.hardlink_to])
@pytest.mark.parametrize("suffix", [".svg", ".png", ".pdf"])
def test_a_picture_is_not_drawn_over_a_blueprint(
    shell: Shell, outer: Path, make: Callable[[Path, Path], None], suffix: str
) -> None:
    other = outer.with_name("other.json")
    other.write_text(TEXT)
    picture = outer.with_name(f"picture{suffix}")
    for read in (outer, outer.with_name("inner.json"), other):
        make(picture, read)
        for words in (["render", str(outer)], ["diff", str(outer), str(other)]):
            if words[0] == "diff" or read != other:
                answer = shell(*words, "-o", str(picture))
                assert (answer.status, "is the same file as" in answer.err) == (2, True)
        picture.unlink()
    assert {path.read_text() for path in outer.parent.glob("*.json")} == {TEXT, INNER}


@pytest.mark.parametrize("name", [same, spelt, link, hard_link, by_folder])
def test_an_account_is_not_written_over_its_log(
    shell: Shell, log: Path, name: Callable[[Path], Path]
) -> None:
    raw = log.read_bytes()
    answer = shell("replay", str(log), "-o", str(name(log)))
    assert answer.status == 2
    assert "would take its place" in answer.err
    assert log.read_bytes() == raw


def test_what_came_through_standard_input_is_not_replaced(
    shell: Shell, outer: Path, log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(outer.parent)
    kept = os.dup(0)
    try:
        for file, words in ((outer, ["convert", "-", "-o"]), (log, ["replay", "-", "-o"])):
            with file.open("rb") as stream:
                os.dup2(stream.fileno(), 0)
            raw = file.read_bytes()
            monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(raw)))
            answer = shell(*words, str(link(file)))
            assert answer.status == 2
            assert "the same file as the file on standard input" in answer.err
            assert file.read_bytes() == raw
    finally:
        os.dup2(kept, 0)
        os.close(kept)


def test_a_link_to_a_file_of_another_kind_is_no_output(shell: Shell, outer: Path) -> None:
    for name in ("bashrc", "notes.toml", "gone"):
        goal = outer.with_name(name)
        if name != "gone":
            goal.write_text("mine")
        picture = outer.with_name(f"{name}.svg")
        picture.symlink_to(goal)
        answer = shell("render", str(outer), "-o", str(picture))
        assert answer.status == 2
        assert f"{picture} leads to {goal}, which is a file of another kind" in answer.err
        assert goal.exists() == (name != "gone")
    goal = outer.with_name("real.svg")
    goal.write_text("former")
    picture.unlink()
    picture.symlink_to(goal)
    assert shell("render", str(outer), "-o", str(picture)).status == 0
    assert picture.is_symlink()
    assert goal.read_text().startswith("<")


def test_only_ordinary_files_are_outputs(shell: Shell, outer: Path, log: Path) -> None:
    odd = outer.parent
    (odd / "folder.svg").mkdir()
    os.mkfifo(odd / "pipe.svg")
    (odd / "null.svg").symlink_to("/dev/null")
    os.mkfifo(odd / "pipe.html")
    for words, name in (
        (["render", str(outer)], "folder.svg"),
        (["render", str(outer)], "pipe.svg"),
        (["render", str(outer)], "null.svg"),
        (["replay", str(log)], "pipe.html"),
        (["render", str(outer)], "/dev/stdout"),
        (["convert", str(outer)], "-"),
        (["replay", str(log)], "-"),
    ):
        answer = shell(*words, "-o", str(odd / name) if name[0] not in "-/" else name)
        assert (answer.status, answer.out) == (2, ""), name
        assert answer.err, name


# --- fmt ------------------------------------------------------------------------------------------


def meanwhile(monkeypatch: pytest.MonkeyPatch, happens: Callable[[], object]) -> None:
    """Let something happen while the new text is being written beside the file."""
    sync = os.fsync
    done: list[object] = []

    def fsync(handle: int) -> None:
        sync(handle)
        if not done:
            done.append(True)
            happens()

    monkeypatch.setattr(os, "fsync", fsync)


def anew(path: Path, text: str) -> None:
    fresh = path.with_name("fresh")
    fresh.write_text(text)
    fresh.replace(path)


def another_link(path: Path, text: str) -> None:
    other = path.with_name("another.json")
    other.write_text(text)
    path.unlink()
    path.symlink_to(other)


@pytest.mark.parametrize("write", [Path.write_text, anew, another_link])
@pytest.mark.parametrize("text", [TEXT.replace("State_0", "State_9"), TEXT], ids=["other", "same"])
def test_an_edit_that_another_program_makes_meanwhile_is_kept(
    shell: Shell,
    outer: Path,
    monkeypatch: pytest.MonkeyPatch,
    write: Callable[[Path, str], object],
    text: str,
) -> None:
    meanwhile(monkeypatch, lambda: write(outer, text))
    answer = shell("fmt", str(outer))
    if (write, text) == (Path.write_text, TEXT):
        assert (answer.status, TIDY in answer.err) == (0, True), "nothing was lost"
        return
    assert answer.status == 2
    assert f"{outer} was not saved: another program has written it since it was read" in answer.err
    assert "Read it, then save again." in answer.err
    assert outer.read_text() == text
    assert list(outer.parent.glob(".*")) == []


def test_a_file_that_is_taken_away_meanwhile_stays_away(
    shell: Shell, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    meanwhile(monkeypatch, outer.unlink)
    assert shell("fmt", str(outer)).status == 2
    assert not outer.exists()


# --- an interrupted save --------------------------------------------------------------------------


def test_every_command_says_that_it_read_another_file(
    shell: Shell, outer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    inner, replace = outer.with_name("inner.json"), os.replace

    def dies(source: object, target: object) -> None:
        if str(target) == str(inner):
            raise KeyboardInterrupt
        replace(source, target)  # type: ignore[arg-type]

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", dies)
        with pytest.raises(KeyboardInterrupt):
            save_together([(TEXT, outer), (INNER.replace("Up", "Higher"), inner)])
    (save,) = pending_saves()
    note = f"{inner}: read from {save.files[1].part}, because a save was interrupted\n"
    values = {"FILE": str(inner), "OTHER": str(outer), "OUT": str(outer.with_name("y"))}
    values |= {"FROM": "State_0", "TO": "State_1"}
    for words in (
        ["check", str(outer)],
        ["run", str(outer), "--world", "table"],
        ["render", str(outer), "-o", str(outer.with_name("x.svg"))],
        ["convert", str(outer), "-o", str(outer.with_name("x.smsl"))],
        ["diff", str(outer), str(outer)],
        *(filled(line, values) for line in calls().values()),
    ):
        answer = shell(*words)
        assert note in answer.err, words
        assert "interrupted" not in answer.out
    assert "Higher" in shell("route", str(inner), "--from", "State_0", "--to", "State_1").out
    assert inner.read_text() == INNER, "a command only reads it"
    assert shell("fmt", str(inner)).status == 0
    assert "Higher" in inner.read_text()
    assert "interrupted" not in shell("check", str(outer)).err
