"""Who must have signed, and when a signature counts: the one function that decides."""

from __future__ import annotations

from dataclasses import replace
from datetime import timedelta
from typing import Any

import pytest

from smsl_studio.inspection.approval.case import SeenRecord, TrustGrounds
from smsl_studio.inspection.approval.known_keys import KnownKey
from smsl_studio.inspection.approval.policy import TrustPolicy
from smsl_studio.inspection.approval.record_file import SignedRecord
from smsl_studio.inspection.approval.statement import WorldCode
from smsl_studio.seal.envelope import Envelope
from tests.approval import (
    ADA,
    BEN,
    BOT,
    DOOR,
    EVE,
    NOON,
    Member,
    codes,
    door,
    judged,
    signed,
    trusting,
)
from tests.plugin_folder import blueprint_of

BOTH = TrustPolicy(roles={"engineer": 1, "surgeon": 1})


def test_one_person_is_enough_where_no_policy_says_more() -> None:
    found = judged(door(), [signed(door(), ADA)])
    assert (found.verdict, found.refusals) == ("approved", ())
    assert found.signers[0].as_json() == {
        "person": "Ada Lovelace",
        "role": "engineer",
        "key": ADA.key,
        "time": "2026-03-01T12:00:00.000000Z",
        "verdict": "approved",
    }


def test_nobody_is_not_enough() -> None:
    assert codes(judged(door(), [])) == {"no_record"}


def test_each_role_needs_a_person_of_its_own() -> None:
    both = [signed(door(), ADA), signed(door(), BEN, 1)]
    assert judged(door(), both, trusting(BOTH)).is_approved
    found = judged(door(), both[:1], trusting(BOTH))
    assert codes(found) == {"too_few_persons", "role_missing"}
    two = [signed(door(), ADA), signed(door(), EVE, 1)]
    assert codes(judged(door(), two, trusting(BOTH))) == {"role_missing"}


def test_a_person_of_two_roles_fills_one_of_them() -> None:
    keys = {ADA.key: KnownKey(ADA.public, ADA.person, ("engineer", "surgeon")), BEN.key: BEN.known}
    grounds = TrustGrounds(BOTH, keys, given=True)
    assert codes(judged(door(), [signed(door(), ADA)], grounds)) == {
        "too_few_persons",
        "role_missing",
    }
    both = [signed(door(), ADA), signed(door(), BEN, 1)]
    assert judged(door(), both, grounds).is_approved
    swapped = [signed(door(), BEN), signed(door(), ADA, 1)]
    assert judged(door(), swapped, grounds).is_approved


def test_one_person_with_two_keys_is_one_person() -> None:
    again = Member("ada  LOVELACE ", "surgeon", bytes(range(9, 41)))
    grounds = trusting(TrustPolicy(persons=2), ADA, again)
    found = judged(door(), [signed(door(), ADA), signed(door(), again, 1)], grounds)
    assert codes(found) == {"too_few_persons"}
    assert len(found.signers) == 1


def test_a_program_never_counts_as_a_person() -> None:
    records = [signed(door(), ADA), signed(door(), BOT, 1)]
    two = trusting(TrustPolicy(persons=2, automatic="may_sign"))
    assert codes(judged(door(), records, two)) == {"too_few_persons"}
    one = trusting(TrustPolicy(automatic="may_sign"))
    assert judged(door(), records, one).is_approved
    assert codes(judged(door(), records)) == {"policy_unmet"}
    role = trusting(TrustPolicy(roles={"automatic": 1}, automatic="may_sign"))
    assert "role_missing" in codes(judged(door(), records, role))


def test_the_last_word_of_a_person_counts() -> None:
    yes = signed(door(), ADA)
    no = signed(door(), ADA, 1, verdict="rejected", follows=yes.digest)
    assert "verdict_not_approved" in codes(judged(door(), [yes, no]))
    again = signed(door(), ADA, 2, follows=no.digest)
    assert judged(door(), [yes, no, again]).is_approved
    other = signed(door(), BEN, 2)
    assert codes(judged(door(), [yes, no, other])) == {"verdict_not_approved"}


