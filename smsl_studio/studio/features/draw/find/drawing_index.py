"""The texts of a drawing that can be found: names, titles, facts, notes, findings, the library."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, chain

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.numbers import numbers_of
from smsl_studio.blueprint.plain_words import told_facts
from smsl_studio.inspection.rules.finding import Finding
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.features.draw.find.haystack import FIELDS, Haystack
from smsl_studio.studio.features.draw.find.hits import DrawnPlace, Hits, TextLines, There, named

ELEMENTS, FACTS_TOO, EVERYTHING = range(3)
"""Scopes: states and operations; facts and notes too; also SBs, hazards, findings, library."""


@dataclass(frozen=True)
class _Part:
    """The lines of one SB by scope. They are kept while the SB is unchanged."""

    branch: StateBranch
    own: TextLines
    elements: tuple[TextLines, ...]
    facts: tuple[TextLines, ...]


class DrawingIndex:
    """The index of one blueprint. What an edit left alone is not read again."""

    def __init__(self) -> None:
        self._blueprint: Blueprint | None = None
        self._parts: dict[str, _Part] = {}
        self._findings: tuple[Finding, ...] = ()
        self._finding_lines: tuple[TextLines, ...] = ()

    def show(self, blueprint: Blueprint) -> None:
        """Index a blueprint."""
        if blueprint is not self._blueprint:
            self._blueprint = blueprint
            self._parts = {branch.name: self._part(branch) for branch in blueprint}

    def show_findings(self, findings: tuple[Finding, ...]) -> None:
        """Index the findings."""
        if findings is not self._findings:
            self._findings = findings
            texts = [f"{one.rule}\t{_one_line(one.message)}" for one in findings]
            self._finding_lines = (
                TextLines("Finding", "", ("rule", "finding"), Haystack(texts),
                          lambda at: findings[at].address),
            )  # fmt: skip

    def find(self, typed: str, scope: int, offered: Sequence[str] = ()) -> Hits:
        """The hits for a typed text. ``offered`` are the operations of the library."""
        return Hits.of_text(self._shelves(scope, offered), typed)

    def _shelves(self, scope: int, offered: Sequence[str]) -> Iterator[TextLines]:
        for part in self._parts.values():
            if scope == EVERYTHING:
                yield part.own
            yield from part.elements
            if scope >= FACTS_TOO:
                yield from part.facts
        if scope == EVERYTHING and self._blueprint is not None:
            yield from named("Hazard", [hazard.name for hazard in self._blueprint.hazards])
            yield from self._finding_lines
            yield from named("Library", offered)

    def _part(self, branch: StateBranch) -> _Part:
        former = self._parts.get(branch.name)
        if former is not None and former.branch is branch:
            return former
        name = Haystack([_one_line(branch.name)])
        own = TextLines("State Branch", branch.name, ("name",), name,
                        lambda _: Address(branch.name))  # fmt: skip
        elements = (_states(branch), _operations(branch))
        noted = (_facts(branch), _notes(branch), *_drawn(branch))
        return _Part(branch, own, elements, noted)


def _states(branch: StateBranch) -> TextLines:
    names, noted, shape = list(branch.table), branch.notes.states, branch.shape
    lines = [_one_line(name) for name in names]
    # Facts that the name does not have are found, too.
    given = shape.width == 0 and not shape.opaque
    if noted or given:
        for at, name in enumerate(names):
            title = _one_line(noted[name].title) if name in noted else ""
            facts = "".join(branch.facts(name)) if given else ""
            lines[at] = f"{lines[at]}\t{title}\t{facts}"

    def number(there: There) -> int:
        """The number of the state at an address."""
        if not isinstance(there, Address) or there.operation:
            return -1
        return numbers_of(branch).of.get(there.state, -1)

    return TextLines("State", branch.name, ("name", "title", "facts"), Haystack(lines),
                     lambda at: Address(branch.name, names[at]), number)  # fmt: skip


def _operations(branch: StateBranch) -> TextLines:
    states, tables = list(branch.table), branch.table.values()
    names = list(chain.from_iterable(tables))
    ends = list(accumulate(map(len, tables)))

    def there(at: int) -> Address:
        """The address of an operation by its number."""
        return Address(branch.name, states[bisect_right(ends, at)], names[at])

    def number(there: There) -> int:
        """The number of the operation at an address."""
        if not isinstance(there, Address) or not there.operation:
            return -1
        own = branch.table.get(there.state, {})
        if there.operation not in own:
            return -1
        last = ends[numbers_of(branch).of[there.state]]
        return last - len(own) + list(own).index(there.operation)

    lines = [_one_line(name) for name in names]
    notes = branch.notes.operations
    if notes:
        for at, name in enumerate(names):
            state = states[bisect_right(ends, at)]
            if note_key(name) in notes or note_key(name, state) in notes:
                lines[at] += FIELDS + _one_line(branch.operation_note(state, name).title)
    fields = ("name", "title")
    return TextLines("Operation", branch.name, fields, Haystack(lines), there, number)


def _facts(branch: StateBranch) -> TextLines:
    digits = range(told_facts(branch) if branch.table else 0)
    lines = []
    for digit in digits:
        note = branch.fact_note(digit)
        parts = [branch.fact_name(digit)]
        if note is not None:
            parts += [", ".join(note.values.values()), ", ".join(note.sensors), note.question]
        lines.append(FIELDS.join(map(_one_line, parts)))
    words = ("name", "meanings", "sensors", "question")
    return TextLines("Fact", branch.name, words, Haystack(lines), lambda at: (branch.name, at))


def _notes(branch: StateBranch) -> TextLines:
    noted = [name for name, note in branch.notes.states.items() if note.note]
    noted = [name for name in noted if name in branch.table]
    lines = [_one_line(branch.notes.states[name].note) for name in noted]
    return TextLines("Description", branch.name, ("description",), Haystack(lines),
                     lambda at: Address(branch.name, noted[at]))  # fmt: skip


def _drawn(branch: StateBranch) -> Iterator[TextLines]:
    """The notes on the drawing and the titles of groups."""
    drawn = branch.drawn
    if drawn.groups:
        titles = Haystack([_one_line(group.title) for group in drawn.groups.values()])
        yield TextLines("Group", branch.name, ("title",), titles, *_keyed(branch, "group"))
    if drawn.notes:
        texts = [
            FIELDS.join(map(_one_line, (note.text, note.author))) for note in drawn.notes.values()
        ]
        fields = ("note", "author")
        yield TextLines("Note", branch.name, fields, Haystack(texts), *_keyed(branch, "note"))


def _keyed(branch: StateBranch, kind: str) -> tuple[Callable[[int], There], Callable[[There], int]]:
    """Where the note or group of a number is, and the number of what is at a place."""
    keys = list(branch.drawn.notes if kind == "note" else branch.drawn.groups)
    numbers = {DrawnPlace(branch.name, DrawnKey(kind, key)): at for at, key in enumerate(keys)}

    def number(there: There) -> int:
        """The number of the note or group at a place, -1 if there is none."""
        return numbers.get(there, -1) if isinstance(there, DrawnPlace) else -1

    return list(numbers).__getitem__, number


def _one_line(text: str) -> str:
    """A text that is one field of one line."""
    return text.replace("\n", " ").replace(FIELDS, " ")
