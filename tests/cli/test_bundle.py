"""``bundle`` writes evidence, and ``replay --verify --blueprint`` judges as the evidence does."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.approval import ADA, BEN, EVE, entry, register_of, written_policy
from tests.cli.people import Desk
from tests.cli.shell import Answer, Shell, sample
from tests.runlog.impossible import Story


@pytest.fixture
def log(shell: Shell, tmp_path: Path) -> Path:
    path = tmp_path / "run.jsonl"
    shell("run", sample("registration-digitization"), "--world", "table", "--log", str(path))
    return path


def test_a_bundle_has_all_its_parts(shell: Shell, tmp_path: Path, log: Path) -> None:
    out = tmp_path / "evidence.zip"
    again = tmp_path / "other" / "run.jsonl"
    again.parent.mkdir()
    again.write_bytes(log.read_bytes())
    file = sample("registration-digitization")
    answer = shell("bundle", file, "--log", str(log), "--log", str(again), "-o", str(out))
    assert (answer.status, answer.out, answer.err) == (0, "", "")
    with zipfile.ZipFile(out) as archive:
        names = archive.namelist()
        archive.extractall(tmp_path / "evidence")
    content = "content/registration-digitization.json"
    assert names == [
        "README.txt",
        "blueprint/registration-digitization.json",
        *(f"{content}/{part}.json" for part in ("behaviour", "brought", "closure", "meaning")),
        "logs/run-2.jsonl",
        "logs/run.jsonl",
        "report.html",
        "verify.py",
    ]
    done = subprocess.run([sys.executable, "verify.py"], cwd=tmp_path / "evidence", check=False)
    assert done.returncode == 0


def test_no_input_is_replaced_and_a_wrong_name_is_told(
    shell: Shell, tmp_path: Path, log: Path
) -> None:
    assert shell("bundle", sample("hfsm"), "-o", str(tmp_path / "out.tar")).status == 2
    assert "Let it end in .zip." in shell("bundle", sample("hfsm"), "-o", "out.tar").err
    kept = tmp_path / "log.zip"
    kept.write_bytes(log.read_bytes())
    assert shell("bundle", sample("hfsm"), "--log", str(kept), "-o", str(kept)).status == 2
    assert kept.read_bytes() == log.read_bytes()
    gone = shell("bundle", sample("hfsm"), "--log", "nowhere.jsonl", "-o", str(tmp_path / "x.zip"))
    assert gone.status == 2
    assert gone.err.startswith("nowhere.jsonl:1:1: the run log cannot be read")


def test_a_story_is_told_again_from_its_blueprint(shell: Shell, log: Path) -> None:
    file = sample("registration-digitization")
    good = shell("replay", str(log), "--verify", "--blueprint", file)
    assert good.status == 0
    assert good.out.rstrip().endswith(f"told again from {file}")
    without = shell("replay", str(log), "--verify")
    assert without.status == 0
    assert "the story was not told again" in without.err
    found = shell("replay", str(log), "--verify", "--blueprint", file, "--format", "json").json
    assert (found["verified"], found["blueprint"]) == (True, file)


def test_another_blueprint_or_story_is_refused(shell: Shell, tmp_path: Path, log: Path) -> None:
    file = sample("registration-digitization")
    other = shell("replay", str(log), "--verify", "--blueprint", sample("hfsm"))
    assert (other.status, other.out) == (1, f"{log}:1:1: not verified: its blueprint is not here\n")
    story = Story.of(log.read_bytes())
    at = story.at("operation_started")[0]
    del story.events[at]
    forged = tmp_path / "forged.jsonl"
    forged.write_bytes(story.raw())
    refused = shell("replay", str(forged), "--verify", "--blueprint", file, "--format", "json")
    assert refused.status == 1
    assert refused.json["line"] > at + 1


def test_a_blueprint_is_for_verify_alone(shell: Shell, log: Path) -> None:
    assert shell("replay", str(log), "--blueprint", sample("hfsm")).status == 2


ROLES = "roles = {engineer = 1, surgeon = 1}\n"


@pytest.fixture
def approved(desk: Desk) -> Desk:
    """An engineer and a surgeon have approved the blueprint."""
    desk.key("Ben Carson", "surgeon", "ben")
    for key in ("ada", "ben"):
        assert desk.approve(key).status == 0
    return desk


def test_signatures_are_checked_in_a_bundle(approved: Desk) -> None:
    assert _run(approved).status == 0
    folder = _bundle(approved, "--policy", written_policy(approved.folder, ROLES))
    assert {path.name for path in folder.iterdir()} >= {"records", "policy.toml", "keys.json"}
    status, said = _verify(folder)
    assert (status, "No record" in said) == (0, False), said


def _other_word(record: dict[str, Any]) -> None:
    one = record["records"][0]
    one["payload"] = record["records"][1]["payload"]


def _one_left(record: dict[str, Any]) -> None:
    del record["records"][1:]


def _another_order(record: dict[str, Any]) -> None:
    record["records"].reverse()


@pytest.mark.parametrize("change", [_other_word, _one_left, _another_order])
def test_a_changed_record_is_refused(
    change: Callable[[dict[str, Any]], None], approved: Desk
) -> None:
    _run(approved)
    folder = _bundle(approved, "--policy", written_policy(approved.folder, ROLES))
    record = folder / "records" / approved.record.name
    values = json.loads(record.read_text())
    change(values)
    record.write_text(json.dumps(values))
    status, said = _verify(folder)
    assert (status, "records: " in said) == (1, True), said


def test_a_policy_that_asks_for_more_is_not_met(approved: Desk) -> None:
    _run(approved)
    folder = _bundle(approved, "--policy", written_policy(approved.folder, f"persons = 3\n{ROLES}"))
    assert _verify(folder)[0] == 1
    folder = _bundle(approved, "--policy", written_policy(approved.folder, "[roles]\nnurse = 1\n"))
    assert _verify(folder)[0] == 1


@pytest.mark.parametrize("name", ["ADA LOVELACE", "AdaLovelace", "\uff21da Lovelace"])
def test_a_person_in_another_spelling_is_no_second_one(name: str, desk: Desk) -> None:
    desk.key(name, "surgeon", "second")
    for key in ("ada", "second"):
        assert desk.approve(key).status == 0
    _run(desk)
    folder = _bundle(desk, "--policy", written_policy(desk.folder, "persons = 2"))
    assert "too few sign" in _verify(folder)[1]


def test_the_last_word_of_a_person_counts_in_a_bundle(desk: Desk) -> None:
    """Who has rejected it and approves it later has changed the mind; and the other way round."""
    assert desk.approve("ada", "--verdict", "rejected").status == 0
    assert desk.approve("ada").status == 0
    assert desk.codes() == []
    _run(desk)
    status, said = _verify(_bundle(desk))
    assert status == 0, said
    assert desk.approve("ada", "--verdict", "rejected").status == 0
    _run(desk)
    assert "records: rejected" in _verify(_bundle(desk))[1]


@pytest.mark.parametrize("role", ["automatic", "recorder"])
def test_a_program_may_sign_only_where_the_policy_says_so(role: str, approved: Desk) -> None:
    approved.key("ci", role, "ci")
    assert approved.approve("ci").status == 0
    _run(approved)
    for text, good in ((ROLES, False), (f'automatic = "may_sign"\n{ROLES}', True)):
        policy = written_policy(approved.folder, text)
        assert (approved.codes("--policy", policy) == []) is good
        status, said = _verify(_bundle(approved, "--policy", policy))
        assert (status == 0) is good, said


def test_a_register_says_whose_the_keys_are(approved: Desk) -> None:
    _run(approved)
    ada, ben = (_public(approved, key) for key in (ADA.person, "Ben Carson"))
    ada_entry, ben_entry = {**entry(ADA), "keys": [ada]}, {**entry(BEN), "keys": [ben]}
    register = register_of(ada_entry, ben_entry)
    policy = written_policy(approved.folder, ROLES, register)
    folder = _bundle(approved, "--policy", policy)
    assert (folder / "register.json").read_bytes() == register
    assert _verify(folder)[0] == 0
    revoked = register_of(ada_entry, {**ben_entry, "revoked": "2020-01-01"})
    (folder / "register.json").write_bytes(revoked)
    assert "too few sign" in _verify(folder)[1]
    (folder / "register.json").write_bytes(register_of(ada_entry, ben_entry, by=ADA))
    assert _verify(folder)[0] == 1
    assert EVE.key not in (folder / "keys.json").read_text()


def test_what_was_signed_later_says_nothing_about_a_run(desk: Desk) -> None:
    _run(desk)
    log = desk.folder / "run.jsonl"
    assert desk.approve("ada").status == 0
    story = Story.of(log.read_bytes())
    story.header["wall_time"] = "2020-01-01T00:00:00.000+00:00"
    log.write_bytes(story.raw())
    status, said = _verify(_bundle(desk))
    assert (status, "too few sign" in said) == (1, True), said


def test_a_condition_is_open_until_it_is_met(desk: Desk) -> None:
    made = [*("--condition", "The lamp is on."), *("--condition", "The door is shut.")]
    assert desk.approve("ada", "--verdict", "conditions", *made).status == 0
    assert desk.approve("ada", "--met", "The lamp is on.").status == 0
    _run(desk)
    assert "a condition is open: The door is shut." in _verify(_bundle(desk))[1]
    assert desk.approve("ada", "--met", "The door is shut.").status == 0
    _run(desk)
    assert _verify(_bundle(desk))[0] == 0
    assert desk.codes() == []


def test_who_says_too_early_that_a_condition_is_met_closes_nothing(desk: Desk) -> None:
    """And a program closes nothing at all."""
    desk.key("Eve", "engineer", "eve")
    assert desk.approve("ada", "--met", "it is dry").status == 0
    assert desk.approve("eve", "--condition", "it is dry").status == 0
    assert desk.codes() == ["condition_unmet"]
    _run(desk)
    assert "a condition is open: it is dry" in _verify(_bundle(desk))[1]
    assert desk.approve("ada", "--met", "it is dry").status == 0
    assert desk.codes() == []
    _run(desk)
    assert _verify(_bundle(desk))[0] == 0


def _run(desk: Desk) -> Answer:
    return desk("run", desk.file, "--world", "table", "--log", str(desk.folder / "run.jsonl"))


def _bundle(desk: Desk, *more: str) -> Path:
    out = desk.folder / "out.zip"
    answer = desk(
        *("bundle", desk.file, "--log", str(desk.folder / "run.jsonl"), *more, "-o", str(out))
    )
    assert (answer.status, answer.err) == (0, "")
    with zipfile.ZipFile(out) as archive:
        archive.extractall(desk.folder / "evidence")
    return desk.folder / "evidence"


def _public(desk: Desk, person: str) -> str:
    answer = desk("keys", "list", "--format", "json")
    (found,) = (one for one in answer.json["keys"] if one["person"] == person)
    return str(found["public"])


def _verify(folder: Path) -> tuple[int, str]:
    command = [sys.executable, "verify.py"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr
    return done.returncode, done.stdout