def test_a_key_that_is_not_known_is_told_and_not_believed() -> None:
    found = judged(door(), [signed(door(), ADA)], trusting(TrustPolicy(), BEN))
    assert codes(found) == {"key_unknown", "too_few_persons"}
    assert found.signers == ()


def test_a_moved_signature_is_wrong() -> None:
    one, other = signed(door(), ADA), signed(door(), ADA, 1)
    first, second = one.envelope, other.envelope
    moved = Envelope(first.kind, first.payload, first.keyid, second.signature)
    assert "signature_invalid" in codes(judged(door(), [SignedRecord.of(moved)]))


@pytest.mark.parametrize(
    "keyid", ["", "ada", ADA.key.removeprefix("sha256:"), BEN.key, "sha256:" + "0" * 64]
)
def test_a_keyid_that_is_not_the_identity_of_the_key_is_wrong(keyid: str) -> None:
    envelope = replace(signed(door(), ADA).envelope, keyid=keyid)
    assert "signature_invalid" in codes(judged(door(), [SignedRecord.of(envelope)]))


def test_records_stand_in_the_order_of_signing() -> None:
    records = [signed(door(), ADA, 1), signed(door(), BEN)]
    assert codes(judged(door(), records)) == {"signature_invalid"}
    assert "signature_invalid" in codes(judged(door(), [records[0], records[0]]))


def test_a_change_voids_a_signature() -> None:
    changed = blueprint_of({"DOOR": {**DOOR["DOOR"], "State_1": {}}})
    found = judged(changed, [signed(door(), ADA)])
    assert codes(found) == {"digest_differs", "too_few_persons"}
    again = [signed(door(), ADA), signed(changed, BEN, 1)]
    assert judged(changed, again).is_approved
    assert "digest_differs" in codes(judged(changed, again, trusting(TrustPolicy(persons=2))))


@pytest.mark.parametrize(
    ("minutes", "expires", "days", "good"),
    [
        (60 * 24, None, None, True),
        (60 * 24, None, 1.0, True),
        (60 * 24 + 1, None, 1.0, False),
        (60 * 24 * 400, None, None, True),
        (30, "2026-03-01T12:30:00.000000Z", 9.0, True),
        (31, "2026-03-01T12:30:00.000000Z", 9.0, False),
        (60 * 24 + 1, "2026-04-01T12:30:00.000000Z", 1.0, False),
    ],
)
def test_a_record_ends_at_the_earlier_of_its_two_ends(
    minutes: float, expires: str | None, days: float | None, good: bool
) -> None:
    grounds = trusting(TrustPolicy(valid_days=days))
    found = judged(door(), [signed(door(), ADA, expires=expires)], grounds, minutes)
    assert found.is_approved == good
    assert ("record_expired" in codes(found)) != good


@pytest.mark.parametrize(("minutes", "good"), [(-5, True), (-5.01, False)])
def test_a_clock_that_stands_before_a_record_refuses_it(minutes: float, good: bool) -> None:
    found = judged(door(), [signed(door(), ADA)], minutes=minutes)
    assert ("signature_invalid" in codes(found)) != good


def test_a_key_counts_while_its_entry_is_valid() -> None:
    hour = timedelta(hours=1)
    for since, until, good in (
        (None, None, True),
        (NOON, NOON, True),
        (NOON + hour, None, False),
        (None, NOON - hour, False),
    ):
        key = KnownKey(ADA.public, ADA.person, ("engineer",), since, until)
        grounds = TrustGrounds(TrustPolicy(), {ADA.key: key}, registered=True, given=True)
        found = judged(door(), [signed(door(), ADA)], grounds)
        assert found.is_approved == good
        assert ("key_expired" in codes(found)) != good


