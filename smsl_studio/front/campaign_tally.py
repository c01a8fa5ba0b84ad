"""What a campaign has shown so far, as a table: a row an operation, a column a fault."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from smsl_studio.front.campaign_runs import Injection, RunVerdict
from smsl_studio.front.campaigns import Campaign, CampaignWatch, row_of, wilson
from smsl_studio.front.fault_foresight import HELD, REACHED, FaultEnd

REFUSED, FAILED = "refused", "failed"
KINDS = (REACHED, REFUSED, HELD, FAILED)
"""How a run can end: at its goal, before its begin, at rest before its goal, or with an error. The
gravest is the last. A run that was refused shows nothing of the procedure, so no share counts it.
"""
_HELD = ("held", "no_route", "stopped")


def kind_of(verdict: RunVerdict) -> str:
    """Return how a run ended."""
    if verdict.reached:
        return REACHED
    if verdict.reason == REFUSED:
        return REFUSED
    return HELD if verdict.reason in _HELD else FAILED


@dataclass
class CampaignCell:
    """The runs of one fault in one operation. Both are empty for runs without a fault.

    ``verdicts`` are by seed; the runs of a campaign that goes on are not all there.
    """

    row: int
    injection: Injection | None
    seeds: int
    verdicts: dict[int, RunVerdict] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=lambda: dict.fromkeys(KINDS, 0))
    recovered: int = 0
    foreseen: FaultEnd | None = None
    """How its runs were foreseen to end, None if that is not known."""

    @property
    def fault(self) -> str:
        """The name of the fault."""
        return self.injection.fault if self.injection is not None else ""

    @property
    def edge(self) -> str:
        """The address of the operation."""
        return str(self.injection.edge) if self.injection is not None else ""

    @property
    def runs(self) -> int:
        """How many runs are done."""
        return len(self.verdicts)

    @property
    def differs(self) -> bool:
        """Whether all runs are done, and most of those that began ended otherwise than foreseen."""
        if self.foreseen is None or self.runs < self.seeds or not self.begun:
            return False
        return (self.foreseen.end == REACHED) is not (2 * self.counts[REACHED] >= self.begun)

    @property
    def begun(self) -> int:
        """How many of them began."""
        return self.runs - self.counts[REFUSED]


@dataclass(frozen=True, slots=True)
class CampaignShare:
    """A share of the runs that began and reached the goal, with its 95 % Wilson interval. Without
    runs it is from 0 to 1.
    """

    reached: int
    runs: int
    low: float = 0.0
    high: float = 1.0
    refused: int = 0
    """How many more runs did not begin."""

    @property
    def nothing(self) -> str:
        """Why there is no share, in words."""
        return "no run began" if self.refused else "not yet run"


def share_of(cells: Iterable[CampaignCell]) -> CampaignShare:
    """Return the share of the runs in some cells that began and reached the goal."""
    own = list(cells)
    reached, runs = sum(one.counts[REACHED] for one in own), sum(one.begun for one in own)
    low, high = wilson(reached, runs) if runs else (0.0, 1.0)
    return CampaignShare(reached, runs, low, high, sum(one.counts[REFUSED] for one in own))


class CampaignTally(CampaignWatch):
    """Counts what it hears."""

    def __init__(self) -> None:
        self.cells: list[CampaignCell] = []
        self.faults: tuple[str, ...] = ()
        """The faults in their order: the columns. One empty name for runs without a fault."""
        self.edges: tuple[str, ...] = ()
        """The operations in their order: the rows."""
        self.done = 0
        self._places: dict[tuple[str, str], CampaignCell] = {}

    @property
    def every(self) -> int:
        """How many runs the campaign has."""
        return sum(one.seeds for one in self.cells)

    def begin(self, rows: Sequence[Injection | None], seeds: int) -> None:
        """Hear the rows, and the number of seeds of each."""
        self.cells = [CampaignCell(at, one, seeds) for at, one in enumerate(rows)]
        self.faults = tuple(dict.fromkeys(one.fault for one in self.cells))
        self.edges = tuple(dict.fromkeys(one.edge for one in self.cells))
        self._places = {(one.edge, one.fault): one for one in self.cells}
        self.done = 0

    def foresee(self, row: int, end: FaultEnd) -> None:
        """Keep how the runs of a row were foreseen to end."""
        self.cells[row].foreseen = end

    def hear(self, row: int, seed: int, verdict: RunVerdict) -> None:
        """Count a run. One that is told twice counts once."""
        cell = self.cells[row]
        if seed in cell.verdicts:
            return
        cell.verdicts[seed] = verdict
        cell.counts[kind_of(verdict)] += 1
        cell.recovered += verdict.recovered
        self.done += 1

    def cell(self, edge: str, fault: str) -> CampaignCell | None:
        """Return a cell; None if this fault cannot occur there."""
        return self._places.get((edge, fault))

    def of_edge(self, edge: str) -> CampaignShare:
        """Return the share of one operation, with the runs of all faults added."""
        return share_of(one for one in self.cells if one.edge == edge)

    def of_fault(self, fault: str) -> CampaignShare:
        """Return the share of one fault, with the runs of all operations added."""
        return share_of(one for one in self.cells if one.fault == fault)

    def result(self, digest: str, left_out: tuple[str, ...] = ()) -> Campaign:
        """Return the campaign as far as it is done. ``digest`` is empty before its end."""
        rows = tuple(
            row_of(one.injection, [one.verdicts[seed] for seed in sorted(one.verdicts)])
            for one in self.cells
            if one.verdicts
        )
        return Campaign(self.done, sum(row.reached for row in rows), digest, rows, left_out)
