"""``learn``: the rules it writes, what it prints, and its exit status."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell

HANOI = str(samples_dir() / "hanoi.json")
CORRECTED = str(samples_dir() / "hanoi-corrected.json")


def test_the_rules_are_written_and_what_does_not_fit_is_printed(
    shell: Shell, tmp_path: Path
) -> None:
    rules, made = tmp_path / "hanoi.toml", tmp_path / "made.json"
    answer = shell("learn", HANOI, "-o", str(rules))
    assert (answer.status, answer.err) == (0, "")
    assert answer.json["cases"] == 3
    assert [one["kind"] for one in answer.json["exceptions"]] == [
        "missing",
        "odd",
        "odd",
        "missing",
    ]
    assert answer.json["exceptions"][1] == {
        "address": "SB1/State_cbb/Op_1c", "kind": "odd", "found": "State_bbb", "expected": None,
    }  # fmt: skip
    assert shell("generate", "rules", str(rules), "-o", str(made)).status == 0
    assert shell("diff", CORRECTED, str(made), "--behaviour").status == 0
    first = rules.read_bytes()
    assert shell("learn", HANOI, "-o", str(rules)).status == 0
    assert rules.read_bytes() == first


def test_a_blueprint_without_rules_is_a_no(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "x.toml"
    answer = shell("learn", str(samples_dir() / "hfsm.json"), "-o", str(out))
    assert (answer.status, answer.out) == (1, "")
    assert "flatten" in answer.err
    assert not out.exists()
    assert shell("learn", HANOI, CORRECTED, "-o", str(out)).status == 2


def test_runs_are_examples(shell: Shell, tmp_path: Path) -> None:
    log, out = tmp_path / "run.jsonl", tmp_path / "run.toml"
    words = ("--world", "table", "--goal", "State_ccc", "--log", str(log))
    assert shell("run", CORRECTED, *words).status == 0
    answer = shell("learn", str(log), "-o", str(out))
    assert answer.status == 0, answer.err
    assert answer.json["exceptions"] == []
    made = smsl.generate_rules(out)
    assert (made.states, made.operations) == (8, 7)
    (branch,) = made.blueprint
    assert (branch.initial, branch.activating) == ("State_aaa", "State_ccc")


@pytest.mark.parametrize("text", ["", "{}", '{"log": "smsl-run"}', "\0", "[" * 9000])
def test_what_is_no_log_has_a_place(shell: Shell, tmp_path: Path, text: str) -> None:
    log = tmp_path / "no.jsonl"
    log.write_text(text)
    answer = shell("learn", str(log), "-o", str(tmp_path / "no.toml"))
    assert answer.status == 2
    assert str(log) in answer.err
