"""Random blueprints of one to three levels, as plain values."""

from __future__ import annotations

from itertools import product
from random import Random
from typing import Any

from tests.oracle.drawing import Drawing
from tests.oracle.standing import all_configurations, start_of

Json = Any

SHAPES: tuple[dict[str, dict[str, int]], ...] = (
    {"A": {}},
    {"A": {}},
    {"A": {"B": 1}, "B": {}},
    {"B": {"A": 0}, "A": {}},
    {"A": {"B": 0, "C": 1}, "B": {}, "C": {}},
    {"A": {"B": 1}, "B": {"C": 0}, "C": {}},
    {"A": {"B": 0}, "D": {"B": 1}, "B": {}},
    {"A": {"B": 0, "D": 1}, "D": {"C": 0}, "B": {"C": 1}, "C": {}},
    {"A": {"B": 0}, "B": {}, "D": {}},
)
"""Who expands which digit of whom: one to three levels, shared subs, several roots."""

FORMS = ("State_", "State", "x_", "S")
STOPS = ("hold", "hold", "abort", "finish")


class RandomBlueprint:
    """A blueprint that hangs together: bases and subs can agree, most goals can be reached.

    ``quiet``: nothing in it is critical; ``peopled``: people act, confirm and sense. ``values`` is
    the JSON, ``places`` are all configurations in which bases and subs agree.
    """

    def __init__(self, random: Random, *, quiet: bool, peopled: bool, subs: dict[str, Any]) -> None:
        self.random, self.quiet, self.peopled, self.subs = random, quiet, peopled, subs
        self.values: dict[str, Json] = {}
        self.names: dict[str, list[str]] = {}
        self.alphabets: dict[str, list[list[str]]] = {}
        self._facts: dict[str, list[tuple[str, ...]]] = {}
        for name in subs:
            self._states(name)
        for name in subs:
            self.values[name] = self._branch(name)
        self.edges = [
            f"{name}/{state}/{op}"
            for name, branch in self.values.items()
            for state in self.names[name]
            for op in branch[state]
        ]
        self.leaves = [
            f"{name}/{digit}"
            for name in subs
            for digit in range(len(self.alphabets[name]))
            if digit not in subs[name].values()
        ]
        for fact in self.leaves:
            self._fact_note(fact)
        drawing = Drawing(self.values, {})
        required = {fact for edge in self.edges for fact in drawing.note(edge).get("requires", ())}
        self.watched = sorted((required | drawing.critical) & set(self.leaves))
        """The leaf facts that something rests on: critical ones, and those that are required."""
        self.places = all_configurations(drawing)
        if self.chance(0.9) and isinstance(start_of(drawing, {}), str):
            self._agree(drawing)

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    @property
    def roots(self) -> list[str]:
        below = {sub for own in self.subs.values() for sub in own}
        return [name for name in self.subs if name not in below]

    def distance(self, one: dict[str, str], other: dict[str, str]) -> int:
        """In how many digits two configurations differ."""
        return sum(self._distance(name, one[name], other[name]) for name in one)

    def _states(self, name: str) -> None:
        own = self.subs[name].values()
        least = max([digit + 1 for digit in own], default=2 if self.chance(0.7) else 1)
        width = self.random.randint(least, max(least, 4 if len(self.subs) < 2 else 3))
        wide = self.chance(0.1)
        self.alphabets[name] = []
        for digit in range(width):
            letters = "01"
            if digit not in own and self.chance(0.25):
                letters = self.random.choice(["012", "ab", "xyz"])
            if digit in own and self.chance(0.1):
                letters = "ab"
            self.alphabets[name].append([letter + "9" * wide for letter in letters])
        every = list(product(*self.alphabets[name]))
        kept = [one for one in every if self.chance(0.9)]
        kept = kept if len(kept) > 1 else every
        while len(kept) > (16 if len(self.subs) < 3 else 9):
            kept.remove(self.random.choice(kept))
        self._facts[name] = kept
        form = self.random.choice(FORMS[:-1] if wide else FORMS)
        self.names[name] = [form + "".join(one) for one in kept]

    def _branch(self, name: str) -> Json:
        states, values = self.names[name], self._facts[name]
        random = self.random
        initial = states[0] if self.chance(0.7) else random.choice(states)
        others = [one for one in states if one != initial]
        activating = max(
            random.choices(others, k=random.choice([1, 8])),
            key=lambda one: self._distance(name, initial, one),
        )
        if self.chance(0.01):
            activating = initial
        header = {
            "INITIAL": initial,
            "ACTIVATING": activating,
            "NUM_FACTS": len(self.alphabets[name]),
            "SUB_SBS": self.subs[name],
        }
        table: dict[str, dict[str, str]] = {state: {} for state in states}
        for state, facts in zip(states, values, strict=True):
            for other, theirs in zip(states, values, strict=True):
                changed = [d for d in range(len(facts)) if facts[d] != theirs[d]]
                near = len(changed) == 1 and self._is_next(name, changed[0], facts, theirs)
                if near and self.chance(0.8):
                    digit = changed[0]
                    up = theirs[digit] > facts[digit]
                    table[state][f"{'up' if up else 'dn'}{digit}{theirs[digit]}"] = other
                elif len(changed) > 1 and self.chance(0.07):
                    table[state][f"m{random.randrange(4)}"] = other
            if self.chance(0.15):
                table[state]["stay"] = state
            if self.chance(0.1):
                table[state][f"r{random.randrange(3)}"] = random.choice(states)
        table[initial].setdefault("go", random.choice(others))
        names = sorted({op for ops in table.values() for op in ops})
        notes = {op: self._note(name) for op in names}
        for state in states:
            for op in table[state]:
                if self.chance(0.06):
                    notes[f"{state}/{op}"] = {"cost": random.randint(0, 4)}
        facts_note: dict[str, Json] = {}
        for digit in self.subs[name].values():
            if self.alphabets[name][digit][0][0] == "a" and self.chance(0.6):
                facts_note[str(digit)] = {"on": random.choice(self.alphabets[name][digit])}
        return {"HEADER": header, "_operations": notes, "_facts": facts_note, **table}

    def _is_next(
        self, name: str, digit: int, facts: tuple[str, ...], theirs: tuple[str, ...]
    ) -> bool:
        """Whether two values stand side by side in the alphabet of their digit."""
        letters = self.alphabets[name][digit]
        return abs(letters.index(facts[digit]) - letters.index(theirs[digit])) == 1

    def _distance(self, name: str, one: str, other: str) -> int:
        """In how many digits two states of an SB differ."""
        places = [self._facts[name][self.names[name].index(state)] for state in (one, other)]
        return sum(a != b for a, b in zip(*places, strict=True))

    def _agree(self, drawing: Drawing) -> None:
        """Where the INITIAL states do not fit together, take others that do."""
        fitting = [
            one
            for one in self.places
            if all(
                one[name] != drawing.branches[name].activating or not drawing.bases[name]
                for name in self.subs
            )
        ]
        if fitting:
            there = self.random.choice(fitting)
            for name, state in there.items():
                self.values[name]["HEADER"]["INITIAL"] = state

    def _note(self, name: str) -> Json:
        random = self.random
        note: dict[str, Json] = {"timeout": random.choice([0.3, 0.5, 1.0])}
        if self.chance(0.3):
            note["cost"] = random.choice([0, 0.5, 1, 2, 3])
        if self.subs[name] and self.chance(0.12):
            note["subs"] = "load"
        if self.chance(0.18):
            note["requires"] = self._requires()
        if self.chance(0.5):
            note["stop"] = random.choice(STOPS)
        if self.chance(0.1):
            note["resumes"] = False
        if self.chance(0.1):
            note["touches"] = [random.randrange(len(self.alphabets[name]))]
        if self.peopled:
            if self.chance(0.25):
                note["actor"] = random.choice(["human", "shared"])
            if self.chance(0.12):
                note["confirm"] = random.choice([["nurse"], ["nurse", "surgeon"]])
            note["answer_within"] = random.choice([0.3, 1.0])
        return note

    def _requires(self) -> dict[str, str]:
        """One fact of any SB, or two; mostly as it reads in the first state."""
        found: dict[str, str] = {}
        for _ in range(self.random.choice([1, 1, 2])):
            other = self.random.choice(list(self.subs))
            digit = self.random.randrange(len(self.alphabets[other]))
            value = self._facts[other][0][digit]
            if self.chance(0.4):
                value = self.random.choice(self.alphabets[other][digit])
            found[f"{other}/{digit}"] = value
        return found

    def _fact_note(self, fact: str) -> None:
        name, digit = fact.split("/")
        note: dict[str, Json] = {}
        if not self.quiet:
            if self.chance(0.25):
                note["critical"] = True
            if self.chance(0.1):
                note["max_age"] = self.random.choice([0.12, 0.6])
        if self.chance(0.04):
            note["failure"] = [self.random.choice(self.alphabets[name][int(digit)])]
        if self.peopled and self.chance(0.12):
            note["aggregation"] = "human"
            note["answer_within"] = self.random.choice([0.3, 1.0])
            note.pop("critical", None)
        if note:
            self.values[name]["_facts"][digit] = note
