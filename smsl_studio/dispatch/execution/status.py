"""The status of a run at one time, as a frozen value. The window draws it and tests read it."""

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

    ``cost`` is the cost of its joint step, or its own cost if it has none. ``pruned`` says that it
    is excluded (pruned or avoided), ``risky`` that it has failed and was not restored, and
    ``vetoed`` that it is skipped the next time. ``needs`` are the facts of other SBs that it
    requires, with their readings. ``risk`` is the declared risk (low, medium, high or empty).
    ``level`` says who acts (human, shared or automatic).
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
    """A command that is offered to a person now: its word, its operation, and a sentence for a
    button.

    If the run holds, ``command`` is restore, adopt, ask, resume, take_over or end. If it is
    stopped, it is reset or end. After a take-over it is accept, give_back or stop. If a veto came
    too late, it is stop.
    """

    command: str
    address: str
    sentence: str


@dataclass(frozen=True, slots=True)
class DispatchStatus:
    """The status of a run. Times are simulated seconds.

    ``phase`` is one of these run states (see ``docs/supervision.md``): ``idle`` (there is no world
    yet), ``ready`` (by hand, no step is carried out, time passes), ``running``, ``paused`` (nothing
    moves, time stands still), ``waiting`` (a task is open), ``no_route``, ``taken_over``,
    ``fault_hold`` (a person must decide), ``stopped`` (latched), ``done``.

    ``pending`` has the states of SBs that have moved and are not committed. ``running`` is the edge
    whose function runs, and ``carrying`` the edge that was asked for. ``route`` are the edges still
    to be carried out, in order. ``detour`` are those if the next edge was vetoed; None if there is
    no such route or nobody attends the run.

    ``check`` is the state check that is awaited, or that of an active state. ``since`` is the time
    when each SB entered its state, and ``previous`` the edge that led there. ``sources`` are all
    sources of all facts. ``by`` is the person who has taken over or stopped the run. ``notes`` has
    sentences about edges that set the facts of their sub-SBs themselves (see ``bypass``).

    ``pausing`` says that the run will pause when its step or operation has ended. ``planning`` says
    that routes are still being searched, so ``route``, ``detour`` and ``possible`` are not
    complete. ``generated`` are the edges, with their targets, that people have let count in this
    run, and ``proposed`` is the one that they are asked about now.
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
    generated: Mapping[Address, str] = field(default_factory=dict)
    proposed: tuple[Address, str] | None = None
