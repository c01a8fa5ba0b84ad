"""``merge``: exit status, text and JSON, what is written; and as git's driver in a repository."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.front.git_drivers import DRIVERS, FORMER
from smsl_studio.front.inputs import read
from tests.cli.histories import History
from tests.cli.repository import Repository
from tests.cli.shell import Shell, sample

BASE = {"S": {"HEADER": {"INITIAL": "A", "ACTIVATING": "B"}, "A": {"go": "B"}, "B": {"back": "A"}}}


def versions(folder: Path, ours: Any, theirs: Any) -> list[str]:
    """The three files, with other operations of the states A and B."""
    files = []
    for name, (here, there) in {"base": ({}, {}), "ours": ours, "theirs": theirs}.items():
        inside = {**BASE["S"], "A": {**BASE["S"]["A"], **here}, "B": {**BASE["S"]["B"], **there}}
        file = folder / f"{name}.json"
        file.write_text(json.dumps({"S": inside}, indent=2))
        files.append(str(file))
    return files


def test_a_merge_without_conflicts_replaces_ours(shell: Shell, tmp_path: Path) -> None:
    files = versions(tmp_path, ({"one": "A"}, {}), ({}, {"two": "B"}))
    before = [Path(file).read_bytes() for file in (files[0], files[2])]
    answer = shell("merge", *files)
    assert (answer.status, answer.out) == (0, f"{files[1]}: merged\n")
    table = read(files[1])["S"].table
    assert table == {"A": {"go": "B", "one": "A"}, "B": {"back": "A", "two": "B"}}
    assert [Path(file).read_bytes() for file in (files[0], files[2])] == before


def test_an_empty_name_of_out_overwrites_nothing(shell: Shell, tmp_path: Path) -> None:
    """As an unset variable of a script gives it."""
    files = versions(tmp_path, ({"one": "A"}, {}), ({}, {"two": "B"}))
    before = Path(files[1]).read_bytes()
    assert shell("merge", *files, "-o", "").status == 2
    assert Path(files[1]).read_bytes() == before


def test_a_conflict_is_told_and_kept_in_the_file(shell: Shell, tmp_path: Path) -> None:
    files = versions(tmp_path, ({"go": "A"}, {}), ({"go": "C"}, {}))
    out = tmp_path / "out.json"
    ours = Path(files[1]).read_bytes()
    answer = shell("merge", *files, "-o", str(out), "--format", "json")
    assert answer.status == 1
    told = {"address": "S/A/go", "base": "B", "ours": "A", "theirs": "C", "path": ["S", "A", "go"]}
    assert answer.json == {"conflicts": [told], "layout_kept": []}
    assert Path(files[1]).read_bytes() == ours
    assert read(out)["S"].table["A"]["go"] == "A"
    found = shell("check", str(out), "--rule", "R29", "--format", "json")
    assert found.status == 1
    (finding,) = found.json["files"][0]["findings"]
    assert (finding["severity"], finding["address"]) == ("E", "S/A/go")
    words = shell("merge", *files, "-o", str(out))
    assert words.out == "S/A/go: mine is A, theirs is C\n"
    assert "_conflicts" in words.err


def test_hostile_names_are_told_without_their_marks(shell: Shell, tmp_path: Path) -> None:
    odd = "C\x1b[2J\u202e\n"
    files = versions(tmp_path, ({odd: "A"}, {}), ({odd: "B"}, {}))
    answer = shell("merge", *files, "-o", str(tmp_path / "out.json"))
    assert answer.status == 1
    assert answer.out.startswith("S/A/C\\x1b[2J\\u202e\\n: mine is A")
    assert len(answer.out.splitlines()) == 1


def test_the_digest_leaves_open_conflicts_out(shell: Shell, tmp_path: Path) -> None:
    files = versions(tmp_path, ({"go": "A"}, {}), ({"go": "C"}, {}))
    out = tmp_path / "out.json"
    shell("merge", *files, "-o", str(out))
    digests = shell("digest", files[1], str(out), "--format", "json").json["files"]
    assert digests[0]["closure"] == digests[1]["closure"]
    assert digests[0]["meaning"] == digests[1]["meaning"]


def test_entries_that_are_not_understood_are_an_error(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "odd.json"
    file.write_text(json.dumps({**BASE, "_conflicts": ["odd", {"path": []}]}))
    answer = shell("check", str(file), "--rule", "R29", "--format", "json")
    found = answer.json["files"][0]["findings"]
    assert [(one["severity"], one["address"]) for one in found] == [("E", "_conflicts")] * 2


@pytest.mark.parametrize("form", ["smsl", "yaml"])
def test_out_has_the_form_of_its_suffix(form: str, shell: Shell, tmp_path: Path) -> None:
    files = versions(tmp_path, ({"go": "A"}, {}), ({"go": "C"}, {}))
    out = tmp_path / f"out.{form}"
    assert shell("merge", *files, "-o", str(out)).status == 1
    assert read(out).document.form == form
    assert read(out).document.values["_conflicts"][0]["theirs"] == "C"


def test_what_cannot_be_merged_changes_nothing(shell: Shell, tmp_path: Path) -> None:
    files = versions(tmp_path, ({"one": "A"}, {}), ({}, {}))
    ours = Path(files[1]).read_bytes()
    Path(files[2]).write_text('{"S": {"A": {}, "A": {}}}')
    answer = shell("merge", *files)
    assert answer.status == 2
    assert f"{files[2]}:1:17: S/A is written 2 times" in answer.err
    assert Path(files[1]).read_bytes() == ours
    assert shell("merge", files[0], files[1], str(tmp_path / "none.json")).status == 2
    assert shell("merge", "-", "-", files[0]).status == 2
    assert shell("merge", files[0], files[1]).status == 2
    assert shell("merge", sample("hanoi"), "-", sample("hanoi")).status == 2
    assert shell("merge", files[0], files[1], files[0], "-o", files[0]).status == 2


def test_an_older_entry_stays_open_and_the_exit_says_so(shell: Shell, tmp_path: Path) -> None:
    """``check`` reports it as an error, whoever left it open."""
    files = versions(tmp_path, ({"one": "A"}, {}), ({}, {"two": "B"}))
    entry = {"path": ["S", "A", "go"], "base": "B", "ours": "B", "theirs": "A"}
    ours = Path(files[1])
    ours.write_text(json.dumps({**json.loads(ours.read_text()), "_conflicts": [entry]}))
    out = tmp_path / "out.json"
    answer = shell("merge", *files, "-o", str(out), "--format", "json")
    assert answer.status == 1
    assert [one["address"] for one in answer.json["conflicts"]] == ["S/A/go"]
    assert read(out).document.values["_conflicts"] == [entry]
    assert read(out)["S"].table["B"]["two"] == "B"
    assert shell("check", str(out), "--rule", "R29").status == 1
    told = shell("merge", *files, "-o", str(out))
    assert told.out == "S/A/go: mine is B, theirs is A\n"
    assert "1 of them was open before this merge." in told.err


def test_an_entry_that_nobody_understands_stays_open_too(shell: Shell, tmp_path: Path) -> None:
    files = versions(tmp_path, ({}, {}), ({}, {}))
    ours = Path(files[1])
    ours.write_text(json.dumps({**json.loads(ours.read_text()), "_conflicts": ["odd"]}))
    answer = shell("merge", *files, "--format", "json")
    assert (answer.status, answer.json["conflicts"][0]["address"]) == (1, "_conflicts/0")


def test_a_decision_of_one_side_counts(shell: Shell, tmp_path: Path) -> None:
    """The entry was open in the base, and ours has taken it out."""
    files = versions(tmp_path, ({"go": "A"}, {}), ({}, {}))
    entry = {"path": ["S", "A", "go"], "base": "B", "ours": "B", "theirs": "A"}
    for file in map(Path, (files[0], files[2])):
        file.write_text(json.dumps({**json.loads(file.read_text()), "_conflicts": [entry]}))
    assert shell("merge", *files).status == 0
    merged = read(files[1])
    assert "_conflicts" not in merged.document.values
    assert merged["S"].table["A"]["go"] == "A"


def test_a_merge_by_lines_answers_in_json_too(shell: Shell, tmp_path: Path) -> None:
    files = [str(tmp_path / name) for name in ("base", "ours", "theirs")]
    for file in files:
        Path(file).write_text("no blueprint\n")
    answer = shell("merge", *files, "--name", "package.json", "--format", "json")
    assert (answer.status, answer.json["conflicts"]) == (0, [])


# --- git -----------------------------------------------------------------------------------------


class PlanRepository(Repository):
    """A repository with one blueprint, ``plan.json``."""

    def commit(self, here: Any, there: Any) -> None:
        inside = {**BASE["S"], "A": {**BASE["S"]["A"], **here}, "B": {**BASE["S"]["B"], **there}}
        (self.folder / "plan.json").write_text(json.dumps({"S": inside}, indent=2))
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "a step")

    def table(self) -> Any:
        return read(self.folder / "plan.json")["S"].table


@pytest.fixture
def repository(tmp_path: Path) -> PlanRepository:
    made = PlanRepository(tmp_path)
    made.commit({}, {})
    return made


def test_git_merges_a_branch_and_a_rebase_by_meaning(repository: PlanRepository) -> None:
    repository.git("checkout", "-q", "-b", "other")
    repository.commit({"go": "A"}, {})
    repository.commit({"go": "A", "more": "B"}, {})
    repository.git("checkout", "-q", "main")
    # In the lines of the text this stands beside the other change.
    repository.commit({"extra": "A"}, {"back": "B"})
    repository.git("checkout", "-q", "other")
    repository.git("rebase", "-q", "main")
    merged = {"A": {"go": "A", "extra": "A", "more": "B"}, "B": {"back": "B"}}
    assert repository.table() == merged
    repository.git("checkout", "-q", "main")
    repository.git("merge", "-q", "--no-ff", "-m", "joined", "other")
    assert repository.table() == merged


def test_a_conflict_in_git_leaves_a_readable_file(repository: PlanRepository) -> None:
    repository.git("checkout", "-q", "-b", "other")
    repository.commit({"go": "A"}, {})
    repository.git("checkout", "-q", "main")
    repository.commit({"go": "B", "slow": "B"}, {"back": "B"})
    repository.commit({"go": "C"}, {"back": "B"})
    told = repository.git("merge", "other", status=1)
    assert "CONFLICT" in told
    assert repository.table() == {"A": {"go": "C"}, "B": {"back": "B"}}
    (entry,) = read(repository.folder / "plan.json").document.values["_conflicts"]
    assert (entry["ours"], entry["theirs"]) == ("C", "A")


def test_the_driver_names_the_file_of_the_project(repository: PlanRepository) -> None:
    """And not the file of a moment in which git keeps a version."""
    repository.git("checkout", "-q", "-b", "other")
    repository.commit({"go": "A"}, {})
    repository.git("checkout", "-q", "main")
    repository.commit({"go": "C"}, {})
    told = repository.told("merge", "other", status=1)
    assert "1 conflict keeps your version in plan.json, and stands there" in told
    assert ".merge_file" not in told


def test_the_driver_names_the_file_of_the_project_when_all_is_merged(
    repository: PlanRepository,
) -> None:
    repository.git("checkout", "-q", "-b", "other")
    repository.commit({}, {"two": "B"})
    repository.git("checkout", "-q", "main")
    repository.commit({"one": "A"}, {})
    told = repository.told("merge", "-m", "joined", "other")
    assert "plan.json: merged" in told
    assert ".merge_file" not in told


def test_a_file_that_both_branches_added_is_merged(repository: PlanRepository) -> None:
    for branch, here in (("other", {"one": "A"}), ("third", {"two": "A"})):
        repository.git("checkout", "-q", "-b", branch, "main")
        inside = {**BASE["S"], "A": {**BASE["S"]["A"], **here}}
        (repository.folder / "new.json").write_text(json.dumps({"S": inside}))
        repository.git("add", "-A")
        repository.git("commit", "-q", "-m", "a file")
    repository.git("merge", "-q", "-m", "joined", "other")
    table = read(repository.folder / "new.json")["S"].table
    assert table["A"] == {"go": "B", "one": "A", "two": "A"}


def test_a_history_of_branches_and_rebases_loses_nothing(tmp_path: Path) -> None:
    """One of the twenty histories of the bench ``histories``."""
    history = History(tmp_path, 0)
    history.grow()
    assert history.merges > 10


@pytest.mark.parametrize("name", ["package.json", "compose.yaml", "broken.json"])
def test_files_that_are_no_blueprints_are_merged_line_by_line(
    name: str, repository: PlanRepository
) -> None:
    file = repository.folder / name
    text = '{"web":\n {"app":\n  {"image": "one",\n\n\n   "ports": "two"}}}\n'
    text = text[:-2] if name == "broken.json" else text
    texts = text, text.replace("one", "ONE"), text.replace("two", "TWO")
    for branch, words in zip(("main", "third", "main"), texts, strict=True):
        repository.git("checkout", "-q", *(["-b", branch] if branch == "third" else [branch]))
        file.write_text(words)
        repository.git("add", "-A")
        repository.git("commit", "-q", "-m", "a step")
    repository.git("merge", "-q", "-m", "joined", "third")
    assert file.read_text() == text.replace("one", "ONE").replace("two", "TWO")


def test_git_setup_says_what_it_wrote_and_takes_it_back(shell: Shell, tmp_path: Path) -> None:
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    below = tmp_path / "plans"
    below.mkdir()
    attributes = tmp_path / ".gitattributes"
    attributes.write_bytes(b"*.png binary")
    config = tmp_path / ".git" / "config"
    before = config.read_text()
    told = shell("git-setup", str(below))
    assert told.status == 0
    assert [line.rpartition(": ")[2] for line in told.out.splitlines()] == [
        "the block of smsl-studio", *DRIVERS,
    ]  # fmt: skip
    text = attributes.read_bytes()
    assert text.startswith(b"*.png binary\n# smsl-studio begin\n*.smsl diff=smsl merge=smsl\n")
    assert shell("git-setup", str(below)).out == "all is written already\n"
    assert attributes.read_bytes() == text
    assert shell("git-setup", str(below), "--undo").status == 0
    assert attributes.read_bytes() == b"*.png binary\n"
    assert "smsl" not in config.read_text()
    assert before.splitlines()[0] in config.read_text()
    assert shell("git-setup", str(below), "--undo").out == "nothing to take back\n"


def _config(folder: Path, *words: str) -> str:
    done = subprocess.run(["git", "config", "--local", *words], cwd=folder, check=False,
                          capture_output=True, text=True)  # fmt: skip
    return done.stdout


@pytest.mark.parametrize("values", [["theirs"], ["one", "two"], ["OURS", "two"], ["one", "OURS"]])
def test_git_setup_stands_several_values_of_one_key(
    values: list[str], shell: Shell, tmp_path: Path
) -> None:
    """Of several git takes the last. What others wrote stays before it, and after ``--undo``."""
    folder = _repository(tmp_path).parent
    key, ours = "merge.smsl.driver", DRIVERS["merge.smsl.driver"]
    written = [ours if one == "OURS" else one for one in values]
    for one in written:
        _config(folder, "--add", key, one)
    assert shell("git-setup", str(folder)).status == 0
    others = [one for one in written if one != ours]
    assert _config(folder, "--get-all", key).splitlines() == [*others, ours]
    assert _config(folder, "--get", key).strip() == ours
    assert shell("git-setup", str(folder)).out == "all is written already\n"
    assert shell("git-setup", str(folder), "--undo").status == 0
    assert _config(folder, "--get-all", key).splitlines() == others


def test_git_setup_replaces_what_an_earlier_version_wrote(shell: Shell, tmp_path: Path) -> None:
    folder = _repository(tmp_path).parent
    for key, value in FORMER.items():
        _config(folder, "--add", key, value)
        _config(folder, "--add", key, value)
    assert shell("git-setup", str(folder)).status == 0
    for key in FORMER:
        assert _config(folder, "--get-all", key).splitlines() == [DRIVERS[key]]


def test_git_setup_needs_a_repository(shell: Shell, tmp_path: Path) -> None:
    answer = shell("git-setup", str(tmp_path))
    assert answer.status == 2
    assert "is in no git repository" in answer.err
    assert not list(tmp_path.iterdir())
    assert shell("git-setup", str(tmp_path / "none")).status == 2


def _repository(folder: Path) -> Path:
    subprocess.run(["git", "init", "-q", str(folder / "r")], check=True)
    return folder / "r" / ".gitattributes"


@pytest.mark.parametrize("exists", [True, False])
def test_git_setup_follows_no_link_out_of_the_repository(
    shell: Shell, tmp_path: Path, exists: bool
) -> None:
    attributes, victim = _repository(tmp_path), tmp_path / "victim.rc"
    if exists:
        victim.write_text("export X=1\n")
    attributes.symlink_to("../victim.rc")
    answer = shell("git-setup", str(attributes.parent))
    assert answer.status == 2
    assert "no ordinary file" in answer.err
    assert victim.exists() is exists
    assert not exists or victim.read_text() == "export X=1\n"


def test_git_setup_waits_for_no_pipe(shell: Shell, tmp_path: Path) -> None:
    attributes = _repository(tmp_path)
    os.mkfifo(attributes)
    assert shell("git-setup", str(attributes.parent)).status == 2


@pytest.mark.parametrize("undo", [True, False])
def test_git_setup_keeps_what_others_wrote_into_its_block(
    shell: Shell, tmp_path: Path, undo: bool
) -> None:
    """The end of the block is missing, as after a disk that was full."""
    attributes = _repository(tmp_path)
    others = "*.psd filter=lfs\nsecret.txt -diff\n"
    attributes.write_text(f"# smsl-studio begin\n*.smsl diff=smsl merge=smsl\n{others}")
    words = ["git-setup", str(attributes.parent), *(["--undo"] if undo else [])]
    assert shell(*words).status == 0
    text = attributes.read_text()
    assert text.startswith(others)
    assert text.count("*.smsl diff=smsl") == (0 if undo else 1)


def test_git_merges_a_file_whose_name_begins_with_a_dash(tmp_path: Path) -> None:
    repository = Repository(tmp_path)
    file = tmp_path / "-x.json"
    for branch, more in (("main", {}), ("ours", {"one": "A"}), ("theirs", {"two": "A"})):
        if branch != "main":
            repository.git("checkout", "-q", "main")
            repository.git("checkout", "-q", "-b", branch)
        inside = {**BASE["S"], ("A" if branch == "ours" else "B"): {"back": "A", **more}}
        file.write_text(json.dumps({"S": inside}, indent=1))
        repository.git("add", "-A")
        repository.git("commit", "-q", "-m", "a step")
    repository.git("merge", "-q", "-m", "joined", "ours")
    table = read(file)["S"].table
    assert "one" in table["A"]
    assert "two" in table["B"]
