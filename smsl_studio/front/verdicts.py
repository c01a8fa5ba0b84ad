"""Answers whether a blueprint is approved. Command line, window, Python and runs all use it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.front.approval_files import (
    RecordFile,
    TrustFiles,
    name_in,
    parts_of,
    record_in,
    trust_files,
)
from smsl_studio.front.check_findings import WHOLE, whole_check
from smsl_studio.front.world_codes import NOWHERE, WorldSurvey, surveyed
from smsl_studio.inspection.approval.case import ApprovalCase, PresentState
from smsl_studio.inspection.approval.conditions import Asking
from smsl_studio.inspection.approval.judge import Judgement, judge, refused
from smsl_studio.inspection.approval.record_file import SignedRecord, record_path
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.rule_code import rule_codes
from smsl_studio.inspection.approval.seen_records import has_seen, keep_record
from smsl_studio.inspection.approval.statement import InspectionOptions, SignedFile
from smsl_studio.inspection.approval.store_files import store_alone

Name = str | os.PathLike[str]


@dataclass(frozen=True)
class ApprovalQuestion:
    """The question whether a blueprint is approved.

    ``record`` is the record's file (None: the one beside the blueprint), and ``policy`` the trust
    policy. ``world`` asks also about the code of a world. ``supervised`` says whether somebody
    supervises the run that asks; None: no run asks. ``now`` is the clock.
    """

    blueprint: Blueprint
    record: Path | None = None
    policy: Path | None = None
    world: str | None = None
    now: datetime = field(default_factory=lambda: datetime.now(UTC))
    supervised: bool | None = None
    plugin_paths: tuple[Path, ...] = ()

    @property
    def record_file(self) -> Path:
        """The file of the record."""
        return record_path(self.blueprint.file, self.record)


@dataclass(frozen=True)
class ApprovalAnswer:
    """The decision, the files that were read for it, and the code of the world."""

    judgement: Judgement
    trust: TrustFiles | None = None
    record: RecordFile | None = None
    survey: WorldSurvey = NOWHERE


def verify_approval(
    blueprint: Blueprint,
    record: Name | None = None,
    policy: Name | None = None,
    world: str | None = None,
    now: datetime | None = None,
) -> Judgement:
    """Return whether a blueprint is approved: ``approved``, ``conditions`` or ``refused``.

    ``record`` is the file of a record; None means the one beside the blueprint. Without a
    ``policy``, one person whose key is in this user's store is enough. If a ``world`` is given, its
    code must be the signed code. PluginError if the policy cannot be read. SealError if another
    user could have written a file of the store.

    >>> found = verify_approval(read("hanoi-corrected.json"))
    >>> found.verdict, [one.code for one in found.refusals]
    ('refused', ['no_record'])
    """
    question = ApprovalQuestion(
        blueprint,
        path_of(record),
        path_of(policy),
        world,
        now or datetime.now(UTC),
    )
    return answered(question).judgement


def path_of(name: Name | None) -> Path | None:
    """Return a name as a path. None stays None."""
    return None if name is None else Path(name)


def answered(question: ApprovalQuestion) -> ApprovalAnswer:
    """Answer a question. Store each record with a valid signature as seen."""
    trust = trust_files(question.policy)
    if isinstance(trust, Refusal):
        return ApprovalAnswer(refused(trust))
    record = record_in(question.record_file)
    return _answered(question, trust, record)


def _answered(question: ApprovalQuestion, trust: TrustFiles, record: RecordFile) -> ApprovalAnswer:
    found = NOWHERE
    if question.world is not None:
        found = surveyed(question.blueprint, question.world, question.plugin_paths)
    case = ApprovalCase(
        record.records,
        trust.grounds,
        _present(question, trust, record, found),
        _asking(question, found),
        _Parts(question, trust).uncovered,
        os.path.realpath(question.blueprint.file),
    )
    judgement = _with_procedures(judge(case), question, trust)
    _keep(question, judgement)
    return ApprovalAnswer(judgement, trust, record, found)


def _with_procedures(
    judgement: Judgement, question: ApprovalQuestion, trust: TrustFiles
) -> Judgement:
    """Return the decision, refused if a blueprint that an operation runs is not approved itself."""
    refusals = []
    for name, part in procedures_of(question.blueprint).files.items():
        asked = replace(question, blueprint=part, record=None)
        own = _answered(asked, trust, record_in(asked.record_file)).judgement
        if not own.is_approved:
            reasons = "; ".join(one.sentence for one in own.refusals[:3])
            words = f"an operation runs {name}, which is not approved: {reasons}"
            refusals.append(Refusal("sub_not_covered", words))
    if not refusals:
        return judgement
    told = (*judgement.refusals, *refusals)
    return replace(judgement, verdict=refused().verdict, refusals=told)


def _asking(question: ApprovalQuestion, found: WorldSurvey) -> Asking:
    asked = question.supervised is not None
    rates = dict(found.rates) if asked and question.world is not None else None
    return Asking(question.now, question.world, question.supervised, rates)


def _present(
    question: ApprovalQuestion, trust: TrustFiles, record: RecordFile, found: WorldSurvey
) -> PresentState:
    """Return the present state. The check runs only if there is a record to compare with."""
    blueprint, records = question.blueprint, record.records
    present = PresentState(digests(blueprint), {}, question.world, found.code, found.missing)
    if isinstance(records, Refusal) or not records:
        return present
    codes = rule_codes() if trust.grounds.policy.rules_unchanged else {}
    worlds = {} if question.world is None or not found.loaded else {question.world: found.loaded}
    answer = whole_check(blueprint, _options(records), worlds)
    relied = [{one.name for one in each.statement.predicate.relies_on} for each in records]
    apart = set.intersection(*relied)
    files = {one.file for one in blueprint.documents if name_in(blueprint, one.file) in apart}
    return replace(present, rules=codes, errors=answer.errors(files))


def _options(records: Sequence[SignedRecord]) -> InspectionOptions:
    """Return the check options of the newest record, but for all rules."""
    options = records[-1].statement.predicate.options
    return WHOLE.model_copy(
        update={
            "limit": options.limit,
            "with_failures": options.with_failures,
            "recoverability": options.recoverability,
        }
    )


def _keep(question: ApprovalQuestion, judgement: Judgement) -> None:
    """Store the records that were not seen before."""
    new = [one for one in judgement.seen if not has_seen(one.record.digest)]
    if not new:
        return
    with store_alone():
        for one in new:
            keep_record(one.record, one.person, question.blueprint.file)


class _Parts:
    """Decides whether imported files that the signer did not check have valid records."""

    def __init__(self, question: ApprovalQuestion, trust: TrustFiles) -> None:
        self._question, self._trust = question, trust
        self._known: dict[str, str] = {}

    def uncovered(self, file: SignedFile) -> str:
        """Return why a file has no valid record of its own, or the empty text if it has one."""
        if file.name not in self._known:
            self._known[file.name] = self._reason(file)
        return self._known[file.name]

    def _reason(self, file: SignedFile) -> str:
        parts = dict(parts_of(self._question.blueprint))
        part = parts.get(file.name)
        if part is None or part is self._question.blueprint:
            return "it is not imported"
        if not file.digest.are(digests(part)):
            return "it has changed"
        asked = replace(self._question, blueprint=part, record=None)
        answer = _answered(asked, self._trust, record_in(asked.record_file))
        if answer.judgement.is_approved:
            return ""
        return "; ".join(one.sentence for one in answer.judgement.refusals[:3])
