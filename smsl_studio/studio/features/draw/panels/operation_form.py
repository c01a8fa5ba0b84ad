"""The form of one edge, or of what several edges share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtWidgets import QPushButton, QSizePolicy, QWidget

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import AUTOMATIC, OF_ACTOR
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.legible import plain_text
from smsl_studio.library.loaded import Loaded
from smsl_studio.picture.sub_marks import sub_mark
from smsl_studio.studio.base.controls import Combo, label, row
from smsl_studio.studio.base.lines.bound_function import BindingLine
from smsl_studio.studio.base.lines.choice import ChoiceLine, SwitchLine
from smsl_studio.studio.base.lines.digits import DigitsLine
from smsl_studio.studio.base.lines.line import VARIOUS, FormLine, ShownValue
from smsl_studio.studio.base.lines.requires import RequiresLine
from smsl_studio.studio.base.lines.roles import RolesLine
from smsl_studio.studio.base.lines.text import NumberBounds, NumberLine, TextLine
from smsl_studio.studio.base.notation_part import NotationPart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.rename_loss import RenameWarning
from smsl_studio.studio.document.rename_scopes import RenameScope, rename_scopes
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.asking_lines import AskingLines
from smsl_studio.studio.features.draw.panels.note_form import NoteForm
from smsl_studio.studio.features.draw.panels.operation_entries import entries_of, noted_edges
from smsl_studio.studio.features.draw.panels.try_alone import TryAlone

ACTORS = (("Human", "human"), ("Shared", "shared"), ("Robot", "robot"))
RISKS = (("Low", "low"), ("Medium", "medium"), ("High", "high"))
STOPS = (("Abort at once", "abort"), ("Hold where it is", "hold"), ("Finish first", "finish"))
MOST = 500
"""At most this many selected edges are checked for whether people are asked."""
SUBS = (("Drive it first", "drive"), ("Load", "load"))


class OperationForm(NoteForm):
    """Edits one edge, or the details that several selected edges share.

    Details (title, cost, who acts ...) hold for every edge with the same name, unless they are
    written for one edge. The choice under the heading says which of the two is edited. Each line
    shows where its value comes from.
    """

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Operation", "_operations", session, parent)
        self._edges: tuple[Address, ...] = ()
        self._heading, self._name = label("Operation", "heading"), label("", "second")
        self.column.addLayout(row(self._heading, self._name, None))
        self._build_edge()
        self.where: Combo = Combo()
        tip = "Whether the details below hold for every edge of this name, or for this edge only"
        self._where = FormLine("Details", self.where, tip)
        self.where.activated.connect(lambda *_: self._show_details())
        self.column.addWidget(self._where)
        self._build_details(tokens)

    def _build_edge(self) -> None:
        self.warning = RenameWarning()
        self.naming = TextLine("Name", "The name of the operation (F2)")
        self.naming.given.connect(self._rename)
        self.name = self.naming.field
        self._scopes: tuple[RenameScope, ...] = ()
        self.scope = Combo()
        tip = "For which operations of this name a new name holds"
        self._scope = FormLine("Rename", self.scope, tip)
        self.start, self.target = Combo(), Combo()
        self.start.activated.connect(self._move_source)
        self.source = QPushButton("Select")
        self.source.setProperty("role", "link")
        self.start.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.source.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Fixed)
        self.source.clicked.connect(self._select_source)
        tip = "The state this operation starts from"
        self._from = FormLine("From", self.start, tip, self.source)
        self._to = FormLine("To", self.target, "The state this operation leads to")
        self.target.activated.connect(self._retarget)
        for line in (self.naming, self._scope, self._from, self._to):
            self.column.addWidget(line)

    def _build_details(self, tokens: Tokens) -> None:
        seconds = NumberBounds(0, open=True)
        self.title = self.add("title", TextLine("Title", "A plain title, for people")).field
        self.cost = self.add("cost", NumberLine(
            "Cost", "What a route adds for this operation; 1 if not set", NumberBounds(),
            hint="1",
        )).field  # fmt: skip
        self.risk = self.add("risk", ChoiceLine(
            "Risk", "The declared risk of this operation", RISKS)).field  # fmt: skip
        self.actor = self.add("actor", ChoiceLine(
            "Who acts", "Human, shared or robot. Where it is not set, it counts as automatic",
            ACTORS, "Not set: automatic")).field  # fmt: skip
        self.confirm = self.add("confirm", RolesLine(
            "Confirms", "The roles that confirm it before it begins, one for each person, with "
            "commas between; “anybody” is a person of any role", "nobody"
        )).field  # fmt: skip
        self.duration = self.add("duration", NumberLine(
            "Duration", "How long it usually takes, in seconds", NumberBounds(), "s", "not set"
        )).field  # fmt: skip
        self.timeout = self.add("timeout", NumberLine(
            "Time limit", "Seconds until the operation counts as failed", seconds, "s", "none"
        )).field  # fmt: skip
        self.stop = self.add("stop", ChoiceLine(
            "On pause", "What a pause does while it runs. Stop always cancels it.", STOPS,
            "As its function says",
        )).field  # fmt: skip
        self.resumes = self.add("resumes", SwitchLine(
            "Resumes", "Whether it goes on after a pause. If not set, its function decides"
        )).field  # fmt: skip
        self.touches = self.add("touches", DigitsLine(
            "Touches", "Digits of facts that are unknown after it was cancelled, besides those it "
            "changes", "those it changes"
        )).field  # fmt: skip
        self.subs = self.add("subs", ChoiceLine(
            "Sub-SB", "Whether the sub-SB moves first, or the operation itself brings its facts "
            "about", SUBS)).field  # fmt: skip
        self.repeatable = self.add("repeatable", SwitchLine(
            "Repeatable", "Whether it may lead back to its own state again and again"
        )).field  # fmt: skip
        self.requires = self.add(
            "requires",
            RequiresLine(
                "Requires", "Facts of any State Branch that must hold before it starts", tokens
            ),
        )
        self.binding = self.add("binding", BindingLine(
            "Function", "The library function that carries it out"))  # fmt: skip

        self.asking = AskingLines(
            self, "What a person who carries it out is told", "its title: please carry it out"
        )
        self.column.addWidget(self.odd)
        self.alone = TryAlone(self._session)
        self.column.addWidget(self.alone)
        self.notation = NotationPart()
        self.column.addWidget(self.notation)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.requires.facts.set_tokens(tokens)

    def set_plugins(self, loaded: Loaded) -> None:
        """Take the functions that an operation can be bound to."""
        self.warning.loaded = loaded
        self.binding.set_plugins(loaded)
        self.alone.set_plugins(loaded)

    def show_operations(self, blueprint: Blueprint, edges: Sequence[Address]) -> None:
        """Show one edge, or what several share."""
        if tuple(edges) != self._edges:
            self._edges = tuple(edges)
            self._offer_where(blueprint)
            self.scope.setCurrentIndex(0)
        one = edges[0] if len(edges) == 1 else None
        names = {edge.operation for edge in edges}
        self._heading.setText("Operation" if one else counted(len(edges), "operation"))
        self._name.setText(edges[0].operation if len(names) == 1 else "")
        branch = blueprint[edges[0].branch]
        together = all(edge.branch == branch.name for edge in edges)
        self.naming.setVisible(len(names) == 1 and together)
        self._from.setVisible(one is not None)
        self._to.setVisible(together)
        for line in (self.naming, self._from, self._to):
            line.refuse("")
        self._show_scopes(blueprint, len(names) == 1 and together)
        self.source.setAccessibleName(plain_text(f"Select {edges[0].state}"))
        self.source.setToolTip(tip_text(f"Select {edges[0].state}"))
        if together:
            self._show_target(branch)
            self._show_start()
        self.alone.show_edges(edges)
        self.notation.show_element(blueprint, str(one or ""))
        self._show_details()

    def who(self) -> str:
        """The edges or the operation in the words of an undo step."""
        names = sorted({edge.operation for edge in self._edges})
        if len(self._edges) == 1 and self._only_here:
            return f"{self._edges[0].state}/{names[0]}"
        if len(names) == 1 and not self._only_here:
            return names[0]
        return counted(len(self._edges), "operation")

    def _show_scopes(self, blueprint: Blueprint, one_name: bool) -> None:
        """Show the name of the edges, and where a new name may hold if others have it too."""
        at = self.scope.currentIndex()
        self._scopes = rename_scopes(blueprint, self._edges) if one_name else ()
        self.naming.show_values([ShownValue(self._edges[0].operation)])
        self.scope.clear()
        self.scope.addItems([scope.words for scope in self._scopes])
        self.scope.setCurrentIndex(at if 0 <= at < len(self._scopes) else 0)
        self._scope.setVisible(len(self._scopes) > 1)

    def _show_target(self, branch: StateBranch) -> None:
        """Show the state to which all edges lead, or that they differ."""
        targets = {branch.table[edge.state][edge.operation] for edge in self._edges}
        states, first = list(branch.table), next(iter(targets))
        unknown = f"{first} (no such state)" if len(targets) == 1 else VARIOUS
        known = len(targets) == 1 and first in branch.table
        items = states if known else [unknown, *states]
        if [self.target.itemText(i) for i in range(self.target.count())] != items:
            self.target.clear()
            self.target.addItems(items)
        self.target.setCurrentIndex(states.index(first) if known else 0)

    def _show_start(self) -> None:
        """Show the state from which the first edge starts. The choices are those of the target."""
        if self.start.model() is not self.target.model():
            self.start.setModel(self.target.model())
        states = list(self._session.blueprint[self._edges[0].branch].table)
        before = self.start.count() - len(states)
        self.start.setCurrentIndex(before + states.index(self._edges[0].state))

    def _show_details(self) -> None:
        blueprint = self._session.blueprint
        self.requires.set_blueprint(blueprint)
        names = {edge.operation for edge in self._edges}
        self.binding.operation = next(iter(names)) if len(names) == 1 else ""
        together = len({edge.branch for edge in self._edges}) == 1
        self.binding.branch = blueprint[self._edges[0].branch] if together else None
        self.show_entries(entries_of(blueprint, self._edges, self._only_here))
        self._where.say("" if self._only_here else _own_words(blueprint, self._edges))
        branches = [blueprint[edge.branch] for edge in self._edges]
        pairs = list(zip(branches, self._edges, strict=True))
        turns = any(
            sub_mark(branch, branch.operation(edge.state, edge.operation)) for branch, edge in pairs
        )
        loops = all(branch.table[at.state][at.operation] == at.state for branch, at in pairs)
        # A written key that has no effect is shown, so that it can be removed.
        for word, fits in (("subs", turns), ("repeatable", loops)):
            written = any(word in entry.written for entry in self._entries)
            self._lines[word].setVisible(fits or written)

        self._show_asking(blueprint)

    def _show_asking(self, blueprint: Blueprint) -> None:
        """Show the lines about asking people, if anybody is asked about these operations.

        Actors, confirmations and the levels of the file decide.
        """
        notes = {id(n): n for entry in self._entries for n in (entry.note, entry.standard)}
        asked = any(note.confirm or note.actor in OF_ACTOR for note in notes.values())
        if not asked and blueprint.levels:
            levels = Levels(blueprint)
            asked = any(levels.operation(edge) != AUTOMATIC for edge in self._edges[:MOST])
        self.asking.show(asked, frozenset(word for e in self._entries for word in e.written))

    @property
    def _only_here(self) -> bool:
        return bool(self.where.currentData())

    def _offer_where(self, blueprint: Blueprint) -> None:
        """Offer to edit every edge of the name or these edges only.

        If an edge has an entry of its own, the second is chosen.
        """
        names = {edge.operation for edge in self._edges}
        self.where.clear()
        every = f"All {next(iter(names))}" if len(names) == 1 else "All edges of these names"
        self.where.addItem(every, False)
        self.where.addItem("This edge only" if len(self._edges) == 1 else "These edges only", True)
        own = noted_edges(blueprint, self._edges)
        self.where.setCurrentIndex(1 if own else 0)

    # Edits.

    def _rename(self, new: Any) -> None:
        name, old = str(new or ""), self._edges[0].operation
        chosen = self._scopes[max(self.scope.currentIndex(), 0)].addresses
        where = f" in {len(chosen):,} places" if len(chosen) > 1 else ""
        # A person who only leaves the field has not agreed to the warning. The new name stays in
        # the field.
        lost = self.warning.once(self._session.blueprint, chosen, name, self.name.hasFocus())
        if lost:
            self.naming.refuse(lost)
            return
        self.edit(
            f"Rename {old} to {name}{where}",
            lambda bp: editing.rename_operations(bp, chosen, name),
            self.naming.refuse,
        )

    def _retarget(self) -> None:
        edges = self._edges
        states = list(self._session.blueprint[edges[0].branch].table)
        # A first entry that is no state says that there is none, or that they differ.
        at = self.target.currentIndex() - (self.target.count() - len(states))
        if at >= 0:
            target = states[at]
            self.edit(
                f"Lead {self._leading()} to {target}",
                lambda bp: editing.retarget(bp, edges, target),
                self._to.refuse,
            )

    def _move_source(self) -> None:
        edge = self._edges[0]
        states = list(self._session.blueprint[edge.branch].table)
        # A first entry that is no state is about the target.
        at = self.start.currentIndex() - (self.start.count() - len(states))
        words = f"Let {edge.operation} start from {states[at]}"
        done = at >= 0 and self.edit(
            words, lambda bp: editing.move_source(bp, edge, states[at]), self._from.refuse
        )
        if done:
            self._session.select((replace(edge, state=states[at]),))
            self.start.setFocus()
        else:
            self._show_start()

    def _leading(self) -> str:
        return self._edges[0].operation if len(self._edges) == 1 else counted(
            len(self._edges), "operation")  # fmt: skip

    def _select_source(self) -> None:
        edge = self._edges[0]
        self._session.select((Address(edge.branch, edge.state),))


def _own_words(blueprint: Blueprint, edges: Sequence[Address]) -> str:
    """A sentence about the edges that have values of their own; empty if none has."""
    own = noted_edges(blueprint, edges)
    if not own:
        return ""
    if len(edges) == 1:
        return "This edge has values of its own, which win over these."
    return f"{counted(len(own), 'edge')} of them: values of their own, which win over these."
