"""Attacks on approvals that were tried by hand, each through the command line."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.front.approval_files import TrustFiles, trust_files
from smsl_studio.front.check_findings import whole_check
from smsl_studio.inspection.approval.audit_log import append_act, audit_file
from smsl_studio.inspection.approval.known_keys import name_of
from smsl_studio.inspection.approval.times import written_time
from smsl_studio.seal.chain import Chain
from smsl_studio.smsl.inputs import read_ordinary
from tests.approval import NOON, PASSPHRASE, written_policy
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


def signed_copy(desk: Desk, *, with_record: bool) -> Desk:
    """A copy in another folder of what Ada has signed, which she signs there, too."""
    assert desk.approve("ada").status == 0
    (desk.folder / "copy").mkdir()
    copy = Desk(desk.shell, desk.folder / "copy")
    shutil.copy(desk.file, copy.file)
    if with_record:
        shutil.copy(desk.record, copy.record)
    assert copy.approve("ada").status == 0
    return copy


def put_back(desk: Desk, raw: bytes) -> list[str]:
    """Put an older record back; the codes of the refusals."""
    desk.record.write_bytes(raw)
    return desk.codes()


@pytest.mark.parametrize("with_record", [False, True])
def test_a_signed_copy_makes_the_file_that_stands_beside_it_no_older(
    with_record: bool, desk: Desk
) -> None:
    first = signed_copy(desk, with_record=with_record)
    assert (desk.codes(), first.codes()) == ([], [])
    old = desk.record.read_bytes()
    assert desk.approve("ada", "--verdict", "rejected").status == 0
    assert (desk.codes(), first.codes()) == (["verdict_not_approved", "too_few_persons"], [])
    assert put_back(desk, old) == ["rolled_back"], "the file itself was rejected since"


@pytest.mark.parametrize("with_record", [False, True])
def test_the_first_record_does_not_bring_back_a_copy_that_was_rejected(
    with_record: bool, desk: Desk
) -> None:
    copy = signed_copy(desk, with_record=with_record)
    assert copy.approve("ada", "--verdict", "rejected").status == 0
    assert put_back(copy, desk.record.read_bytes()) == ["rolled_back"]
    assert desk.codes() == []


def test_a_copy_with_its_record_goes_on_in_the_chain_for_everybody_else(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who sees only the copy must notice when the second record is cut off."""
    copy, public = signed_copy(desk, with_record=True), str(desk.folder / "ada.json")
    assert desk("keys", "export", "ada", "-o", public).status == 0
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(desk.folder / "another home"))
    assert desk("keys", "import", public).status == 0
    assert copy.codes() == []
    assert put_back(copy, desk.record.read_bytes()) == ["rolled_back"]


def test_a_file_that_was_moved_keeps_its_chain(desk: Desk) -> None:
    """Under its new name it is signed again without its record, and then the old one is put back,
    under both names."""
    assert desk.approve("ada").status == 0
    old = desk.record.read_bytes()
    desk.record.unlink()
    (desk.folder / "moved").mkdir()
    moved = Desk(desk.shell, desk.folder / "moved")
    shutil.move(desk.file, moved.file)
    assert moved.approve("ada", "--verdict", "rejected").status == 0
    assert put_back(moved, old) == ["rolled_back"]
    shutil.move(moved.file, desk.file)
    assert put_back(desk, old) == ["rolled_back"]


def test_a_moved_file_with_its_record_is_approved_and_its_old_record_is_not(desk: Desk) -> None:
    assert desk.approve("ada").status == 0
    old = desk.record.read_bytes()
    assert desk.approve("ada").status == 0
    (desk.folder / "moved").mkdir()
    moved = Desk(desk.shell, desk.folder / "moved")
    for path in (desk.file, desk.record):
        shutil.move(path, moved.folder)
    assert moved.codes() == []
    assert put_back(moved, old) == ["rolled_back"]


def test_of_two_first_signatures_at_the_same_moment_one_is_refused(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Ben rejects while the record of Ada is made: no word is lost without a sentence."""
    desk.key("Ben Carson", "engineer", "ben")
    statuses: list[int] = []

    def meanwhile(*given: Any) -> Any:
        if not statuses:
            statuses.append(-1)
            # The command that waits has taken the passphrase out of the environment.
            monkeypatch.setenv("SMSL_PASSPHRASE", PASSPHRASE)
            statuses[0] = desk.approve("ben", "--verdict", "rejected").status
        return whole_check(*given)

    monkeypatch.setattr("smsl_studio.front.signatures.whole_check", meanwhile)
    later = desk.approve("ada")
    assert statuses == [0]
    assert later.status != 0
    assert "another program has written it" in later.err
    people = [one["person"] for one in desk.verify().json["signers"]]
    assert people == ["Ben Carson"]
    assert desk.approve("ada").status == 0
    assert "verdict_not_approved" in desk.codes()


def test_a_name_in_a_bundle_is_plain_and_no_way_out_of_its_folder(
    desk: Desk, tmp_path: Path
) -> None:
    for name in ("..\\..\\evil.json", "a\nb.json", "%5c.json", "\\.json"):
        path = Path(desk.write(name=name))
        out = tmp_path / "evidence.zip"
        assert desk.shell("approve", str(path), "--key", "ada").status == 0
        assert desk.shell("bundle", str(path), "-o", str(out)).status == 0
        with zipfile.ZipFile(out) as archive:
            names = archive.namelist()
            archive.extractall(tmp_path / "evidence")
        odd = {char for one in names for char in one if char == "\\" or not char.isprintable()}
        assert (odd, len(set(names))) == (set(), len(names))
        verifier = [sys.executable, "verify.py"]
        done = subprocess.run(verifier, cwd=tmp_path / "evidence", check=False, capture_output=True)
        assert done.returncode == 0, done.stdout
        shutil.rmtree(tmp_path / "evidence")
