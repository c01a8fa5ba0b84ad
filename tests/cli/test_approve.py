"""``keys``, ``approve``, ``verify`` and ``store revoke``: what people do with them."""

from __future__ import annotations

import json
import stat
from pathlib import Path
from typing import Any

import pytest
from google.protobuf.json_format import ParseDict
from in_toto_attestation.v1 import statement_pb2
from in_toto_attestation.v1.statement import Statement

from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.strict_json import from_base64
from tests.approval import ADA, BEN, DOOR, PASSPHRASE, entry, register_of, written_policy
from tests.cli.people import Desk
from tests.cli.shell import Shell


def statement(desk: Desk, number: int = -1) -> dict[str, Any]:
    """What the record says."""
    envelope = json.loads(desk.record.read_text())["records"][number]
    return dict(json.loads(from_base64(envelope["payload"], "it")))


def test_a_record_says_what_its_rules_are_worth(desk: Desk) -> None:
    assert desk.approve("ada").status == 0
    rules = {one["id"]: one["score"] for one in statement(desk)["predicate"]["rules"]}
    assert rules["R02"]["found"] > 0
    assert all(0 <= score["found"] <= score["of"] == 5_000 for score in rules.values())


def test_two_people_approve_and_the_record_says_so(desk: Desk) -> None:
    assert desk.codes() == ["no_record"]
    assert desk.approve("ada").status == 0
    desk.key("Ben Carson", "surgeon", "ben")
    assert desk.approve("ben", "--expires", "2999-01-31").status == 0
    answer = desk.verify()
    assert answer.status == 0
    assert answer.json["file"] == desk.file
    assert answer.json["verdict"] == "approved"
    assert answer.json["refusals"] == []
    assert [(one["person"], one["role"]) for one in answer.json["signers"]] == [
        ("Ada Lovelace", "engineer"),
        ("Ben Carson", "surgeon"),
    ]
    assert "keys of this computer, not of a register" in answer.err
    said = statement(desk)
    predicate = said["predicate"]
    assert predicate["expires"] == "2999-01-31T23:59:59.999999Z"
    assert predicate["follows"] is None
    assert {one["id"] for one in predicate["rules"]} > {"R01", "R19", "R30"}


def test_the_record_is_an_in_toto_statement(desk: Desk) -> None:
    desk.approve("ada")
    said = statement(desk)
    Statement.copy_from_pb(ParseDict(said, statement_pb2.Statement())).validate()
    assert said["predicateType"] == "urn:smsl-studio:inspection:v1"
    envelope = json.loads(desk.record.read_text())["records"][0]
    assert from_base64(envelope["payload"], "it") == canonical(said)


def test_the_digests_are_those_of_digest(desk: Desk) -> None:
    desk.approve("ada")
    found = desk("digest", desk.file, "--format", "json").json["files"][0]
    (subject,) = statement(desk)["subject"]
    assert subject["digest"] == {k: found[k] for k in ("behaviour", "meaning", "closure")}
    assert subject["name"] == "door.json"


def test_an_open_error_is_refused_unless_it_is_rejected(desk: Desk) -> None:
    desk.write({"DOOR": {**DOOR["DOOR"], "State_1": {"close": "State_9"}}})
    refused = desk.approve("ada")
    assert refused.status == 1
    assert "R02" in refused.err
    assert not desk.record.exists()
    assert desk.approve("ada", "--verdict", "rejected").status == 0
    assert "verdict_not_approved" in desk.codes()


def test_a_warning_needs_a_disposition(desk: Desk) -> None:
    values = {"DOOR": {**DOOR["DOOR"], "_operations": {"open": {"nonsense": 1}}}}
    desk.write(values)
    found = desk("check", desk.file, "--format", "json").json["files"][0]["findings"]
    (warning,) = (one for one in found if one["severity"] == "W")
    refused = desk.approve("ada")
    assert refused.status == 1
    assert f"{warning['rule']} {warning['address']} has no disposition" in refused.err
    about = f"{warning['rule']}@{warning['address']}=it is known, a = b"
    assert desk.approve("ada", "--disposition", about).status == 0
    predicate = statement(desk)["predicate"]
    assert predicate["dispositions"] == [
        {
            "rule": warning["rule"],
            "address": warning["address"],
            "text": "it is known, a = b",
        }
    ]
    assert desk.verify().status == 0
    assert desk.approve("ada", "--disposition", "nonsense").status == 2


