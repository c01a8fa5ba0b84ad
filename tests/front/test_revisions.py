"""The versions of a file in git, also for odd file names, and on a machine without git."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.front.revisions import bytes_at, merging_commits, revisions
from tests.git_folder import git_folder


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    git_folder(tmp_path, monkeypatch)
    return tmp_path


def git(folder: Path, *arguments: str) -> None:
    subprocess.run(["git", *arguments], cwd=folder, check=True, capture_output=True, timeout=60)


def commit(folder: Path, path: Path, text: str, subject: str) -> None:
    path.write_text(text)
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", subject)


@pytest.mark.parametrize("name", ["plan.json", "-rf é '\"$(x)\n*.json", ":(top)a b.json"])
def test_every_commit_that_touched_the_file_the_latest_first(folder: Path, name: str) -> None:
    git(folder, "init", "-q")
    path = folder / name
    commit(folder, path, "one", "First")
    commit(folder, folder / "other", "x", "Something else")
    commit(folder, path, "two", "Second: 'quoted' é")
    found = revisions(path)
    assert [one.subject for one in found] == ["Second: 'quoted' é", "First"]
    assert {one.author for one in found} == {"Ada"}
    assert [bytes_at(path, one) for one in found] == [b"two", b"one"]


def test_a_file_is_followed_through_renames_and_from_a_folder_below(folder: Path) -> None:
    git(folder, "init", "-q")
    below = folder / "below"
    below.mkdir()
    old, new = folder / "old.json", below / "new.json"
    commit(folder, old, "a\nb\nc\nd\n", "First")
    old.rename(new)
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", "Renamed")
    found = revisions(new)
    assert [one.name for one in found] == ["below/new.json", "old.json"]
    assert bytes_at(new, found[1]) == b"a\nb\nc\nd\n"


def test_what_is_not_there_is_one_sentence(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = folder / "plan.json"
    path.write_text("{}")
    with pytest.raises(ReadError, match="in no git repository"):
        revisions(path)
    git(folder, "init", "-q")
    with pytest.raises(ReadError, match=r"no commit has plan\.json yet"):
        revisions(path)
    commit(folder, folder / "other", "x", "Other")
    git(folder, "rm", "-q", "--cached", "plan.json")
    git(folder, "commit", "-q", "--amend", "-m", "Other")
    with pytest.raises(ReadError, match=r"no commit has plan\.json yet"):
        revisions(path)
    with pytest.raises(ReadError, match="cannot be looked at"):
        revisions(folder / "nowhere" / "plan.json")
    monkeypatch.setenv("PATH", str(folder))
    with pytest.raises(ReadError, match="git is not installed here"):
        revisions(path)


def test_a_merge_that_has_not_ended_names_who_made_each_version(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    git(folder, "init", "-q", "-b", "main")
    path = folder / "plan.json"
    commit(folder, path, "base\n", "Base")
    git(folder, "checkout", "-q", "-b", "other")
    monkeypatch.setenv("GIT_AUTHOR_NAME", "Bea é")
    commit(folder, path, "theirs\n", "Theirs")
    git(folder, "checkout", "-q", "main")
    monkeypatch.setenv("GIT_AUTHOR_NAME", "Cas")
    commit(folder, path, "ours\n", "Ours")
    assert set(merging_commits(path)) == {"ours"}, "no merge is there yet"
    with pytest.raises(subprocess.CalledProcessError):
        git(folder, "merge", "other")
    found = merging_commits(path)
    assert {side: who for side, (who, _, _) in found.items()} == {
        "ours": "Cas", "theirs": "Bea é", "base": "Ada"
    }  # fmt: skip
    assert all(len(commit) == 40 and day.count("-") == 2 for _, day, commit in found.values())
