"""The page Rules: the text at the left, what it gives in the middle, the differences at the
right."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QEvent, Qt, QTimer, Signal, SignalInstance
from PySide6.QtGui import QKeyEvent, QKeySequence
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, Table
from smsl_studio.errors import ReadError, StudioError, TextFix
from smsl_studio.front.rule_differences import RuleDifference, taken
from smsl_studio.front.rule_draft import MOST_SHOWN
from smsl_studio.legible import one_line
from smsl_studio.picture.marks import Marks
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.controls import Elided, label
from smsl_studio.studio.base.paint.change_signs import MISSING, ODD
from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted, refusal_words
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.rules.rule_answer import RuleAnswer, rule_answer
from smsl_studio.studio.features.rules.rules_file import RulesFile
from smsl_studio.studio.features.rules.rules_text import RulesText
from smsl_studio.studio.features.rules.side import MOST, RulesSide
from smsl_studio.studio.running.frames import head, split

PAUSE = 60
"""Milliseconds without a keystroke before the rules are followed."""
_SAVE = QKeySequence.StandardKey.Save
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
        self._refusal: StudioError | None = None
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
        self.saving = self._tool("Save", "Save the rules into their file", self.save_wanted)
        self.saving.setAccessibleName("Save rules")
        self.learning = self._tool(
            "Complete from examples", "Write the rules that most of the drawing follows, and "
            "suggest what is missing or odd (Ctrl+Z brings the text back)",
            self.learn_wanted)  # fmt: skip
        self.fixing = QPushButton()
        self.fixing.setProperty("role", "primary")
        self.fixing.setAutoDefault(False)
        self.fixing.hide()
        self.fixing.clicked.connect(self._fix)
        self._build()
        self.setAccessibleName("Rules")
        self.text.textChanged.connect(self._typed)
        self.text.cursorPositionChanged.connect(self._show_caret)
        self.problems.clicked.connect(self._go_to_problem)
        self.problems.activated.connect(self._go_to_problem)
        self.problems.selectionModel().currentChanged.connect(lambda *_: self._show_fix())
        self.side.taken.connect(self._take)
        self.side.shown.connect(self._mark)
        self.side.write_wanted.connect(self.write_wanted)
        session.blueprint_changed.connect(lambda *_: self._drawing_changed())

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
        column.addWidget(head("Problems", self._caret, None, self.fixing))
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

    def begin_anew(self) -> None:
        """Take the next text as another one: it is no change of the text before."""
        self.answer = self._shown = None

    def follow(self) -> None:
        """Follow the rules as they are written now."""
        self.keep()
        self._beside.drop()
        text = self.text.toPlainText()
        drawn = self._session.blueprint
        work = partial(rule_answer, text, self.file.name, drawn, self.answer)
        self._beside.do(work, self._show)

    def _typed(self) -> None:
        self._pause.start()

    def _show(self, answer: RuleAnswer) -> None:
        self.answer = answer
        draft = answer.draft
        lines = {fault.place.line: fault.sentence for fault in draft.faults if fault.place}
        self.text.show_faults(lines)
        self.text.words.facts = draft.rules.facts if draft.rules else self.text.words.facts
        self._show_problems()
        self.sum.setText(_sum_words(answer, self._shown is not None))
        if answer.preview is not None and draft.rules is not None:
            branch, shown = draft.rules.branch, answer.preview.blueprint
            same = self._shown is not None and branch in self._shown.branches
            self.change.setText(_change_words(answer))
            if self._shown is None or self._shown != shown:
                self._shown = shown
                self.canvas.show_branch(shown, branch, answer.places, keep_view=same)
                if same:
                    self.canvas.show_all()
        self.side.show_answer(answer)

    def _mark(self) -> None:
        """Mark what the last change did, and the differences with their numbers."""
        preview = self.answer.preview if self.answer is not None else None
        if preview is None:
            return
        numbers: dict[Address, str] = {}
        for number, one in enumerate(self.side.open[:MOST], start=1):
            if one in preview.drawn:
                sign = MISSING if one.kind != "odd" else ODD
                numbers.setdefault(preview.drawn[one], f"{sign}{number}")
        changes = {at: sign for at, sign in preview.changes.items() if at not in numbers}
        self.canvas.set_marks(Marks(changes=changes, conflicts=numbers))

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

    def refuse(self, error: StudioError | None) -> None:
        """Show why no rules can be learnt, until the drawing changes."""
        self._refusal = error
        self._show_problems()

    def _drawing_changed(self) -> None:
        self._refusal = None
        self._pause.start()

    def _show_problems(self) -> None:
        faults = self.answer.draft.faults if self.answer is not None else ()
        refused = (self._refusal,) if self._refusal is not None else ()
        self.problems.show_rows([_problem_row(fault) for fault in (*refused, *faults)])
        if self.problems.rows.rows and not self.problems.currentIndex().isValid():
            self.problems.setCurrentIndex(self.problems.rows.index(0))
        self._show_fix()

    def _show_fix(self) -> None:
        fix = self._chosen_fix()
        self.fixing.setVisible(fix is not None)
        if fix is not None:
            self.fixing.setText(one_line(fix.words))

    def _chosen_fix(self) -> TextFix | None:
        """The repair of the chosen problem, if the text is still the one that was read."""
        fault = self.problems.current_payload if self.problems.rows.rows else None
        followed = self.answer is not None and self.answer.text == self.text.toPlainText()
        return fault.fix if isinstance(fault, ReadError) and followed else None

    def _fix(self) -> None:
        fix = self._chosen_fix()
        if fix is not None:
            self.text.repair(fix)

    def event(self, event: QEvent) -> bool:
        """Ctrl+S is about the rules while the keyboard is on this page."""
        override = event.type() is QEvent.Type.ShortcutOverride
        if override and isinstance(event, QKeyEvent) and event.matches(_SAVE):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Save the rules with Ctrl+S."""
        if event.matches(_SAVE):
            self.save_wanted.emit()
            return
        super().keyPressEvent(event)

    def _go_to_problem(self) -> None:
        fault = self.problems.current_payload
        if fault is not None and fault.place is not None:
            self.text.go_to(fault.place.line)

    def _show_caret(self) -> None:
        line, column = self.text.caret
        self._caret.setText(f"Line {line}, column {column}")


def _problem_row(fault: StudioError) -> ListRow:
    line = fault.place.line if fault.place is not None else 0
    where = f"Line {line}: " if line else ""
    words = f"{where}{fault.sentence}"
    return ListRow(words, fault, severity="E", tip=f"{where}{refusal_words(fault)}")


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


def _change_words(answer: RuleAnswer) -> str:
    """What the last change of the text has brought and taken away."""
    before, after = answer.before, answer.draft.branch
    if before is None or after is None:
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
