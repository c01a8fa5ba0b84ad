"""``diff``: meaning, layout apart, in text and JSON; and as git's driver in a real repository."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.shell import Shell, sample

HANOI = ("diff", sample("hanoi"), sample("hanoi-corrected"))


def test_the_two_misprints_of_the_appendix_are_all_that_differs(shell: Shell) -> None:
    answer = shell(*HANOI)
    assert answer.status == 1
    first, second, last = answer.out.splitlines()
    assert first.startswith("~ SB1/State_cbb/Op_1b: The operation Op_1c of SB1/State_cbb is now")
    assert "hanoi.json:73:13 -> " in first
    assert second.startswith("~ SB1/State_cbc/Op_2a: ")
    assert last == "2 changes: 2 renamed."


def test_as_json(shell: Shell) -> None:
    answer = shell(*HANOI, "--format", "json")
    assert answer.status == 1
    assert [(c["kind"], c["old"], c["new"]) for c in answer.json["changes"]] == [
        ("renamed", "Op_1c", "Op_1b"),
        ("renamed", "Op_2b", "Op_2a"),
    ]


def test_the_same_in_another_layout_is_no_difference(shell: Shell, tmp_path: Path) -> None:
    other = tmp_path / "tight.json"
    other.write_text(json.dumps(json.loads(Path(sample("hanoi")).read_text())))
    answer = shell("diff", sample("hanoi"), str(other))
    assert (answer.status, answer.out) == (0, "No difference.\n")


@pytest.mark.parametrize("form", ["smsl", "yaml"])
def test_the_form_makes_no_difference(form: str, shell: Shell, tmp_path: Path) -> None:
    other = tmp_path / f"hanoi.{form}"
    assert shell("convert", sample("hanoi"), "-o", str(other)).status == 0
    answer = shell("diff", sample("hanoi"), str(other))
    assert (answer.status, answer.out) == (0, "No difference.\n")
    changed = shell("diff", str(other), sample("hanoi-corrected"))
    assert changed.status == 1
    assert f"hanoi.{form}:" in changed.out


def test_moved_boxes_are_layout_only(shell: Shell, tmp_path: Path) -> None:
    values = json.loads(Path(sample("hanoi")).read_text())
    values["SB1"]["_layout"] = {"State_aaa": [10, 20]}
    other = tmp_path / "moved.json"
    other.write_text(json.dumps(values))
    answer = shell("diff", sample("hanoi"), str(other))
    assert (answer.status, answer.out) == (0, "Layout only: 1 state was moved.\n")
    told = shell("diff", sample("hanoi"), str(other), "--format", "json").json
    assert (told["layout_only"], told["same"], told["moved"]) == (True, False, 1)


def test_a_comment_field_is_listed_apart_and_is_no_change(shell: Shell, tmp_path: Path) -> None:
    values = json.loads(Path(sample("hanoi")).read_text())
    values["SB1"]["_comment"] = "who reads this"
    other, picture = tmp_path / "told.json", tmp_path / "told.svg"
    other.write_text(json.dumps(values, indent=4))
    answer = shell("diff", sample("hanoi"), str(other), "-o", str(picture))
    assert answer.status == 0
    first, second, last = answer.out.splitlines()
    assert first == "Beside the meaning:"
    assert second.startswith("  + SB1: The field _comment of SB1 is added: who reads this. (")
    assert last == "Same meaning: only _comment differs."
    told = shell("diff", sample("hanoi"), str(other), "--format", "json").json
    assert (told["changes"], told["same"], told["same_meaning"]) == ([], False, True)
    assert [one["field"] for one in told["fields"]] == ["_comment"]
    drawn = picture.read_text("utf-8")
    assert "Same meaning: only _comment differs." in drawn
    assert "The field _comment of SB1 is added" in drawn


def test_what_cannot_be_compared(shell: Shell, tmp_path: Path) -> None:
    broken = tmp_path / "broken.json"
    broken.write_text('{"SB": ')
    assert shell("diff", sample("hanoi"), str(broken)).status == 2
    assert shell("diff", sample("hanoi")).status == 2
    assert shell("diff", "-", "-").status == 2
    answer = shell("diff", *(sample("hanoi"),) * 3)
    assert answer.status == 2
    assert "two files are compared" in answer.err


def test_names_that_would_break_the_line_are_escaped(shell: Shell, tmp_path: Path) -> None:
    one, other = tmp_path / "one.json", tmp_path / "other.json"
    one.write_text('{"S": {"A": {}}}')
    other.write_text('{"S": {"A": {"x\\n\\u202e": "A"}}}')
    answer = shell("diff", str(one), str(other))
    assert "x\\n\\u202e" in answer.out
    assert len(answer.out.splitlines()) == 2


# --- git -----------------------------------------------------------------------------------------


class Repository:
    """A repository whose work tree has the driver of the pages configured."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.git("init", "-q")
        self.git("config", "diff.smsl.command", f'"{sys.executable}" -m smsl_studio diff --')
        (folder / ".gitattributes").write_text("*.json diff=smsl\n*.smsl diff=smsl\n")

    def git(self, *arguments: str) -> str:
        kept = {k: v for k, v in os.environ.items() if not k.startswith("GIT_")}
        who = {f"GIT_{w}_{k}": "person" for w in ("AUTHOR", "COMMITTER") for k in ("NAME", "EMAIL")}
        nowhere = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1", "GIT_PAGER": "cat"}
        done = subprocess.run(
            ["git", *arguments],
            cwd=self.folder,
            env=kept | who | nowhere,
            capture_output=True,
            text=True,
            check=False,
            timeout=60,
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    def commit(self, text: str | None, name: str = "plan.json") -> None:
        path = self.folder / name
        if text is None:
            path.unlink()
        else:
            path.write_text(text)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "a step")


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    return Repository(tmp_path)


