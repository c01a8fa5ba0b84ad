"""Standard streams that are closed or full, and words that would break a line."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.shell import Shell, sample

ROOT = Path(__file__).parents[2]
PROGRAM = f"{sys.executable} -m smsl_studio"


def _in_shell(line: str) -> subprocess.CompletedProcess[str]:
    """A command as a shell starts it, with the redirections that only a shell can make."""
    return subprocess.run(
        ["sh", "-c", line], capture_output=True, text=True, cwd=ROOT, timeout=60, check=False
    )


def test_data_for_a_closed_standard_output_is_lost_and_the_answer_stands() -> None:
    done = _in_shell(f"{PROGRAM} check {sample('hanoi')} >&-")
    assert (done.returncode, done.stderr) == (1, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
@pytest.mark.parametrize("command", ["check", "run --world table --format json"])
def test_a_full_standard_output_is_two_sentences(command: str) -> None:
    done = _in_shell(f"{PROGRAM} {command} {sample('hfsm')} >/dev/full")
    assert done.returncode == 2
    assert "Traceback" not in done.stderr
    assert "standard output cannot be written" in done.stderr.splitlines()[-2]


def test_no_note_gets_into_the_data_where_standard_error_is_closed() -> None:
    done = _in_shell(f"{PROGRAM} check missing.json {sample('hfsm')} --format json 2>&-")
    assert (done.returncode, done.stdout[:10]) == (2, '{"files": ')


def test_a_closed_standard_input_cannot_be_read() -> None:
    done = _in_shell(f"{PROGRAM} check - <&-")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("<stdin>:1:1: standard input cannot be read")


def test_a_finding_on_a_name_with_a_line_break_is_one_line(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "odd.json"
    file.write_text(r'{"SB": {"State_0": {"go\nto": "State_9"}}}', "utf-8")
    answer = shell("check", str(file), "--rule", "R02")
    assert len(answer.out.splitlines()) == 2
    assert r"SB/State_0/go\nto" in answer.out
    file.write_text(r'{"SB": {"State_0": {"go\nto": "State_0"}}}', "utf-8")
    swept = shell("sweep", str(file), "--world", "table")
    assert len(swept.out.splitlines()) == 2


@pytest.mark.parametrize("seed", ["-1", "1.5", "x", "", "9" * 5000])
def test_a_seed_is_a_whole_number_from_0_up(shell: Shell, seed: str) -> None:
    answer = shell("run", sample("hanoi-2"), "--world", "table", f"--seed={seed}")
    assert (answer.status, answer.out) == (2, "")
    assert "--seed" in answer.err


def test_a_log_does_not_take_the_place_of_the_blueprint(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "hfsm.json"
    raw = Path(sample("hfsm")).read_bytes()
    file.write_bytes(raw)
    (tmp_path / "link.json").symlink_to(file)
    (tmp_path / "other.json").hardlink_to(file)
    os.mkfifo(tmp_path / "pipe")
    for log, words in (
        (file, "never written over"),
        (tmp_path / "other.json", "never written over"),
        (tmp_path / "link.json", "is a link"),
        (tmp_path / "pipe", "is no ordinary file"),
        (Path("/dev/null"), "is no ordinary file"),
        (Path("/dev/stdout"), "is "),
        (Path("-"), "a log is a file"),
    ):
        answer = shell("run", str(file), "--world", "table", "--log", os.fspath(log))
        assert (answer.status, answer.out) == (2, "")
        assert words in answer.err
        assert "Name a new file" in answer.err
        assert file.read_bytes() == raw
