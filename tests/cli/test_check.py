"""``check``: findings with places, and files that cannot be read."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.cli.mutations import mutations
from tests.cli.shell import Shell, sample


def test_the_two_misprints_of_the_paper_are_found(shell: Shell) -> None:
    answer = shell("check", sample("hanoi"), "--format", "json")
    (report,) = answer.json["files"]
    assert (answer.status, report["states"], report["operations"]) == (1, 27, 78)
    errors = [finding for finding in report["findings"] if finding["severity"] == "E"]
    assert [(e["rule"], e["address"], e["line"], e["column"], e["advice"]) for e in errors] == [
        ("R15", "SB1/State_cbb/Op_1c", 73, 13, "did you mean Op_1b?"),
        ("R15", "SB1/State_cbc/Op_2b", 100, 13, "did you mean Op_2a?"),
    ]
    keys = ["rule", "severity", "address", "line", "column", "message", "advice", "fix"]
    assert all(list(finding) == keys for finding in report["findings"])


def test_the_text_names_place_rule_and_address(shell: Shell) -> None:
    answer = shell("check", sample("hanoi"))
    assert answer.status == 1
    place = f"{sample('hanoi')}:73:13"
    words = "E R15 SB1/State_cbb/Op_1c: moves fact 1 to b; did you mean Op_1b?"
    assert f"{place}: {words}" in answer.out.splitlines()
    assert answer.out.splitlines()[-1].endswith(
        ": 27 states, 78 operations: 2 errors, 0 warnings, 1 note"
    )


@pytest.mark.parametrize("name", ["hanoi-corrected", "registration", "hanoi-2", "hfsm"])
def test_the_other_samples_are_good(shell: Shell, name: str) -> None:
    assert shell("check", sample(name)).status == 0


def test_only_the_rules_that_are_asked_for(shell: Shell) -> None:
    answer = shell("check", sample("hanoi"), "--rule", "R04", "--format", "json")
    assert answer.status == 0
    assert [f["rule"] for f in answer.json["files"][0]["findings"]] == ["R04"]


def test_several_files_are_reported_and_the_worst_decides(shell: Shell, tmp_path: Path) -> None:
    bad = tmp_path / "bad.json"
    bad.write_text('{"SB1": {\n    "State_0": 3}}')
    answer = shell("check", sample("hfsm"), str(bad), sample("hanoi"), "--format", "json")
    assert answer.status == 2
    assert [report["file"] for report in answer.json["files"]] == [sample("hfsm"), sample("hanoi")]
    assert answer.err.splitlines() == [
        f"{bad}:2:5: 'State_0' is a number, not a state",
        "Write a state as { ... }, or start the name with _ to have it skipped.",
    ]


def test_every_fault_of_a_file_is_told(shell: Shell, tmp_path: Path) -> None:
    broken, wrong = tmp_path / "broken.json", tmp_path / "wrong.json"
    broken.write_text('{"A": {"S": {"o": "T" "p": "S"},\n "T": {},},\n}')
    wrong.write_text('{"A": {"S": {"o": 1}},\n "version": 2}')
    answer = shell("check", str(broken), str(wrong))
    assert (answer.status, answer.out) == (2, "")
    assert answer.err.splitlines() == [
        f"{broken}:1:23: a comma is missing before this",
        "Write a comma.",
        f"{broken}:2:9: a comma with nothing behind it",
        "Remove it.",
        f"{broken}:2:11: a comma with nothing behind it",
        "Remove it.",
        f"{wrong}:1:14: the target of 'o' is a number, not the name of a state",
        'Write the operation as "Operation": "TargetState".',
        f"{wrong}:2:2: 'version' is a number, not a State Branch",
        "Write a State Branch as { ... }, or start the name with _ to have it skipped.",
    ]


def test_standard_input_is_a_file(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    with Path(sample("hanoi")).open(encoding="utf-8") as stream:
        monkeypatch.setattr("sys.stdin", stream)
        answer = shell("check", "-", "--format", "json")
    assert answer.status == 1
    assert answer.json["files"][0]["file"] == "<stdin>"


def test_a_world_may_be_named_if_it_exists(shell: Shell) -> None:
    assert shell("check", sample("hfsm"), "--world", "table").status == 0
    answer = shell("check", sample("hfsm"), "--world", "hanio")
    assert answer.status == 2
    assert "Did you mean hanoi?" in answer.err


def test_three_hundred_broken_files(shell: Shell, tmp_path: Path) -> None:
    """Exit 0, 1 or 2; a place and an advice in every rejection; never a traceback."""
    file = tmp_path / "mutated.json"
    seen = set()
    for raw in mutations(seed=0, count=300):
        file.write_bytes(raw)
        answer = shell("check", str(file), "--format", "json")
        seen.add(answer.status)
        if answer.status == 2:
            said = answer.err.splitlines()
            assert len(said) % 2 == 0, raw
            for where, advice in zip(said[::2], said[1::2], strict=True):
                assert re.match(rf"{re.escape(str(file))}:[0-9]+:[0-9]+: \S", where), raw
                assert advice, raw
        else:
            places = [(f["line"], f["column"]) for f in answer.json["files"][0]["findings"]]
            assert all(line >= 1 and column >= 1 for line, column in places), raw
            assert answer.err == "", raw
    assert seen == {0, 1, 2}


def test_a_finding_in_an_imported_file_says_so(shell: Shell, tmp_path: Path) -> None:
    base, low = tmp_path / "base.json", tmp_path / "low.json"
    base.write_text('{"_imports": ["low.json"],\n "A": {"State0": {"o": "StateX"}}}')
    low.write_text('{"_imports": ["gone.json"],\n\n "B": {"State0": {"o": "StateX"}}}')
    answer = shell("check", "--format", "json", "--rule", "R02", "--rule", "R08", str(base))
    found = answer.json["files"][0]["findings"]
    assert [(f["rule"], f.get("file"), f["line"]) for f in found] == [
        ("R02", None, 2),
        ("R08", str(low), 1),
        ("R02", str(low), 3),
    ]
    assert "(base.json > low.json > gone.json)" in found[1]["message"]
    said = shell("check", "--rule", "R02", str(base)).out
    assert f"{low}:3:" in said