def test_git_shows_what_changed_in_meaning(repository: Repository) -> None:
    before = '{"S": {"A": {"go": "B"}, "B": {}}}'
    repository.commit(before)
    repository.commit(before.replace('"go"', '"walk"'), "plan.json")
    repository.commit(json.dumps(json.loads(before.replace('"go"', '"walk"')), indent=1))
    story = repository.git("log", "-p", "--ext-diff", "--format=")
    assert "smsl plan.json\nNo difference.\n" in story
    assert "~ S/A/walk: The operation go of S/A is now called walk." in story
    assert "+ S: The State Branch S is added, with 2 states and 1 operation." in story


def test_git_shows_renamed_removed_and_odd_files(repository: Repository) -> None:
    text = json.dumps({"S": {f"A{i}": {"go": f"A{i}"} for i in range(9)}}, indent=1)
    repository.commit(text, "-a b é.json")
    (repository.folder / "-a b é.json").rename(repository.folder / "other.json")
    repository.commit(text.replace("A8", "A9"), "other.json")
    repository.commit(None, "other.json")
    story = repository.git("log", "-p", "-M", "--ext-diff", "--format=")
    assert "smsl -a b é.json -> other.json" in story
    assert "The state A8 of S is now called A9." in story
    assert "- S: The State Branch S is removed" in story


def test_an_earlier_version_that_cannot_be_read_ends_nothing(repository: Repository) -> None:
    repository.commit('{"S": {"A": {}}}')
    repository.commit('{"S": {"A": \n')
    repository.commit('{"S": {"A": {}}}\n')
    story = repository.git("log", "-p", "--ext-diff", "--format=")
    assert "the earlier version cannot be read: plan.json:" in story
    assert "the later version cannot be read: plan.json:" in story
    assert '-{"S": {"A": \n+{"S": {"A": {}}}' in story
    assert story.count("smsl plan.json") == 3


def test_behaviours_are_compared(shell: Shell, tmp_path: Path) -> None:
    flat = str(tmp_path / "flat.smsl")
    assert shell("flatten", sample("hfsm"), "-o", flat).status == 0
    same = shell("diff", sample("hfsm"), flat, "--behaviour", "--format", "json")
    assert same.status == 0
    assert same.json == {"equal": True, "path": [], "reason": "", "configurations": [4, 4]}
    files = sample("hanoi"), sample("hanoi-corrected")
    other = shell("diff", *files, "--behaviour", "--format", "json")
    assert other.status == 1
    assert other.json["path"] == ["Op_1c", "Op_2b", "Op_1b", "Op_3c", "Op_1c", "Op_2a"]
    text = shell("diff", *files, "--behaviour").out
    assert text.startswith("They differ: after 6 operations ")
    unknown = shell("diff", *files, "--behaviour", "--limit", "3", "--format", "json")
    assert (unknown.status, unknown.json["equal"]) == (1, None)
    assert shell("diff", *files, "--behaviour", "-o", "x.svg").status == 2


def test_unchanged_operations_between_two_states_are_one_line_in_the_picture(
    shell: Shell, tmp_path: Path
) -> None:
    values = json.loads(Path(sample("registration")).read_text())
    del values["REGISTRATION"]["State_1100"]["Op_ReplanLandmarks"]
    other, whole, bundled = (tmp_path / name for name in ("b.json", "a.svg", "b.svg"))
    other.write_text(json.dumps(values))
    files = ("diff", sample("registration"), str(other))
    assert shell(*files, "-o", str(whole)).status == 1
    assert shell(*files, "-o", str(bundled), "--collapse").status == 1
    texts = whole.read_text("utf-8"), bundled.read_text("utf-8")
    assert texts[0].count("<polyline") > texts[1].count("<polyline")
    assert "State_1100 -&gt; Op_ClearDigitization" in texts[1]
    assert "State_1100 -&gt; Op_ReplanLandmarks" not in texts[1], "a change stands alone"
    refused = shell(*files, "--collapse")
    assert refused.status == 2
    assert "Name it with -o." in refused.err
