"""The operations that the blueprint uses, and what plugins and the user's store offer."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain

from PySide6.QtCore import QMimeData, QModelIndex, Qt
from PySide6.QtGui import QGuiApplication, QResizeEvent
from PySide6.QtWidgets import QLabel, QLineEdit, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.annotations import PLAIN, OperationNote
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.stored_lines import StoredLine
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.studio.base.controls import label, name_parts
from smsl_studio.studio.base.icons import ACTOR_ICON, icon
from smsl_studio.studio.base.rows import LINE, ListRow
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.library_drop import library_data
from smsl_studio.studio.features.draw.canvas.template_drop import TEMPLATES
from smsl_studio.studio.features.draw.panels.frame import Panel
from smsl_studio.studio.features.draw.panels.library_list import LibraryList

MOST = 2_000
"""At most this many operations of the blueprint have a row; the filter finds the others."""
LOW = 200
"""A panel that is lower (pixels) has no room for the hint."""
_COPY = "Press Enter to copy its name, for a binding or an import."
NO_PLUGIN = "No plugin offers operations. Add a plugin folder."


@dataclass(frozen=True)
class LibraryEntry:
    """An operation that a plugin offers: its name or pattern, and the plugin."""

    pattern: str
    plugin: str
    names: tuple[str, ...] = ()
    """The operations of the blueprint whose names match."""


@dataclass(frozen=True)
class TemplateRow:
    """What a row of a template is about."""

    key: str


class Library(Panel):
    """Operations by name: how often each is used, and who acts. Blueprints of the user's store.

    A click selects the edges of one SB. A row can be dragged to the canvas. Enter uses it there,
    as ``use`` (kind, name) does; if that returns False, Enter is as a click. At a blueprint of the
    store Enter copies the name by which a binding or an import calls it.
    """

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Library", parent)
        self._session, self._tokens = session, tokens
        self.use: Callable[[str, str], bool] = lambda kind, name: False
        self._offers: tuple[LibraryEntry, ...] = ()
        self._stored: tuple[StoredLine, ...] = ()
        self._severities: dict[str, str] = {}
        self.tools: QLabel = label("", "small")
        self.tools.setContentsMargins(0, 0, 8, 0)
        self.filter = QLineEdit()
        self.filter.setPlaceholderText("Filter operations")
        self.filter.setAccessibleName("Filter operations")
        self.filter.setClearButtonEnabled(True)
        name_parts(self.filter)
        self._glass = self.filter.addAction(
            icon("search", tokens), QLineEdit.ActionPosition.LeadingPosition
        )
        self._glass.setText("Filter")
        box = QVBoxLayout()
        box.setContentsMargins(12, 10, 12, 8)
        box.addWidget(self.filter)
        self.list = LibraryList(tokens, _dragged, self)
        self.list.setAccessibleName("Operations")
        self.hint: QLabel = label("", "hint")
        self.hint.setContentsMargins(12, 6, 12, 10)
        self.column.addLayout(box)
        self.column.addWidget(self.list, 1)
        self.column.addWidget(self.hint)
        self.filter.textChanged.connect(lambda *_: self._show())
        self.list.clicked.connect(self._clicked)
        self.list.activated.connect(self._activated)
        session.afterwards.follow(self._show, session.blueprint_changed)
        self._show()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._glass.setIcon(icon("search", tokens))
        self.list.set_tokens(tokens)

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Mark the operations that have errors or warnings."""
        marks = _marks(findings)
        if marks != self._severities:
            self._severities = marks
            self._show()

    def set_offers(self, offers: Sequence[LibraryEntry]) -> None:
        """Show what the plugins offer."""
        if tuple(offers) != self._offers:
            self._offers = tuple(offers)
            self._session.afterwards.show(self._show)

    def set_stored(self, lines: Sequence[StoredLine]) -> None:
        """Show what the user's store holds, with the mark of each blueprint."""
        if tuple(lines) != self._stored:
            self._stored = tuple(lines)
            self._session.afterwards.show(self._show)

    @property
    def offered(self) -> tuple[str, ...]:
        """The names or patterns of the operations that plugins offer."""
        return tuple(offer.pattern for offer in self._offers)

    def reveal(self, pattern: str) -> None:
        """Mark the row of an operation that a plugin offers."""
        self.filter.clear()
        rows = self.list.rows.rows
        marked = [at for at, row in enumerate(rows) if row.text == pattern and row.payload is None]
        if marked:
            self.list.setCurrentIndex(self.list.rows.index(marked[-1]))

    def _activated(self, index: QModelIndex) -> None:
        row: ListRow = index.data(Qt.ItemDataRole.UserRole)
        if isinstance(row.payload, StoredLine):
            QGuiApplication.clipboard().setText(row.payload.name)
        elif row.kind == LINE and not self.use(*_offer_of(row)):
            self._clicked(index)

    def _clicked(self, index: QModelIndex) -> None:
        row: ListRow = index.data(Qt.ItemDataRole.UserRole)
        if isinstance(row.payload, str):
            edges = _edges(self._session.blueprint, self._session.branch, row.payload)
            if edges:
                # Selected edges of a hidden SB could be deleted unseen, so show that SB.
                self._session.show_branch(edges[0].branch)
            self._session.select(edges)

    def _show(self) -> None:
        wanted = self.filter.text().strip().casefold()
        blueprint = self._session.blueprint
        used, notes = _used(blueprint), _first_notes(blueprint)
        here = [name for name in sorted(used, key=_by_name) if wanted in name.casefold()]
        rows: list[ListRow] = []
        if here:
            rows.append(ListRow(f"In this blueprint · {len(here):,}", kind="section"))
        rows += [self._row(name, used[name], notes) for name in here[:MOST]]
        if len(here) > MOST:
            rest = f"and {len(here) - MOST:,} more: filter them by a part of their name"
            rows.append(ListRow(rest, kind="section"))
        offers = [o for o in self._offers if wanted in o.pattern.casefold()]
        if offers:
            of = f" of {len(self._offers)}" if len(offers) < len(self._offers) else ""
            rows.append(ListRow(f"From plugins · {len(offers)}{of}", kind="section"))
        rows += [_offered(offer) for offer in offers]
        rows += _stored_rows(self._stored, wanted)
        self.tools.setText(f"{len([r for r in rows if r.kind == LINE]):,} shown")
        # Plugins may offer many operations. The few templates stand above them.
        above = len(here[:MOST]) + bool(here) + (len(here) > MOST)
        rows[above:above] = _template_rows(wanted)
        self.list.show_rows(rows)
        hint = self._hint(bool(used), bool(rows))
        self.hint.setText(hint)
        self._place_hint()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """In a low panel the operations have the room of the hint."""
        super().resizeEvent(event)
        self._place_hint()

    def _place_hint(self) -> None:
        self.hint.setVisible(bool(self.hint.text()) and self.height() >= LOW)

    def _row(self, name: str, count: int, notes: Mapping[str, OperationNote]) -> ListRow:
        note = notes.get(note_key(name), PLAIN)
        times = counted(count, "edge")
        return ListRow(
            name,
            name,
            ACTOR_ICON.get(note.actor or "", "robot" if note.actor else "arrow"),
            note.title,
            f"{count:,}",
            self._severities.get(name, ""),
            tip=f"{name}, {times}. Click to select those of one State Branch. Drag it to a state, "
            "or press Enter with a state selected.",
        )

    def _hint(self, used: bool, shown: bool) -> str:
        if not shown and (used or self._offers):
            return "No operation has this in its name."
        if not self._offers:
            return NO_PLUGIN
        if used:
            return "Drag a line onto a state, or between two states."
        return "Draw an operation from a state's handle to another state."


