"""The partial view: what an automatic supervisor of a plugin sees before an operation begins.

All values are frozen. A supervisor is a function that gets one ``SupervisorView`` and returns its
answer, or the answer with a reason (paper, Supervision).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from smsl_studio.library.prediction import Prediction

APPROVE, ASK, VETO, TAKE_OVER = "approve", "ask", "veto", "take_over"
ANSWERS = (APPROVE, ASK, VETO, TAKE_OVER)
"""The answers of a supervisor, the most careful last: the operation may begin, a person decides, it
does not begin this time, or the automation is locked out until a person gives it back."""


@dataclass(frozen=True, slots=True)
class SeenFact:
    """The value of a fact (None: unknown), and the age of the oldest sample that it rests on.

    ``age`` and ``limit`` are in seconds. An older sample does not count. ``limit`` is infinite for
    the answer of a person.
    """

    value: str | None
    age: float
    limit: float


@dataclass(frozen=True, slots=True)
class Neighbour:
    """An operation out of a present state: its address, its target, its cost and declared risk."""

    operation: str
    target: str
    cost: float
    risk: str


@dataclass(frozen=True, slots=True)
class RiskEstimate:
    """The risk of an operation from 0 to 1, its parts before they are weighted, and the reasons in
    words.
    """

    risk: float
    parts: Mapping[str, float]
    reasons: tuple[str, ...]


NO_RISK = RiskEstimate(0.0, {}, ())


@dataclass(frozen=True, slots=True)
class SupervisorView:
    """The present state, its neighbours, and the proposed operation.

    ``time`` is in simulated seconds. ``configuration`` has the state of each SB. ``operation`` is
    the address of the proposed operation, ``operations`` are all of its joint step, and ``target``
    is the state to which it leads. ``facts`` has each sensed fact by ``SB/digit``. ``declared`` is
    the declared risk: low, medium, high or empty. ``history`` has a pair (address, ``committed`` or
    ``failed``) for each operation of the run so far. ``forecast`` is what the simulated world
    predicts, None in a run without forecasts. ``durations`` has how long each operation took the
    last time that it returned (s), by its address. ``measures`` has the newest number of each
    source of a fact with predicates, or three for a position, by ``SB/digit/source`` in its unit.
    """

    time: float
    configuration: Mapping[str, str]
    operation: str
    operations: tuple[str, ...]
    target: str
    cost: float
    declared: str
    neighbours: tuple[Neighbour, ...] = ()
    facts: Mapping[str, SeenFact] = field(default_factory=dict)
    history: tuple[tuple[str, str], ...] = ()
    estimate: RiskEstimate = NO_RISK
    forecast: Prediction | None = None
    durations: Mapping[str, float] = field(default_factory=dict)
    measures: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
