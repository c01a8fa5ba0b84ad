"""The names that the author of a supervisor imports. ``drive.supervisor`` explains them."""

from __future__ import annotations

from smsl_studio.dispatch.drive.supervisor import (
    ALLOW,
    ASK,
    PAUSE,
    PRUNE,
    VETO,
    Proposal,
    Supervisor,
    Verdict,
)

__all__ = ["ALLOW", "ASK", "PAUSE", "PRUNE", "VETO", "Proposal", "Supervisor", "Verdict"]