def test_who_is_revoked_does_not_count_whatever_the_time() -> None:
    record = signed(door(), ADA)
    stolen = KnownKey(ADA.public, ADA.person, ("engineer",), revoked="it was stolen")
    grounds = TrustGrounds(TrustPolicy(), {ADA.key: stolen, BEN.key: BEN.known}, given=True)
    found = judged(door(), [record], grounds)
    assert codes(found) == {"key_revoked", "too_few_persons"}
    assert judged(door(), [record, signed(door(), BEN, 1)], grounds).is_approved
    by_policy = trusting(TrustPolicy(revoked=[ADA.key]))
    assert "key_revoked" in codes(judged(door(), [record], by_policy))
    for named in (f"record:sha256:{record.digest}", f"sha256:{record.digest}"):
        found = judged(door(), [record], trusting(TrustPolicy(revoked=[named])))
        assert "record_revoked" in codes(found)
    closure = record.statement.digests.closure
    for digest in (record.digest, closure):
        mine = trusting(TrustPolicy(), revoked={digest: "a wrong file"})
        assert "record_revoked" in codes(judged(door(), [record], mine))
    registered = trusting(TrustPolicy(), revoked={closure: "mine"}, registered=True)
    assert judged(door(), [record], registered).is_approved


def test_an_older_record_than_the_store_has_seen_is_rolled_back() -> None:
    old = signed(door(), ADA)
    new = signed(door(), ADA, 1, verdict="rejected", follows=old.digest)
    seen = (SeenRecord(ADA.key, new.digest, old.digest),)
    assert codes(judged(door(), [old], trusting(seen=seen))) == {"rolled_back"}
    fork = signed(door(), ADA, 2, follows=old.digest)
    assert "rolled_back" in codes(judged(door(), [old, fork], trusting(seen=seen)))
    first = (SeenRecord(ADA.key, "0" * 64, None),)
    assert judged(door(), [old], trusting(seen=first)).is_approved
    for key in (BEN.key, "sha256:" + "0" * 64):
        other = (SeenRecord(key, new.digest, old.digest),)
        assert judged(door(), [old], trusting(seen=other)).is_approved


def test_rules_that_have_changed_count_where_the_policy_asks() -> None:
    record, others = signed(door(), ADA), {"R01": "0" * 64}
    assert judged(door(), [record], rules=others).is_approved
    strict = trusting(TrustPolicy(rules_unchanged=True))
    assert judged(door(), [record], strict).is_approved
    assert "rules_changed" in codes(judged(door(), [record], strict, rules=others))


def test_an_error_that_is_found_now_is_open() -> None:
    found = judged(door(), [signed(door(), ADA)], errors=("R11 DOOR/State_1: a trap",))
    assert codes(found) == {"open_finding"}


def test_free_conditions_are_closed_by_the_role_that_set_them() -> None:
    text = "the drill is calibrated"
    record = signed(door(), BEN, verdict="conditions", conditions=[text])
    found = judged(door(), [record])
    assert (found.verdict, codes(found)) == ("conditions", {"condition_unmet"})
    for member, met, minutes, good in (
        (ADA, [text], 1, False),
        (Member("Dr Jones", "surgeon", EVE.private), [text], 1, True),
        (Member("Dr Jones", "surgeon", EVE.private), [text.upper()], 1, False),
    ):
        more = signed(door(), member, minutes, met=met)
        grounds = trusting(TrustPolicy(), BEN, member)
        assert judged(door(), [record, more], grounds).is_approved == good
    before = signed(door(), Member("Dr Jones", "surgeon", EVE.private), -1, met=[text])
    grounds = trusting(TrustPolicy(), BEN, Member("Dr Jones", "surgeon", EVE.private))
    assert not judged(door(), [before, record], grounds).is_approved


