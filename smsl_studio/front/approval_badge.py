"""The words of the approval badge: whether the blueprint is approved, the reasons, what to do."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.former_record import may_have_record

LONGEST = 6
"""The largest number of reasons that the badge lists."""

NOBODY = "Nobody has signed this blueprint. It runs in simulation only."
TO_SIGN = "To sign it: smsl-studio approve FILE --key ID. The page Approval of the help says how."


@dataclass(frozen=True)
class ApprovalWords:
    """What the badge shows.

    ``is_good`` says whether the blueprint is approved. ``reasons`` are sentences about why or why
    not. ``advice`` says what to do.
    """

    words: str
    reasons: tuple[str, ...] = ()
    advice: str = ""
    is_good: bool = False


UNINSPECTED = ApprovalWords("Uninspected", (NOBODY,), TO_SIGN)

_WORDS = (
    ("signature_invalid", "Signature invalid"),
    ("rolled_back", "Older record"),
    ("verdict_not_approved", "Rejected"),
    ("key_revoked", "Revoked"),
    ("record_revoked", "Revoked"),
    ("digest_differs", "Changed since signed"),
    ("record_expired", "Expired"),
    ("key_expired", "Expired"),
    ("key_unknown", "Unknown key"),
    ("open_finding", "Open error"),
    ("sub_not_covered", "Part not approved"),
)
"""The words of the badge for some codes. If several codes apply, the first in this list counts."""


def approval_words(blueprint: Blueprint) -> ApprovalWords:
    """Return the words of the badge for a blueprint, without a policy.

    This verifies signatures and runs the whole check, so it may take long. It heeds a stop.
    """
    if not may_have_record(blueprint.file):
        return UNINSPECTED
    from smsl_studio.front.verdicts import ApprovalQuestion, answered

    question = ApprovalQuestion(blueprint)
    if not Path(question.record_file).exists():
        return UNINSPECTED
    try:
        answer = answered(question)
    except StudioError as error:
        return ApprovalWords("Not verified", (str(error),), error.advice)
    judgement = answer.judgement
    signers = tuple(
        f"{one.key.person} ({one.role}), {one.said.time[:10]}: {one.said.verdict}"
        for one in judgement.signers
    )
    keys = f"{answer.trust.keys[:1].upper()}{answer.trust.keys[1:]}." if answer.trust else ""
    if judgement.is_approved:
        many = sum(one.counts for one in judgement.signers)
        return ApprovalWords(f"Approved by {many}", signers, keys, True)
    told = {one.code for one in judgement.refusals}
    reasons = tuple(one.sentence for one in judgement.refusals[:LONGEST])
    if told == {"condition_unmet"}:
        return ApprovalWords("Approved with conditions", (*signers, *reasons), keys)
    words = next((words for code, words in _WORDS if code in told), "Not approved")
    return ApprovalWords(words, (*signers, *reasons), "Look at it again, then sign it again.")
