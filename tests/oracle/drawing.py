"""The meaning of a blueprint, read from its plain JSON by docs/language.md alone.

The oracle shares no code with the program, so that a mistake in the program's reader is not
repeated here. Facts are written ``SB/digit``, states ``SB/State``, edges ``SB/State/Operation``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

Json = Any
DEFAULT_COST = 1.0


class Branch:
    """One SB: its states with their facts, its edges, its sub-SBs by digit."""

    def __init__(self, name: str, values: Mapping[str, Json]) -> None:
        self.name = name
        header = values.get("HEADER", {})
        self.states = {
            state: {op: target for op, target in table.items() if not op.startswith("_")}
            for state, table in values.items()
            if state != "HEADER" and not state.startswith("_")
        }
        names = list(self.states)
        self.initial: str = header.get("INITIAL") or names[0]
        self.activating: str = header.get("ACTIVATING") or names[-1]
        self.subs: dict[int, str] = {d: sub for sub, d in header.get("SUB_SBS", {}).items()}
        self.facts = _facts(names, header.get("NUM_FACTS"))
        self.width = len(self.facts[names[0]])
        self._notes: Mapping[str, Json] = values.get("_operations", {})
        self._fact_notes: Mapping[str, Json] = values.get("_facts", {})
        self.on = {digit: self._on_value(digit) for digit in self.subs}
        self.edges = {
            f"{name}/{state}/{op}": (state, target)
            for state, table in self.states.items()
            for op, target in table.items()
        }
        self.leaves = [digit for digit in range(self.width) if digit not in self.subs]
        self._said: dict[str, Mapping[str, Json]] = {}

    def _on_value(self, digit: int) -> str:
        """Clause 1: what ``_facts`` says; else 1 where values lie in {0, 1}; else ACTIVATING's."""
        note = self._fact_notes.get(str(digit), {})
        if note.get("on") is not None:
            return str(note["on"])
        values = {facts[digit] for facts in self.facts.values()}
        return "1" if values <= {"0", "1"} else self.facts[self.activating][digit]

    def is_on(self, state: str, digit: int) -> bool:
        """Whether a digit that a sub-SB expands is on in a state."""
        return self.facts[state][digit] == self.on[digit]

    def note(self, edge: str) -> Mapping[str, Json]:
        """What ``_operations`` says of an edge: its own words win over those of its name."""
        found = self._said.get(edge)
        if found is None:
            state, operation = edge.split("/")[1:]
            own = self._notes.get(f"{state}/{operation}", {})
            found = self._said[edge] = {**self._notes.get(operation, {}), **own}
        return found

    def fact_note(self, digit: int) -> Mapping[str, Json]:
        """What ``_facts`` says of a digit."""
        found: Mapping[str, Json] = self._fact_notes.get(str(digit), {})
        return found

    def fails(self, state: str) -> bool:
        """Whether a fact of the state has a value that is declared a failure."""
        return any(
            value in (self.fact_note(digit).get("failure") or ())
            for digit, value in enumerate(self.facts[state])
        )