def test_what_changed_since_the_record_is_a_warning_of_check_and_approve(desk: Desk) -> None:
    desk.approve("ada")
    same = desk("check", desk.file, "--rule", "R27", "--format", "json")
    assert same.json["files"][0]["findings"] == []
    desk.write({"DOOR": {**DOOR["DOOR"], "State_1": {"shut": "State_0"}}})
    for more in ((), ("--against", str(desk.record))):
        answer = desk("check", desk.file, *more, "--rule", "R27", "--format", "json")
        (finding,) = answer.json["files"][0]["findings"]
        assert (finding["rule"], finding["severity"]) == ("R27", "W")
        assert "the record of Ada Lovelace" in finding["message"]
        assert "its signature was not checked" in answer.err
    desk.record.rename(desk.folder / "elsewhere")
    answer = desk("check", desk.file, "--rule", "R27", "--format", "json")
    assert [one["rule"] for one in answer.json["files"][0]["findings"]] == ["R27"], "the store"
    refused = desk.approve("ada")
    assert refused.status == 1
    assert "R27" in refused.err
    about = f"R27@{finding['address']}=it was meant"
    assert desk.approve("ada", "--disposition", about).status == 0
    assert desk.verify().status == 0


def test_a_second_record_of_a_person_follows_the_first(desk: Desk) -> None:
    first = desk("approve", desk.file, "--key", "ada", "--format", "json").json
    desk.approve("ada")
    predicate = statement(desk)["predicate"]
    assert f"sha256:{predicate['follows']}" == first["digest"]
    assert len(json.loads(desk.record.read_text())["records"]) == 2
    assert desk.verify().status == 0


