"""What the table of facts shows of each fact."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.annotations import FactNote
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.studio.base.chips import values_of

MOST = 200
"""At most this many facts have a line; a name of 10,000 characters may have as many facts."""
MOST_VALUES = 12
PLAIN = FactNote()


@dataclass(frozen=True)
class FactValue:
    """A value of a fact. ``kind`` is on, off or value, as chips are painted."""

    text: str
    meaning: str
    kind: str
    failure: bool


@dataclass(frozen=True)
class TabledFact:
    """One fact. ``name`` is empty if it has none; ``more`` values are not shown."""

    digit: int
    name: str
    values: tuple[FactValue, ...]
    more: int
    critical: bool
    sub: str
    source: str
    told: bool
    """Whether a person says what it is."""
    age: str
    unit: str
    measured: str = ""
    """The sources that decide it, if predicates do."""

    @property
    def words(self) -> str:
        """The line as a screen reader says it."""
        values = [f"{one.text} {one.meaning}".strip() for one in self.values]
        values += [f"and {self.more:,} more"] if self.more else []
        if self.sub:
            source = f"expanded by {self.sub}"
        else:
            source = f"read by {self.source}" if self.source else "no sensor"
            source = f"decided from {self.measured}" if self.measured else source
            source = "a person says it" if self.told and not self.source else source
        name = self.name or f"Fact {self.digit + 1}"
        parts = [name, f"digit {self.digit}", *values, source]
        parts += [f"maximum age {self.age}"] if self.age else []
        parts += [f"unit {self.unit}"] if self.unit else []
        return ", ".join(parts + (["critical"] if self.critical else []))


def fact_lines(branch: StateBranch) -> tuple[TabledFact, ...]:
    """The lines of the facts of an SB, digit 0 first."""
    return tuple(_line(branch, digit) for digit in range(min(told_facts(branch), MOST)))


def _line(branch: StateBranch, digit: int) -> TabledFact:
    note = branch.fact_note(digit) or PLAIN
    sub = branch.subs.get(digit, "")
    texts = values_of(branch, digit)
    two = len(texts) <= 2 and (set(texts) <= {"0", "1"} or note.on is not None or bool(sub))
    on = branch.on_value(digit) if two else note.on
    values = tuple(
        FactValue(
            text,
            note.values.get(text, ""),
            "on" if text == on else "off" if two else "value",
            text in note.failure,
        )
        for text in texts[:MOST_VALUES]
    )
    age = "" if note.max_age is None or sub else f"{note.max_age:g} s"
    return TabledFact(
        digit,
        note.name,
        values,
        len(texts) - len(values),
        note.critical,
        sub,
        ", ".join(note.sensors),
        note.aggregation == "human",
        age,
        note.unit,
        ", ".join(note.sources) if isinstance(note.predicate, dict) else "",
    )
