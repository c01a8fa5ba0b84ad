"""People who approve blueprints in tests: keys, records, policies, registers, without a store."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.digests import content_of, digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.inspection.approval.case import ApprovalCase, PresentState, TrustGrounds
from smsl_studio.inspection.approval.conditions import Asking
from smsl_studio.inspection.approval.judge import Judgement, judge
from smsl_studio.inspection.approval.known_keys import KnownKey
from smsl_studio.inspection.approval.policy import USUAL, TrustPolicy
from smsl_studio.inspection.approval.record_file import SignedRecord
from smsl_studio.inspection.approval.register import PAYLOAD_TYPE as REGISTER
from smsl_studio.inspection.approval.rule_code import rule_codes
from smsl_studio.inspection.approval.statement import (
    MEANINGS,
    PAYLOAD_TYPE,
    InspectionOptions,
    Predicate,
    SignedDigests,
    SignedFile,
    SignedRule,
    statement_of,
)
from smsl_studio.inspection.approval.times import written_time
from smsl_studio.seal import key_box
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.ed25519 import identity, public_of, sealed
from smsl_studio.seal.strict_json import base64_text
from tests.plugin_folder import blueprint_of

NOON = datetime(2026, 3, 1, 12, tzinfo=UTC)
"""When the first record of a test is signed. No test reads the clock of the computer."""

PASSPHRASE = "correct horse"

DOOR: dict[str, Any] = {
    "DOOR": {
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"open": "State_1"},
        "State_1": {"close": "State_0"},
    }
}
"""A blueprint without a finding of severity E or W."""


def door() -> Blueprint:
    """The blueprint that is approved."""
    return blueprint_of(DOOR)


@dataclass(frozen=True)
class Member:
    """A person with a key."""

    person: str
    role: str
    private: bytes

    @property
    def public(self) -> bytes:
        return public_of(self.private)

    @property
    def key(self) -> str:
        return identity(self.public)

    @property
    def known(self) -> KnownKey:
        return KnownKey(self.public, self.person, (self.role,))


ADA = Member("Ada Lovelace", "engineer", bytes(range(32)))
BEN = Member("Ben Carson", "surgeon", bytes(range(1, 33)))
EVE = Member("Eve", "engineer", bytes(range(2, 34)))
BOT = Member("ci", "automatic", bytes(range(3, 35)))
EVERYBODY = (ADA, BEN, EVE, BOT)


def make_keys_cheap(patch: pytest.MonkeyPatch) -> None:
    """Let the boxes of keys take the least work that is allowed, and each only once."""
    patch.setattr(key_box, "_N", 1 << 14)
    patch.setattr(key_box, "_key", cache(key_box._key))


@cache
def codes_of_rules() -> dict[str, str]:
    """The code of each rule, computed once."""
    return dict(rule_codes())


def said(blueprint: Blueprint, member: Member, minutes: float = 0, **other: Any) -> Predicate:
    """What a person says at noon, or so many minutes later."""
    verdict = other.get("verdict", "approved")
    values: dict[str, Any] = {
        "rules": [
            SignedRule(id=rule, version="1", code=code, result="passed")
            for rule, code in codes_of_rules().items()
        ],
        "properties": [],
        "findings": [],
        "dispositions": [],
        "verdict": verdict,
        "conditions": [],
        "met": [],
        "worlds": {},
        "looked_at": ["test.json"],
        "relies_on": [],
        "options": InspectionOptions(
            limit=None, with_failures=False, recoverability=False, rules=None
        ),
        "person": member.person,
        "role": member.role,
        "meaning": MEANINGS[verdict],
        "time": written_time(NOON + timedelta(minutes=minutes)),
        "expires": None,
        "content": {"test.json": content_of(blueprint)},
        "follows": None,
    }
    return Predicate(**{**values, **other})


def signed(blueprint: Blueprint, member: Member, minutes: float = 0, **other: Any) -> SignedRecord:
    """A record, signed with the person's key."""
    digest = SignedDigests(**digests(blueprint).as_json())
    subject = [SignedFile(name="test.json", digest=digest)]
    statement = statement_of(subject, said(blueprint, member, minutes, **other))
    return SignedRecord.of(sealed(member.private, PAYLOAD_TYPE, statement.payload()))


def trusting(policy: TrustPolicy = USUAL, *members: Member, **other: Any) -> TrustGrounds:
    """Grounds in which these people count (all, if none is named)."""
    keys = {one.key: one.known for one in members or EVERYBODY}
    return TrustGrounds(policy, keys, **{"given": True, **other})


def judged(
    blueprint: Blueprint,
    records: Sequence[SignedRecord],
    grounds: TrustGrounds | None = None,
    minutes: float = 10,
    **other: Any,
) -> Judgement:
    """The judgement ten minutes past noon. ``other`` are fields of the present state, or of what is
    asked."""
    asked = {key: other.pop(key) for key in ("supervised", "rates") if key in other}
    present = PresentState(digests(blueprint), **{"rules": codes_of_rules(), **other})
    now = NOON + timedelta(minutes=minutes)
    asking = Asking(now, present.world, **asked)
    return judge(ApprovalCase(tuple(records), grounds or trusting(), present, asking, lambda _: ""))


def codes(judgement: Judgement) -> set[str]:
    """The codes of its refusals."""
    return {one.code for one in judgement.refusals}


def register_of(*persons: dict[str, Any], serial: int = 1, by: Member = EVE) -> bytes:
    """The bytes of a register, signed by somebody."""
    values = {"version": 1, "serial": serial, "persons": list(persons)}
    envelope = sealed(by.private, REGISTER, canonical(values))
    return json.dumps(envelope.as_json()).encode()


def entry(member: Member, **other: Any) -> dict[str, Any]:
    """The entry of a person in a register."""
    keys = [base64_text(member.public)]
    return {"person": member.person, "roles": [member.role], "keys": keys, **other}


def written_policy(folder: Path, text: str, register: bytes | None = None, by: Member = EVE) -> str:
    """A policy, with its register beside it."""
    if register is not None:
        (folder / "persons.json").write_bytes(register)
        key = base64_text(by.public)
        text += f'\nregister = "persons.json"\nregister_key = "{key}"\n'
    (folder / "policy.toml").write_text(text, "utf-8")
    return str(folder / "policy.toml")
