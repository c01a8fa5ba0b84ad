"""What stands below the table of hazards and properties if there is no run to show."""

from __future__ import annotations

from smsl_studio.front.claim_rows import ClaimRow
from smsl_studio.inspection.proof.verdict import FAILS, HOLDS, UNKNOWN
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.features.inspection.claim_model import NEW

WORDS = {FAILS: "It fails", UNKNOWN: "It is unknown", HOLDS: "It holds"}


def words_below(claim: ClaimRow | None, waiting: str) -> str:
    """Return what is known of the chosen row. ``waiting`` says why no verdict is shown now."""
    if claim is None and waiting == NEW:
        return f"{NEW}."
    if claim is None:
        return "Choose a row. If it fails, its shortest run stands here, and on the drawing."
    verdict = f"{waiting}." if waiting else _verdict(claim)
    return "\n".join(filter(None, (capital(claim.sentence), claim.why, verdict)))


def _verdict(claim: ClaimRow) -> str:
    engine = f" Engine: {claim.engine}." if claim.engine else ""
    return f"{WORDS[claim.verdict]}: {claim.looked_at}.{engine}"
