"""Automatic supervisors: agents that decide on every operation before it begins."""

from __future__ import annotations

from smsl_studio.dispatch.drive.supervisor import ALLOW, ASK, VETO, Proposal, Verdict
from smsl_studio.errors import UsageError, did_you_mean

RISKS = ("low", "medium", "high")


class RiskLimit:
    """Allows operations up to a declared risk, vetoes those above it, and asks a person about the
    others.

    It sees only the proposed operation, as every supervisor does. An operation without a declared
    risk is not assumed to be safe, so a person is asked.
    """

    def __init__(self, limit: str = "medium") -> None:
        if limit not in RISKS:
            near = did_you_mean(limit, RISKS) or f"Choose one of {', '.join(RISKS)}."
            raise UsageError(f"{limit!r} is no risk", advice=near)
        self.limit = limit

    @property
    def name(self) -> str:
        """The name of this supervisor in the record, with its limit."""
        return f"risk limit {self.limit}"

    def review(self, proposal: Proposal) -> Verdict:
        """Return ``allow`` or ``veto``, or ``ask`` if no risk is declared."""
        risk = proposal.risk
        if risk not in RISKS:
            return Verdict(ASK, f"No risk is declared for {proposal.operation}.")
        if RISKS.index(risk) > RISKS.index(self.limit):
            return Verdict(VETO, f"Its risk is {risk}, above the limit of {self.limit}.")
        return Verdict(ALLOW, f"Its risk is {risk}.")