class Drawing:
    """A whole blueprint: SBs by name, who expands whom, and what is said before a run."""

    def __init__(self, values: Mapping[str, Json], levels: Mapping[str, str]) -> None:
        self.branches = {
            name: Branch(name, branch) for name, branch in values.items() if name[0] != "_"
        }
        self.hazards = {one["name"]: dict(one["facts"]) for one in values.get("_hazards", ())}
        """The facts of each hazard, by its name."""
        self.bases: dict[str, list[tuple[str, int]]] = {name: [] for name in self.branches}
        for branch in self.branches.values():
            for digit, sub in branch.subs.items():
                self.bases[sub].append((branch.name, digit))
        self.roots = [name for name, bases in self.bases.items() if not bases]
        self._levels = {**values.get("_levels", {}), **levels}
        self.leaves = [
            f"{name}/{digit}" for name, branch in self.branches.items() for digit in branch.leaves
        ]
        self.critical = {fact for fact in self.leaves if self.fact_note(fact).get("critical")}
        self.edges = {
            edge: ends for branch in self.branches.values() for edge, ends in branch.edges.items()
        }
        self.peopled = (
            any(level != "automatic" for level in self._levels.values())
            or any(self.fact_level(fact) != "automatic" for fact in self.leaves)
            or any(
                self.level(edge) != "automatic" or self.note(edge).get("confirm")
                for edge in self.edges
            )
        )
        """Whether people are asked anything in a run."""
        self.can_fail = any(
            branch.fails(state) for branch in self.branches.values() for state in branch.states
        )
        """Whether some state holds a value that is declared a failure."""
        self.trees = {name: tuple(self._below(name)) for name in self.branches}

    def _below(self, name: str) -> Iterator[str]:
        found = [name]
        for one in found:
            found += [sub for sub in self.branches[one].subs.values() if sub not in found]
        return iter(found)

    def fact_note(self, fact: str) -> Mapping[str, Json]:
        name, digit = fact.rsplit("/", 1)
        return self.branches[name].fact_note(int(digit))

    def note(self, edge: str) -> Mapping[str, Json]:
        return self.branches[edge.split("/", 1)[0]].note(edge)

    def value(self, state: str, name: str, digit: int) -> str:
        """The value that a state of an SB has at a digit."""
        return self.branches[name].facts[state][digit]

    def alphabet(self, fact: str) -> list[str]:
        """The values that the states of an SB have at a digit."""
        name, digit = fact.rsplit("/", 1)
        return sorted({facts[int(digit)] for facts in self.branches[name].facts.values()})

    def level(self, edge: str) -> str:
        """Who carries an edge out: human, shared or automatic."""
        name, _, operation = edge.split("/")
        said = self._levels.get(edge) or self._levels.get(f"{name}/{operation}")
        actor = {"human": "human", "shared": "shared"}.get(self.note(edge).get("actor", ""))
        return str(said or actor or "automatic")

    def fact_level(self, fact: str) -> str:
        """Who senses a fact."""
        declared = "human" if self.fact_note(fact).get("aggregation") == "human" else "automatic"
        return str(self._levels.get(fact) or declared)

    @property
    def supervision(self) -> str:
        return str(self._levels.get("supervision", "shared"))

    def changed_subs(self, edge: str) -> tuple[list[int], list[int]]:
        """The digits with a sub-SB that an edge lets fall and rise, each in order of digit."""
        branch = self.branches[edge.split("/", 1)[0]]
        source, target = self.edges[edge]
        changed = [
            digit
            for digit in sorted(branch.subs)
            if branch.facts[source][digit] != branch.facts[target][digit]
        ]
        falls = [digit for digit in changed if branch.is_on(source, digit)]
        return falls, [digit for digit in changed if digit not in falls]

    def changes_leaf(self, edge: str) -> bool:
        """Whether an edge changes a digit that no sub-SB expands."""
        branch = self.branches[edge.split("/", 1)[0]]
        source, target = self.edges[edge]
        return any(branch.facts[source][d] != branch.facts[target][d] for d in branch.leaves)

    def kind(self, edge: str) -> str:
        """Clause 2: pure, rise, fall or mixed; ``load`` where the function brings subs about."""
        falls, rises = self.changed_subs(edge)
        if not falls and not rises:
            return "pure"
        if self.note(edge).get("subs") == "load":
            return "load"
        if len(falls) + len(rises) > 1 or self.changes_leaf(edge):
            return "mixed"
        return "rise" if rises else "fall"

    def is_crossing(self, edge: str) -> bool:
        """Clause 6: whether an edge of a sub-SB enters or leaves its ACTIVATING state."""
        name = edge.split("/", 1)[0]
        source, target = self.edges[edge]
        active = self.branches[name].activating
        return bool(self.bases[name]) and (source == active) != (target == active)


def _facts(names: list[str], count: int | None) -> dict[str, tuple[str, ...]]:
    """The fact string of each state, cut into its digits (docs/language.md, Facts)."""
    strings = {name: _fact_string(name, count) for name in names}
    lengths = {len(text) for text in strings.values()}
    if len(lengths) != 1:
        return {name: (name,) for name in names}
    (length,) = lengths
    width = length // count if count else 1
    return {
        name: tuple(text[at : at + width] for at in range(0, length, width))
        for name, text in strings.items()
    }


def _fact_string(name: str, count: int | None) -> str:
    for prefix in ("State_", "State"):
        if name.startswith(prefix):
            return name.removeprefix(prefix)
    if "_" in name:
        return name.rsplit("_", 1)[1]
    return name[-count:] if count else name
