"""The view of the state check, term by term: true, false or not yet known."""

from __future__ import annotations

from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QVBoxLayout, QWidget

from smsl_studio.blueprint.check import CheckResult
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import markup
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.theme import Tokens

SIGNS = {True: "✓", False: "✗", None: "…"}
SO_FAR = "True so far"
VERDICTS = {True: ("True", "good"), False: ("Not true", "held"), None: ("Not yet known", "unknown")}


class StateCheckView(QWidget):
    """Shows C_state(s) of the target while an operation runs, otherwise of the active state."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 8, 12, 10)
        column.setSpacing(6)
        first = QHBoxLayout()
        first.addWidget(label("State check", "heading"))
        self._name = label("", "mono")
        first.addWidget(self._name, 1)
        self._verdict = Label()
        self._verdict.setProperty("role", "phase")
        first.addWidget(self._verdict)
        column.addLayout(first)
        self._terms = Label(rich=True)
        self._terms.setWordWrap(True)
        self._terms.setProperty("role", "terms")
        column.addWidget(self._terms)
        self._why = label("", "hint")
        column.addWidget(self._why)
        self._shown: object = None
        self.show_check(None, None, waiting=False)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens, self._shown = tokens, None

    def show_check(
        self, blueprint: Blueprint | None, check: CheckResult | None, waiting: bool
    ) -> None:
        """Show one result; ``waiting`` says that the operation to that state still runs."""
        key = (check, waiting, blueprint is None)
        if key == self._shown:
            return
        self._shown = key
        self._verdict.setVisible(check is not None)
        self._terms.setVisible(check is not None)
        if check is None or blueprint is None:
            self._name.setText("")
            self._terms.setText("")
            self._why.setText(
                "Nothing is sensed, so no state can be checked."
                if blueprint is not None
                else "Starts with the run. What an operation returns is not evidence."
            )
            return
        truth = None if waiting and check.truth is False else check.truth
        words, kind = VERDICTS[truth]
        if truth is None and not waiting:
            words = "Unknown"
        if truth is True and waiting:
            words, kind = SO_FAR, "unknown"
        self._verdict.setText(f"✓ {words}" if kind == "good" else words)
        self._verdict.setProperty("kind", kind)
        self._verdict.style().unpolish(self._verdict)
        self._verdict.style().polish(self._verdict)
        self._name.setText(check.state)
        self._terms.setText("&nbsp;&nbsp; ".join(self._term(blueprint, check, waiting)))
        self._why.setText(
            "Decided when the operation ends and the facts have settled. "
            "What the operation returns is not evidence."
            if waiting
            else "; ".join(term.reason for term in check.unknown if term.reason)
        )

    def _term(self, blueprint: Blueprint, check: CheckResult, waiting: bool) -> list[str]:
        t = self._tokens
        branch = blueprint[check.branch]
        found = []
        for term in check.terms:
            truth = None if waiting and term.truth is False else term.truth
            colour = {True: t.ok, False: t.bad, None: t.acc if waiting else t.unk}[truth]
            name = branch.fact_name(term.fact[1]).lower() if term.fact[0] == branch.name else ""
            words = f"{SIGNS[truth]} {name or term.fact[0]} = {term.wanted}"
            safe = markup(words).replace(" ", "&nbsp;")
            found.append(f'<span style="color:{colour.name()}">{safe}</span>')
        return found
