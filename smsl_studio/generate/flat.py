"""From a blueprint of several SBs to one SB that behaves alike.

Each configuration that can be reached is a state, and each step an operation. What coupled the SBs
(sub-SBs, ``requires``) is worked into the edges.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from smsl_studio.blueprint.configuration import Hierarchy, standing
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import EditRefused, PlanningError
from smsl_studio.inspection.equivalence.transitions import (
    fact_keys,
    label_of,
    transitions_of,
)
from smsl_studio.inspection.proof.space import Key

Json = Any


class FlatBranch:
    """A blueprint written as one SB with the same behaviour.

    PlanningError if it has more than ``limit`` configurations, RunRefused if it has no start.
    ``values`` raises EditRefused if two operations of one state would get the same name.
    """

    def __init__(self, blueprint: Blueprint, limit: int) -> None:
        found = transitions_of(blueprint, limit)
        if found.bound:
            raise PlanningError(
                f"it was not flattened: it has more than {found.bound}",
                advice="Take a larger --limit, or flatten one SB and what is below it with --sb.",
            )
        self._blueprint, self._found = blueprint, found
        self._hierarchy = Hierarchy(blueprint)
        self._keys = list(found.keys)
        goals = self._goals()
        if not goals:
            # Nothing leads there, so it behaves alike, and the goal is still named.
            goals = [len(self._keys)]
            self._keys.append(self._unreached_goal())
        self._goal, *self._more = goals
        self._names = _names(self._keys)

    @property
    def places(self) -> dict[str, dict[str, str]]:
        """For each state the states of the former SBs."""
        order = self._found.order
        return {
            name: dict(zip(order, key, strict=True))
            for name, key in zip(self._names, self._keys, strict=True)
        }

    def values(self) -> dict[str, Json]:
        """Return the plain values of a file with the one SB."""
        several = len(self._blueprint.branches) > 1
        header = {"INITIAL": self._names[0], "ACTIVATING": self._names[self._goal]}
        table: dict[str, dict[str, str]] = {name: {} for name in self._names}
        for node, steps in enumerate(self._found.steps):
            row = table[self._names[node]]
            for address, target in steps:
                label = label_of(address, several)
                if label in row:
                    raise EditRefused(
                        f"two operations would be called {label} in one state",
                        advice="Rename an SB or an operation, so that SB.operation is one of them.",
                    )
                row[label] = self._names[target]
        noted = {"_facts": self._fact_notes(), "_states": self._state_notes()}
        name = "+".join(self._hierarchy.roots)
        return {name: {"HEADER": header, **noted, **table}}

    def _goals(self) -> list[int]:
        ends = {name: self._blueprint[name].activating for name in self._hierarchy.roots}
        places = [(self._found.order.index(name), state) for name, state in ends.items()]
        return [
            node
            for node, key in enumerate(self._keys)
            if all(key[place] == state for place, state in places)
        ]

    def _unreached_goal(self) -> Key:
        here: dict[str, str] = {}
        for root in self._hierarchy.roots:
            here |= standing(self._hierarchy, root, self._blueprint[root].activating)
        return tuple(here[name] for name in self._found.order)

    def _fact_notes(self) -> dict[str, Json]:
        """Return the notes of all facts, with their keys as names."""
        found: dict[str, Json] = {}
        for number, (key, (name, digit)) in enumerate(fact_keys(self._blueprint).items()):
            written = self._blueprint[name].fields.get("_facts")
            note = written.get(str(digit)) if isinstance(written, Mapping) else None
            own = note if isinstance(note, Mapping) else {}
            found[str(number)] = {**own, "name": key}
        return found

    def _state_notes(self) -> dict[str, Json]:
        keys = fact_keys(self._blueprint).values()
        order = {name: at for at, name in enumerate(self._found.order)}
        further = set(self._more)
        found: dict[str, Json] = {}
        for node, (name, key) in enumerate(zip(self._names, self._keys, strict=True)):
            facts = [self._blueprint[sb].facts(key[order[sb]])[digit] for sb, digit in keys]
            found[name] = {"facts": facts, **({"note": "goal"} if node in further else {})}
        return found


def _names(keys: Sequence[Key]) -> list[str]:
    """Return a name for each configuration: the names of its states, and a number if others have
    the same."""
    found: dict[str, None] = {}
    for key in keys:
        name = joined = "+".join(key)
        number = 1
        while name in found:
            number += 1
            name = f"{joined} {number}"
        found[name] = None
    return list(found)
