"""Keys on a token: they sign records, registers and logs as others do. The token is SoftHSM's."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.cli.people import Desk

PIN = "4321"


@pytest.fixture
def token(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The label of a new token, whose PIN is in the environment."""
    folder = tmp_path / "tokens"
    folder.mkdir()
    settings = tmp_path / "softhsm2.conf"
    settings.write_text(f"directories.tokendir = {folder}\nobjectstore.backend = file\n")
    monkeypatch.setenv("SOFTHSM2_CONF", str(settings))
    made = ["softhsm2-util", "--init-token", "--free", "--label", "card"]
    subprocess.run([*made, "--so-pin", "12345678", "--pin", PIN], check=True, capture_output=True)
    monkeypatch.setenv("SMSL_PASSPHRASE", PIN)
    return "card"


@pytest.fixture
def grace(desk: Desk, token: str) -> str:
    """A surgeon's key on the token."""
    made = ("keys", "make", "--person", "Grace Hopper", "--role", "surgeon", "--token", token)
    answer = desk(*made, "--id", "grace")
    assert answer.status == 0, answer.err
    return "grace"


def test_a_key_on_a_token_approves(desk: Desk, grace: str) -> None:
    answer = desk("approve", desk.file, "--key", grace)
    assert answer.status == 0, answer.err
    verified = desk.verify()
    assert (verified.status, verified.json["verdict"]) == (0, "approved")
    assert [one["person"] for one in verified.json["signers"]] == ["Grace Hopper"]
    shown = desk("keys", "show", grace, "--format", "json").json
    assert (shown["private"], shown["token"]) == (True, "card")
    assert "on the token card" in desk("keys", "list").out


def test_a_wrong_pin_signs_nothing(desk: Desk, grace: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SMSL_PASSPHRASE", "9999")
    for act in (
        ("approve", desk.file, "--key", grace),
        ("keys", "revoke", grace, "--why", "a try"),
    ):
        answer = desk(*act)
        assert answer.status != 0
        assert "the token card: the PIN does not open it" in answer.err
    assert not desk.record.exists()
    assert desk("keys", "show", grace, "--format", "json").json["revoked"] is None


def test_the_private_half_stays_on_its_token(
    desk: Desk, grace: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SMSL_NEW_PASSPHRASE", "another")
    copy = desk.folder / "copy.json"
    answer = desk("keys", "export", grace, "--private", "-o", str(copy))
    assert answer.status == 2
    assert "never leaves its token" in answer.err
    assert not copy.exists()
    assert desk("keys", "export", grace, "-o", str(copy)).status == 0
    assert "card" not in copy.read_text()


def test_a_token_that_was_taken_away_is_missed(desk: Desk, grace: str, tmp_path: Path) -> None:
    (tmp_path / "tokens").rename(tmp_path / "away")
    (tmp_path / "tokens").mkdir()
    answer = desk("approve", desk.file, "--key", grace)
    assert answer.status == 2
    assert "the token card: it is not here" in answer.err


def test_another_token_of_the_same_label_does_not_sign(
    desk: Desk, grace: str, tmp_path: Path
) -> None:
    (tmp_path / "tokens").rename(tmp_path / "away")
    (tmp_path / "tokens").mkdir()
    made = ["softhsm2-util", "--init-token", "--free", "--label", "card"]
    subprocess.run([*made, "--so-pin", "12345678", "--pin", PIN], check=True, capture_output=True)
    answer = desk("approve", desk.file, "--key", grace)
    assert answer.status == 2
    assert not desk.record.exists()


def test_a_log_is_signed_by_a_computer_whose_key_is_on_a_token(
    desk: Desk, token: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = ("keys", "make", "--person", "Room 3", "--role", "recorder", "--token", token)
    assert desk(*made).status == 0
    log = desk.folder / "run.jsonl"
    run = ("run", desk.file, "--world", "table", "--log", str(log))
    assert desk(*run).status == 0
    checked = desk("replay", str(log), "--verify", "--format", "json")
    assert (checked.status, bool(checked.json["signed"])) == (0, True)
    log.unlink()
    monkeypatch.setenv("SMSL_PASSPHRASE", "9999")
    answer = desk(*run)
    assert answer.status == 2
    assert "the PIN does not open it" in answer.err
    assert not log.exists()


def test_a_register_is_signed_by_a_token(desk: Desk, grace: str) -> None:
    persons = desk.folder / "persons.json"
    persons.write_text('{"version": 1, "serial": 1, "persons": []}')
    signed = desk.folder / "register.json"
    answer = desk("keys", "register", str(persons), "--key", grace, "-o", str(signed))
    assert answer.status == 0, answer.err
    assert "application/vnd.smsl-studio.register+json" in signed.read_text()
