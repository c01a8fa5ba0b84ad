"""Finds the states of an SB that could be a sub-SB of it (the paper's "SB identification")."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from smsl_studio.blueprint.facts import changed_digits
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.generate.shapes.chosen import ChosenStates, CutRefused
from smsl_studio.generate.shapes.cut import Cut, cuts
from smsl_studio.generate.shapes.extract import alike
from smsl_studio.stop import heed

Json = Any
MOST = 100
"""The largest number of cuts that are listed."""
MOST_LOOKED = 3_000_000
"""The largest number of states that are looked at, over all sets of states."""


@dataclass(frozen=True, eq=False)
class FoundCut:
    """States that can become a sub-SB, with the blueprint in which they are one.

    ``states_saved`` says how many states the base has less, and ``facts_saved`` how many facts.
    """

    cut: Cut
    name: str
    after: Blueprint

    @property
    def branch(self) -> StateBranch:
        """The SB out of which they are cut."""
        return self.cut.chosen.branch

    @property
    def states_saved(self) -> int:
        """The number of states that the base has less."""
        return len(self.cut.chosen.states) - 1

    @property
    def facts_saved(self) -> int:
        """The number of facts that the base has less."""
        return len(self.cut.digits) - 1

    @property
    def fact_names(self) -> tuple[str, ...]:
        """The names of the facts that the sub-SB takes."""
        return tuple(self.branch.fact_name(digit) for digit in self.cut.digits)

    @property
    def why(self) -> str:
        """Why these states belong together, in a sentence."""
        count = len(self.cut.chosen.states)
        states = "1 state is" if count == 1 else f"these {count} states are"
        names = dict.fromkeys(edge.name for edge in self.cut.exits)
        return (
            f"{states} entered at {self.cut.chosen.entry} and left through "
            f"{' and '.join(self.fact_names)}, by {', '.join(names)}"
        )

    def as_json(self) -> dict[str, Json]:
        """Return it as ``identify`` writes it."""
        return {
            "sb": self.branch.name,
            "states": list(self.cut.chosen.states),
            "as": self.name,
            "facts": list(self.fact_names),
            "saves": {"states": self.states_saved, "facts": self.facts_saved},
            "why": self.why,
        }


class Identification(NamedTuple):
    """The cuts that were found, the best first. ``bound`` says in words why others may be
    missing."""

    cuts: tuple[FoundCut, ...]
    bound: str = ""

    def as_json(self) -> dict[str, Json]:
        """Return it as ``identify`` writes it."""
        found: dict[str, Json] = {"cuts": [one.as_json() for one in self.cuts]}
        return {**found, "bound": self.bound} if self.bound else found


def identification(blueprint: Blueprint, limit: int) -> Identification:
    """Return the cuts that save states or facts of a base, the best first; at most 100.

    Each behaves as before (see ``alike``). PlanningError if more than ``limit`` configurations can
    be reached, RunRefused if there is no start.
    """
    search = _Search(blueprint)
    ranked = sorted(
        search.candidates(),
        key=lambda cut: (
            -(len(cut.chosen.states) - 1 + len(cut.digits) - 1),
            -len(cut.exits) - len(cut.chosen.inner),
            cut.chosen.branch.name,
            cut.chosen.states,
        ),
    )
    found: list[FoundCut] = []
    for cut in ranked:
        if len(found) == MOST:
            return Identification(tuple(found), search.bound or f"{MOST} cuts")
        name = _name(blueprint, cut)
        try:
            after, way = next(alike(blueprint, cut.chosen, name, limit))
        except CutRefused:
            continue
        if way.digits == cut.digits and way.on == cut.on:
            found.append(FoundCut(cut, name, after))
    return Identification(tuple(found), search.bound)


class _Search:
    """Looks for sets of states that are entered at one state and left through a fact."""

    def __init__(self, blueprint: Blueprint) -> None:
        self._blueprint = blueprint
        self._left = MOST_LOOKED
        self.bound = ""

    def candidates(self) -> Iterator[Cut]:
        """Yield the best cut of each set that saves something."""
        for branch in self._blueprint:
            if branch.shape.opaque or len(branch.table) < 2:
                continue
            for states, entry in self._sets(branch):
                try:
                    best = cuts(ChosenStates(branch, states))[0]
                except CutRefused:
                    continue
                saved = len(states) - 1 + len(best.digits) - 1
                if best.exits and saved > 0 and best.kept and best.chosen.entry == entry:
                    yield best

    def _sets(self, branch: StateBranch) -> Iterator[tuple[frozenset[str], str]]:
        """Yield each set once, with the state at which it is entered."""
        before: dict[str, set[str]] = {name: set() for name in branch.table}
        for edge in branch.edges():
            if edge.target in before:
                before[edge.target].add(edge.source)
        size = len(branch.table) * branch.num_facts
        for entry in branch.table:
            seen: set[frozenset[str]] = set()
            for states in self._entered_at(branch, entry, before):
                heed()
                if states not in seen:
                    seen.add(states)
                    self._left -= 8 * (size + branch.edge_count)
                    yield states, entry
                if self._left < 0:
                    self.bound = f"{MOST_LOOKED:,} states looked at, over all sets of states"
                    return

    def _entered_at(
        self, branch: StateBranch, entry: str, before: dict[str, set[str]]
    ) -> Iterator[frozenset[str]]:
        """Yield sets of states that are entered at one state only."""
        facts = branch.facts(entry)
        targets = [target for target in branch.table[entry].values() if target in branch.table]
        self._left -= len(targets) + len(facts)
        if any(len(changed_digits(facts, branch.facts(target))) > 1 for target in targets):
            yield frozenset({entry})
        for digit, value in enumerate(facts):
            states, waiting = {entry}, [entry]
            while waiting and self._left >= 0:
                row = branch.table[waiting.pop()]
                self._left -= 1 + len(row)
                for target in row.values():
                    if target not in branch.table or target in states:
                        continue
                    if branch.facts(target)[digit : digit + 1] == (value,):
                        states.add(target)
                        waiting.append(target)
            self._leave_at_one_entry(branch, states, entry, before)
            if len(states) > 1:
                yield frozenset(states)

    def _leave_at_one_entry(
        self, branch: StateBranch, states: set[str], entry: str, before: dict[str, set[str]]
    ) -> None:
        """Take out states until the rest is entered at one state only."""
        waiting = [
            one
            for one in states
            if one != entry and (one == branch.initial or not before[one] <= states)
        ]
        self._left -= 2 * len(states)
        states.difference_update(waiting)
        while waiting:
            heed()
            row = branch.table[waiting.pop()]
            self._left -= 1 + len(row)
            for target in row.values():
                if target != entry and target in states:
                    states.discard(target)
                    waiting.append(target)


def _name(blueprint: Blueprint, cut: Cut) -> str:
    """Return a free name for the sub-SB, made from its first fact with a name."""
    branch = cut.chosen.branch
    named = [note.name for digit in cut.digits if (note := branch.fact_note(digit)) and note.name]
    words = "".join(sign if sign.isalnum() else "_" for sign in (named or [branch.name])[0].upper())
    name, number = words, 1
    while name in blueprint.branches:
        number += 1
        name = f"{words}_{number}"
    return name
