"""The reader of the library: which of its operations lead on from where a run stands.

It uses no model. What an operation changes is known from edges of the same name, if they all write
the same values, or from the twin of the run's world, in which it is tried. In a failure state the
operations come first that the library has for recovery. Then come those that the blueprint has in
the most states that are most alike, then those with the cheapest way behind them.
So equal runs get equal proposals.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.failure_states import failing_states
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.dispatch.drive.generation import WayQuestion
from smsl_studio.library.prediction import AGREES, NONE, Prediction
from smsl_studio.stop import heed

MOST_SHOWN = 3
"""The reader proposes at most so many edges."""
MOST_FORESEEN = 12
"""At most so many operations with a known effect are foreseen for one question."""
MOST_TRIED = 200
"""At most so many operations without a known effect are tried for one question."""

Foresee = Callable[[Address, str], Prediction]
Try = Callable[[Sequence[Address]], Iterator[tuple[Address, Prediction]]]


class LeadingEdge(NamedTuple):
    """An edge that leads on. ``unlike`` says how unlike the states are in which the blueprint has
    this operation, ``cost`` is that of the way behind it, and ``why`` says how its effect is known.
    """

    unlike: tuple[int, int]
    cost: float
    edge: Address
    target: str
    why: str


class LibraryEdges:
    """The operations of the library from where a run stands.

    ``names`` are the library operations of each SB, ``recovers`` those for recovery. ``foresee``
    foresees an edge. ``trial`` is None in a world that cannot tell what an operation would change.
    """

    def __init__(
        self,
        question: WayQuestion,
        names: Mapping[str, Sequence[str]],
        recovers: Mapping[str, Collection[str]],
        foresee: Foresee,
        trial: Try | None,
    ) -> None:
        self._question, self._foresee, self._trial = question, foresee, trial
        every = [
            Address(branch, state, name)
            for branch, state in question.configuration.items()
            for name in names.get(branch, ())
            if name not in question.blueprint[branch].table[state]
        ]
        open_edges = [edge for edge in every if edge not in question.shut]
        first = [edge for edge in open_edges if self._recovers(edge, recovers)]
        kept = frozenset(first)
        self._stages = (first, [edge for edge in open_edges if edge not in kept])

    def leading(self) -> list[LeadingEdge]:
        """Return the edges that lead on, the best first."""
        for stage in self._stages:
            found = self._of(stage)
            if found:
                return found
        return []

    def _recovers(self, edge: Address, recovers: Mapping[str, Collection[str]]) -> bool:
        """Return whether an operation is for the failure state in which its SB stands."""
        branch = self._question.blueprint[edge.branch]
        failing = edge.state in failing_states(branch)
        return failing and edge.operation in recovers.get(edge.branch, ())

    def _of(self, edges: Sequence[Address]) -> list[LeadingEdge]:
        known: list[LeadingEdge] = []
        unknown: list[Address] = []
        for edge in edges:
            heed()
            branch = self._question.blueprint[edge.branch]
            written = _written(branch, edge.operation)
            if written is None:
                unknown.append(edge)
            else:
                target = _state_with(branch, edge.state, written)
                known += self._leading(edge, target, "as it does elsewhere in the blueprint")
        found = self._good(known, NONE)
        if found or self._trial is None:
            return found
        tried: list[LeadingEdge] = []
        for edge, prediction in self._trial(unknown[:MOST_TRIED]):
            target = _foreseen_target(self._question, edge, prediction)
            tried += self._leading(edge, target, "as the simulated world shows")
        return self._good(tried, AGREES)

    def _leading(self, edge: Address, target: str, why: str) -> Iterator[LeadingEdge]:
        """Yield an edge if a way leads on from its target."""
        question = self._question
        if target and target != edge.state:
            cost = question.cost_from({**question.configuration, edge.branch: target})
            if cost is not None:
                unlike = _unlike(question.blueprint[edge.branch], edge)
                yield LeadingEdge(unlike, cost, edge, target, why)

    def _good(self, edges: Sequence[LeadingEdge], also: str) -> list[LeadingEdge]:
        """Return the first edges of which the forecast agrees, or says what ``also`` says."""
        found: list[LeadingEdge] = []
        for one in sorted(edges)[:MOST_FORESEEN]:
            if self._foresee(one.edge, one.target).verdict in (AGREES, also):
                found.append(one)
                if len(found) == MOST_SHOWN:
                    break
        return found


def _unlike(branch: StateBranch, edge: Address) -> tuple[int, int]:
    """Return in how many facts the nearest states differ that have an operation of this name, and
    the number of these states, below zero: the more, the more likely is the operation here.
    """
    here = branch.facts(edge.state)
    others = (branch.facts(state) for state, row in branch.table.items() if edge.operation in row)
    counts = Counter(sum(a != b for a, b in zip(here, one, strict=True)) for one in others)
    nearest = min(counts, default=branch.num_facts)
    return nearest, -counts[nearest]


def _written(branch: StateBranch, name: str) -> dict[int, str] | None:
    """Return the values that all operations of a name write, None if that is not known: there is
    none, or they differ."""
    rows: list[tuple[tuple[str, ...], tuple[str, ...]]] = []
    for state, row in branch.table.items():
        if row.get(name) in branch.table:
            rows.append((branch.facts(state), branch.facts(row[name])))
    changed = {n for before, after in rows for n, v in enumerate(after) if before[n] != v}
    values = {n: {after[n] for _, after in rows} for n in changed}
    if not changed or any(len(own) > 1 for own in values.values()):
        return None
    return {n: min(own) for n, own in values.items()}


def _state_with(branch: StateBranch, state: str, written: Mapping[int, str]) -> str:
    """Return the state that a state becomes if facts are written. Empty if there is none, or
    several."""
    facts = list(branch.facts(state))
    for digit, value in written.items():
        facts[digit] = value
    found = [name for name in branch.table if branch.facts(name) == tuple(facts)]
    return found[0] if len(found) == 1 else ""


def _foreseen_target(question: WayQuestion, edge: Address, prediction: Prediction) -> str:
    """Return the state to which an operation led when it was tried. Empty if there is none."""
    branch = question.blueprint[edge.branch]
    written: dict[int, str] = {}
    for key, value in prediction.after.items():
        name, _, digit = key.rpartition("/")
        if value is None or (
            name != str(Address(edge.branch)) and value != question.facts.get(key)
        ):
            return ""
        if name == str(Address(edge.branch)):
            written[int(digit)] = value
    return _state_with(branch, edge.state, written)
