"""``extract``, ``inline`` and ``identify``: what is written, refused and told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from smsl_studio.front.inputs import read
from tests.cli.shell import Shell, sample

LINE = {
    "P": {
        "HEADER": {"INITIAL": "State000", "ACTIVATING": "State110"},
        "State000": {"plan": "State100"},
        "State100": {"next": "State101"},
        "State101": {"end": "State111"},
        "State111": {"use": "State011"},
        "State011": {},
        "State110": {},
    }
}


@pytest.fixture
def flat(shell: Shell, tmp_path: Path) -> Path:
    out = tmp_path / "flat.json"
    assert shell("flatten", sample("registration-digitization"), "-o", str(out)).status == 0
    return out


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_states_become_a_sub_sb_and_go_back(
    shell: Shell, tmp_path: Path, flat: Path, form: str
) -> None:
    cut, back = tmp_path / f"cut.{form}", tmp_path / f"back.{form}"
    words = ("--sb", "REGISTRATION", "--states", "State100+State0", "--as", "DIGITIZATION")
    answer = shell("extract", str(flat), *words, "-o", str(cut))
    assert (answer.status, answer.out) == (0, "")
    assert "has 6 states" in answer.err
    assert list(read(cut).branches) == ["REGISTRATION", "DIGITIZATION"]
    answer = shell("inline", str(cut), "--sb", "DIGITIZATION", "-o", str(back), "--format", "json")
    assert (answer.status, json.loads(answer.out)["equal"]) == (0, True)
    assert list(read(back).branches) == ["REGISTRATION"]


def test_a_refusal_prints_the_run_and_writes_nothing(shell: Shell, tmp_path: Path) -> None:
    file, out = tmp_path / "line.json", tmp_path / "out.json"
    file.write_text(json.dumps(LINE), "utf-8")
    words = ("--sb", "P", "--states", "State100, State111", "--as", "SUB", "-o", str(out))
    answer = shell("extract", str(file), *words)
    assert (answer.status, answer.out) == (1, "run: plan, next, end\n")
    assert "entered at State100 and at State111" in answer.err
    answer = shell("extract", str(file), *words, "--format", "json")
    told = json.loads(answer.out)
    assert (answer.status, told["equal"]) == (1, False)
    assert told["path"] == ["plan", "next", "end"]
    assert shell("inline", str(file), "--sb", "P", "-o", str(out)).status == 1
    assert not out.exists()


@pytest.mark.parametrize(
    "words",
    [
        ("--sb", "P", "--states", "State9", "--as", "SUB"),
        ("--sb", "Q", "--states", "State100", "--as", "SUB"),
        ("--sb", "P", "--states", "State100", "--as", "P"),
        ("--sb", "P", "--states", "State100"),
    ],
)
def test_wrong_words(shell: Shell, tmp_path: Path, words: tuple[str, ...]) -> None:
    file, out = tmp_path / "line.json", tmp_path / "out.json"
    file.write_text(json.dumps(LINE), "utf-8")
    assert shell("extract", str(file), *words, "-o", str(out)).status == 2
    assert not out.exists()


def test_parts_are_listed_and_the_best_is_written(shell: Shell, tmp_path: Path, flat: Path) -> None:
    out = tmp_path / "out.json"
    answer = shell("identify", str(flat), "-o", str(out), "--format", "json")
    best = json.loads(answer.out)["cuts"][0]
    assert (answer.status, best["states"]) == (0, ["State100+State0"])
    assert best["saves"] == {"states": 0, "facts": 1}
    assert best["as"] in read(out).branches
    text = shell("identify", str(flat)).out
    assert "1 state is entered at State100+State0 and left through" in text
    assert "the base saves 0 states and 1 fact" in text


def test_that_there_is_no_part_is_said(shell: Shell, tmp_path: Path) -> None:
    out = tmp_path / "out.json"
    answer = shell("identify", sample("hanoi"), "-o", str(out))
    assert (answer.status, answer.out) == (
        1, "no states could be a sub-SB that saves states or facts\n",
    )  # fmt: skip
    answer = shell("identify", sample("hanoi"), "--format", "json")
    assert (answer.status, json.loads(answer.out)) == (1, {"cuts": []})
    assert not out.exists()


BROKEN = {
    "R02": {"A": {"State_0": {"c": "State_1", "x": "State_9"}, "State_1": {}}},
    "R07": {"A": {"HEADER": {"SUB_SBS": {"Z": 0}}, "State_0": {"c": "State_1"}, "State_1": {}}},
    "R08": {"_imports": ["gone.json"], "A": {"State_0": {"c": "State_1"}, "State_1": {}}},
}


@pytest.mark.parametrize("rule", BROKEN)
def test_nothing_is_said_about_a_part_as_if_it_were_the_whole(
    shell: Shell, tmp_path: Path, rule: str
) -> None:
    file, out = tmp_path / "broken.json", tmp_path / "out.json"
    file.write_text(json.dumps(BROKEN[rule]), "utf-8")
    whole = tmp_path / "whole.json"
    whole.write_text(json.dumps({"A": {"State_0": {"c": "State_1"}, "State_1": {}}}), "utf-8")
    for words in (
        ("diff", str(file), str(whole), "--behaviour"),
        ("diff", str(whole), str(file), "--behaviour"),
        ("explore", str(file)),
        ("flatten", str(file), "-o", str(out)),
        ("identify", str(file), "-o", str(out)),
        ("inline", str(file), "--sb", "A", "-o", str(out)),
        ("extract", str(file), "--sb", "A", "--states", "State_0", "--as", "N", "-o", str(out)),
    ):
        answer = shell(*words)
        assert answer.status == 1, words
        assert rule in answer.err, words
    assert not out.exists()


def test_flatten_loses_no_operation_of_two_with_one_name(shell: Shell, tmp_path: Path) -> None:
    file, out = tmp_path / "dots.json", tmp_path / "out.json"
    ends = {"INITIAL": "State_0", "ACTIVATING": "State_1"}
    file.write_text(json.dumps({
        "A.B": {"HEADER": ends, "State_0": {"c": "State_1"}, "State_1": {}},
        "A": {"HEADER": ends, "State_0": {"B.c": "State_1"}, "State_1": {}},
    }), "utf-8")  # fmt: skip
    answer = shell("flatten", str(file), "-o", str(out))
    assert answer.status == 1
    assert "two operations would be called A.B.c" in answer.err
    assert not out.exists()
