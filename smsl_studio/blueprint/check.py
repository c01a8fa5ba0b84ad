"""The scene and state checks: s and C_state(s) of the paper (Eq. 4), in three-valued logic.

A ``FactKey`` identifies a fact: the name of the SB, and the digit counted from 0.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, ItemsView, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from types import MappingProxyType
from typing import NamedTuple

from smsl_studio.blueprint.address import state_text
from smsl_studio.blueprint.model import Blueprint, StateBranch

FactKey = tuple[str, int]


class Reading(NamedTuple):
    """The reading of one fact: its value, or None (unknown) with the reason. It is a light value,
    because a fact that changes is read anew at every tick.

    ``age`` is in seconds of the receiver's clock. ``sensed`` is false if nobody senses the fact, so
    that it is believed from the configuration.
    """

    value: str | None
    reason: str = ""
    age: float = 0.0
    sensed: bool = True


reading_of: Callable[[tuple[str | None, str, float, bool]], Reading] = partial(
    tuple.__new__, Reading
)
"""Return the reading with these fields, in a third of the time of a call with names."""


@lru_cache(maxsize=256)
def fresh_reading(value: str | None) -> Reading:
    """The reading of a fact that was sensed at this instant: one object for each value."""
    return Reading(value)


NOTHING_SENSED: Mapping[FactKey, Reading] = MappingProxyType({})


class Scene(NamedTuple):
    """The sensed facts at one time (the paper's *s*). A fact that is missing has no sensor."""

    readings: Mapping[FactKey, Reading] = NOTHING_SENSED
    time: float = 0.0

    def get(self, branch: str, digit: int) -> Reading | None:
        """Return the reading of a fact, or None if no sensor reads it."""
        return self.readings.get((branch, digit))


@dataclass(frozen=True, slots=True)
class Term:
    """One f_i of a state check: the fact, the value that the state needs, the reading and the
    truth.
    """

    fact: FactKey
    wanted: str
    reading: str | None
    truth: bool | None
    reason: str = ""


@dataclass(frozen=True, eq=False)
class CheckResult:
    """The result of a state check: every term, and from them true, false or unknown (None)."""

    branch: str
    state: str
    terms: tuple[Term, ...]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CheckResult):
            return NotImplemented
        same = self.branch == other.branch and self.state == other.state
        return same and self.terms == other.terms

    def __hash__(self) -> int:
        return hash((self.branch, self.state, self.terms))

    @cached_property
    def address(self) -> str:
        """The state's address as text."""
        return state_text(self.branch, self.state)

    @cached_property
    def truth(self) -> bool | None:
        """False if a term is false, else None if one is unknown, else True."""
        if any(term.truth is False for term in self.terms):
            return False
        return None if any(term.truth is None for term in self.terms) else True

    @cached_property
    def holds(self) -> tuple[Term, ...]:
        """The terms that are true."""
        return tuple(term for term in self.terms if term.truth is True)

    @cached_property
    def misses(self) -> tuple[Term, ...]:
        """The terms that are false."""
        return tuple(term for term in self.terms if term.truth is False)

    @cached_property
    def unknown(self) -> tuple[Term, ...]:
        """The terms that are unknown."""
        return tuple(term for term in self.terms if term.truth is None)


class _Met(CheckResult):
    """The result in which every fact has the value that the state needs.

    Most checks of a run are such, and nobody asks for their terms. So these are made when they are
    first asked for.
    """

    truth = True
    _own: StateBranch
    _reason: str

    def __init__(self, branch: StateBranch, state: str, reason: str = "") -> None:
        kept = self.__dict__  # as a frozen value is made, and quicker than by its own way
        kept["branch"], kept["state"] = branch.name, state
        kept["_own"], kept["_reason"] = branch, reason

    @cached_property
    def terms(self) -> tuple[Term, ...]:
        """The terms, all true."""
        name, reason = self.branch, self._reason
        values = enumerate(self._own.facts(self.state))
        return tuple(Term((name, digit), value, value, True, reason) for digit, value in values)


class _Sensed(NamedTuple):
    """The values that each fact of a state must have, and the result if they are sensed.

    ``fresh`` are these values as readings of this instant.
    """

    pairs: tuple[tuple[FactKey, str], ...]
    fresh: ItemsView[FactKey, Reading]
    result: CheckResult


class StateChecks:
    """The results of state checks that are kept for the states of one SB (see ``as_expected``).

    Each is made when it is first asked for. Several runs may ask the same object.
    """

    __slots__ = ("_believed", "_branch", "_last", "_sensed", "_whole")

    def __init__(self, branch: StateBranch) -> None:
        self._branch = branch
        self._whole = not branch.subs
        self._believed: dict[str, CheckResult] = {}
        self._sensed: dict[str, _Sensed] = {}
        self._last: tuple[Mapping[FactKey, Reading], str, CheckResult | None]
        self._last = (NOTHING_SENSED, "", None)
        """The last readings, state and result in which all facts were sensed."""

    def expected(
        self, state: str, readings: Mapping[FactKey, Reading], held: str | None
    ) -> CheckResult | None:
        """Return the result of a check if every fact has the value that the state needs, else
        None.
        """
        if not self._whole:
            return None
        if not readings:
            if held != state:
                return None
            return self._believed.get(state) or self._believe(state)
        last = self._last
        if last[0] is readings and last[1] == state:
            return last[2]
        wanted = self._sensed.get(state) or self._sense(state)
        if not wanted.pairs:
            return None
        if not wanted.fresh <= readings.items():
            unsensed = 0
            for key, value in wanted.pairs:
                reading = readings.get(key)
                if reading is None or not reading.sensed:
                    unsensed += 1
                elif reading.value != value:
                    return None
            if unsensed:
                believed = held == state and unsensed == len(wanted.pairs)
                return self._believe(state) if believed else None
        self._last = (readings, state, wanted.result)
        return wanted.result

    def _believe(self, state: str) -> CheckResult:
        return self._believed.setdefault(state, _Met(self._branch, state, BELIEVED))

    def _sense(self, state: str) -> _Sensed:
        branch = self._branch
        pairs = tuple(((branch.name, d), value) for d, value in enumerate(branch.facts(state)))
        fresh = {key: fresh_reading(value) for key, value in pairs}
        found = self._sensed[state] = _Sensed(pairs, fresh.items(), _Met(branch, state))
        return found


