"""``replay``: it prints the same events as the run, from the log alone, and verifies the log."""

from __future__ import annotations

import io
import json
import sys
from pathlib import Path
from random import Random
from types import SimpleNamespace

import pytest

from smsl_studio.runlog.events import Held
from tests.cli.shell import Shell, sample
from tests.runlog.logs import CHANGES, EVENTS, OTHER, tampered, write_log

BOTH = pytest.mark.parametrize("form", ["text", "json"])


@BOTH
@pytest.mark.parametrize(
    ("name", "seed", "more"),
    [
        ("hfsm", 0, ()),
        ("hfsm", 7, ("--start", "State111", "--goal", "State000")),
        ("registration", 1, ("--host", "process")),
        ("three-levels", 2, ()),
        ("three-roots", 3, ()),
        ("hanoi", 4, ("--avoid", "State_aaa/Op_1c")),
    ],
)
def test_a_replay_prints_what_the_run_printed(
    shell: Shell, tmp_path: Path, form: str, name: str, seed: int, more: tuple[str, ...]
) -> None:
    log = str(tmp_path / "log")
    asked = ("--world", "table", "--seed", str(seed), "--format", form, "--log", log)
    ran = shell("run", sample(name), *asked, *more)
    again = shell("replay", log, "--format", form)
    assert (again.status, again.err) == (0, "")
    assert again.out == ran.out
    assert shell("replay", log, "--verify").status == 0


def test_a_replay_of_physics_needs_none(shell: Shell, tmp_path: Path) -> None:
    log = str(tmp_path / "log")
    asked = ("--world", "hanoi", "--seed", "5", "--format", "json", "--log", log)
    ran = shell("run", sample("hanoi-2"), *asked)
    assert ran.status == 0
    assert shell("replay", log, "--format", "json").out == ran.out
    assert shell("replay", log, "--verify").status == 0


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "run.jsonl"
    write_log(path)
    return path


def test_standard_input_is_read(shell: Shell, log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told = shell("replay", str(log)).out
    for argv, words in ((("-",), told), (("-", "--verify"), "<stdin>: verified: 17 events, ")):
        stream = SimpleNamespace(buffer=io.BytesIO(log.read_bytes()))
        monkeypatch.setattr(sys, "stdin", stream)
        answer = shell("replay", *argv)
        assert answer.status == 0
        assert answer.out.startswith(words)
    monkeypatch.setattr(sys, "stdin", None)
    assert shell("replay", "-").err.startswith("<stdin>:1:1: standard input cannot be read")


def test_a_good_log_is_verified(shell: Shell, log: Path) -> None:
    head = json.loads(log.read_bytes().splitlines()[-1])["head"]
    answer = shell("replay", str(log), "--verify")
    assert (answer.status, answer.out) == (0, f"{log}: verified: 17 events, {head['hash']}\n")
    assert shell("replay", str(log), "--verify", "--format", "json").json == {
        "file": str(log),
        "verified": True,
        "events": 17,
        "head": head,
        "line": None,
        "column": None,
        "version": 3,
        "message": "",
    }


def test_a_changed_line_is_named(shell: Shell, log: Path) -> None:
    raw = log.read_bytes()
    log.write_bytes(raw.replace(b'"cost":1.5', b'"cost":1.4'))
    words = "not verified: the chain does not hold: this line, or one before it, was changed"
    answer = shell("replay", str(log), "--verify")
    assert (answer.status, answer.out, answer.err) == (1, f"{log}:5:1: {words}\n", "")
    verdict = shell("replay", str(log), "--verify", "--format", "json")
    assert verdict.status == 1
    found = verdict.json
    assert (found["verified"], found["line"], found["column"]) == (False, 5, 1)
    told = shell("replay", str(log), "--format", "json")
    assert (told.status, told.err) == (0, f"{log}:5:1: {words}\n")
    assert len(told.lines) == len(EVENTS)


def test_a_cut_log_is_told_up_to_there_and_not_verified(shell: Shell, log: Path) -> None:
    log.write_bytes(b"".join(log.read_bytes().splitlines(keepends=True)[:5]))
    told = shell("replay", str(log), "--format", "json")
    assert (told.status, len(told.lines)) == (0, 4)
    assert told.err.startswith(f"{log}:6:1: not verified: the log has no head")
    assert shell("replay", str(log), "--verify").status == 1


def test_changed_logs_are_answered_with_no(shell: Shell, log: Path, tmp_path: Path) -> None:
    raw, other = log.read_bytes(), write_log(tmp_path / "other", OTHER, 9)
    random = Random(11)
    for _ in range(40):
        how, changed = tampered(raw, other, random)
        log.write_bytes(changed)
        answer = shell("replay", str(log), "--verify")
        foreign = how in ("encode_anew", "dump_anew")
        assert answer.status == 1 or (answer.status == 2 and foreign), (how, changed)
        assert (answer.out + answer.err).startswith(f"{log}:")
        again = shell("replay", str(log))
        assert again.err.startswith(f"{log}:"), how
    assert len(CHANGES) > 20


@pytest.mark.parametrize("more", [(), ("--verify",), ("-o", "account.html")])
def test_what_is_no_log_is_unreadable(
    shell: Shell, tmp_path: Path, more: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for file in (sample("hfsm"), str(tmp_path), str(tmp_path / "nowhere"), "nul\0"):
        answer = shell("replay", file, *more)
        assert (answer.status, answer.out) == (2, "")
        place, advice = answer.err.splitlines()
        assert ":1:1: " in place
        assert advice
    assert not (tmp_path / "account.html").exists()


def test_what_a_log_says_cannot_disturb_a_terminal(shell: Shell, tmp_path: Path) -> None:
    log = tmp_path / "log"
    write_log(log, [Held(t=0.0, reason="\x1b[2J\n\u202egood\x9b", details=("\udcff",))])
    out = shell("replay", str(log)).out
    assert (
        out == "    0.000 s  held: reason \\x1b[2J\\n\\u202egood\\x9b, details \\udcff, kind held\n"
    )


def test_an_account_is_written_instead(shell: Shell, log: Path, tmp_path: Path) -> None:
    page = tmp_path / "account.html"
    answer = shell("replay", str(log), "-o", str(page))
    assert (answer.status, answer.out, answer.err) == (0, "", "")
    assert "The goal was reached" in page.read_text("utf-8")
    log.write_bytes(log.read_bytes()[:-1])
    answer = shell("replay", str(log), "-o", str(page))
    assert answer.status == 0
    assert "not verified" in answer.err
    assert "Not verified" in page.read_text("utf-8")


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("-o", "account.pdf"), "no name of a page"),
        (("-o", "x.html", "--verify"), "not allowed with"),
        (("--format", "xml"), "invalid choice"),
    ],
)
def test_wrong_usage_is_told(shell: Shell, log: Path, more: tuple[str, ...], words: str) -> None:
    answer = shell("replay", str(log), *more)
    assert (answer.status, answer.out) == (2, "")
    assert words in answer.err