def test_a_passphrase_comes_from_a_file_and_a_wrong_one_signs_nothing(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = desk.folder / "wrong"
    wrong.write_text("something else\n")
    answer = desk.approve("ada", "--passphrase-file", str(wrong))
    assert answer.status == 2
    assert "does not open" in answer.err
    assert not desk.record.exists()
    monkeypatch.delenv("SMSL_PASSPHRASE")
    answer = desk.approve("ada")
    assert answer.status == 2
    assert "nobody to ask" in answer.err
    right = desk.folder / "right"
    right.write_text(f"{PASSPHRASE}\r\nand more\n")
    assert desk.approve("ada", "--passphrase-file", str(right)).status == 0


def test_private_keys_are_encrypted_and_for_their_owner_alone(desk: Desk, home: Path) -> None:
    (file,) = (home / "store" / "keys").iterdir()
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert PASSPHRASE not in file.read_text()
    shown = desk("keys", "list", "--format", "json").json["keys"]
    assert [one["id"] for one in shown] == ["ada"]
    assert shown[0]["private"] is True
    values = json.loads(file.read_text())
    file.write_text(json.dumps({**values, "role": "surgeon"}))
    answer = desk.approve("ada")
    assert answer.status == 2, "the role stands in the seal of the key"


def test_a_key_moves_to_another_store(
    desk: Desk, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    new = tmp_path / "new"
    new.write_text("another passphrase")
    both, public = str(tmp_path / "both.json"), str(tmp_path / "public.json")
    more = ("--private", "--new-passphrase-file", str(new))
    assert desk("keys", "export", "ada", "-o", both, *more).status == 0
    assert stat.S_IMODE(Path(both).stat().st_mode) == 0o600
    assert desk("keys", "export", "ada", "-o", both, *more).status == 2, "never over a file"
    assert desk("keys", "export", "ada", "-o", public).status == 0
    assert '"private": null' in Path(public).read_text()
    desk.approve("ada")
    monkeypatch.setenv("SMSL_STUDIO_HOME", str(tmp_path / "other home"))
    assert desk.codes() == ["key_unknown", "too_few_persons"]
    assert desk("keys", "import", public).status == 0
    assert desk.verify().status == 0
    assert desk.approve("ada").status == 2, "only the public half is here"
    assert desk("keys", "import", both).status == 0
    assert desk.approve("ada").status == 2, "the old passphrase does not open the copy"
    assert desk.approve("ada", "--passphrase-file", str(new)).status == 0


def test_a_register_decides_who_counts(desk: Desk, tmp_path: Path) -> None:
    ada = desk("keys", "show", "ada", "--format", "json").json
    desk.key("Head of quality", "quality", "head")
    desk.approve("ada")
    persons = {"version": 1, "serial": 3, "persons": []}
    (tmp_path / "list.json").write_text(json.dumps(persons))
    words = ("keys", "register", str(tmp_path / "list.json"), "--key", "head")
    assert desk(*words, "-o", str(tmp_path / "persons.json")).status == 0
    head = desk("keys", "show", "head", "--format", "json").json["public"]
    policy = tmp_path / "policy.toml"
    policy.write_text(f'register = "persons.json"\nregister_key = "{head}"\n')
    assert "key_unknown" in desk.codes("--policy", str(policy))
    person = {"person": "A. Lovelace", "roles": ["chief"], "keys": [ada["public"]]}
    persons = {"version": 1, "serial": 4, "persons": [{**person, "until": "2999-12-31"}]}
    (tmp_path / "list.json").write_text(json.dumps(persons))
    assert desk(*words, "-o", str(tmp_path / "persons.json")).status == 0
    answer = desk.verify("--policy", str(policy))
    assert answer.status == 0
    assert answer.json["signers"][0]["person"] == "A. Lovelace"
    assert answer.json["signers"][0]["role"] == "chief"
    assert "keys of this computer" not in answer.err
    (tmp_path / "list.json").write_text(json.dumps({**persons, "serial": 2}))
    assert desk(*words, "-o", str(tmp_path / "persons.json")).status == 0
    assert desk.codes("--policy", str(policy)) == ["register_invalid"]


def test_parts_with_records_of_their_own(desk: Desk) -> None:
    part = {"PART": {**DOOR["DOOR"]}}
    desk.write(part, "part.json")
    desk.write({"_imports": ["part.json"], **DOOR})
    part_file = str(desk.folder / "part.json")
    assert desk.approve("ada", "--relies-on", desk.file).status == 2
    assert desk.approve("ada", "--relies-on", part_file).status == 0
    assert desk.codes() == ["sub_not_covered", "too_few_persons"]
    assert desk("approve", part_file, "--key", "ada").status == 0
    assert desk.verify().status == 0
    predicate = statement(desk)["predicate"]
    assert predicate["looked_at"] == ["door.json"]
    assert [one["name"] for one in predicate["relies_on"]] == ["part.json"]


def test_digests_are_revoked_for_this_user(desk: Desk) -> None:
    signed = desk("approve", desk.file, "--key", "ada", "--format", "json").json
    words = ("store", "revoke", signed["digest"], "--key", "ada", "--why", "a wrong file")
    assert desk("store", "revoke", "nonsense", "--key", "ada", "--why", "x").status == 2
    assert desk("store", "revoke", signed["digest"], "--key", "ada").status == 2
    assert desk(*words).status == 0
    assert desk.codes() == ["record_revoked", "too_few_persons"]


def test_the_audit_log_tells_what_was_done_and_shows_a_change(desk: Desk, home: Path) -> None:
    desk.approve("ada")
    log = home / "store" / "audit.jsonl"
    lines = log.read_bytes().splitlines(keepends=True)
    assert [json.loads(line)["act"] for line in lines] == ["make", "approve"]
    log.write_bytes(lines[0].replace(b"engineer", b"surgeonX") + lines[1])
    answer = desk.approve("ada")
    assert answer.status == 2
    assert "audit.jsonl:1:1" in answer.err
    log.write_bytes(lines[0])
    assert "taken away" in desk.approve("ada").err
    log.write_bytes(b"".join(lines))
    assert desk.approve("ada").status == 0


@pytest.mark.parametrize(
    "words",
    [
        ("keys", "make", "--person", "x"),
        ("keys", "make", "--person", "x", "--role", "y", "--id", "../up"),
        ("keys", "make", "--person", "x", "--role", "y", "--why", "z"),
        ("keys", "make", "--person", "Ada", "--role", "y", "--id", "ADA"),
        ("keys", "show", "nobody"),
        ("keys", "show"),
        ("keys", "import", "no such file"),
        ("keys", "revoke", "ada"),
        ("keys", "revoke", "ada", "--why", " "),
        ("store", "revoke"),
    ],
)
def test_wrong_words_change_nothing(desk: Desk, home: Path, words: tuple[str, ...]) -> None:
    before = sorted((home / "store" / "keys").iterdir())
    answer = desk(*words)
    assert (answer.status, answer.out) == (2, "")
    assert "Traceback" not in answer.err
    assert sorted((home / "store" / "keys").iterdir()) == before


@pytest.mark.parametrize(
    "more",
    [
        ("--verdict", "conditions"),
        ("--verdict", "rejected", "--condition", "x"),
        ("--expires", "2001-01-01"),
        ("--expires", "soon"),
        ("--rule", "R99"),
        ("--relies-on", "nothing.json"),
        ("--world", "nowhere"),
    ],
)
def test_an_approval_whose_parts_do_not_fit_is_refused(desk: Desk, more: tuple[str, ...]) -> None:
    assert desk.approve("ada", *more).status in (1, 2)
    assert not desk.record.exists()


def test_a_register_made_by_others_is_read(shell: Shell, desk: Desk, tmp_path: Path) -> None:
    policy = written_policy(tmp_path, "persons = 1", register_of(entry(ADA), entry(BEN)))
    assert desk.codes("--policy", policy) == ["no_record"]
