"""Logs with a signed head: who has written a log, and what is said about one that nobody signed."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.inspection.approval.log_seal import PAYLOAD_TYPE
from smsl_studio.seal.ed25519 import new_private, sealed
from tests.approval import PASSPHRASE, register_of, written_policy
from tests.cli.people import Desk
from tests.runlog.impossible import Story

Json = Any


@pytest.fixture
def recorded(desk: Desk) -> Path:
    """The log of a run where a recorder's key is; its passphrase is in the environment."""
    desk.key("Room 3", "recorder", "room-3")
    return _run(desk)


def _run(desk: Desk, *more: str) -> Path:
    log = desk.folder / "run.jsonl"
    answer = desk("run", desk.file, "--world", "table", "--log", str(log), *more)
    assert answer.status == 0, answer.err
    return log


def _last(log: Path) -> Json:
    return json.loads(log.read_bytes().splitlines()[-1])


def test_a_run_signs_the_head_of_its_log(recorded: Path, desk: Desk) -> None:
    last = _last(recorded)
    assert set(last) == {"head", "signed"}
    assert PASSPHRASE not in recorded.read_text()
    plain = desk("replay", str(recorded), "--verify", "--blueprint", desk.file)
    assert (plain.status, ", signed by Room 3 (room-3), " in plain.out) == (0, True)
    assert desk("replay", str(recorded), "--verify", "--format", "json").json["signed"]
    status, said = _verify(_bundle(desk))
    assert (status, "The head of a log is signed by Room 3." in said) == (0, True), said
    page = desk.folder / "account.html"
    assert desk("replay", str(recorded), "-o", str(page)).status == 0
    assert "It carries a signature of its head" in page.read_text()


def test_without_a_recorder_nothing_is_signed(desk: Desk) -> None:
    log = _run(desk)
    assert set(_last(log)) == {"head"}
    answer = desk("replay", str(log), "--verify", "--blueprint", desk.file)
    assert (answer.status, answer.err) == (0, "")
    assert "The head of a log is signed by nobody." in _verify(_bundle(desk))[1]


def test_a_log_that_was_made_anew_is_not_signed(recorded: Path, desk: Desk) -> None:
    recorded.write_bytes(Story.of(recorded.read_bytes()).raw())
    answer = desk("replay", str(recorded), "--verify", "--blueprint", desk.file)
    assert answer.status == 0
    assert "its head is not signed, and this computer has a recorder's key" in answer.err
    assert "is signed by nobody" in _verify(_bundle(desk))[1]


def _other_chain(desk: Desk, raw: bytes) -> Json:
    """The signature of another log."""
    return {}


def _other_key(desk: Desk, raw: bytes) -> Json:
    """The key of a computer that nobody here knows."""
    return sealed(new_private(), PAYLOAD_TYPE, raw).as_json()


def _other_kind(desk: Desk, raw: bytes) -> Json:
    return sealed(_private(desk, "room-3"), "application/vnd.in-toto+json", raw).as_json()


def _person(desk: Desk, raw: bytes) -> Json:
    """A person's key, which approves blueprints and writes no logs."""
    return sealed(_private(desk, "ada"), PAYLOAD_TYPE, raw).as_json()


def _moved(desk: Desk, raw: bytes) -> Json:
    """The signature of another head, under the right bytes and the right name."""
    right = sealed(_private(desk, "room-3"), PAYLOAD_TYPE, raw).as_json()
    other = sealed(_private(desk, "room-3"), PAYLOAD_TYPE, b"{}").as_json()
    return {**right, "signatures": other["signatures"]}


def _one_more_member(desk: Desk, raw: bytes) -> Json:
    """Another spelling of the right envelope."""
    right = sealed(_private(desk, "room-3"), PAYLOAD_TYPE, raw).as_json()
    return {**right, "extra": 1}


def _other_base64(desk: Desk, raw: bytes) -> Json:
    """Another spelling of the right signature: the last digit has bits that mean nothing."""
    right = sealed(_private(desk, "room-3"), PAYLOAD_TYPE, raw).as_json()
    one = right["signatures"][0]
    last = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/"
    digit = last[last.index(one["sig"][-3]) + 1]
    return {**right, "signatures": [{**one, "sig": f"{one['sig'][:-3]}{digit}=="}]}


FORGED: tuple[Callable[[Desk, bytes], Json], ...] = (
    _other_chain, _other_key, _other_kind, _person, _moved, _one_more_member, _other_base64,
)  # fmt: skip


@pytest.mark.parametrize("forger", FORGED, ids=lambda one: one.__name__[1:])
def test_a_head_that_this_computer_did_not_sign_is_refused(
    forger: Callable[[Desk, bytes], Json], recorded: Path, desk: Desk
) -> None:
    before = _last(recorded)["signed"]
    story = Story.of(recorded.read_bytes())
    story.header["node"] = "elsewhere"
    *lines, head = story.raw().splitlines(keepends=True)
    raw = head[len(b'{"head":') : -2]
    _write(recorded, lines, json.loads(raw), forger(desk, raw) or before)
    answer = desk("replay", str(recorded), "--verify", "--blueprint", desk.file)
    assert (answer.status, "not verified" in answer.out) == (1, True), answer.out
    status, said = _verify(_bundle(desk))
    assert (status, "Not consistent." in said) == (1, True), said


