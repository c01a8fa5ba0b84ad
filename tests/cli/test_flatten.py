"""``flatten``: one SB that behaves alike, in each written form."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.front.inputs import read
from tests.cli.shell import Shell, sample


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_one_sb_is_written(shell: Shell, tmp_path: Path, form: str) -> None:
    out = tmp_path / f"flat.{form}"
    answer = shell("flatten", sample("three-levels"), "-o", str(out))
    assert (answer.status, answer.out) == (0, "")
    assert "12 states" in answer.err
    assert len(read(out).branches) == 1


def test_a_limit_and_an_unknown_sb_are_told(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "flat.json"
    small = shell("flatten", sample("hanoi"), "-o", str(out), "--limit", "5")
    assert small.status == 1
    assert "more than 5 configurations" in small.err
    assert shell("flatten", sample("hfsm"), "-o", str(out), "--sb", "SB7").status == 2
    assert not out.exists()


@pytest.mark.parametrize("command", ["flatten", "identify", "convert"])
def test_the_advice_names_only_forms_that_the_command_writes(
    command: str, shell: Shell, tmp_path: Path
) -> None:
    """Each suffix of the advice is taken."""
    refused = shell(command, sample("hfsm"), "-o", str(tmp_path / "q.txt"))
    assert refused.status == 2
    advice = refused.err.splitlines()[-1]
    suffixes = [word.strip(",.") for word in advice.removeprefix("End it with ").split()]
    assert ("dot" in suffixes) == (command == "convert")
    for suffix in suffixes:
        answer = shell(command, sample("hfsm"), "-o", str(tmp_path / f"q.{suffix}"))
        assert answer.status != 2, answer.err
