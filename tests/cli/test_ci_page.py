"""The page about git and CI can be followed: its files are real YAML, and their commands work."""

from __future__ import annotations

import json
import re
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from smsl_studio.cli.arguments import COMMANDS
from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell

ROOT = Path(__file__).parents[2]
FENCE = re.compile(r"^```yaml (\S+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
FILES: dict[str, Any] = {
    name: YAML(typ="safe").load(body)
    for name, body in FENCE.findall((ROOT / "docs" / "ci.md").read_text("utf-8"))
}


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with ``procedures/``, as the page supposes it; the current folder."""
    (tmp_path / "procedures").mkdir()
    for name in ("hfsm", "hanoi-corrected"):
        shutil.copy(samples_dir() / f"{name}.json", tmp_path / "procedures")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def commands(node: object) -> Iterator[str]:
    """Every text of a file that calls the program."""
    if isinstance(node, dict):
        node = list(node.values())
    if isinstance(node, list):
        for each in node:
            yield from commands(each)
    elif isinstance(node, str) and node.startswith("smsl-studio "):
        yield node


def test_the_page_has_a_file_for_each_of_three_programs() -> None:
    assert list(FILES) == [
        ".pre-commit-config.yaml",
        ".github/workflows/blueprints.yml",
        ".gitlab-ci.yml",
    ]


@pytest.mark.parametrize("file", [name for name in FILES if not name.startswith(".pre")])
def test_the_commands_of_a_server_succeed_and_write_its_files(
    file: str, shell: Shell, checkout: Path
) -> None:
    for hook in FILES[".pre-commit-config.yaml"]["repos"][0]["hooks"]:
        shell(*hook["entry"].split()[1:], *_expanded("procedures/*.json", checkout))
    for line in commands(FILES[file]):
        command, _, output = line.partition(" > ")
        _, *words = shlex.split(command)
        answer = shell(*(name for word in words for name in _expanded(word, checkout)))
        assert answer.status == 0, (line, answer.err)
        if output:
            (checkout / output).write_text(answer.out, "utf-8")
    assert json.loads((checkout / "blueprints.sarif").read_text("utf-8"))["version"] == "2.1.0"
    last = (checkout / "run.jsonl").read_text("utf-8").splitlines()[-1]
    assert json.loads(last)["reason"] == "goal_reached"


def _expanded(word: str, folder: Path) -> list[str]:
    if "*" not in word:
        return [word]
    return sorted(str(path.relative_to(folder)) for path in folder.glob(word))


def test_the_hooks_of_the_page_are_those_of_the_repository() -> None:
    shipped = YAML(typ="safe").load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))
    ours = {hook["id"]: hook["entry"] for hook in shipped}
    (repository,) = FILES[".pre-commit-config.yaml"]["repos"]
    assert {hook["id"]: hook["entry"] for hook in repository["hooks"]} == ours
    for hook in shipped:
        assert hook["entry"].split()[1] in COMMANDS
        assert re.search(hook["files"], "a/b.smsl")
        assert not re.search(hook["files"], "a/package.json")
    for hook in repository["hooks"]:
        assert re.search(hook["files"], "procedures/hfsm.json")
        assert not re.search(hook["files"], "package.json")


def test_the_hooks_refuse_a_wrong_blueprint(shell: Shell, checkout: Path) -> None:
    shutil.copy(samples_dir() / "hanoi.json", checkout / "procedures")
    for hook in YAML(typ="safe").load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8")):
        words = [*hook["entry"].split()[1:], "procedures/hanoi.json"]
        assert shell(*words).status == (1 if hook["id"] == "smsl-check" else 0)