def test_a_signed_head_in_another_spelling_is_refused(recorded: Path, desk: Desk) -> None:
    raw = recorded.read_bytes()
    recorded.write_bytes(raw.replace(b'"signed":{', b'"signed":{ '))
    answer = desk("replay", str(recorded), "--verify")
    assert (answer.status, "not as Studio writes it" in answer.out) == (1, True)
    assert _verify(_bundle(desk))[0] == 1


def test_the_right_key_makes_no_impossible_story_true(recorded: Path, desk: Desk) -> None:
    story = Story.of(recorded.read_bytes())
    del story.events[story.at("operation_started")[0]]
    *lines, head = story.raw().splitlines(keepends=True)
    raw = head[len(b'{"head":') : -2]
    signed = sealed(_private(desk, "room-3"), PAYLOAD_TYPE, raw).as_json()
    _write(recorded, lines, json.loads(raw), signed)
    assert desk("replay", str(recorded), "--verify", "--blueprint", desk.file).status == 1
    status, said = _verify(_bundle(desk))
    assert (status, "logs/run.jsonl: line" in said) == (1, True), said


def test_a_revoked_recorder_counts_no_more(recorded: Path, desk: Desk) -> None:
    assert desk("keys", "revoke", "room-3", "--why", "stolen").status == 0
    answer = desk("replay", str(recorded), "--verify")
    assert (answer.status, "which is revoked: stolen" in answer.out) == (1, True)
    assert _verify(_bundle(desk))[0] == 1
    again = desk.folder / "again.jsonl"
    assert desk("run", desk.file, "--world", "table", "--log", str(again)).status == 0
    assert set(_last(again)) == {"head"}


def test_the_passphrase_is_asked_before_anything_moves(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    desk.key("Room 3", "recorder", "room-3")
    monkeypatch.setenv("SMSL_PASSPHRASE", "wrong")
    log = desk.folder / "run.jsonl"
    words = ("run", desk.file, "--world", "table", "--log", str(log))
    answer = desk(*words)
    assert (answer.status, log.exists()) == (2, False)
    assert "does not open this key" in answer.err
    right = desk.folder / "passphrase"
    right.write_text(PASSPHRASE)
    assert desk(*words, "--passphrase-file", str(right)).status == 0
    assert "signed" in _last(log)
    monkeypatch.delenv("SMSL_PASSPHRASE")
    log.unlink()
    answer = desk(*words)
    assert (answer.status, set(_last(log))) == (0, {"head"})
    assert "the log is not signed: there is no passphrase for room-3" in answer.err
    assert desk("run", desk.file, "--world", "table", "--passphrase-file", str(right)).status == 2


def test_a_recorder_approves_nothing(desk: Desk) -> None:
    desk.key("Room 3", "recorder", "room-3")
    assert desk.approve("room-3").status == 0
    assert "policy_unmet" in desk.codes()
    assert "a program signs" in _verify(_bundle(desk, log=False))[1]


def test_with_a_register_it_must_name_the_recorder(recorded: Path, desk: Desk) -> None:
    assert desk.approve("ada").status == 0
    keys = {
        one["person"]: one["public"]
        for one in desk("keys", "list", "--format", "json").json["keys"]
    }
    known = {"person": "Ada Lovelace", "roles": ["engineer"], "keys": [keys["Ada Lovelace"]]}
    room = {"person": "Room 3", "roles": ["recorder"], "keys": [keys["Room 3"]]}
    _run_again(desk, recorded)
    policy = written_policy(desk.folder, "", register_of(known, room))
    status, said = _verify(_bundle(desk, "--policy", policy))
    assert (status, "is signed by Room 3" in said) == (0, True), said
    policy = written_policy(desk.folder, "", register_of(known))
    assert _verify(_bundle(desk, "--policy", policy))[0] == 1


def _run_again(desk: Desk, log: Path) -> None:
    log.unlink()
    _run(desk)


def _private(desk: Desk, key: str) -> bytes:
    from smsl_studio.inspection.approval.key_store import stored_key

    return stored_key(key).opened(PASSPHRASE.encode())


def _write(log: Path, lines: list[bytes], head: Json, signed: Json) -> None:
    last = json.dumps({"head": head, "signed": signed}, separators=(",", ":")).encode()
    log.write_bytes(b"".join(lines) + last + b"\n")


def _bundle(desk: Desk, *more: str, log: bool = True) -> Path:
    out = desk.folder / "out.zip"
    logs = ("--log", str(desk.folder / "run.jsonl")) if log else ()
    answer = desk("bundle", desk.file, *logs, *more, "-o", str(out))
    assert answer.status == 0, answer.err
    with zipfile.ZipFile(out) as archive:
        archive.extractall(desk.folder / "evidence")
    return desk.folder / "evidence"


def _verify(folder: Path) -> tuple[int, str]:
    command = [sys.executable, "verify.py"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout
