"""Asks whether a run may start. This happens before any plugin code is loaded."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

from smsl_studio.blueprint.added_automation import added_automation
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.front.approval_badge import words_of
from smsl_studio.front.request import RunRequest
from smsl_studio.front.run_trust import RunTrust
from smsl_studio.front.verdicts import ApprovalAnswer, ApprovalQuestion, answered
from smsl_studio.front.world_codes import WorldSurvey
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.approval.rule_code import common_code
from smsl_studio.library.bindings_file import MqttTable
from smsl_studio.seal.digest import digest_of
from smsl_studio.smsl.files import read_content

Json = Any


def with_trust(request: RunRequest) -> RunRequest:
    """Return the request with the answer whether it may start.

    What the request sets beside the signed blueprint is asked, too: levels, broker and robot. No
    plugin code runs in this process. PluginError if the policy cannot be read, UsageError for a
    level or a robot that does not exist.
    """
    question = ApprovalQuestion(
        request.blueprint,
        request.record,
        request.policy,
        request.world,
        request.now or datetime.now(UTC),
        request.supervised,
        request.plugin_paths,
    )
    answer = answered(question)
    refusals = (
        *answer.judgement.refusals,
        *_changed(request.blueprint),
        *_unsigned(request, answer.survey),
    )
    told = RunTrust(
        refusals,
        answer.judgement.met,
        answer.survey.locations,
        _header(answer),
        _words(answer),
        answer.survey.loaded,
        answer.survey.bindings,
        answer.survey.code is not None and answer.survey.code.hardware,
        words_of(answer, request.blueprint).words,
        answer.survey.speakers,
        answer.trust.grounds.policy.generated_edges if answer.trust is not None else "never",
    )
    return replace(request, trust=told)


def _changed(blueprint: Blueprint) -> Iterator[Refusal]:
    """Yield a refusal for each file that has changed on the disk since it was read."""
    for document in blueprint.documents:
        try:
            same = read_content(document.file).raw == document.encoded()
        except ReadError:
            same = document.file.startswith("<")  # standard input has no file
        if not same:
            words = f"{document.file} is not what was read, or it is not saved"
            yield Refusal("file_changed", words)


def _unsigned(request: RunRequest, survey: WorldSurvey) -> Iterator[Refusal]:
    """Yield a refusal for each setting of a run that differs from what was signed."""
    added = list(added_automation(request.blueprint, request.set_levels))
    if added:
        told = ", ".join(
            f"{one.element} is {one.asked} and not {one.declared}" for one in added[:3]
        )
        more = f", and {len(added) - 3:,} more" if len(added) > 3 else ""
        words = f"levels of this run leave people less to do than what was signed: {told}{more}"
        yield Refusal("digest_differs", f"{words}. Leave them out, or sign a blueprint with them")
    table = survey.bindings.mqtt if survey.bindings is not None else MqttTable()
    for name, asked, signed in (
        ("broker", request.broker, table.broker),
        ("site", request.site, table.site),
    ):
        if asked and asked != signed:
            words = (
                f"the {name} {asked} is not the one that was signed, {signed or 'which is none'}"
            )
            advice = "Leave it out, or write it into the bindings file and sign this world again"
            yield Refusal("code_changed", f"{words}. {advice}")
    loaded = survey.loaded if request.robot else None
    if loaded is not None and loaded.robot_name(request.world, request.robot):
        words = f"nobody has signed that the robot {request.robot} is in {request.world}"
        usual = f"Leave it out: {loaded.robots(request.world)[0]} is its usual robot"
        yield Refusal("code_missing", f"{words}. {usual}")


def _header(answer: ApprovalAnswer) -> dict[str, Json]:
    """Return the part of the log's header that says who approved the run.

    ``code`` is the SHA-256 of the world's code in the form that a record signs. ``rules`` is the
    code of the rules, if the policy wants it unchanged. ``verify.py`` compares both with records.
    """
    trust, judgement, code = answer.trust, answer.judgement, answer.survey.code
    unchanged = trust is not None and trust.grounds.policy.rules_unchanged
    return {
        "verdict": judgement.verdict,
        "policy": trust.policy if trust else None,
        "record": answer.record.digest if answer.record else None,
        "register": trust.register if trust else None,
        "serial": trust.serial if trust else None,
        "keys": trust.keys if trust else "",
        "signers": [one.as_json() for one in judgement.signers],
        "met": list(judgement.met),
        **({} if code is None else {"code": digest_of(code.model_dump())}),
        **({"rules": common_code()} if unchanged else {}),
    }


def _words(answer: ApprovalAnswer) -> str:
    many = sum(one.counts for one in answer.judgement.signers)
    keys = answer.trust.keys if answer.trust else ""
    return f"APPROVED by {many} {'person' if many == 1 else 'persons'}; {keys}"
