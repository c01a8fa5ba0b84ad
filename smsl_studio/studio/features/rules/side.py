"""The right side of the page: facts, what is left out, and the differences to the drawing."""

from __future__ import annotations

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.front.rule_differences import RuleDifference
from smsl_studio.front.rule_draft import RuleDraft
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.rows import ListRow, RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.rules.rule_answer import RuleAnswer
from smsl_studio.studio.running.frames import head

KINDS = {"missing": "Missing", "odd": "Odd", "target": "Other target"}
WHY = {
    "missing": "The rules give it, and the drawing lacks it.",
    "odd": "It is in the drawing, and no rule gives it.",
    "target": "By the rules it leads to another state.",
}
VERBS = {"missing": "Take", "odd": "Remove", "target": "Take"}
MOST = 500
"""So many differences are listed and taken at once."""


class RulesSide(QWidget):
    """Shows an answer. A difference is taken, or refused until it is offered again."""

    taken = Signal(object)
    """tuple[RuleDifference, ...]: let the drawing follow the rules in these."""
    shown = Signal()
    """The differences that are shown have changed."""
    refusals_changed = Signal()
    """Something was refused, or what was refused is offered again."""
    write_wanted = Signal()
    """Write what the rules give as a new blueprint."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.refused: set[RuleDifference] = set()
        self._answer: RuleAnswer | None = None
        self.facts, self.list = RowsView(tokens, self), RowsView(tokens, self)
        self.facts.setAccessibleName("Facts and forbidden combinations")
        self.list.setAccessibleName("Differences to the drawing")
        self._count, self.why = label("", "second"), label("", "hint")
        self.why.setWordWrap(True)
        self.why.setContentsMargins(12, 4, 12, 4)
        self.take = self._button("Take", "primary", self._take_one)
        self.refuse = self._button("Refuse", "", self._refuse_one)
        self.again = self._button("Offer again", "", self._offer_again)
        self.again.setToolTip(tip_text("Offer the differences again that were refused"))
        self.all = self._button("Take all", "", self._take_all)
        self.write = self._button("Write as blueprint", "primary", self.write_wanted.emit)
        self.write.setToolTip("Open what the rules give as a new blueprint, to be inspected")
        inner, column = empty_panel()
        column.addWidget(head("Facts"))
        column.addWidget(self.facts, 2)
        column.addWidget(head("Differences to the drawing", None, self._count))
        column.addWidget(self.list, 3)
        column.addWidget(self.why)
        for parts in ((self.take, self.refuse, None, self.all), (self.again, None, self.write)):
            across = row(*parts)
            across.setContentsMargins(12, 6, 12, 6)
            column.addLayout(across)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(inner)
        self.list.selectionModel().currentChanged.connect(lambda *_: self._show_chosen())

    def _button(self, words: str, role: str, call: object) -> QPushButton:
        made = QPushButton(words)
        made.setAutoDefault(False)
        if role:
            made.setProperty("role", role)
        made.clicked.connect(call)
        return made

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.facts.set_tokens(tokens)
        self.list.set_tokens(tokens)

    @property
    def open(self) -> tuple[RuleDifference, ...]:
        """The differences that are neither taken nor refused."""
        comparison = self._answer.comparison if self._answer is not None else None
        found = comparison.differences if comparison is not None else ()
        return tuple(one for one in found if one not in self.refused)

    def show_answer(self, answer: RuleAnswer) -> None:
        """Show what is known of the rules that were read last."""
        self._answer = answer
        self.facts.show_rows(_fact_rows(answer.draft))
        self.write.setEnabled(answer.draft.blueprint is not None and answer.draft.whole)
        self._show_differences()

    def _show_differences(self) -> None:
        answer, found = self._answer, self.open
        at = self.list.currentIndex().row()
        self.list.show_rows([_difference_row(one, at) for at, one in enumerate(found[:MOST], 1)])
        if found and not self.list.currentIndex().isValid():
            self.list.setCurrentIndex(self.list.rows.index(min(max(at, 0), len(found[:MOST]) - 1)))
        compared = answer is not None and answer.comparison is not None
        kinds = [sum(one.kind == kind for one in found) for kind in KINDS]
        told = [f"{many} {word.lower()}" for many, word in zip(kinds, KINDS.values(), strict=True)
                if many]  # fmt: skip
        self._count.setText(", ".join(told) if compared else "")
        self.all.setText(f"Take all {min(len(found), MOST)}" if found else "Take all")
        self.all.setEnabled(bool(found))
        self.again.setVisible(bool(self.refused))
        self._show_chosen()
        self.shown.emit()

    def _show_chosen(self) -> None:
        chosen: RuleDifference | None = self.list.current_payload if self.open else None
        for button in (self.take, self.refuse):
            button.setEnabled(chosen is not None)
        self.take.setText(VERBS[chosen.kind] if chosen is not None else "Take")
        self.why.setText(WHY[chosen.kind] if chosen is not None else self._nothing())

    def _nothing(self) -> str:
        answer = self._answer
        if answer is None or answer.draft.branch is None:
            return "Nothing to compare: the rules give no states yet."
        if not answer.draft.whole:
            return "Nothing to compare: not all states of the rules are known."
        if answer.comparison is None:
            name = answer.draft.branch.name
            return f"Nothing to compare: the drawing has no states in {name}."
        same = counted(answer.comparison.same, "operation")
        left = f" {counted(len(self.refused), 'difference')} refused." if self.refused else ""
        return f"Rules and drawing agree: {same} the same in both.{left}"

    def _take_one(self) -> None:
        chosen = self.list.current_payload
        if chosen is not None:
            self.taken.emit((chosen,))

    def _take_all(self) -> None:
        self.taken.emit(self.open[:MOST])

    def _refuse_one(self) -> None:
        chosen = self.list.current_payload
        if chosen is not None:
            self.refused.add(chosen)
            self._show_differences()
            self.refusals_changed.emit()

    def set_refused(self, refused: set[RuleDifference]) -> None:
        """Take what was refused in another drawing."""
        self.refused = set(refused)
        self._show_differences()

    def _offer_again(self) -> None:
        self.refused.clear()
        self._show_differences()
        self.refusals_changed.emit()


def _fact_rows(draft: RuleDraft) -> list[ListRow]:
    rules = draft.rules
    if rules is None:
        return []
    rows = [
        ListRow(
            name,
            right=" ".join(values),
            mono=True,
            tip=f"{name}: {', '.join(values)}",
        )
        for name, values in rules.facts.items()
    ]
    if rules.never:
        rows.append(ListRow("Left out by “never”", kind="section"))
        counts = draft.combinations or ("",) * len(rules.never)
        for (text, _), count in zip(rules.never, counts, strict=True):
            said = f"{count:,}" if isinstance(count, int) else ""
            rows.append(ListRow(text, right=said, tip=f"{text}: {said or 'not counted'}"))
    return rows


def _difference_row(one: RuleDifference, number: int) -> ListRow:
    words = f"{number} {KINDS[one.kind]}: {one.state}, {one.operation}"
    return ListRow(words, one, right=one.target, severity="W" if one.kind == "odd" else "",
                   tip=f"{words} to {one.target}. {WHY[one.kind]}", mono=True)  # fmt: skip
