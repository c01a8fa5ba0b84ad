"""What whoever writes a supervisor imports; ``drive.supervisor`` explains it."""

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
