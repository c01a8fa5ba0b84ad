"""The properties of operations: one edge, or what several edges share."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from PySide6.QtWidgets import QLabel, QPushButton, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address, note_key
from smsl_studio.blueprint.annotations import OperationNote
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.controls import Combo, Field, Switch, label, row
from smsl_studio.studio.panels.frame import Panel
from smsl_studio.studio.panels.note_edits import Spot, set_note_value
from smsl_studio.studio.panels.state_form import labelled
from smsl_studio.studio.panels.trying import try_edit
from smsl_studio.studio.session import Session
from smsl_studio.picture.sub_marks import sub_mark
from smsl_studio.studio.words import counted

NOT_SAID, VARIOUS = "Not said", "Various"
ACTORS = (("Human", "human"), ("Shared", "shared"), ("Robot", "robot"))
RISKS = (("Low", "low"), ("Medium", "medium"), ("High", "high"))
SUBS = (("Drive: it moves first", "drive"), ("Load: brought by the function", "load"))


class OperationForm(Panel):
    """Edits one edge, or the details that several selected edges share.

    Details (title, cost, who acts ...) belong to the operation wherever it stands, unless they
    are written for this edge alone: the choice under the heading says which.
    """

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__("Operation", parent)
        self._session = session
        self._edges: tuple[Address, ...] = ()
        self.column.setContentsMargins(12, 8, 12, 12)
        self.column.setSpacing(6)
        self._heading, self._name = label("Operation", "heading"), label("", "second")
        self.column.addLayout(row(self._heading, self._name, None))
        self.name = self._field("Name", "The name of this edge (F2)")
        self.name.editingFinished.connect(self._rename)
        self.everywhere = Switch()
        self.everywhere.setAccessibleName("Rename everywhere")
        self.everywhere.setToolTip("Rename every edge of this name in the State Branch")
        self._every_words = label("", "second")
        self._every_words.setBuddy(self.everywhere)
        line = labelled("", self.everywhere)
        line.addSpacing(8)
        line.addWidget(self._every_words, 1)
        self.column.addLayout(line)
        self.source = QPushButton()
        self.source.setProperty("role", "link")
        self.source.setAccessibleName("Source state")
        self.source.clicked.connect(self._select_source)
        self._from = labelled("From", self.source)
        self.column.addLayout(self._from)
        self.target = self._combo("To", "The state this operation leads to")
        self.target.activated.connect(self._retarget)
        self.where = self._combo("Details", "Whether the details below hold for every edge of "
                                 "this name, or for this edge only")  # fmt: skip
        self.where.activated.connect(lambda *_: self._show_details())
        self.title = self._field("Title", "A plain title, for people")
        self.title.editingFinished.connect(lambda: self._text("title", self.title))
        self.cost = self._field("Cost", "What a route adds for this operation; 1 where not said")
        self.cost.editingFinished.connect(lambda: self._number("cost", self.cost))
        self.actor = self._combo("Who acts", "Human, shared or robot")
        self.actor.activated.connect(lambda *_: self._chosen("actor", self.actor))
        self.risk = self._combo("Risk", "The declared risk of this operation")
        self.risk.activated.connect(lambda *_: self._chosen("risk", self.risk))
        self.timeout = self._field("Time limit", "Seconds until the operation counts as failed")
        self.timeout.set_suffix("s")
        self.timeout.editingFinished.connect(lambda: self._number("timeout", self.timeout))
        self.subs = self._combo("Sub-SB", "Whether the sub-SB moves first, or the operation "
                                "itself brings its facts about")  # fmt: skip
        self.subs.activated.connect(lambda *_: self._chosen("subs", self.subs))
        self.repeatable = Switch()
        self.repeatable.setAccessibleName("Repeatable")
        self.repeatable.clicked.connect(lambda on: self._note("repeatable", on or None))
        self._repeat_line = labelled("Repeatable", self.repeatable)
        self._repeat_line.addStretch(1)
        self.column.addLayout(self._repeat_line)
        self.refusal: QLabel = label("", "refusal")
        self.refusal.hide()
        self.column.addWidget(self.refusal)

    def show_operations(self, blueprint: Blueprint, edges: Sequence[Address]) -> None:
        """Show one edge, or what several share."""
        if tuple(edges) != self._edges:
            self.refusal.hide()
            self.everywhere.setChecked(False)
            self._edges = tuple(edges)
            self._offer_where(blueprint)
        one = edges[0] if len(edges) == 1 else None
        names = {edge.operation for edge in edges}
        self._heading.setText("Operation" if one else counted(len(edges), "operation"))
        self._name.setText(edges[0].operation if len(names) == 1 else "")
        for line in (self.name, self.target, self.source):
            _show_line(line, one is not None)
        if one is not None:
            self._show_edge(blueprint[one.branch], one)
        _show_line(self.everywhere, one is not None and self._count_of(one) > 1)
        self._show_details()

    def _show_edge(self, branch: StateBranch, edge: Address) -> None:
        self.name.settle(edge.operation)
        count = self._count_of(edge)
        self._every_words.setText(f"Rename all {count}")
        self.source.setText(edge.state)
        self.source.setToolTip(f"Select {edge.state}")
        target = branch.table[edge.state][edge.operation]
        states = list(branch.table)
        known = target in branch.table
        items = states if known else [f"{target} (no such state)", *states]
        if [self.target.itemText(i) for i in range(self.target.count())] != items:
            self.target.clear()
            self.target.addItems(items)
        self.target.setCurrentIndex(states.index(target) if known else 0)

    def _show_details(self) -> None:
        blueprint = self._session.blueprint
        notes = [self._shown_note(blueprint, edge) for edge in self._edges]
        _settle(self.title, {note.title for note in notes})
        _settle(self.cost, {_number_text(note.cost) for note in notes}, "1")
        _settle(self.timeout, {_number_text(note.timeout) for note in notes}, "none")
        _choose(self.actor, ACTORS, {note.actor for note in notes})
        _choose(self.risk, RISKS, {note.risk for note in notes})
        _choose(self.subs, SUBS, {note.subs for note in notes}, optional=False)
        branches = [blueprint[edge.branch] for edge in self._edges]
        turns = [
            sub_mark(branch, branch.operation(edge.state, edge.operation))
            for branch, edge in zip(branches, self._edges, strict=True)
        ]
        _show_line(self.subs, any(turns))
        loops = all(
            branch.table[edge.state][edge.operation] == edge.state
            for branch, edge in zip(branches, self._edges, strict=True)
        )
        _show_line(self.repeatable, loops)
        self.repeatable.setChecked(all(note.repeatable for note in notes))

    def _shown_note(self, blueprint: Blueprint, edge: Address) -> OperationNote:
        branch = blueprint[edge.branch]
        if self._only_here:
            return branch.operation_note(edge.state, edge.operation)
        return branch.notes.operations.get(note_key(edge.operation), OperationNote())

    @property
    def _only_here(self) -> bool:
        return bool(self.where.currentData())

    def _offer_where(self, blueprint: Blueprint) -> None:
        """Every edge of the name, or these edges only; what is written already decides."""
        names = {edge.operation for edge in self._edges}
        self.where.clear()
        every = f"Every {next(iter(names))}" if len(names) == 1 else "Every edge of these names"
        self.where.addItem(every, False)
        self.where.addItem("This edge only" if len(self._edges) == 1 else "These edges only", True)
        own = [
            note_key(edge.operation, edge.state) in blueprint[edge.branch].notes.operations
            for edge in self._edges
        ]
        self.where.setCurrentIndex(1 if any(own) else 0)

    def _count_of(self, edge: Address) -> int:
        table = self._session.blueprint[edge.branch].table
        return sum(edge.operation in operations for operations in table.values())

    # Edits.

    def _rename(self) -> None:
        new = self.name.text().strip()
        if not self.name.changed or len(self._edges) != 1:
            return
        edge, every = self._edges[0], self.everywhere.isChecked()
        done = try_edit(
            self._session,
            f"Rename {edge.operation} to {new}",
            lambda bp: editing.rename(bp, edge, new, rename_everywhere=every),
            self.refusal,
        )
        self.name.set_refused(not done)
        if done:
            self._session.select((Address(edge.branch, edge.state, new),))

    def _retarget(self) -> None:
        edge, target = self._edges[0], self.target.currentText()
        if target not in self._session.blueprint[edge.branch].table:
            return
        try_edit(
            self._session,
            f"Lead {edge.operation} to {target}",
            lambda bp: editing.retarget(bp, edge, target),
            self.refusal,
        )

    def _select_source(self) -> None:
        edge = self._edges[0]
        self._session.select((Address(edge.branch, edge.state),))

    def _text(self, key: str, field: Field) -> None:
        if field.changed:
            self._note(key, field.text().strip() or None)

    def _number(self, key: str, field: Field) -> None:
        if not field.changed:
            return
        text = field.text().strip().replace(",", ".")
        try:
            value = float(text) if text else None
        except ValueError:
            self.refusal.setText(f"“{text}” is no number. Write one such as 2.5.")
            self.refusal.show()
            field.set_refused(True)
            return
        whole = value is not None and value.is_integer()
        field.set_refused(not self._note(key, int(value) if whole and value is not None else value))

    def _chosen(self, key: str, combo: Combo) -> None:
        if combo.currentText() != VARIOUS:
            value = combo.currentData()
            self._note(key, None if value == "drive" else value)

    def _note(self, key: str, value: object) -> bool:
        # Thousands of edges of one name share one note, which is written once.
        spots = dict.fromkeys(self._spot(edge, key) for edge in self._edges)

        def change(blueprint: Blueprint) -> Blueprint:
            for spot in spots:
                blueprint = set_note_value(blueprint, spot, value)
            return blueprint

        names = sorted({edge.operation for edge in self._edges})
        words = names[0] if len(names) == 1 else counted(len(names), "operation")
        return try_edit(self._session, f"Set {_WORDS[key]} of {words}", change, self.refusal)

    def _spot(self, edge: Address, key: str) -> Spot:
        state = edge.state if self._only_here else ""
        return Spot(edge.branch, "_operations", note_key(edge.operation, state), key)

    # Rows.

    def _field(self, words: str, tip: str) -> Field:
        field = Field()
        field.setAccessibleName(f"{words} of the operation")
        field.setToolTip(tip)
        self.column.addLayout(labelled(words, field))
        return field

    def _combo(self, words: str, tip: str) -> Combo:
        combo = Combo()
        combo.setAccessibleName(f"{words}, operation")
        combo.setToolTip(tip)
        self.column.addLayout(labelled(words, combo))
        return combo


_WORDS = {
    "title": "the title", "cost": "the cost", "timeout": "the time limit", "actor": "who acts",
    "risk": "the risk", "subs": "the sub-SB's part", "repeatable": "repeatable",
}  # fmt: skip


def _show_line(field: QWidget, shown: bool) -> None:
    """Show or hide a field with its name."""
    field.setVisible(shown)
    above = field.parentWidget()
    for name in above.findChildren(QLabel) if above else ():
        if name.buddy() is field:
            name.setVisible(shown)


def _settle(field: Field, values: set[str], default: str = "") -> None:
    field.settle(next(iter(values)) if len(values) == 1 else "")
    field.setPlaceholderText(default if len(values) <= 1 else VARIOUS)


def _choose(
    combo: Combo,
    choices: tuple[tuple[str, str], ...],
    values: Collection[str | None],
    optional: bool = True,
) -> None:
    combo.clear()
    if optional:
        combo.addItem(NOT_SAID, None)
    for words, value in choices:
        combo.addItem(words, value)
    if len(values) > 1:
        combo.addItem(VARIOUS, VARIOUS)
        combo.setCurrentIndex(combo.count() - 1)
    else:
        combo.setCurrentIndex(max(0, combo.findData(next(iter(values), None))))


def _number_text(value: float | None) -> str:
    return "" if value is None else f"{value:g}"
