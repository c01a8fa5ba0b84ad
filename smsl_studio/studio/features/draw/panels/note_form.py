"""What the forms of annotations share: lines for the words of entries, and one edit for each."""

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
    """One entry of a table of annotations, written or not.

    ``note`` is what its words mean, ``standard`` what holds for words that are not written; those
    ``inherited`` come from ``origin``, the others are defaults. ``misfits`` are words whose value
    fits no kind, with the reason.
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
        """What a line shows of a word: what is written, what holds otherwise, and where from."""
        written = getattr(self.note, word) if word in self.written else None
        origin = self.origin if word in self.inherited else ""
        return ShownValue(written, getattr(self.standard, word), origin)


class NoteForm(Panel):
    """A panel with lines for words of ``table``; several entries are edited together."""

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
        """A line for a word of the entries."""
        line.given.connect(lambda value: self.give(word, value))
        self._lines[word] = line
        self.column.addWidget(line)
        return line

    def line(self, word: str) -> FormLine:
        """The line of a word."""
        return self._lines[word]

    def unknown(self, misfits: Mapping[str, str]) -> dict[str, str]:
        """Those of the misfits for which this form has no line."""
        return {word: reason for word, reason in misfits.items() if word not in self._lines}

    def who(self) -> str:
        """Whom an edit is about, as its step says; subclasses know."""
        raise NotImplementedError

    def show_entries(self, entries: Sequence[NoteEntry]) -> None:
        """Show these entries in all lines."""
        self._entries = tuple(entries)
        # Thousands of edges of one name share one note, which is looked at once.
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
        """Write a word of all entries as one step; a default is not written."""
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

        return self.edit(_short(step), change, line.refuse)

    def edit(
        self, step: str, change: Callable[[Blueprint], Blueprint], refuse: Callable[[str], None]
    ) -> bool:
        """One step; ``refuse`` says, where it is typed, why it was not taken (or nothing)."""
        return try_edit(self._session, step, change, refuse)


def misfits_of(branch: StateBranch, table: str) -> dict[str, dict[str, str]]:
    """For each entry of a table the words that fit no kind, with the reason."""
    found: dict[str, dict[str, str]] = {}
    for path, sentence in branch.notes.faults:
        if len(path) == 2 and path[0] == table:
            word, _, reason = sentence.partition(": ")
            found.setdefault(path[1], {})[word.partition(".")[0]] = reason or sentence
    return found


def written_words(branch: StateBranch, table: str, key: str) -> frozenset[str]:
    """The words that stand in an entry."""
    entries = branch.fields.get(table)
    entry = entries.get(key) if isinstance(entries, dict) else None
    return frozenset(entry) if isinstance(entry, dict) else frozenset()


def _is(value: Any, entry: NoteEntry, word: str) -> bool:
    """Whether a value is what holds without being written."""
    standard = getattr(entry.standard, word)
    if isinstance(standard, tuple):
        return bool(value is None or tuple(value) == standard)
    return bool(value is None or value == standard)


def _each(shown: Sequence[ShownValue]) -> list[ShownValue]:
    """The different ones, in order: thousands of edges show but a few values."""
    found: list[ShownValue] = []
    for one in shown:
        if one not in found:
            found.append(one)
        if len(found) > 8:
            break
    return found


def _short(step: str) -> str:
    return step if len(step) <= 120 else f"{step[:119]}…"
