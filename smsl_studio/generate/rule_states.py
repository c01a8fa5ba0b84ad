"""From rules to a State Branch: every state that can be reached from the start, breadth first."""

from __future__ import annotations

import itertools
import json
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import prod
from typing import Any

import numpy as np

from smsl_studio.errors import ReadError
from smsl_studio.generate.rule_circuit import RuleCircuit, bits, every_state
from smsl_studio.generate.rule_file import RuleSet
from smsl_studio.generate.rule_steps import RuleSteps
from smsl_studio.smsl.document.limits import MAX_CHARACTERS, MAX_VALUES
from smsl_studio.stop import heed

Json = Any
MOST_STATES = 1_000_000
"""So many states are followed at most."""
MOST_EDGES = 1_000_000
"""No further states are followed once there are so many operations."""
_STATE, _EDGE, _FACT = 27, 22, 120
"""The characters that a state, an operation and a fact have in a file, beside their names."""
_HEADER = 10_000
"""The characters of everything else: the header with two names, and the origin."""


@dataclass(frozen=True, slots=True)
class RuledBranch:
    """A branch made of rules, as plain values. ``goal_reached`` says whether the goal is one of its
    states; without a goal it is true. ``whole`` is false if the search has stopped at its limit.
    ``facts`` are the names of the facts."""

    values: dict[str, Json]
    states: int
    operations: int
    goal_reached: bool
    whole: bool = True
    facts: tuple[str, ...] = ()


def ruled_branch(rules: RuleSet, limit: int = MOST_STATES) -> RuledBranch:
    """Return the branch of some rules. Operations stand in the order of the rules.

    If there are more than ``limit`` states or ``MOST_EDGES`` operations, or more than a file can
    hold, the first states are returned, and the operations between them. ReadError if the start
    is one of the states that are left out.
    """
    steps = RuleSteps(rules)
    first = steps.packed(rules.start)
    if steps.left_out(first):
        raise ReadError("the start is a state that 'never' leaves out", rules.start_at)
    found = _searched(steps, first, limit)
    found = found.within_text(rules)
    names = [f"State_{values}" for values in steps.names(found.keys)]
    table = dict(zip(names, found.rows(names), strict=True))
    goal = None if rules.goal is None else f"State_{''.join(rules.goal)}"
    header: dict[str, Json] = {"INITIAL": names[0]}
    if goal in table:
        header["ACTIVATING"] = goal
    header |= {"NUM_FACTS": len(rules.facts), "NUM_STATES": len(table)}
    values_of = {rules.branch: {"HEADER": header, **table}}
    reached = goal is None or goal in table
    edges = len(found.operations)
    return RuledBranch(values_of, len(table), edges, reached, found.whole, tuple(rules.facts))


@dataclass(slots=True)
class _StatesFound:
    """Packed states in the order in which they are found, and the operations of all states, one
    state after the other. ``targets`` are numbers of states, ``ends`` has the number of all
    operations up to the end of each state."""

    keys: list[bytes]
    ends: list[int] = field(default_factory=list)
    operations: list[str] = field(default_factory=list)
    targets: list[int] = field(default_factory=list)
    whole: bool = True

    def rows(self, names: list[str]) -> Iterator[dict[str, str]]:
        """Give the operations of each state with the names of their targets."""
        targets = list(map(names.__getitem__, self.targets))
        begin = 0
        for end in self.ends:
            yield dict(zip(self.operations[begin:end], targets[begin:end], strict=True))
            begin = end

    def within_text(self, rules: RuleSet) -> _StatesFound:
        """Return the first states that one file can hold: so many characters, names and values."""
        wide = len(json.dumps("State_" + "".join(rules.start)))
        sizes = {one.name: len(json.dumps(one.name)) for one in rules.operations}
        edges = np.fromiter((sizes[name] for name in self.operations), np.int64) + wide + _EDGE
        ends = np.concatenate(([0], np.cumsum(edges)))[self.ends]
        values = 20 + 2 * len(rules.facts)
        room = MAX_CHARACTERS - _HEADER - 2 * wide
        room -= sum(len(json.dumps(name)) + _FACT for name in rules.facts)
        numbers = np.arange(1, len(self.ends) + 1)
        kept = min(
            int(np.searchsorted(ends + numbers * (wide + _STATE), room, side="right")),
            int(np.searchsorted(np.array(self.ends) + numbers, MAX_VALUES - values, side="right")),
        )
        return self if kept >= len(self.keys) else self.within(kept)

    def within(self, limit: int) -> _StatesFound:
        """Return the first states, and the operations between them."""
        found = _StatesFound(self.keys[:limit], whole=False)
        begin = 0
        for end in self.ends[:limit]:
            for at in range(begin, end):
                if self.targets[at] < limit:
                    found.operations.append(self.operations[at])
                    found.targets.append(self.targets[at])
            found.ends.append(len(found.targets))
            begin = end
        return found


def _searched(steps: RuleSteps, first: bytes, limit: int) -> _StatesFound:
    """Follow all operations from the first state on, breadth first, as many states at once as are
    known."""
    # Each key that is asked for the first time gets the next number.
    numbers: defaultdict[bytes, int] = defaultdict(itertools.count().__next__)
    found = _StatesFound([first])
    assert numbers[first] == 0
    while len(found.ends) < min(len(found.keys), limit):
        for part in steps.rows(found.keys[len(found.ends) : limit]):
            heed()
            before = len(found.operations)
            found.operations += part.operations
            found.targets += map(numbers.__getitem__, part.targets)
            found.ends += [before + end for end in part.ends]
            new = len(numbers) - len(found.keys)
            found.keys += [*itertools.islice(reversed(numbers), new)][::-1]
            if len(found.operations) > MOST_EDGES:
                return found.within(min(limit, len(found.ends)))
    return found if len(found.keys) <= limit else found.within(limit)


def left_out(rules: RuleSet, most: int) -> tuple[int, ...] | None:
    """Return how many combinations of values each condition of ``never`` leaves out. None if there
    are more than ``most`` combinations."""
    alphabets = list(rules.facts.values())
    if prod(map(len, alphabets)) > most:
        return None
    circuit = RuleCircuit(rules.facts, [one for _, one in rules.never])
    states = every_state(rules.facts)
    counts = np.zeros(len(rules.never), np.int64)
    for at, holds in circuit.holding(states):
        counts += bits(holds, len(states) - at).sum(axis=1)
    return tuple(counts.tolist())
