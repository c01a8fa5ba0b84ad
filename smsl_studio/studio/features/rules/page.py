"""The page Rules: the text at the left, what it gives in the middle, the differences at the
right."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt, QTimer, Signal, SignalInstance
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint, Table
from smsl_studio.errors import StudioError
from smsl_studio.front.rule_differences import RuleDifference, taken
from smsl_studio.front.rule_draft import MOST_SHOWN
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.rules.rule_answer import RuleAnswer, rule_answer
from smsl_studio.studio.features.rules.rules_file import RulesFile
from smsl_studio.studio.features.rules.rules_text import RulesText
from smsl_studio.studio.features.rules.side import RulesSide
from smsl_studio.studio.running.frames import head, split

PAUSE = 60
"""Milliseconds without a keystroke before the rules are followed."""
PROBLEMS = 102
"""The height of the problems (pixels)."""


class RulesPage(QWidget):
    """Follows every keystroke. The drawing changes only when a difference is taken."""

    open_wanted = Signal()
    save_wanted = Signal()
    learn_wanted = Signal()
    write_wanted = Signal()

    def __init__(self, session: Session, file: RulesFile, tokens: Tokens) -> None:
        super().__init__()
        self._session, self.file = session, file
        self.answer: RuleAnswer | None = None
        self._shown: Blueprint | None = None
        self._beside = Beside(self)
        self._pause = QTimer(self)
        self._pause.setSingleShot(True)
        self._pause.setInterval(PAUSE)
        self._pause.timeout.connect(self.follow)
        self.text, self.problems = RulesText(tokens), RowsView(tokens, self)
        self.problems.setAccessibleName("Problems")
        self.problems.setFixedHeight(PROBLEMS)
        self.canvas = Canvas(tokens)
        self.canvas.editing = False
        self.canvas.collapse.join(SharedCollapse(self))
        self.canvas.setAccessibleName("Preview of the rules")
        self.side = RulesSide(tokens)
        self._file, self._caret = Elided(), label("", "second")
        self.sum, self.change = Elided(), Elided()
        self.opening = self._tool("Open…", "Open a file of rules", self.open_wanted)
        self.saving = self._tool("Save rules", "Save the rules into their file", self.save_wanted)
        self.learning = self._tool(
            "Learn", "Write the rules that make the drawing (Ctrl+Z brings the text back)",
            self.learn_wanted)  # fmt: skip
        self._build()
        self.setAccessibleName("Rules")
        self.text.textChanged.connect(self._typed)
        self.text.cursorPositionChanged.connect(self._show_caret)
        self.problems.clicked.connect(self._go_to_problem)
        self.problems.activated.connect(self._go_to_problem)
        self.side.taken.connect(self._take)
        self.side.write_wanted.connect(self.write_wanted)
        session.blueprint_changed.connect(lambda *_: self._pause.start())
        session.opened.connect(self.side.refused.clear)

    def _tool(self, words: str, tip: str, wanted: SignalInstance) -> QPushButton:
        made = QPushButton(words)
        made.setToolTip(tip_text(tip))
        made.setAutoDefault(False)
        made.clicked.connect(wanted)
        return made

    def _build(self) -> None:
        left, column = empty_panel()
        column.addWidget(head("Rules", self._file, self.learning, self.opening, self.saving))
        column.addWidget(self.text, 1)
        column.addWidget(head("Problems", None, self._caret))
        column.addWidget(self.problems)
        middle, between = empty_panel()
        between.addWidget(head("Preview", self.sum))
        between.addWidget(self.canvas, 1)
        between.addWidget(head("Last change", self.change))
        parts = (left, middle, self.side)
        whole = split(Qt.Orientation.Horizontal, parts, (524, 552, 364), (2, 2, 1))
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(whole)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.text, self.problems, self.canvas, self.side):
            part.set_tokens(tokens)

    def stop(self) -> None:
        """Keep the text for the next time, and end all work, because the window closes."""
        self.keep()
        self._pause.stop()
        self._beside.stop()

    def keep(self) -> None:
        """Store the text as it is now, and show whether the file has it."""
        text = self.text.toPlainText()
        self.file.keep(text)
        edited = text != self.file.saved
        self._file.setText(f"{self.file.name}, not saved" if edited else self.file.name)
        self.saving.setEnabled(edited)

    def follow(self) -> None:
        """Follow the rules as they are written now."""
        self.keep()
        self._beside.drop()
        text = self.text.toPlainText()
        work = partial(rule_answer, text, self.file.name, self._session.blueprint)
        self._beside.do(work, self._show)

    def _typed(self) -> None:
        self._pause.start()

    def _show(self, answer: RuleAnswer) -> None:
        former, self.answer = self.answer, answer
        draft = answer.draft
        lines = {fault.place.line: fault.sentence for fault in draft.faults if fault.place}
        self.text.show_faults(lines)
        self.problems.show_rows([_problem_row(fault) for fault in draft.faults])
        self.sum.setText(_sum_words(answer, self._shown is not None))
        if draft.blueprint is not None and draft.rules is not None:
            branch = draft.rules.branch
            same = self._shown is not None and branch in self._shown.branches
            self.change.setText(_change_words(former, answer))
            if self._shown is None or self._shown != draft.blueprint:
                self._shown = draft.blueprint
                self.canvas.show_branch(draft.blueprint, branch, answer.places, keep_view=same)
                if same:
                    self.canvas.show_all()
        self.side.show_answer(answer)

    def _take(self, differences: tuple[RuleDifference, ...]) -> None:
        rules = self.answer.draft.rules if self.answer is not None else None
        if rules is None or not differences:
            return
        one, name = differences[0], rules.branch
        words = (
            f"Follow the rules in {one.state}/{one.operation}"
            if len(differences) == 1
            else f"Follow the rules in {counted(len(differences), 'operation')}"
        )
        self._session.edit(words, lambda blueprint: taken(blueprint, name, differences))

    def _go_to_problem(self) -> None:
        line = self.problems.current_payload
        if line:
            self.text.go_to(line)

    def _show_caret(self) -> None:
        line, column = self.text.caret
        self._caret.setText(f"Line {line}, column {column}")


def _problem_row(fault: StudioError) -> ListRow:
    line = fault.place.line if fault.place is not None else 0
    where = f"Line {line}: " if line else ""
    words = f"{where}{fault.sentence}"
    return ListRow(words, line, severity="E", tip=f"{where}{refusal_words(fault)}")


def _sum_words(answer: RuleAnswer, former: bool) -> str:
    draft = answer.draft
    if draft.blueprint is None:
        return "The text gives nothing yet." + (" This is what it gave before." if former else "")
    states, operations = counted(draft.states, "state"), counted(draft.operations, "operation")
    if not draft.whole:
        return f"Stopped at {MOST_SHOWN:,} states. This is not the whole."
    left = f", {counted(len(draft.faults), 'part')} left out" if draft.faults else ""
    goal = "" if draft.goal_reached else ". The goal is not reached"
    return f"{states}, {operations}{left}{goal}"


def _change_words(former: RuleAnswer | None, answer: RuleAnswer) -> str:
    """What the last change of the text has brought and taken away."""
    before = former.draft.branch if former is not None else None
    after = answer.draft.branch
    if former is None or before is None or after is None:
        return ""
    told = []
    for name, one, other in (
        ("state", set(before.table), set(after.table)),
        ("operation", _edges(before.table), _edges(after.table)),
    ):
        for sign, many in (("+", len(other - one)), ("−", len(one - other))):
            if many:
                told.append(f"{sign}{counted(many, name)}")
    return ", ".join(told) or "Same states and operations"


def _edges(table: Table) -> set[tuple[str, str, str]]:
    return {
        (state, operation, target)
        for state, operations in table.items()
        for operation, target in operations.items()
    }
