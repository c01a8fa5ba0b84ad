"""State checks in three-valued logic: does a state hold in the scene, fact by fact (clause 13)?

A fact that nobody senses is believed from the configuration. A fact that is sensed and has no value
is unknown, and a check with an unknown fact is never true.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from .elements import Blueprint, Branch, Configuration, Edge, FactKey, address

BELIEVED = "believed, nobody senses it"
IN_TRANSIT = "in transit"
"""Why a digit is unknown while a crossing below it is pending (clause 6)."""


@dataclass(frozen=True)
class Reading:
    """What is sensed of one fact: its value, or None with the reason."""

    value: str | None
    reason: str = ""


Scene = Mapping[FactKey, Reading]
"""The sensed facts. One that is missing has no sensor."""


@dataclass(frozen=True)
class Term:
    """One fact of a state check: what the state needs, what is read, and whether that is so."""

    fact: FactKey
    wanted: str
    reading: str | None
    truth: bool | None
    reason: str = ""


@dataclass(frozen=True)
class Check:
    """A state check: its terms, and from them true, false or None (unknown)."""

    branch: str
    state: str
    terms: tuple[Term, ...]

    @property
    def address(self) -> str:
        """The address of the state."""
        return address(self.branch, self.state)

    @cached_property
    def truth(self) -> bool | None:
        """False if a term is false, else None if one is unknown, else True."""
        truths = {term.truth for term in self.terms}
        return False if False in truths else None if None in truths else True

    @property
    def misses(self) -> list[Term]:
        """The terms that are false."""
        return [term for term in self.terms if term.truth is False]

    @property
    def unknown(self) -> list[Term]:
        """The terms that are unknown."""
        return [term for term in self.terms if term.truth is None]


class Checking:
    """State checks on one scene. A sub-SB that several bases share is checked once.

    ``believed`` are the states of SBs from which unsensed facts follow. ``transit`` are base digits
    in transit.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        scene: Scene,
        believed: Configuration,
        transit: Collection[FactKey] = (),
    ) -> None:
        self._blueprint, self._scene, self._believed = blueprint, scene, believed
        self._transit = transit
        self._activating: dict[str, Check] = {}

    def of(self, branch: str, state: str) -> Check:
        """Return the check of one state."""
        own = self._blueprint[branch]
        values = enumerate(own.facts(state))
        return Check(branch, state, tuple(self._term(own, digit, value) for digit, value in values))

    def _term(self, own: Branch, digit: int, wanted: str) -> Term:
        key, sub = (own.name, digit), own.flags[digit].sub
        if key in self._transit:
            return Term(key, wanted, None, None, IN_TRANSIT)
        if sub:
            return self._of_sub(own, digit, wanted, sub)
        reading = self._scene.get(key)
        if reading is None:
            value = own.facts(self._believed[own.name])[digit]
            return Term(key, wanted, value, value == wanted, BELIEVED)
        if reading.value is None:
            return Term(key, wanted, None, None, reading.reason or "no valid reading")
        return Term(key, wanted, reading.value, reading.value == wanted)

    def _of_sub(self, own: Branch, digit: int, wanted: str, sub: str) -> Term:
        """Return the term of a digit that a sub-SB expands: the check of its ACTIVATING state."""
        inner = self._activating.get(sub)
        if inner is None:
            inner = self.of(sub, self._blueprint[sub].activating)
            self._activating[sub] = inner
        key, flag = (own.name, digit), own.flags[digit]
        if inner.truth is None:
            unknown = [term for term in inner.unknown if term.reason != IN_TRANSIT]
            names = ", ".join(f"{term.fact[0]}/{term.fact[1]}" for term in unknown)
            reason = f"{names} in {sub} is unknown" if unknown else IN_TRANSIT
            return Term(key, wanted, None, None, reason)
        reading = flag.on if inner.truth else flag.off
        return Term(key, wanted, reading, inner.truth == (wanted == flag.on), f"the check of {sub}")


def fitting(blueprint: Blueprint, branch: str, scene: Scene, believed: Configuration) -> list[str]:
    """Return every state of an SB whose check is true. They all have the same facts."""
    own = blueprint[branch]
    terms = Checking(blueprint, scene, believed).of(branch, next(iter(own.states))).terms
    if any(term.truth is None for term in terms):
        return []
    return [name for name in own.states if all(_fits(own, name, term) for term in terms)]


def _fits(own: Branch, state: str, term: Term) -> bool:
    digit = term.fact[1]
    flag, value = own.flags[digit], own.facts(state)[digit]
    if flag.sub:
        return (value == flag.on) == (term.truth == (term.wanted == flag.on))
    return value == term.reading


def words_of(blueprint: Blueprint, term: Term, what: str = "") -> str:
    """Return a term in words, such as ``Fact 2 of SB1 reads b, not a``."""
    name, digit = term.fact
    subject = f"{blueprint[name].fact_name(digit)} of {name}{what}"
    if term.truth is None:
        return f"{subject} is unknown, {term.reason}"
    return f"{subject} reads {term.reading}" + ("" if term.truth else f", not {term.wanted}")


def required_words(blueprint: Blueprint, edge: Edge, term: Term) -> str:
    """Return the words for a fact that an edge requires and that does not hold."""
    name, digit = term.fact
    said = words_of(blueprint, term)
    return f"{edge} requires {name}/{digit} to be {term.wanted}: {said}"


def check_words(blueprint: Blueprint, check: Check) -> str:
    """Return why a state check is not true."""
    facts = "; ".join(words_of(blueprint, term) for term in (*check.misses, *check.unknown))
    return f"{check.branch}/{check.state} does not check true: {facts}"


def all_words(blueprint: Blueprint, checks: Iterator[Check]) -> list[str]:
    """Return the words of every fact that keeps some checks from being true."""
    return [words_of(blueprint, t) for check in checks for t in (*check.misses, *check.unknown)]
