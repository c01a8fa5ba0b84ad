"""Attacks on approvals that were tried by hand, each through the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from smsl_studio.front.approval_files import TrustFiles, trust_files
from smsl_studio.inspection.approval.audit_log import append_act, audit_file
from smsl_studio.inspection.approval.known_keys import name_of
from smsl_studio.inspection.approval.times import written_time
from smsl_studio.seal.chain import Chain
from smsl_studio.smsl.inputs import read_ordinary
from tests.approval import NOON, written_policy
from tests.cli.people import Desk


def test_a_record_that_nobody_verified_in_between_is_no_gap(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Another store sees the first record, and then the third one with both others before it."""
    public, home = str(desk.folder / "ada.json"), str(desk.folder / "another home")
    own = str(Path(desk.folder / "own"))
    monkeypatch.setenv("SMSL_STUDIO_HOME", own)
    desk.key("Ada Lovelace", "engineer", "ada")
    assert desk("keys", "export", "ada", "-o", public).status == 0
    assert desk.approve("ada").status == 0
    first = desk.record.read_bytes()
    monkeypatch.setenv("SMSL_STUDIO_HOME", home)
    assert desk("keys", "import", public).status == 0
    assert desk.codes() == []
    monkeypatch.setenv("SMSL_STUDIO_HOME", own)
    assert desk.approve("ada").status == 0
    assert desk.approve("ada", "--verdict", "rejected").status == 0
    monkeypatch.setenv("SMSL_STUDIO_HOME", home)
    assert "verdict_not_approved" in desk.codes()
    desk.record.write_bytes(first)
    assert desk.codes() == ["rolled_back"]


SPELLINGS = ("ada lovelace", "AdaLovelace", "Ada\u200b Lovelace", "A\u00adda Lovelace",
             "\uff21da Lovelace", "Ada\u2800Lovelace", "Ada\tLovelace\u2060")  # fmt: skip


@pytest.mark.parametrize("name", SPELLINGS)
def test_a_person_under_another_spelling_is_no_second_person(name: str, desk: Desk) -> None:
    assert name_of(name) == name_of("Ada Lovelace")
    desk.key(name, "surgeon", "second")
    assert desk.approve("ada").status == 0
    assert desk.approve("second").status == 0
    policy = written_policy(desk.folder, "persons = 2")
    assert desk.codes("--policy", policy) == ["too_few_persons"]


def test_no_line_can_be_put_at_the_end_of_a_changed_audit_log(desk: Desk, home: Path) -> None:
    """The head may count one line less than the log, but then it must be the head of the rest."""
    desk.approve("ada")
    lines = audit_file().read_bytes().splitlines(keepends=True)
    chain, forged = Chain(), b""
    for act in ("nothing", "nothing", "nothing"):
        text = json.dumps({"time": written_time(NOON), "act": act}, separators=(",", ":"))
        forged += chain.linked(text.encode())
    assert len(lines) == 2
    audit_file().write_bytes(forged)
    assert "taken away or put there" in desk.approve("ada").err
    # A stop between the line and its head is no change.
    head = home / "store" / "audit-head.json"
    audit_file().write_bytes(b"".join(lines))
    before = head.read_bytes()
    append_act(NOON, "something")
    head.write_bytes(before)
    assert desk.approve("ada").status == 0


def test_the_digest_in_the_header_is_that_of_the_policy_that_was_judged(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The policy is read once: what is written into the log is what was believed."""
    policy = Path(written_policy(desk.folder, "persons = 1"))

    def swapped(path: Path, most: int) -> object:
        found = read_ordinary(path, most)
        if path == policy:
            policy.write_text("persons = 3")
        return found

    monkeypatch.setattr("smsl_studio.front.approval_files.read_ordinary", swapped)
    found = trust_files(policy)
    assert isinstance(found, TrustFiles)
    assert found.grounds.policy.needed == 1


def test_a_copy_of_an_earlier_version_is_signed_without_a_fork(desk: Desk) -> None:
    """The copy stands elsewhere, and the file has been changed and signed again since."""
    copy = desk.folder / "elsewhere" / "door.json"
    copy.parent.mkdir()
    copy.write_bytes(Path(desk.file).read_bytes())
    assert desk.approve("ada").status == 0
    changed = json.loads(Path(desk.file).read_bytes())
    changed["DOOR"]["State_0"]["push"] = "State_1"
    desk.write(changed)
    assert desk.approve("ada", "--disposition", "R27@DOOR/State_0/push=wanted").status == 0
    assert desk.codes() == []
    assert desk.shell("approve", str(copy), "--key", "ada").status == 0
    answer = desk.shell("verify", str(copy), "--format", "json")
    assert (answer.status, answer.json["refusals"]) == (0, [])
    assert desk.codes() == [], "the file that was changed is not older either"
