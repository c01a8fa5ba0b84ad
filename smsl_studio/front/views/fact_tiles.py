"""The facts of a run as tiles: what each value means, and where a fact is between two values."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from smsl_studio.blueprint.check import FactKey
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.fact_rows import FactRow

UNKNOWN = "unknown"


@dataclass(frozen=True, slots=True)
class FactTile:
    """One fact of one SB.

    ``group`` is the name of the SB if there are several. ``value`` is the sensed value, or the
    believed one if nobody senses the fact; None if it is unknown. ``target`` is the value that the
    running operation expects, and empty if it changes nothing here. ``values`` are all values of
    the fact in the states. ``meaning`` and ``words`` say what the value means, and what is to be
    known about it besides. ``quality`` is that of its ``FactRow``.
    """

    key: FactKey
    name: str
    group: str
    value: str | None
    target: str
    values: tuple[str, ...]
    meaning: str
    words: str
    quality: str

    @property
    def shown(self) -> str:
        """The value as it is shown; ``?`` if it is unknown."""
        return "?" if self.value is None else self.value

    @property
    def said(self) -> str:
        """The whole tile in one line, for a screen reader and the tooltip."""
        group = f"{self.group} " if self.group else ""
        value = self.value if self.value is not None else UNKNOWN
        meaning = f" ({self.meaning})" if self.meaning else ""
        return f"{group}{self.name}: {value}{meaning}" + (f", {self.words}" if self.words else "")


def fact_tiles(blueprint: Blueprint, rows: Sequence[FactRow]) -> tuple[FactTile, ...]:
    """Return a tile for every row of ``fact_rows`` that is a fact."""
    several = len(blueprint) > 1
    return tuple(_tile(blueprint, row, row.key, several) for row in rows if row.key is not None)


def value_words(blueprint: Blueprint, key: FactKey, value: str) -> str:
    """Return a value with its meaning, such as ``fixed (1)``; the value alone if it has none."""
    note = blueprint[key[0]].fact_note(key[1])
    meaning = note.values.get(value, "") if note is not None else ""
    return f"{meaning} ({value})" if meaning else value


def _tile(blueprint: Blueprint, row: FactRow, key: FactKey, several: bool) -> FactTile:
    branch, digit = blueprint[key[0]], key[1]
    note = branch.fact_note(digit)
    value = row.believed if row.sensed == "" else row.sensed
    meaning = note.values.get(value or "", "") if note is not None else ""
    words = "" if row.words == row.quality else row.words
    if row.quality == "transit":
        words = f"moving to {value_words(blueprint, key, row.expected)}"
    elif row.quality == "differs":
        words = f"the run believes {value_words(blueprint, key, row.believed)}"
    return FactTile(
        key=key,
        name=row.name,
        group=branch.name if several else "",
        value=value,
        target=row.expected,
        values=branch.alphabet[digit],
        meaning=meaning,
        words=words,
        quality=row.quality,
    )
