"""Refusals: the reasons why a blueprint is not approved, each with a code and a sentence."""

from __future__ import annotations

from typing import NamedTuple

CODES = (
    "digest_differs",
    "no_record",
    "policy_unmet",
    "key_unknown",
    "key_expired",
    "key_revoked",
    "signature_invalid",
    "too_few_persons",
    "role_missing",
    "record_expired",
    "record_revoked",
    "rolled_back",
    "verdict_not_approved",
    "condition_unmet",
    "open_finding",
    "rules_changed",
    "code_missing",
    "code_changed",
    "sub_not_covered",
    "policy_invalid",
    "register_invalid",
    "start_unconfirmed",
    "sensor_missing",
    "supervisor_missing",
    "log_unwritable",
    "file_changed",
)
"""Every code. Only runs use the last five."""


class Refusal(NamedTuple):
    """One reason why a run may not start: a code of ``CODES``, and a sentence for people.

    ``condition`` is the text of a condition that a person may sign as met, else empty.
    """

    code: str
    sentence: str
    condition: str = ""

    def as_json(self) -> dict[str, str]:
        """Return the refusal in the form that ``verify`` and runs write."""
        return {"code": self.code, "sentence": self.sentence}
