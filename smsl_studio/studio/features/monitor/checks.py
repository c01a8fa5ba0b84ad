"""State checks in the paper's notation, with the truth of every term, for every SB of the run."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QScrollArea, QSizePolicy, QVBoxLayout, QWidget

from smsl_studio.blueprint.check import CheckResult, state_check
from smsl_studio.blueprint.estimate import Estimate
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.written_check import WrittenCheck, written_check
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.views.monitor_rows import estimate_words, moved, short
from smsl_studio.legible import markup, plain_text
from smsl_studio.studio.base.controls import Label, label
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import Tokens

SIGNS = {True: "✓", False: "✗", None: "?"}
WORDS = {True: "true", False: "not true", None: "unknown"}
EMPTY = "Starts with the run. Each state check is written here as lambda s: [f1(s), f2(s)]."


class CheckCard(QWidget):
    """The check of one state: its formula, its terms one by one, and the state estimated from
    sensors."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens = tokens
        column = QVBoxLayout(self)
        column.setContentsMargins(12, 8, 12, 10)
        column.setSpacing(4)
        self.heading = label("", "strong")
        self.estimate = label("", "small")
        self.written, self.terms = Label(rich=True), Label(rich=True)
        for part in (self.heading, self.estimate, self.written, self.terms):
            part.setWordWrap(True)
            part.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
            column.addWidget(part)
        for rich in (self.written, self.terms):
            rich.setProperty("role", "terms")
        self._shown: object = None

    def show_check(self, written: WrittenCheck, which: str, where: str) -> None:
        """Show a check.

        ``which`` says of which state it is, such as "SB1, awaited aab". ``where`` is the state that
        the sensors suggest.
        """
        key = (written, which, where, self.tokens.name)
        if key == self._shown:
            return
        self._shown = key
        self.heading.setText(f"{which}: {WORDS[written.truth]}")
        self.estimate.setText(f"By its sensors: {where}" if where else "")
        self.written.setText(self._written(written))
        rows = (self._row(written, at) for at in range(len(written.terms)))
        self.terms.setText(f"<table cellspacing=0 cellpadding=2>{''.join(rows)}</table>")
        why = "; ".join(f"{term.text} {WORDS[term.truth]}, {term.why}" for term in written.terms)
        self.setAccessibleName(
            plain_text(f"{which}: {written.text}, {WORDS[written.truth]}: {why}")
        )

    def _written(self, written: WrittenCheck) -> str:
        html, at = f"{markup(short(written.name))} := ", 0
        for term in written.terms:
            html += markup(written.text[at : term.start])
            colour, words = self._colour(term.truth), markup(term.text)
            html += f'<span style="color:{colour}"><b>{SIGNS[term.truth]}</b>&nbsp;{words}</span>'
            at = term.end
        return html + markup(written.text[at:])

    def _row(self, written: WrittenCheck, at: int) -> str:
        term = written.terms[at]
        mark = f"{SIGNS[term.truth]}&nbsp;{markup(term.text)}"
        colour = self._colour(term.truth)
        why = markup(term.why)
        return f'<tr><td style="color:{colour}">{mark}&nbsp;</td><td>{why}</td></tr>'

    def _colour(self, truth: bool | None) -> str:
        t = self.tokens
        return {True: t.ok, False: t.bad, None: t.unk}[truth].name()


class Checks(QScrollArea):
    """A card for every SB. The card of the awaited check says so."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.cards: dict[str, CheckCard] = {}
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("State checks")
        FocusLine(self)
        inside = QWidget()
        inside.setProperty("role", "panel")
        self._column = QVBoxLayout(inside)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(0)
        self._empty = label(EMPTY, "hint")
        self._empty.setContentsMargins(12, 8, 12, 8)
        self._column.addWidget(self._empty)
        self._column.addStretch(1)
        self.setWidget(inside)

    def show_checks(
        self, blueprint: Blueprint | None, status: DispatchStatus | None,
        estimates: Mapping[str, Estimate],
    ) -> None:  # fmt: skip
        """Show the check of every SB; without a status there is no run."""
        names = tuple(status.configuration) if blueprint and status else ()
        if names != tuple(self.cards):
            self._make(names)
        if blueprint is None or status is None:
            return
        for name, card in self.cards.items():
            awaited = status.check if status.check and status.check.branch == name else None
            check = awaited or _of_active(blueprint, status, name)
            ahead = awaited is not None and awaited.state != status.configuration[name]
            which = f"{name}, {'awaited' if ahead else 'active'} {short(check.state)}"
            found = estimates.get(name)
            where = estimate_words(found, moved(status, name)) if found else ""
            card.show_check(written_check(blueprint, check), which, where)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for card in self.cards.values():
            card.tokens = tokens

    def _make(self, names: tuple[str, ...]) -> None:
        for card in self.cards.values():
            self._column.removeWidget(card)
            card.deleteLater()
        self.cards = {name: CheckCard(self._tokens) for name in names}
        for at, card in enumerate(self.cards.values()):
            self._column.insertWidget(at, card)
        self._empty.setVisible(not names)


def _of_active(blueprint: Blueprint, status: DispatchStatus, name: str) -> CheckResult:
    believed = status.configuration
    return state_check(blueprint, name, believed[name], status.scene, believed)
