"""Guards before motion, and the facts that must stay true meanwhile (clauses 4 and 9)."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from .checks import IN_TRANSIT, Term, required_words, words_of
from .elements import Edge, FactKey
from .joint import Action, JointStep
from .live import NOTHING, LiveRun


def refusals(run: LiveRun, step: JointStep) -> list[str]:
    """Return why a joint step may not begin now. Empty if it may."""
    found: list[str] = []
    for branch, source in step.leaves.items():
        if source == run.configuration[branch]:
            check = run.check(branch, source)
            if check.truth is not True:
                found.append(run.why_not(check))
    found += lost_critical(run)
    moved: set[str] = set()
    for edge in step.edges:
        found += [
            required_words(run.blueprint, edge, term)
            for term in needs(run, edge)
            if term.fact[0] not in moved and term.truth is not True
        ]
        moved |= run.moved_by(edge)
    return list(dict.fromkeys(found))


def needs(run: LiveRun, edge: Edge) -> Iterator[Term]:
    """Yield the facts of other SBs that an edge requires, as they are sensed."""
    for branch, digit, value in edge.requires:
        if digit >= 0:
            term = run.check(branch, run.configuration[branch]).terms[digit]
            yield _as_wanted(term, value)


def doubt(run: LiveRun, edge: Edge) -> str:
    """Return why an edge of a step that has begun may not run its function now."""
    check = run.check(edge.branch, run.believed[edge.branch], run.transit)
    return "" if check.truth is True else run.why_not(check)


def lost_terms(run: LiveRun, changing: Collection[FactKey] = NOTHING) -> Iterator[Term]:
    """Yield the critical facts that are false or unknown now, but those that a step changes."""
    believed, left_out = run.believed, run.transit.union(changing)
    checking = run.checking(believed, left_out)
    for name, digit in run.critical:
        term = checking.of(name, believed[name]).terms[digit]
        if term.truth is not True and term.reason != IN_TRANSIT:
            yield term


def lost_critical(run: LiveRun, changing: Collection[FactKey] = NOTHING) -> list[str]:
    """Return the same as sentences."""
    what = ", a critical fact,"
    return [words_of(run.blueprint, term, what) for term in lost_terms(run, changing)]


class Safeguards:
    """The facts that one step needs while it is carried out, as far as it does not change them."""

    def __init__(self, run: LiveRun) -> None:
        self._run = run
        self._required: list[Edge] = []
        self._changing: frozenset[FactKey] = NOTHING
        self._changed: set[FactKey] = set()

    def begin(self, action: Action) -> list[str]:
        """Return why an action may not begin. From now on the facts that it changes are left out,
        and those that its edges require must stay.
        """
        self._required += [edge for edge in action.begins if edge.requires]
        lost = self.lost()
        self._changing = frozenset(self._run.changed_by(action)) | action.transit
        self._changed |= self._changing
        return lost

    def end(self, action: Action) -> None:
        """Note that the check of an action was true."""
        self._changing = NOTHING
        self._required = [edge for edge in self._required if edge not in action.commits]

    def lost(self, asked: Collection[FactKey] = NOTHING) -> list[str]:
        """Return the needed facts that are false or unknown now. Those that people are ``asked``
        for are left out.
        """
        changing = self._changing.union(asked)
        required = [words for edge in self._required for words in self._unmet(edge, changing)]
        return list(dict.fromkeys([*required, *lost_critical(self._run, changing)]))

    def _unmet(self, edge: Edge, changing: Collection[FactKey]) -> Iterator[str]:
        run, believed = self._run, self._run.believed
        checking = run.checking(believed, run.transit.union(changing))
        for name, digit, value in edge.requires:
            if digit < 0 or (name, digit) in self._changed:
                continue
            term = checking.of(name, believed[name]).terms[digit]
            if term.reading != value and term.reason != IN_TRANSIT:
                yield required_words(run.blueprint, edge, _as_wanted(term, value))


def _as_wanted(term: Term, value: str) -> Term:
    truth = None if term.reading is None else term.reading == value
    return Term(term.fact, value, term.reading, truth, term.reason)
