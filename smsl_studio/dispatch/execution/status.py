"""How a run stands at one instant: a frozen value that windows draw and tests read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, Scene, Term
from smsl_studio.dispatch.people.task import Task
from smsl_studio.monitor.facts import SourceState


@dataclass(frozen=True, slots=True)
class Possible:
    """One edge out of an active state: whether it may be asked for now, and if not, why.

    ``cost`` is that of its joint step, or its declared cost where it has none. ``pruned`` says
    that it is shut out (pruned or avoided), ``risky`` that it failed and was not restored,
    ``vetoed`` that the next time it is skipped. ``needs`` are the facts of other SBs that it
    requires, as they stand; ``risk`` is declared (low, medium, high or empty), ``level`` says who
    acts (human, shared, automatic).
    """

    address: Address
    target: str
    permitted: bool
    reasons: tuple[str, ...]
    cost: float
    on_route: bool
    pruned: bool = False
    risky: bool = False
    vetoed: bool = False
    needs: tuple[Term, ...] = ()
    risk: str = ""
    level: str = "automatic"


@dataclass(frozen=True, slots=True)
class Offer:
    """Something a person may do now: the command, on what, and a sentence for a button.

    ``command`` is restore, adopt, ask, resume, take_over or end where the run holds, reset or end
    where it is stopped, accept, give_back or stop where somebody has taken over, and stop where a
    veto came too late.
    """

    command: str
    address: str
    sentence: str


@dataclass(frozen=True, slots=True)
class DispatchStatus:
    """How a run stands.

    ``phase``: ``idle`` (no world stands yet), ``ready`` (by hand, nothing runs, the world lives),
    ``running``, ``paused`` (nothing moves, simulated time stands still), ``waiting`` (a task is
    open), ``no_route``, ``taken_over``, ``fault_hold`` (a person must decide), ``stopped``
    (latched), ``done``. ``docs/supervision.md`` draws them.
    ``pending`` are the states of SBs in transit, not committed. ``running`` is the edge whose
    library function runs, ``carrying`` the edge that was asked for. ``route`` are the edges still
    to be carried out, in order; ``detour`` those if the next one were vetoed (None: no way, or
    nobody attends the run).
    ``check`` is the state check that is awaited, or that of the active state of the SB in
    question. ``since`` has the time at which each SB entered its state, ``previous`` the edge that
    led there. ``sources`` are all sources of all facts. ``by`` is who has taken over or stopped.
    ``notes`` say which edges of the route set the facts of their subs by themselves (see
    ``bypass``).
    ``pausing`` says that it will pause when what is carried out has ended: after a step, or where
    the operation does not let itself be held.
    ``planning`` says that routes are still being looked for: ``route``, ``detour`` and
    ``possible`` are not all that there is.
    Times are simulated seconds.
    """

    phase: str
    time: float
    configuration: Mapping[str, str]
    pending: Mapping[str, str]
    running: Address | None
    carrying: Address | None
    running_since: float | None
    progress: float | None
    route: tuple[Address, ...]
    goals: tuple[Address, ...]
    scene: Scene
    check: CheckResult | None
    possible: tuple[Possible, ...]
    candidates: tuple[Mapping[str, str], ...]
    reason: str
    sentence: str
    operations: int
    details: tuple[str, ...] = ()
    offers: tuple[Offer, ...] = ()
    tasks: tuple[Task, ...] = ()
    detour: tuple[Address, ...] | None = None
    since: Mapping[str, float] = field(default_factory=dict)
    previous: Mapping[str, Address] = field(default_factory=dict)
    sources: tuple[SourceState, ...] = ()
    full_map: bool = False
    by: str = ""
    notes: tuple[str, ...] = ()
    planning: bool = False
    pausing: bool = False
