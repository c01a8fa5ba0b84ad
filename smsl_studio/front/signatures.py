"""Signs a record of a blueprint: what the check says, and what a person says about it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from smsl_studio.blueprint.digests import content_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.stored import digest_named, stored_file
from smsl_studio.errors import ApprovalRefused, UsageError
from smsl_studio.front.approval_files import (
    RecordFile,
    name_in,
    parts_of,
    record_in,
    signed_file,
)
from smsl_studio.front.check_findings import WHOLE, CheckAnswer, whole_check
from smsl_studio.front.former_record import changes_since_record
from smsl_studio.front.reviews import open_comments_said
from smsl_studio.front.version import version
from smsl_studio.front.world_codes import WorldSurvey, surveyed
from smsl_studio.inspection.approval.audit_log import append_act
from smsl_studio.inspection.approval.key_store import StoredKey, stored_key
from smsl_studio.inspection.approval.known_keys import name_of
from smsl_studio.inspection.approval.record_file import (
    SignedRecord,
    record_path,
    written_record_file,
)
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.rule_code import rule_codes
from smsl_studio.inspection.approval.rule_scores import rule_scores
from smsl_studio.inspection.approval.seen_index import COPY, copied_from, is_followed
from smsl_studio.inspection.approval.seen_records import keep_record, newest_seen
from smsl_studio.inspection.approval.statement import (
    APPROVED,
    CONDITIONS,
    MEANINGS,
    PAYLOAD_TYPE,
    REJECTED,
    Disposition,
    InspectionOptions,
    Predicate,
    SignedFinding,
    SignedProperty,
    SignedRule,
    statement_of,
)
from smsl_studio.inspection.approval.store_files import store_alone
from smsl_studio.inspection.approval.times import end_of, written_time
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.smsl.files import save_document
from smsl_studio.smsl.inputs import seen_at

Name = str | os.PathLike[str]
VERDICTS = (APPROVED, CONDITIONS, REJECTED)


@dataclass(frozen=True)
class ApprovalRequest:
    """Everything that is asked for a signature.

    ``key`` is a key of the store, opened by ``passphrase``. ``verdict`` is approved, conditions or
    rejected. Empty means approved, or conditions if there are ``conditions``. ``met`` are
    conditions of other signers that are met now. ``dispositions`` are texts ``RULE@ADDRESS=TEXT``
    about warnings. ``expires`` is a date. ``worlds`` are those whose code is signed too.
    ``relies_on`` are imported files that the signer did not check again. ``record`` is the file for
    the record; None means the one beside the blueprint. ``now`` is the time of the signature.

    >>> ApprovalRequest(read("hanoi-2.json"), "brandt", b"a passphrase").checked().verdict
    'approved'
    """

    blueprint: Blueprint
    key: str
    passphrase: bytes = field(repr=False)
    verdict: str = ""
    conditions: tuple[str, ...] = ()
    met: tuple[str, ...] = ()
    dispositions: tuple[str, ...] = ()
    expires: str | None = None
    worlds: tuple[str, ...] = ()
    relies_on: tuple[str, ...] = ()
    record: Path | None = None
    options: InspectionOptions = WHOLE
    now: datetime = field(default_factory=lambda: datetime.now(UTC))

    def checked(self) -> ApprovalRequest:
        """Return the request with its verdict set. UsageError if the parts do not fit together."""
        verdict = self.verdict or APPROVED
        if verdict not in VERDICTS:
            raise UsageError(f"the verdict is {verdict!r}, not one of {', '.join(VERDICTS)}")
        if verdict == APPROVED and self.conditions:
            verdict = CONDITIONS
        if (verdict == CONDITIONS) != bool(self.conditions):
            raise UsageError(
                "conditions and the verdict 'conditions' belong together",
                advice="Name a condition with --condition TEXT, or leave both out.",
            )
        for text in (*self.conditions, *self.met):
            if not text.strip() or len(text) > 10_000:
                raise UsageError("the text of a condition is empty or very long")
        return replace(self, verdict=verdict)

    def opened_with(self, passphrase: bytes) -> ApprovalRequest:
        """Return the same request with the passphrase of its key."""
        return replace(self, passphrase=passphrase)

    @property
    def record_file(self) -> Path:
        """The file that gets the record."""
        return record_path(self.blueprint.file, self.record)


@dataclass(frozen=True)
class SignedApproval:
    """A signed record, its file, and the findings that it has."""

    record: SignedRecord
    file: Path
    findings: tuple[Finding, ...]


def approve(request: ApprovalRequest) -> SignedApproval:
    """Sign the result of the check, and a person's decision about it.

    ApprovalRefused, with every reason, if an error is open, if a warning has no disposition, if a
    comment in the review beside the file is open, if the key is revoked, or if an earlier record
    has a later time than the clock. A rejection may have open errors, warnings and comments.
    SealError if the passphrase is wrong, ReadError if the review cannot be read, SaveError if the
    record cannot be written.

    >>> key = make_key("L. Brandt", "engineer", b"a passphrase").id
    >>> blueprint = read("hanoi-corrected.json")
    >>> done = approve(ApprovalRequest(blueprint, key, b"a passphrase"))
    >>> done.file.name, verify_approval(blueprint).verdict
    ('hanoi-corrected.json.record.json', 'approved')
    """
    asked = request.checked()
    key = stored_key(asked.key)
    if key.revoked:
        raise ApprovalRefused(f"the key {key.id} is revoked: {key.revoked}")
    sign = key.signer(asked.passphrase)
    before = seen_at(asked.record_file, 1 << 26)
    present = record_in(asked.record_file)
    former = _former(present, asked.record_file)
    last = _last_of(asked, key, former)
    copied = copied_from(last.digest, asked.blueprint.file) if last else ""
    follows = _followed_by(last, former, asked.blueprint.file, copied)
    _check_clock(asked.now, (*former, *([last] if last else [])))
    parts = list(parts_of(asked.blueprint))
    relied = _relied(asked, parts)
    surveys = _surveys(asked)
    answer = _answer(asked, surveys)
    dispositions = _dispositions(asked, answer)
    apart = {one.file for _, one in parts if name_in(asked.blueprint, one.file) in relied}
    if asked.verdict != REJECTED:
        asks = open_comments_said(asked.blueprint.file)
        _refuse_open(answer, dispositions, apart, asks)
    predicate = Predicate(
        rules=_rules(answer, asked.options),
        properties=[
            SignedProperty(
                name=one.name,
                kind=one.kind,
                severity=one.severity,
                verdict=one.verdict,
                configurations=one.configurations,
            )
            for one in answer.verdicts
        ],
        findings=[
            SignedFinding(
                rule=one.rule,
                severity=one.severity.value,
                address=str(one.address),
                message=one.message,
            )
            for one in answer.findings
        ],
        dispositions=dispositions,
        verdict=_verdict(asked.verdict),
        conditions=list(asked.conditions),
        met=list(asked.met),
        worlds={world: one.code for world, one in surveys.items() if one.code is not None},
        looked_at=[name for name, _ in parts if name not in relied],
        relies_on=[one for one in (signed_file(*part) for part in parts) if one.name in relied],
        options=asked.options,
        person=key.person,
        role=key.role,
        meaning=MEANINGS[asked.verdict],
        time=written_time(asked.now),
        expires=_expiry(asked),
        content={name: content_of(part) for name, part in parts},
        follows=follows,
    )
    statement = statement_of([signed_file(*part) for part in parts], predicate)
    envelope = sign(PAYLOAD_TYPE, statement.payload())
    record = SignedRecord.of(envelope)
    raw = written_record_file([*(one.envelope for one in former), envelope])
    with store_alone():
        save_document(raw, asked.record_file, before)
        behind = last.digest if last else ""
        copy = dict(zip(COPY, (copied, behind), strict=True)) if copied else {}
        keep_record(record, name_of(key.person), asked.blueprint.file, copy)
        append_act(
            asked.now,
            "approve",
            key=key.identity,
            record=record.digest,
            closure=statement.digests.closure,
            verdict=asked.verdict,
        )
    return SignedApproval(record, asked.record_file, answer.findings)


def _verdict(word: str) -> Literal["approved", "conditions", "rejected"]:
    """Return a verdict with its exact type. It was checked before."""
    return "approved" if word == APPROVED else "conditions" if word == CONDITIONS else "rejected"


def _former(present: RecordFile, path: Path) -> tuple[SignedRecord, ...]:
    if not isinstance(present.records, Refusal):
        return present.records
    if present.records.code == "no_record" and not os.path.lexists(path):
        return ()
    raise ApprovalRefused(
        f"nothing can be added to this record: {present.records.sentence}",
        advice="Put back your copy of it, or move it away.",
    )


def _last_of(
    asked: ApprovalRequest, key: StoredKey, former: Sequence[SignedRecord]
) -> SignedRecord | None:
    """Return the newest record of the same person for this file, with any of the person's keys."""
    person = name_of(key.person)
    own = [one for one in former if name_of(one.statement.predicate.person) == person]
    closure = signed_file("", asked.blueprint).digest.closure
    seen = newest_seen(asked.blueprint.file, closure, person)
    both = [*own[-1:], *([seen] if seen else [])]
    return max(both, key=lambda one: one.statement.time, default=None)