_KEY = "_kept_checks"
BELIEVED = "believed, nobody senses it"

IN_TRANSIT = "in transit"
"""The reason why a digit is unknown while a crossing below it is pending (clause 6)."""


def state_check(
    blueprint: Blueprint,
    branch: str,
    state: str,
    scene: Scene,
    believed: Mapping[str, str],
    *,
    transit: Collection[FactKey] = (),
) -> CheckResult:
    """Return the state check C_state(s): whether ``state`` holds in the scene, fact by fact.

    The value of a digit with a sub-SB is the state check of the sub-SB in ACTIVATING, recursively.
    If the state needs the digit off, the result is negated. A fact that nobody senses is taken from
    ``believed`` (SB -> state). A sensed fact without a value makes the check unknown, and so does a
    digit in ``transit``. The SUB_SBS must have no cycle.
    """
    expected = as_expected(blueprint.branches[branch], state, scene, believed.get(branch))
    if expected is not None:
        return expected
    return _Checking(blueprint, scene, believed, transit).of(branch, state)


class _Checking:
    """One state check over all levels. A sub-SB that several bases share is checked only once."""

    def __init__(
        self,
        blueprint: Blueprint,
        scene: Scene,
        believed: Mapping[str, str],
        transit: Collection[FactKey],
    ) -> None:
        self._blueprint, self._scene, self._believed = blueprint, scene, believed
        self._transit = transit
        self._activating: dict[str, CheckResult] = {}

    def of(self, branch: str, state: str) -> CheckResult:
        """Return the result of the check of one state."""
        own = self._blueprint.branches[branch]
        expected = as_expected(own, state, self._scene, self._believed.get(branch))
        if expected is not None:
            return expected
        values = enumerate(own.facts(state))
        return CheckResult(branch, state, tuple(self._term(own, d, value) for d, value in values))

    def _term(self, own: StateBranch, digit: int, value: str) -> Term:
        if (own.name, digit) in self._transit:
            return Term((own.name, digit), value, None, None, IN_TRANSIT)
        sub = sub_below(self._blueprint, own, digit)
        if sub is None:
            return _term(own, digit, value, self._scene, self._believed)
        inner = self._activating.get(sub.name)
        if inner is None:
            inner = self._activating[sub.name] = self.of(sub.name, sub.activating)
        return _sub_term(own, digit, value, inner)


def as_expected(
    branch: StateBranch, state: str, scene: Scene, held: str | None
) -> CheckResult | None:
    """Return the result of a state check if every fact has the value that the state needs, else
    None.

    Either all facts are sensed with these values, or none is sensed and the SB is believed
    (``held``) to be in the state. The result is also None if a sub-SB expands a fact, because each
    term must then be checked. Most checks of a run end here, so each state keeps its two results.
    """
    return checks_of(branch).expected(state, scene.readings, held)


def checks_of(branch: StateBranch) -> StateChecks:
    """Return the kept results of an SB. They live as long as the SB."""
    kept: StateChecks | None = branch.__dict__.get(_KEY)
    return kept or branch.__dict__.setdefault(_KEY, StateChecks(branch))


def sub_below(blueprint: Blueprint, branch: StateBranch, digit: int) -> StateBranch | None:
    """Return the sub-SB whose state check gives the value of a digit. None if the digit is read as
    any other fact.
    """
    sub = blueprint.branches.get(branch.subs.get(digit, ""))
    return sub if sub is not None and sub.activating in sub.table else None


def _term(
    branch: StateBranch, digit: int, wanted: str, scene: Scene, believed: Mapping[str, str]
) -> Term:
    key = (branch.name, digit)
    reading = scene.readings.get(key)
    if reading is not None and reading.sensed:
        if reading.value is None:
            return Term(key, wanted, None, None, reading.reason or "no valid reading")
        return Term(key, wanted, reading.value, reading.value == wanted)
    held = believed.get(branch.name)
    if held is None:
        return Term(key, wanted, None, None, "nobody senses it")
    value = branch.facts(held)[digit]
    return Term(key, wanted, value, value == wanted, BELIEVED)


def _sub_term(base: StateBranch, digit: int, wanted: str, inner: CheckResult) -> Term:
    key, on, truth = (base.name, digit), base.on_value(digit), inner.truth
    if truth is None:
        unknown = [term for term in inner.unknown if term.reason != IN_TRANSIT]
        names = ", ".join(f"{term.fact[0]}/{term.fact[1]}" for term in unknown)
        reason = f"{names} in {inner.branch} is unknown" if unknown else IN_TRANSIT
        return Term(key, wanted, None, None, reason)
    reading = on if truth else off_value(base, digit)
    return Term(key, wanted, reading, truth == (wanted == on), f"the check of {inner.branch}")


def off_value(base: StateBranch, digit: int) -> str:
    """Return the value of a digit with a sub-SB that means off, ``0`` if the states show none."""
    on = base.on_value(digit)
    return next((value for value in base.alphabet[digit] if value != on), "0")
