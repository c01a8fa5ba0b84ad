"""The terms of a run: they are settled before its first tick and never change."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.drive.foresight import Foresight
from smsl_studio.dispatch.drive.generation import EdgeProposer
from smsl_studio.dispatch.drive.loop_guard import VISITS


@dataclass(frozen=True, slots=True)
class RunTerms:
    """The start and the goals of a run, and what it may do by itself.

    ``start`` has the state of some SBs, and ``goals`` are states. Neither a route nor a person may
    use an edge in ``avoid``. If ``on_mismatch`` is ``hold``, a mismatch waits for a person. If it
    is ``adopt``, the run goes on from the configuration that fits the scene, if there is only one.
    A run that is not ``automatic`` chooses no operation by itself. ``attended`` says whether
    somebody is there to decide; None means that only a run by hand is attended. Without attendance
    a hold or a stop ends the run. The automatic route begins an edge from one configuration at most
    ``visits`` times, and then the run holds. ``findings`` are the findings that a person must
    accept before anything moves, in words. A run that is not ``guarded`` ignores hazards.
    ``left_out`` are annotations of the file that nobody can read, as addresses with sentences.
    ``approved`` says that a policy or a record guards the run and is met, and ``hardware`` that the
    approval is one for a world that is hardware. ``met`` are the typed conditions that are met.
    ``robot`` is the robot that was asked for, for the record. ``foresight`` looks at each step in a
    simulated world before it begins. Where ``unconfirmed``, nobody is asked to confirm an
    operation: a forecast of it comes before people are asked. ``proposer`` is asked for edges where
    no way leads to the goals.
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
    guarded: bool = True
    left_out: Sequence[tuple[str, str]] = ()
    approved: bool = False
    hardware: bool = False
    met: Sequence[str] = ()
    robot: str = ""
    foresight: Foresight | None = None
    unconfirmed: bool = False
    proposer: EdgeProposer | None = None

    @property
    def adopts(self) -> bool:
        """Whether a mismatch is resolved by the only configuration that fits the scene."""
        return self.on_mismatch == "adopt"

    @property
    def somebody_decides(self) -> bool:
        """Whether somebody is there to decide."""
        return not self.automatic if self.attended is None else self.attended


USUAL = RunTerms()
"""An automatic run from INITIAL to ACTIVATING, without attendance."""