def _followed_by(
    last: SignedRecord | None, former: Sequence[SignedRecord], file: str, copied: str
) -> str | None:
    """Return the digest of the record that a new one follows, if there is one.

    A copy of what was signed, changed and signed again elsewhere begins a chain of its own: a
    second record behind the same one would count as an older one at once. So does a copy without
    the record, because a chain is that of one file.
    """
    if last is None or is_followed(last.digest, file):
        return None
    own = any(one.digest == last.digest for one in former)
    return None if copied and not own else last.digest


def _check_clock(now: datetime, before: Iterable[SignedRecord]) -> None:
    for one in before:
        if one.statement.time >= now:
            raise ApprovalRefused(
                f"the clock says {written_time(now)}, and a record of "
                f"{one.statement.predicate.person} is of {one.statement.predicate.time}",
                advice="Set the clock of this computer, then sign again.",
            )


def _relied(asked: ApprovalRequest, parts: Sequence[tuple[str, Blueprint]]) -> set[str]:
    """Return the names of the imported files that the signer did not check again."""
    real = {os.path.realpath(part.file): name for name, part in parts[1:]}
    found = set()
    for file in asked.relies_on:
        digest = digest_named(file)
        name = real.get(os.path.realpath(stored_file(digest) if digest else file))
        if name is None:
            raise UsageError(
                f"{asked.blueprint.file} does not import {file}",
                advice="--relies-on names an imported file.",
            )
        found.add(name)
    return found