def test_who_says_that_one_condition_is_met_leaves_the_others_open() -> None:
    first = signed(door(), BEN, verdict="conditions", conditions=["one", "world = lamp"])
    met = signed(door(), BEN, 1, met=["one"], follows=first.digest)
    found = judged(door(), [first, met])
    assert [one.sentence for one in found.refusals] == [
        "this is asked when a run starts, and cannot be asked here: world = lamp"
    ]
    assert judged(door(), [first, met], world="lamp").is_approved
    other = signed(door(), BEN, 1, met=["another"], follows=first.digest)
    assert len(judged(door(), [first, other]).refusals) == 2
    anew = signed(door(), BEN, 2, follows=met.digest)
    assert judged(door(), [first, other, anew]).is_approved, "a fresh word has no conditions"


@pytest.mark.parametrize(
    ("text", "asked", "wanted"),
    [
        ("world = lamp", {"world": "lamp"}, set()),
        ("world = lamp", {"world": "table"}, {"condition_unmet"}),
        ("world = lamp", {}, {"condition_unmet"}),
        ("supervisor present", {"supervised": True}, set()),
        (
            "supervisor present",
            {"supervised": False},
            {"condition_unmet", "supervisor_missing"},
        ),
        ("supervisor present", {}, {"condition_unmet"}),
        ("sensor DOOR/0 at 20 Hz", {"rates": {("DOOR", 0): 20.0}}, set()),
        (
            "sensor DOOR/0 at 20.5 Hz",
            {"rates": {("DOOR", 0): 20.0}},
            {"condition_unmet", "sensor_missing"},
        ),
        ("sensor DOOR/1 at 1 Hz", {"rates": {}}, {"condition_unmet", "sensor_missing"}),
        ("sensor DOOR/0 at 20 Hz", {}, {"condition_unmet"}),
        ("until 2026-03-01", {}, set()),
        ("until 2026-02-28", {}, {"condition_unmet"}),
        ("until then", {}, {"condition_unmet"}),
    ],
)
def test_typed_conditions_are_asked(text: str, asked: dict[str, Any], wanted: set[str]) -> None:
    record = signed(door(), ADA, verdict="conditions", conditions=[text])
    found = judged(door(), [record], **asked)
    assert codes(found) == wanted
    assert found.met == (() if wanted else (text,))


def test_hardware_demands_a_policy_with_a_register() -> None:
    code = WorldCode(hardware=True, functions=[], bindings="0" * 64)
    record = signed(door(), ADA, worlds={"arm": code})
    there: dict[str, Any] = {"world": "arm", "code": code}
    assert codes(judged(door(), [record], trusting(given=False), **there)) == {"policy_unmet"}
    assert codes(judged(door(), [record], trusting(), **there)) == {"register_invalid"}
    assert judged(door(), [record], trusting(registered=True), **there).is_approved


def test_the_code_of_a_world_must_be_signed_and_the_same() -> None:
    code = WorldCode(hardware=False, functions=[], bindings="0" * 64)
    other = WorldCode(hardware=False, functions=[], bindings="1" * 64)
    plain, with_code = signed(door(), ADA), signed(door(), ADA, worlds={"arm": code})
    assert "code_missing" in codes(judged(door(), [plain], world="arm", code=code))
    assert judged(door(), [with_code], world="arm", code=code).is_approved
    assert "code_changed" in codes(judged(door(), [with_code], world="arm", code=other))
    gone: dict[str, Any] = {"world": "arm", "missing": "there is no world 'arm'"}
    assert "code_missing" in codes(judged(door(), [with_code], **gone))
    assert judged(door(), [plain], world="table").is_approved


def test_a_policy_may_ask_for_a_supervisor() -> None:
    strict = trusting(TrustPolicy(supervisor=True))
    record = signed(door(), ADA)
    assert judged(door(), [record], strict).is_approved
    assert judged(door(), [record], strict, supervised=True).is_approved
    assert codes(judged(door(), [record], strict, supervised=False)) == {"supervisor_missing"}
