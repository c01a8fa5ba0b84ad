"""``fmt``: canonical layout of files, of standard input, and asked for with --check."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest

from tests.cli.shell import Shell, sample

UGLY = '{"SB1": {"State_0": {"Op":"State_0"}, "_x": 1.50}}'
TIDY = """{
    "SB1": {
        "State_0": {
            "Op": "State_0"
        },
        "_x": 1.50
    }
}
"""
NATIVE = "{ #NAME:A // a\nState_0:[Op->State_0]\n}"
NATIVE_TIDY = "{\n    # NAME: A // a\n    State_0: [Op -> State_0]\n}\n"


@pytest.fixture
def ugly(tmp_path: Path) -> Path:
    path = tmp_path / "ugly.json"
    path.write_text(UGLY)
    return path


def test_files_are_laid_out_in_every_form(shell: Shell, ugly: Path) -> None:
    native, yaml = ugly.with_suffix(".smsl"), ugly.with_suffix(".yaml")
    native.write_text(NATIVE)
    yaml.write_text("SB1: {State_0: {Op: State_0}} # a\n")
    answer = shell("fmt", str(ugly), str(native), str(yaml))
    assert (answer.status, answer.out) == (0, "")
    assert len(answer.err.splitlines()) == 3
    assert ugly.read_text() == TIDY
    assert native.read_text() == NATIVE_TIDY
    assert "# a" in yaml.read_text()
    again = shell("fmt", "--check", str(ugly), str(native), str(yaml))
    assert (again.status, again.out, again.err) == (0, "", "")


def test_check_writes_nothing_and_names_what_would_change(shell: Shell, ugly: Path) -> None:
    answer = shell("fmt", "--check", sample("hanoi"), str(ugly))
    assert (answer.status, answer.out) == (1, f"{ugly}\n")
    assert ugly.read_text() == UGLY
    answer = shell("fmt", "--check", "--format", "json", sample("hanoi"), str(ugly))
    assert answer.status == 1
    assert answer.json == {
        "files": [
            {"file": sample("hanoi"), "changed": False},
            {"file": str(ugly), "changed": True},
        ]
    }


@pytest.mark.parametrize(
    ("text", "tidy"), [(UGLY, TIDY), (NATIVE.replace("\n", "\r"), NATIVE_TIDY.replace("\n", "\r"))]
)
def test_standard_input_goes_to_standard_output(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, text: str, tidy: str
) -> None:
    def given(content: str) -> None:
        stream = io.TextIOWrapper(io.BytesIO(content.encode()), "utf-8", newline="")
        monkeypatch.setattr(sys, "stdin", stream)

    given(text)
    answer = shell("fmt", "-")
    assert (answer.status, answer.err) == (0, "")
    assert answer.out == tidy
    given(text)
    checked = shell("fmt", "-", "--check")
    assert (checked.status, checked.out) == (1, "<stdin>\n")


def test_broken_files_are_told_with_all_their_faults_and_left_alone(
    shell: Shell, ugly: Path
) -> None:
    broken = ugly.with_name("broken.smsl")
    text = "{ # NAME: A\nState_0 [Op -> State_0]\nState_1: [Op => State_0]\n}"
    broken.write_text(text)
    answer = shell("fmt", str(broken), str(ugly), str(ugly.with_name("gone.json")))
    assert answer.status == 2
    places = [line for line in answer.err.splitlines() if line.startswith(str(broken))]
    assert [place.split(":")[1:3] for place in places] == [["2", "9"], ["3", "14"]]
    assert broken.read_text() == text
    assert ugly.read_text() == TIDY


def test_a_report_and_a_text_do_not_share_standard_output(shell: Shell) -> None:
    answer = shell("fmt", "-", "--format", "json")
    assert answer.status == 2
    assert "goes to standard output" in answer.err


def test_a_file_that_cannot_be_saved_is_told(
    shell: Shell, ugly: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.fsync", lambda _: (_ for _ in ()).throw(OSError(28, "no room")))
    answer = shell("fmt", str(ugly))
    assert answer.status == 2
    assert "was not saved" in answer.err
    assert ugly.read_text() == UGLY
