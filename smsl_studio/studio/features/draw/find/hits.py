"""Hits: what a search in the drawing finds, in the order of the drawing."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Protocol

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.features.draw.find.haystack import FIELDS, Haystack

MOST = 20_000
"""At most this many hits are counted."""
MOST_MARKED = 2_000
"""If more operations of one SB than this are found, they get no sign on the canvas."""


@dataclass(frozen=True)
class DrawnPlace:
    """Where a note or a group is: its SB and its key."""

    branch: str
    key: DrawnKey


There = Address | DrawnPlace | tuple[str, int] | str
"""Where something is: an address, a note or group, a fact as (SB, digit), or the name of a hazard
or an operation of the library."""


@dataclass(frozen=True)
class Occurrence:
    """One hit: where it is, and the text of which field holds the part from ``start`` to ``end``.

    ``kind`` is State, Operation, State Branch, Fact, Note, Group, Hazard, Finding or Library.
    ``field`` is the word for the text, such as "title".
    """

    kind: str
    there: There
    field: str
    text: str
    start: int
    end: int


class Lines(Protocol):
    """Things of one kind that a search can find, by number."""

    @property
    def branch(self) -> str:
        """The SB that they are in; empty for the whole file."""

    @property
    def kind(self) -> str:
        """The kind of the things, see ``Occurrence``."""

    def there(self, line: int) -> There:
        """Where the thing of this number is."""

    def number(self, there: There) -> int:
        """The number of the thing at a place, -1 if there is none."""

    def hit(self, line: int, start: int, end: int) -> Occurrence:
        """The hit in the thing of this number."""


@dataclass(frozen=True)
class TextLines:
    """Things with texts: ``fields`` has the words for the texts of one thing, in their order."""

    kind: str
    branch: str
    fields: tuple[str, ...]
    haystack: Haystack
    there: Callable[[int], There]
    index: Callable[[There], int] | None = None
    """The number of the thing at a place, for kinds of which there may be many."""

    def number(self, there: There) -> int:
        """The number of the thing at a place, -1 if there is none."""
        if self.index is not None:
            return self.index(there)
        numbers = (at for at in range(len(self.haystack)) if self.there(at) == there)
        return next(numbers, -1)

    def hit(self, line: int, start: int, end: int) -> Occurrence:
        """The hit in the field that holds the part from ``start`` on."""
        text = self.haystack.line(line)
        before = text[:start].rpartition(FIELDS)[0]
        left = len(before) + 1 if FIELDS in text[:start] else 0
        field = self.fields[text.count(FIELDS, 0, start)]
        shown = text[left:].partition(FIELDS)[0]
        return Occurrence(self.kind, self.there(line), field, shown, start - left, end - left)


@dataclass(frozen=True)
class StateLines:
    """States that were chosen by their facts; ``words`` says why, such as "Disk 2 is b"."""

    branch: str
    states: tuple[str, ...]
    words: str
    kind: str = "State"

    def there(self, line: int) -> Address:
        """The address of the state."""
        return Address(self.branch, self.states[line])

    def number(self, there: There) -> int:
        """The number of the state at an address, -1 if it was not chosen."""
        state = there.state if isinstance(there, Address) and not there.operation else ""
        return self.states.index(state) if state in self.states else -1

    def hit(self, line: int, start: int, end: int) -> Occurrence:
        """The state, with the words of the filter."""
        return Occurrence(self.kind, self.there(line), "facts", self.words, 0, len(self.words))


LinePart = tuple[int, int, int]
"""The number of a thing, and from where to where its line holds the typed text."""


@dataclass(frozen=True)
class _Run:
    """The hits in things of one kind. ``first`` is the number of the first of them."""

    lines: Lines
    first: int
    found: list[LinePart]


class Hits:
    """The hits of one search. ``more`` says that there are more than were counted."""

    def __init__(self, searched: Iterable[tuple[Lines, Iterable[LinePart]]] = ()) -> None:
        self._runs: list[_Run] = []
        self._count, self.more = 0, False
        for lines, found in searched:
            first = list(islice(found, MOST + 1 - self._count))
            self.more = self._count + len(first) > MOST
            kept = first[: MOST - self._count]
            if kept:
                self._runs.append(_Run(lines, self._count, kept))
                self._count += len(kept)
            if self.more:
                break

    @classmethod
    def of_text(cls, searched: Iterable[TextLines], typed: str) -> Hits:
        """The lines that hold the typed text."""
        return cls((lines, lines.haystack.holding(typed)) for lines in searched)

    @classmethod
    def of_states(cls, searched: Iterable[StateLines]) -> Hits:
        """All of these states."""
        return cls((lines, ((at, 0, 0) for at in range(len(lines.states)))) for lines in searched)

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, at: int) -> Occurrence:
        run = self._run(at)
        return run.lines.hit(*run.found[at - run.first])

    def branch(self, at: int) -> str:
        """The SB of a hit; empty for a hit of the whole file."""
        return self._run(at).lines.branch

    def in_branch(self, branch: str) -> tuple[Address, ...]:
        """The elements of an SB that were found, without operations if these are too many."""
        places: dict[There, None] = {}
        for run in self._runs:
            many = len(run.found) > MOST_MARKED and run.lines.kind == "Operation"
            if run.lines.branch == branch and not many:
                places.update((run.lines.there(one[0]), None) for one in run.found)
        return tuple(at for at in places if isinstance(at, Address) and at.state)

    def drawn_in(self, branch: str) -> frozenset[DrawnKey]:
        """The notes and groups of an SB that were found."""
        places = (
            run.lines.there(one[0])
            for run in self._runs
            if run.lines.branch == branch and run.lines.kind in ("Note", "Group")
            for one in run.found
        )
        return frozenset(at.key for at in places if isinstance(at, DrawnPlace))

    def place(self, there: There) -> int | None:
        """The number of the first hit at a place, None if there is none."""
        home = there.branch if isinstance(there, Address | DrawnPlace) else ""
        for run in self._runs:
            if not home or run.lines.branch in ("", home):
                at = run.lines.number(there)
                found = bisect_left(run.found, (at, -1, -1)) if at >= 0 else len(run.found)
                if found < len(run.found) and run.found[found][0] == at:
                    return run.first + found
        return None

    def first_in(self, branch: str) -> int | None:
        """The number of the first hit in an SB, None if there is none."""
        return next((run.first for run in self._runs if run.lines.branch == branch), None)

    def _run(self, at: int) -> _Run:
        return self._runs[bisect_right(self._runs, at, key=lambda run: run.first) - 1]


def named(kind: str, names: Sequence[str], texts: Sequence[str] = ()) -> Iterator[TextLines]:
    """Things of the whole file by name; nothing if there are none."""
    if names:
        yield TextLines(kind, "", ("name",), Haystack(texts or names), lambda at: names[at])
