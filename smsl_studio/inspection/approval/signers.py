"""The signers of a case: the faults of each record, and the last record of each person."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from datetime import datetime

from smsl_studio.inspection.approval.case import ApprovalCase
from smsl_studio.inspection.approval.known_keys import KnownKey, name_of
from smsl_studio.inspection.approval.record_file import SignedRecord
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.statement import REJECTED, Predicate
from smsl_studio.inspection.approval.times import AHEAD, later, written_time
from smsl_studio.seal.ed25519 import is_signed


@dataclass(frozen=True, slots=True)
class Signer:
    """One record with a valid signature of a known key.

    ``faults`` says why the record does not count; it is empty if it counts.
    """

    record: SignedRecord
    key: KnownKey
    faults: tuple[Refusal, ...] = ()

    @property
    def said(self) -> Predicate:
        """The statement's predicate: what the signer has looked at and says."""
        return self.record.statement.predicate

    @property
    def person(self) -> str:
        """The name of the signer for comparison (see ``name_of``)."""
        return name_of(self.key.person)

    @property
    def roles(self) -> frozenset[str]:
        """The roles in which the person may sign."""
        return frozenset(map(name_of, self.key.roles))

    @property
    def role(self) -> str:
        """The role to show: the one in the record if the person has it, else the person's first
        role.
        """
        if name_of(self.said.role) in self.roles:
            return self.said.role
        return self.key.roles[0] if self.key.roles else ""

    @property
    def is_automatic(self) -> bool:
        """Whether a program has signed, and not a person."""
        return self.key.is_automatic or name_of(self.said.role) == "automatic"

    @property
    def rejects(self) -> bool:
        """Whether the signer rejects this blueprint. A rejection stays valid when it is old."""
        codes = {fault.code for fault in self.faults}
        gone = {"digest_differs", "key_revoked", "key_expired", "record_revoked"}
        return self.said.verdict == REJECTED and not codes & gone

    @property
    def counts(self) -> bool:
        """Whether the record counts as the approval of one person."""
        return not (self.faults or self.is_automatic or self.said.verdict == REJECTED)

    def as_json(self) -> dict[str, str]:
        """Return the signer in the form that ``verify`` prints."""
        return {
            "person": self.key.person,
            "role": self.role,
            "key": self.record.envelope.keyid,
            "time": self.said.time,
            "verdict": self.said.verdict,
        }


def signers_of(
    case: ApprovalCase, records: Sequence[SignedRecord]
) -> tuple[list[Signer], list[Refusal]]:
    """Return the records with a valid signature, in order of signing, and what is wrong with
    others.
    """
    found: list[Signer] = []
    wrong: list[Refusal] = []
    before: datetime | None = None
    for record in records:
        said = record.statement.predicate
        who = f"the record of {said.person}"
        key = case.grounds.keys.get(record.envelope.keyid)
        moment = record.statement.time
        if key is None:
            wrong.append(_unknown(case, record, who))
        elif not is_signed(record.envelope, key.public):
            wrong.append(Refusal("signature_invalid", f"the signature of {who} is wrong"))
        elif moment > case.asking.now + AHEAD:
            words = f"{who} is of {said.time}, and the clock says {written_time(case.asking.now)}"
            wrong.append(Refusal("signature_invalid", words))
        elif before is not None and moment <= before:
            words = f"{who} does not stand in the order of signing"
            wrong.append(Refusal("signature_invalid", words))
        else:
            found.append(Signer(record, key, tuple(_faults(case, record, key))))
        before = moment
    return found, wrong


def _unknown(case: ApprovalCase, record: SignedRecord, who: str) -> Refusal:
    """Return the refusal for a record whose key is not known."""
    named = record.envelope.keyid
    is_identity = re.fullmatch(r"sha256:[0-9a-f]{64}", named) is not None
    other = (replace(record.envelope, keyid=one) for one in case.grounds.keys)
    if not is_identity or any(is_signed(one, case.grounds.keys[one.keyid].public) for one in other):
        words = f"{who} names a key {named[:80]!r} that is not the one that has signed it"
        return Refusal("signature_invalid", words)
    return Refusal("key_unknown", f"{who} is signed with the key {named}, which is not known")


def last_words(signers: Sequence[Signer]) -> list[Signer]:
    """Return the last record of each person, in order of signing."""
    found: dict[str, Signer] = {}
    for one in signers:
        found.pop(one.person, None)
        found[one.person] = one
    return list(found.values())


