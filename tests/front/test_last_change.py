"""Who changed an element last, in histories of git: by what the versions mean, not by lines."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import read
from smsl_studio.front.last_change import LastChange, last_change
from smsl_studio.stop import StopListener, Stopped, heeding
from tests.blueprint.merge.test_merge import BASE, changed
from tests.front.test_revisions import commit, folder, git

__all__ = ["folder"]
GO, BACK = Address("A", "S0", "go"), Address("A", "S2", "back")


def text(*changes: tuple[str, Any], indent: int = 1) -> str:
    return json.dumps(changed(*changes), indent=indent)


def asked(path: Path, address: Address) -> LastChange:
    return last_change(read(path), address, path)


def subject(path: Path, address: Address) -> str:
    found = asked(path, address)
    assert found.revision is not None, found.reason
    return found.revision.subject


@pytest.mark.parametrize("name", ["plan.json", "-rf $(x)*.json"])
def test_the_commit_that_changed_the_element_counts_and_not_the_lines(
    folder: Path, name: str
) -> None:
    git(folder, "init", "-q")
    path = folder / name
    commit(folder, path, text(), "First")
    commit(folder, path, text(("A|S0|go", "S2")), "Go on")
    commit(folder, path, text(("A|S0|go", "S2"), indent=4), "All lines are written anew")
    commit(folder, path, text(("A|S0|go", "S2"), ("A|S2|back", "S0"), indent=4), "Another one")
    assert subject(path, GO) == "Go on"
    assert subject(path, BACK) == "Another one"
    assert subject(path, Address("A", "S2")) == "Another one", "its operations belong to a state"
    assert subject(path, Address("B", "X0", "up")) == "First"
    found = asked(path, GO)
    assert found.revision is not None
    assert found.revision.author == "Ada"
    assert [line.strip() for line in found.lines] == ['"go": "S1",']
    assert found.changes
    assert "S2" in found.changes[0]
    assert found.uncommitted == ()


def test_a_merge_that_took_it_from_one_side_does_not_count(folder: Path) -> None:
    git(folder, "init", "-q", "-b", "main")
    path = folder / "plan.json"
    commit(folder, path, text(), "First")
    git(folder, "checkout", "-q", "-b", "side")
    commit(folder, path, text(("A|S0|go", "S2")), "On the side")
    git(folder, "checkout", "-q", "main")
    commit(folder, path, text(("B|X1|down", "X0")), "On main")
    git(folder, "merge", "-q", "-s", "ours", "--no-commit", "side")
    commit(folder, path, text(("A|S0|go", "S2"), ("B|X1|down", "X0")), "Joined")
    assert subject(path, GO) == "On the side"
    assert subject(path, Address("B", "X1", "down")) == "On main"


def test_a_file_with_a_former_name_is_followed(folder: Path) -> None:
    git(folder, "init", "-q")
    old, new = folder / "old.json", folder / "new.json"
    commit(folder, old, text(), "First")
    commit(folder, old, text(("A|S0|go", "S2")), "Go on")
    old.rename(new)
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", "Renamed")
    assert subject(new, GO) == "Go on"


def test_what_is_not_committed_is_told_apart(folder: Path) -> None:
    git(folder, "init", "-q")
    path = folder / "plan.json"
    commit(folder, path, text(), "First")
    path.write_text(text(("A|S0|go", "S2"), ("A|S9", {"x": "S0"})))
    found = asked(path, GO)
    assert found.uncommitted
    assert found.revision is not None
    assert found.revision.subject == "First"
    new = asked(path, Address("A", "S9"))
    assert (new.revision, new.reason) == (None, "No commit has it yet")


def test_a_version_that_is_no_blueprint_is_passed_over(folder: Path) -> None:
    git(folder, "init", "-q")
    path = folder / "plan.json"
    commit(folder, path, text(), "First")
    commit(folder, path, "{ broken", "Broken")
    commit(folder, path, text(("A|S2|back", "S0")), "Repaired")
    found = asked(path, BACK)
    assert found.revision is not None
    assert found.revision.subject == "Repaired"
    assert found.unread == 1


def test_a_shallow_clone_says_that_earlier_is_not_known(folder: Path, tmp_path: Path) -> None:
    git(folder, "init", "-q")
    path = folder / "plan.json"
    commit(folder, path, text(), "First")
    commit(folder, path, text(("A|S2|back", "S0")), "Second")
    git(folder, "clone", "-q", "--depth", "1", f"file://{folder}", str(folder / "clone"))
    found = asked(folder / "clone" / "plan.json", GO)
    assert found.revision is None
    assert "shallow" in found.reason


def test_no_repository_and_no_git_are_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = folder / "plan.json"
    path.write_text(text())
    with pytest.raises(ReadError, match="in no git repository"):
        asked(path, GO)
    blueprint = read(path)
    monkeypatch.setenv("PATH", str(folder / "nowhere"))
    with pytest.raises(ReadError, match="git is not installed here"):
        last_change(blueprint, GO, path)


def test_no_hook_pager_or_filter_of_the_repository_runs(folder: Path) -> None:
    git(folder, "init", "-q")
    path, ran = folder / "plan.json", folder.parent / "ran"
    commit(folder, path, text(), "First")
    program = folder / "program"
    program.write_text(f"#!{sys.executable}\nopen({str(ran)!r}, 'w')\n")
    program.chmod(0o755)
    for key in ("core.pager", "core.fsmonitor", "diff.external", "gpg.program", "core.sshCommand",
                "diff.x.textconv", "filter.x.smudge", "core.editor", "pager.log"):  # fmt: skip
        git(folder, "config", key, str(program))
    git(folder, "config", "log.showSignature", "true")
    (folder / ".gitattributes").write_text("*.json diff=x filter=x\n")
    for hook in ("post-checkout", "pre-commit", "post-index-change"):
        target = folder / ".git" / "hooks" / hook
        target.parent.mkdir(exist_ok=True)
        target.write_bytes(program.read_bytes())
        target.chmod(0o755)
    assert subject(path, GO) == "First"
    assert not ran.exists()


def test_a_stop_ends_the_search(folder: Path) -> None:
    git(folder, "init", "-q")
    path = folder / "plan.json"
    commit(folder, path, text(), "First")
    with pytest.raises(Stopped), heeding(StopListener(3).heed):
        asked(path, GO)


def test_a_git_that_does_not_end_is_ended_by_a_stop(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    slow = folder / "bin"
    slow.mkdir()
    program = slow / "git"
    pid = folder / "pid"
    program.write_text(
        f"#!/bin/sh\necho $$ > {pid}.new && mv {pid}.new {pid}\nexec tail -f {pid}\n"
    )
    program.chmod(0o755)
    path = folder / "plan.json"
    path.write_text(json.dumps(BASE))
    blueprint = read(path)
    monkeypatch.setenv("PATH", f"{slow}{os.pathsep}{os.environ['PATH']}")

    def heed() -> None:
        if pid.exists():
            raise Stopped

    with pytest.raises(Stopped), heeding(heed):
        last_change(blueprint, GO, path)
    with pytest.raises(ProcessLookupError):
        os.kill(int(pid.read_text()), 0)
