"""The base of the forms for annotations: lines for the keys of entries, one edit a change."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.lines.line import FormLine, Sentence, ShownValue
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.frame import Panel

LineT = TypeVar("LineT", bound=FormLine)


@dataclass(frozen=True)
class NoteEntry:
    """An entry of a table of annotations (``_states``, ``_operations``, ``_facts``), written or
    not.

    ``note`` is the parsed entry, ``standard`` the values that hold for keys that are not written.
    The keys in ``inherited`` take their standard from ``origin``, the others from the defaults.
    ``misfits`` holds the keys whose value cannot be read, with the reason.
    """

    branch: str
    key: str
    note: Any
    standard: Any
    written: frozenset[str] = frozenset()
    origin: str = ""
    inherited: frozenset[str] = frozenset()
    misfits: Mapping[str, str] = field(default_factory=dict)

    def shown(self, word: str) -> ShownValue:
        """The content of a key's line: the written value, the value that holds otherwise, and
        its origin."""
        written = getattr(self.note, word) if word in self.written else None
        origin = self.origin if word in self.inherited else ""
        return ShownValue(written, getattr(self.standard, word), origin)


class NoteForm(Panel):
    """A panel with a line for each key of the entries in ``table``.

    Several entries are edited together.
    """

    def __init__(
        self, name: str, table: str, session: Session, parent: QWidget | None = None
    ) -> None:
        super().__init__(name, parent)
        self._session, self._table = session, table
        self._lines: dict[str, FormLine] = {}
        self._entries: tuple[NoteEntry, ...] = ()
        self.odd = Sentence("hint")
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)

    def add(self, word: str, line: LineT) -> LineT:
        """Add the line of a key."""
        line.given.connect(lambda value: self.give(word, value))
        self._lines[word] = line
        self.column.addWidget(line)
        return line

    def line(self, word: str) -> FormLine:
        """The line of a key."""
        return self._lines[word]

    def unknown(self, misfits: Mapping[str, str]) -> dict[str, str]:
        """The misfits for which this form has no line."""
        return {word: reason for word, reason in misfits.items() if word not in self._lines}

    def who(self) -> str:
        """What the form edits, in the words of an undo step. Subclasses implement it."""
        raise NotImplementedError

    def show_entries(self, entries: Sequence[NoteEntry]) -> None:
        """Show these entries in all lines."""
        self._entries = tuple(entries)
        # Thousands of edges with one name share one note; look at it once.
        few = list({(id(e.note), id(e.standard)): e for e in entries}.values())
        for word, line in self._lines.items():
            line.show_values(_each([entry.shown(word) for entry in few]))
            odd = next((e.misfits[word] for e in entries if word in e.misfits), "")
            if odd:
                line.refuse(
                    f"What is written does not fit: {odd}. It is kept until you replace it."
                )

        lost = self.unknown({k: v for e in entries for k, v in e.misfits.items()})
        words = "; ".join(f"{w} ({r})" if w != r else r for w, r in list(lost.items())[:4])
        self.odd.say(f"Not understood, and kept: {words}." if words else "")

    def give(self, word: str, value: Any) -> bool:
        """Write the value of a key in all entries, as one step. A default is removed instead.

        Returns whether the edit was made.
        """
        line = self._lines[word]
        write: Mapping[str, Any] = {word: value}
        leave: Mapping[str, Any] = {word: None}
        changes = {
            (entry.branch, entry.key): leave if _is(value, entry, word) else write
            for entry in self._entries
        }
        what = line.words[:1].lower() + line.words[1:]
        step = f"Clear {what} of {self.who()}"
        if value is not None:
            step = f"Set {what} of {self.who()} to {line.said(value)}"

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the changed annotations."""
            return change_notes(blueprint, self._table, changes)

        return self.edit(short_step(step), change, line.refuse)

    def edit(
        self, step: str, change: Callable[[Blueprint], Blueprint], refuse: Callable[[str], None]
    ) -> bool:
        """Make an edit as one step. ``refuse`` gets the reason for a refusal, or the empty text."""
        return try_edit(self._session, step, change, refuse)


def misfits_of(branch: StateBranch, table: str) -> dict[str, dict[str, str]]:
    """For each entry of a table: the keys whose value cannot be read, with the reason."""
    found: dict[str, dict[str, str]] = {}
    for path, sentence in branch.notes.faults:
        if len(path) == 2 and path[0] == table:
            word, _, reason = sentence.partition(": ")
            found.setdefault(path[1], {})[word.partition(".")[0]] = reason or sentence
    return found


def written_words(branch: StateBranch, table: str, key: str) -> frozenset[str]:
    """The keys that are written in an entry."""
    entries = branch.fields.get(table)
    entry = entries.get(key) if isinstance(entries, dict) else None
    return frozenset(entry) if isinstance(entry, dict) else frozenset()


def _is(value: Any, entry: NoteEntry, word: str) -> bool:
    """Whether a value is the one that holds if nothing is written."""
    standard = getattr(entry.standard, word)
    if isinstance(standard, tuple):
        return bool(value is None or tuple(value) == standard)
    return bool(value is None or value == standard)


def _each(shown: Sequence[ShownValue]) -> list[ShownValue]:
    """The different values in order, at most 9: thousands of edges share a few values."""
    found: list[ShownValue] = []
    for one in shown:
        if one not in found:
            found.append(one)
        if len(found) > 8:
            break
    return found


def short_step(step: str) -> str:
    """The words of a step, cut where they are too long for a row of the history."""
    return step if len(step) <= 120 else f"{step[:119]}…"
