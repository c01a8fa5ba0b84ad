"""``generate rules``: what it writes and prints, and its exit status."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell

RIVER = str(samples_dir() / "rules" / "river.toml")


@pytest.mark.parametrize("suffix", ["json", "smsl", "yaml"])
def test_each_form_says_the_same(shell: Shell, tmp_path: Path, suffix: str) -> None:
    out = tmp_path / f"river.{suffix}"
    answer = shell("generate", "rules", RIVER, "-o", str(out))
    assert (answer.status, answer.err) == (0, "")
    assert "40 states, 92 operations" in answer.out
    assert (
        smsl.digest(smsl.read(out)).meaning
        == smsl.digest(smsl.generate_rules(RIVER).blueprint).meaning
    )
    assert shell("check", str(out)).status == 0


def test_a_goal_out_of_reach_is_a_no(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "stuck.toml"
    file.write_text(
        'facts = [{name = "a", values = ["0", "1"]}]\nstart = ["0"]\ngoal = ["1"]\n'
        '[[rule]]\noperation = "stay"\ncases = [{set = {}}]\n'
    )
    out = tmp_path / "stuck.json"
    answer = shell("generate", "rules", str(file), "-o", str(out), "--format", "json")
    assert answer.status == 1
    assert answer.json == {"states": 1, "operations": 1, "goal": False}
    assert "the goal cannot be reached" in answer.err
    assert out.exists()


def test_wrong_rules_have_a_place(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "wrong.toml"
    file.write_text("facts = 3\n")
    answer = shell("generate", "rules", str(file), "-o", str(tmp_path / "x.json"))
    assert answer.status == 2
    assert answer.err.startswith(f"{file}:1:1: ")
    assert not (tmp_path / "x.json").exists()
