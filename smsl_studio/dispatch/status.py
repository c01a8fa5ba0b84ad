"""How a run stands at one instant: a frozen value that windows draw and tests read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.check import CheckResult, Scene


@dataclass(frozen=True, slots=True)
class Possible:
    """One edge out of an active state: whether it may be asked for now, and if not, why.

    ``cost`` is that of its joint step, or its declared cost where it has none. ``pruned`` says
    that it is shut out (pruned or avoided), ``risky`` that it failed and was not restored.
    """

    address: Address
    target: str
    permitted: bool
    reasons: tuple[str, ...]
    cost: float
    on_route: bool
    pruned: bool = False
    risky: bool = False


@dataclass(frozen=True, slots=True)
class DispatchStatus:
    """How a run stands.

    ``phase``: ``ready`` (by hand, nothing runs, the world lives), ``running``, ``paused`` (nothing
    moves, simulated time stands still), ``held`` (a person must decide), ``finished``.
    ``pending`` are the states of SBs in transit, not committed. ``running`` is the edge whose
    library function runs, ``carrying`` the edge that was asked for. ``route`` are the edges still
    to be carried out, in order. ``check`` is the state check that is awaited, or that of the
    active state of the SB in question. Times are simulated seconds.
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
