"""The terms of a run: all that is settled before its first tick and never changes."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.drive.loop_guard import VISITS


@dataclass(frozen=True, slots=True)
class RunTerms:
    """Where a run starts, where it is to go, and what it may do by itself.

    ``start`` names the state of an SB, ``goals`` are states. Neither routing nor a person may use
    an edge of ``avoid``. With ``on_mismatch`` ``hold`` a mismatch waits for a person; with
    ``adopt`` the run goes on from the one configuration that the scene agrees with. A run that is
    not ``automatic`` chooses no operation by itself. ``attended`` says whether somebody is there
    to decide; None: not in an automatic run. Where nobody is there, a hold or a stop ends the run.
    The automatic route begins one edge from one configuration at most ``visits`` times, then the
    run holds. ``findings`` are the words of inspection that a person must accept before anything
    moves; empty where nobody has to.
    """

    start: Mapping[str, str] = field(default_factory=dict)
    goals: Sequence[Address] = ()
    seed: int = 0
    avoid: Collection[Address] = ()
    on_mismatch: str = "hold"
    automatic: bool = True
    attended: bool | None = None
    visits: int = VISITS
    findings: str = ""

    @property
    def adopts(self) -> bool:
        """Whether a mismatch is taken for the configuration that the scene agrees with."""
        return self.on_mismatch == "adopt"

    @property
    def somebody_decides(self) -> bool:
        """Whether somebody is there to decide."""
        return not self.automatic if self.attended is None else self.attended


USUAL = RunTerms()
"""An automatic run from INITIAL to ACTIVATING, which nobody attends."""