def rolled_back(case: ApprovalCase, one: Signer) -> bool:
    """Whether the store has seen a later record of this person, or a different one at its place.

    The chain counts whatever the file is called: it may have been moved. What was signed in a copy
    says nothing about the file that still stood at its own place. In the copy itself it counts.
    """
    follows, digest = one.said.follows, one.record.digest
    copied = next((seen.apart for seen in case.grounds.seen if seen.digest == digest), "")
    for seen in case.grounds.seen:
        key = case.grounds.keys.get(seen.key)
        if key is None or name_of(key.person) != one.person or seen.digest == digest:
            continue
        if seen.apart and seen.apart == case.file:
            continue
        here = bool(case.file) and seen.file == case.file
        if seen.follows == digest or (here and seen.behind == digest):
            return True
        elsewhere = bool(copied) and seen.file == copied and not here
        if follows is not None and seen.follows == follows and not elsewhere:
            return True
    return False


def _faults(case: ApprovalCase, record: SignedRecord, key: KnownKey) -> Iterator[Refusal]:
    """Yield the reasons why a record with a valid signature does not count."""
    said, grounds, present = record.statement.predicate, case.grounds, case.present
    who = f"the record of {key.person}"
    if key.revoked:
        yield Refusal("key_revoked", f"the key of {key.person} is revoked: {key.revoked}")
    elif record.envelope.keyid in grounds.policy.revoked:
        yield Refusal("key_revoked", f"the policy revokes the key of {key.person}")
    if not key.may_sign_at(record.statement.time):
        yield Refusal("key_expired", f"the key of {key.person} was not valid at {said.time}")
    yield from _revoked(case, record, who)
    end = record.statement.expires
    if grounds.policy.valid_days is not None:
        limit = later(record.statement.time, grounds.policy.valid_days)
        end = limit if end is None else min(end, limit)
    if end is not None and case.asking.now > end:
        yield Refusal("record_expired", f"{who} was valid until {written_time(end)}")
    if not record.statement.digests.are(present.digests):
        yield Refusal("digest_differs", f"the blueprint has changed since {who}, of {said.time}")
    if grounds.policy.rules_unchanged:
        changed = sorted(one.id for one in said.rules if present.rules.get(one.id) != one.code)
        new = sorted(present.rules.keys() - {one.id for one in said.rules})
        if (changed or new) and said.options.rules is None:
            words = f"{who} was made with other rules: {', '.join([*changed, *new][:5])}"
            yield Refusal("rules_changed", words)
        elif changed:
            words = f"{who} was made with other rules: {', '.join(changed[:5])}"
            yield Refusal("rules_changed", words)
    yield from _code_faults(case, said, who)
    for file in said.relies_on:
        reason = case.uncovered(file)
        if reason:
            yield Refusal("sub_not_covered", f"{who} relies on {file.name}: {reason}")


def _revoked(case: ApprovalCase, record: SignedRecord, who: str) -> Iterator[Refusal]:
    grounds, digests = case.grounds, record.statement.digests
    parts = (one.digest.closure for one in record.statement.subject[1:])
    named = (record.digest, digests.closure, digests.behaviour, digests.meaning, *parts)
    revoked = {one.removeprefix("record:") for one in grounds.policy.revoked}
    if any(f"sha256:{digest}" in revoked for digest in named):
        yield Refusal("record_revoked", f"the policy revokes {who}")
    if grounds.registered:
        return
    for digest in named:
        if digest in grounds.revoked:
            yield Refusal("record_revoked", f"{who} is revoked: {grounds.revoked[digest]}")
            return


def _code_faults(case: ApprovalCase, said: Predicate, who: str) -> Iterator[Refusal]:
    """Yield what has changed in the world's code since the record was signed."""
    present = case.present
    if present.world is None or (present.code is None and not present.missing):
        return
    signed = said.worlds.get(present.world)
    if signed is None:
        bare = present.code is not None and not present.code.functions
        what = "who tells facts from elsewhere in" if bare else "the code of"
        yield Refusal("code_missing", f"{who} does not sign {what} the world {present.world}")
    elif present.code is None:
        yield Refusal("code_missing", present.missing)
    elif signed != present.code:
        now = {one.function: one for one in present.code.functions}
        gone = [one.function for one in signed.functions if one.function not in now]
        if gone:
            words = f"{present.world} has no {', '.join(gone[:5])} any more, which {who} names"
            yield Refusal("code_missing", words)
        else:
            other = [one.function for one in signed.functions if now[one.function] != one]
            what = ", ".join(other[:5]) or "what is bound to what"
            words = f"the code in {present.world} has changed since {who}: {what}"
            yield Refusal("code_changed", words)