def _answer(asked: ApprovalRequest, surveys: Mapping[str, WorldSurvey]) -> CheckAnswer:
    """Return the result of the whole check, with the changes since the newest record."""
    worlds = {world: one.loaded for world, one in surveys.items() if one.loaded is not None}
    answer = whole_check(asked.blueprint, asked.options, worlds)
    rules = asked.options.rules
    if rules is not None and "R27" not in rules:
        return answer
    beside = asked.record_file
    record = str(beside) if asked.record is not None and os.path.lexists(beside) else None
    _, changes = changes_since_record(asked.blueprint, record)
    return replace(answer, findings=(*answer.findings, *changes))


def _dispositions(asked: ApprovalRequest, answer: CheckAnswer) -> list[Disposition]:
    known = {(one.rule, str(one.address)) for one in answer.findings}
    return [_disposition(text, known) for text in asked.dispositions]


def _disposition(text: str, known: Iterable[tuple[str, str]]) -> Disposition:
    """Read ``RULE@ADDRESS=TEXT``.

    An address may have a ``=`` in it, so the addresses of known findings are tried first.
    """
    for rule, address in sorted(known, key=lambda one: -len(one[1])):
        start = f"{rule}@{address}="
        if text.startswith(start) and text[len(start) :].strip():
            return Disposition(rule=rule, address=address, text=text[len(start) :])
    rule, at, rest = text.partition("@")
    address, equals, words = rest.partition("=")
    if not (rule and at and address and equals and words.strip()):
        raise UsageError(
            f"{text[:200]!r} is no disposition",
            advice="Write RULE@ADDRESS=TEXT, such as R17@SB1/State_a/Wait=it only waits.",
        )
    return Disposition(rule=rule, address=address, text=words)


def _refuse_open(
    answer: CheckAnswer, dispositions: Sequence[Disposition], apart: set[str], asks: Sequence[str]
) -> None:
    disposed = {(one.rule, one.address) for one in dispositions}
    open_ = list(answer.errors(apart))
    for one in answer.of(Severity.WARNING, apart):
        if (one.rule, str(one.address)) not in disposed:
            open_.append(f"{one.rule} {one.address} has no disposition: {one.message}")
    advice = "Mend each error. Say about each warning: --disposition RULE@ADDRESS=TEXT."
    if asks:
        advice = f"{advice} " if open_ else ""
        advice += "Answer each comment in Review, and let its writer close it."
    if open_ or asks:
        raise ApprovalRefused("\n".join(dict.fromkeys((*open_, *asks))), advice=advice)


def open_warnings(request: ApprovalRequest) -> tuple[Finding, ...]:
    """Return the warnings about which a signer must say something. No passphrase is needed."""
    answer = _answer(request, _surveys(request))
    return tuple(answer.of(Severity.WARNING, set()))


def _rules(answer: CheckAnswer, options: InspectionOptions) -> list[SignedRule]:
    """Return each rule that was checked, with the digest of its code and its worst finding."""
    words: dict[Severity, Literal["noted", "warned", "failed"]] = {
        Severity.ERROR: "failed",
        Severity.WARNING: "warned",
        Severity.NOTE: "noted",
    }
    gravest: dict[str, Literal["noted", "warned", "failed"]] = {}
    for severity in (Severity.NOTE, Severity.WARNING, Severity.ERROR):
        gravest |= {one.rule: words[severity] for one in answer.of(severity)}
    scores = rule_scores()
    return [
        SignedRule(
            id=rule,
            version=version(),
            code=code,
            result=gravest.get(rule, "passed"),
            score=scores.get(rule),
        )
        for rule, code in rule_codes().items()
        if options.rules is None or rule in options.rules
    ]


def _surveys(asked: ApprovalRequest) -> dict[str, WorldSurvey]:
    """Return the code of each world. ApprovalRefused if a world does not exist."""
    found = {world: surveyed(asked.blueprint, world) for world in asked.worlds}
    for one in found.values():
        if one.missing:
            raise ApprovalRefused(one.missing)
    return found


def _expiry(asked: ApprovalRequest) -> str | None:
    if asked.expires is None:
        return None
    try:
        end = end_of(asked.expires)
    except ValueError as error:
        raise UsageError(str(error), advice="Write a date such as 2027-01-31.") from None
    if end <= asked.now:
        raise UsageError(f"{asked.expires} is over", advice="Name a date to come.")
    return written_time(end)