def _dragged(row: ListRow) -> QMimeData | None:
    """What is dragged with a row; None for a heading, and for what the store holds."""
    still = row.kind != LINE or isinstance(row.payload, StoredLine)
    return None if still else library_data(*_offer_of(row))


def _offer_of(row: ListRow) -> tuple[str, str]:
    """What a row offers: its kind and its name."""
    if isinstance(row.payload, TemplateRow):
        return "template", row.payload.key
    return "operation", row.text


def _template_rows(wanted: str) -> list[ListRow]:
    """The rows of the templates with a text in their name, below their heading."""
    rows = [
        ListRow(one.name, TemplateRow(key), one.icon, tip=f"{one.tip}. Drag it to a state or an "
                "operation, or press Enter with one selected.")
        for key, one in TEMPLATES.items()
        if wanted in one.name.casefold()
    ]  # fmt: skip
    return [ListRow(f"Templates · {len(rows)}", kind="section"), *rows] if rows else []


def _offered(offer: LibraryEntry) -> ListRow:
    bound = counted(len(offer.names), "operation") if offer.names else "not used"
    names = ", ".join(offer.names[:8]) or "no operation of this blueprint"
    return ListRow(
        offer.pattern,
        None,
        "robot",
        right=bound,
        tip=f"{offer.pattern}, offered by {offer.plugin}; serves {names}.",
        pale=not offer.names,
    )


def _stored_rows(lines: Sequence[StoredLine], wanted: str) -> list[ListRow]:
    """The rows of the store in whose title, State Branches, operations or facts a text stands."""
    found = [one for one in lines if any(wanted in word.casefold() for word in _words_of(one))]
    many = sum(not one.operation for one in found)
    rows = [
        ListRow(
            one.title,
            one,
            "arrow" if one.operation else "shield",
            right=one.mark,
            severity="" if one.is_good or not one.withdrawn else "E",
            tip=f"{one.told} {_COPY}" if one.name else one.told,
            pale=not one.is_good,
        )
        for one in found
    ]
    return [ListRow(f"From your store · {many}", kind="section"), *rows] if rows else []


def _words_of(line: StoredLine) -> tuple[str, ...]:
    """The words of a line by which the filter finds it. An operation is found by its own name."""
    return (line.title,) if line.operation else (line.title, *line.words)


def _used(blueprint: Blueprint) -> Counter[str]:
    counts: Counter[str] = Counter()
    for branch in blueprint:
        counts.update(chain.from_iterable(branch.table.values()))
    return counts


def _by_name(name: str) -> tuple[str, str]:
    return name.casefold(), name


def _first_notes(blueprint: Blueprint) -> dict[str, OperationNote]:
    """The first note of each operation name, in the order of the SBs."""
    found: dict[str, OperationNote] = {}
    for branch in blueprint:
        for name, note in branch.notes.operations.items():
            found.setdefault(name, note)
    return found


def _marks(findings: Sequence[Finding]) -> dict[str, str]:
    found: dict[str, str] = {}
    for finding in findings:
        if finding.severity is not Severity.NOTE:
            for name in {address.operation for address in finding.addresses} - {""}:
                if found.get(name) != "E":
                    found[name] = finding.severity.value
    return found


def _edges(blueprint: Blueprint, shown: str, name: str) -> list[Address]:
    """The edges of an operation in the shown SB, else in the first SB that has it."""
    order = sorted(blueprint.branches, key=lambda branch: branch != shown)
    for branch in order:
        table = blueprint[branch].table
        edges = [Address(branch, state, name) for state in table if name in table[state]]
        if edges:
            return edges
    return []
