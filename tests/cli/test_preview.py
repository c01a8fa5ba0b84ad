"""``preview``: what it prints, and its exit status."""

from __future__ import annotations

from smsl_studio.shipped import samples_dir
from tests.cli.shell import Shell

HANOI = str(samples_dir() / "hanoi-corrected.json")
PAPER = str(samples_dir() / "hanoi.json")


def test_json_has_the_facts_before_and_after(shell: Shell) -> None:
    words = ("preview", HANOI, "--world", "table", "--edge", "SB1/State_aaa/Op_1c")
    answer = shell(*words, "--format", "json")
    assert answer.status == 0
    start = {"SB1/0": "a", "SB1/1": "a", "SB1/2": "a"}
    assert answer.json == {
        "edge": "SB1/State_aaa/Op_1c",
        "before": start,
        "after": {**start, "SB1/0": "c"},
        "declared": {**start, "SB1/0": "c"},
        "agrees": True,
        "share": 1.0,
        "hazard": None,
    }


def test_a_difference_is_a_no(shell: Shell) -> None:
    words = ("preview", PAPER, "--world", "hanoi", "--edge", "SB1/State_cbb/Op_1c")
    answer = shell(*words, "--repeats", "2")
    assert answer.status == 1
    assert "SB1/0: c to c, declared b" in answer.out
    assert "0 % of 2 repeats agree" in answer.out


def test_wrong_words_are_refused(shell: Shell) -> None:
    words = ("preview", HANOI, "--world", "table", "--edge")
    assert shell(*words, "SB1/State_aaa").status == 2
    both = ("--start", "SB1/State_aaa", "--log", "x.jsonl")
    assert shell(*words, "SB1/State_aaa/Op_1c", *both).status == 2
    assert shell(*words, "SB1/State_aaa/Op_1c", "--repeats", "0").status == 2
