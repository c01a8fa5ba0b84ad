"""The words of the approval badge: whether the blueprint is approved, the reasons, what to do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.former_record import has_record_beside
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.inspection.reading.sections import NOTICE

if TYPE_CHECKING:
    from smsl_studio.front.verdicts import ApprovalAnswer

LONGEST = 6
"""The largest number of reasons that the badge lists."""

NOBODY = "Nobody has signed this blueprint. It runs in simulation only."
COMPUTED = "It was computed and not drawn: its field _origin says how."
TO_SIGN = (
    "Sign it in Review, or in a terminal: smsl-studio approve FILE --key ID. The page Approval of "
    "the help says how."
)
AGAIN = "Look at it again, then sign it again."
ANOTHER = "Let another person look at it and sign."
TO_MEET = (
    "When a condition is met, sign that in Review, or in a terminal: approve FILE --key ID --met "
    "TEXT."
)
MEND = "Let the keeper of the policy mend it. Until then nothing runs under it."


@dataclass(frozen=True)
class ApprovalWords:
    """What the badge shows.

    ``is_good`` says whether the blueprint is approved. ``reasons`` are sentences about who has
    signed. ``refusals`` say why it is not approved, each with its code. ``advice`` says what to do.
    """

    words: str
    reasons: tuple[str, ...] = ()
    advice: str = ""
    is_good: bool = False
    refusals: tuple[Refusal, ...] = ()

    @property
    def foot(self) -> str:
        """The line below a picture or a page: the words of the badge, and the notice."""
        return f"{self.words}. {NOTICE}."

    @property
    def lines(self) -> tuple[str, ...]:
        """Everything that the card of the badge says, line by line."""
        refusals = (refusal_line(one) for one in self.refusals)
        return tuple(filter(None, (self.words, *self.reasons, *refusals, self.advice)))


def refusal_line(refusal: Refusal) -> str:
    """Return a refusal for people: the sentence, and the code behind it."""
    return f"{refusal.sentence[:1].upper()}{refusal.sentence[1:]} ({refusal.code})"


UNINSPECTED = ApprovalWords("Uninspected", (NOBODY,), TO_SIGN)
NOT_VERIFIED = "Not verified"
"""The words where there is a record, and nobody has verified it or it cannot be read."""
GENERATED = "Generated, not inspected"
"""The words for a blueprint that was computed and that no record covers."""
LOOKING = ApprovalWords("Looking at the record", ("Signatures are being verified.",))
"""Stands until the signatures are verified."""

_WORDS = (
    ("policy_invalid", "Policy invalid", MEND),
    ("register_invalid", "Register invalid", MEND),
    ("no_record", "Uninspected", TO_SIGN),
    ("signature_invalid", "Signature invalid", "Fetch the record again from who has signed it."),
    ("rolled_back", "Older record", "Fetch the newest record from who has signed it."),
    ("verdict_not_approved", "Rejected", "Ask the person who has rejected it."),
    ("key_revoked", "Revoked", ANOTHER),
    ("record_revoked", "Revoked", AGAIN),
    ("digest_differs", "Changed since signed", "Look at what has changed, then sign it again."),
    ("rules_changed", "Rules changed", AGAIN),
    ("record_expired", "Expired", AGAIN),
    ("key_expired", "Expired", ANOTHER),
    ("key_unknown", "Unknown key", "Take in the public key of who has signed: keys import FILE."),
    ("open_finding", "Open error", "Mend what the finding says, then sign it again."),
    ("sub_not_covered", "Part not approved", "Let somebody look at the imported file and sign it."),
    ("code_changed", "Code changed", "Look at the code again: approve FILE --key ID --world NAME."),
    ("code_missing", "Code not signed", "Sign the code, too: approve FILE --key ID --world NAME."),
    ("policy_unmet", "Not approved", "Let a person look at it and sign."),
    ("role_missing", "Signature missing", ANOTHER),
    ("too_few_persons", "Signature missing", ANOTHER),
)
"""The words of the badge for some codes, and what to do. If several codes apply, the first in this
list counts."""


def is_generated(blueprint: Blueprint) -> bool:
    """Return whether a blueprint, or a State Branch of it, says that it was computed."""
    every = (blueprint.fields, *(branch.fields for branch in blueprint))
    return any(isinstance(fields.get("_origin"), Mapping) for fields in every)


def unsigned_words(blueprint: Blueprint) -> ApprovalWords:
    """Return the words of the badge for a blueprint without a record."""
    return (
        ApprovalWords(GENERATED, (COMPUTED, NOBODY), TO_SIGN)
        if is_generated(blueprint)
        else (UNINSPECTED)
    )


def approval_words(blueprint: Blueprint, policy: Path | None = None) -> ApprovalWords:
    """Return the words of the badge for a blueprint, under a policy if one is named.

    This verifies signatures and runs the whole check, so it may take long. It heeds a stop.
    """
    if policy is None and not has_record_beside(blueprint.file):
        return unsigned_words(blueprint)
    from smsl_studio.front.verdicts import ApprovalQuestion, answered

    try:
        answer = answered(ApprovalQuestion(blueprint, policy=policy))
    except StudioError as error:
        return ApprovalWords(NOT_VERIFIED, (str(error),), error.advice)
    return words_of(answer, blueprint)


def words_of(answer: ApprovalAnswer, blueprint: Blueprint) -> ApprovalWords:
    """Return the words of the badge for a blueprint, from the answer whether it is approved."""
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
    refusals = judgement.refusals[:LONGEST]
    if told == {"condition_unmet"}:
        return ApprovalWords("Approved with conditions", signers, TO_MEET, refusals=refusals)
    known = ((words, advice) for code, words, advice in _WORDS if code in told)
    words, advice = next(known, ("Not approved", AGAIN))
    if words == UNINSPECTED.words and is_generated(blueprint):
        words = GENERATED
    return ApprovalWords(words, signers, advice, refusals=refusals)
