"""The supervisor: a person or an automatic agent that is asked before an operation begins."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import Scene
from smsl_studio.library.prediction import Prediction
from smsl_studio.library.supervisor_view import (
    NO_RISK,
    Neighbour,
    RiskEstimate,
    SeenFact,
    SupervisorView,
)

ALLOW, VETO, PRUNE, PAUSE, ASK = "allow", "veto", "prune", "pause", "ask"
TAKE_OVER, HOLD = "take_over", "hold"


@dataclass(frozen=True, slots=True)
class Proposal:
    """The partial view for a decision: the active states, the proposed operation and its target.

    ``operations`` are all edges of the joint step. The proposed operation comes last, the others in
    the order in which they start. ``risk`` is the highest declared risk among them, empty if none
    is declared. ``time`` is simulated seconds.

    The rest is filled for an ``Estimating`` supervisor alone. ``neighbours`` are all operations out
    of the active states. ``facts`` are those that are sensed, by ``SB/digit``. ``history`` has the
    results of edges so far, and ``estimate`` the risk with its parts. ``durations`` and
    ``measures`` are those of ``SupervisorView``. ``forecast`` is what the simulated world predicts,
    None in a run without forecasts.
    """

    time: float
    configuration: Mapping[str, str]
    operation: Address
    operations: tuple[Address, ...]
    target: str
    risk: str
    cost: float
    scene: Scene
    neighbours: tuple[Neighbour, ...] = ()
    facts: Mapping[str, SeenFact] = field(default_factory=dict)
    history: tuple[tuple[str, str], ...] = ()
    estimate: RiskEstimate = NO_RISK
    forecast: Prediction | None = None
    durations: Mapping[str, float] = field(default_factory=dict)
    measures: Mapping[str, tuple[float, ...]] = field(default_factory=dict)

    def view(self) -> SupervisorView:
        """Return the same for a supervisor in another process."""
        return SupervisorView(
            time=self.time,
            configuration=dict(self.configuration),
            operation=str(self.operation),
            operations=tuple(map(str, self.operations)),
            target=self.target,
            cost=self.cost,
            declared=self.risk,
            neighbours=self.neighbours,
            facts=dict(self.facts),
            history=self.history,
            estimate=self.estimate,
            forecast=self.forecast,
            durations=dict(self.durations),
            measures=dict(self.measures),
        )


@dataclass(frozen=True, slots=True)
class Verdict:
    """A supervisor's decision, with its reason: ``allow``, ``veto`` (once), ``prune``, ``pause``,
    ``ask`` (a person), ``take_over`` (the automation is locked out until a person gives it back) or
    ``hold`` (of a forecast). ``by`` is who decided, if not the supervisor of the run.
    """

    decision: str
    reason: str = ""
    by: str = ""


class Supervisor(Protocol):
    """A supervisor is asked after every other guard, before anything moves.

    It must answer at once. If it needs time, it answers ``ask`` or ``pause``.
    """

    @property
    def name(self) -> str:
        """The name of the supervisor in the record of the run."""

    def review(self, proposal: Proposal) -> Verdict:
        """Decide on a proposed operation. It is called once before the operation begins."""


@runtime_checkable
class Estimating(Protocol):
    """A supervisor that decides by the estimated risk. The run tells the estimate then."""

    @property
    def estimates(self) -> bool:
        """Whether the event ``risk_estimated`` stands before each of its decisions."""


@runtime_checkable
class Closing(Protocol):
    """A supervisor that holds something, such as a process, until the run ends."""

    def close(self) -> None:
        """Free it. A second call does nothing."""
