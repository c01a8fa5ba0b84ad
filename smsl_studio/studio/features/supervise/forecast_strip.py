"""The strip with the forecast of the operation at hand: agrees, differs, or why there is none."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QWidget

from smsl_studio.blueprint.address import split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.library.prediction import AGREES, DIFFERS
from smsl_studio.studio.base.controls import Elided, Label
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.forecaster import ForecastView, Values

HEIGHT, SIGN = 36, 16
EVIDENCE = "A forecast is no evidence; the state check decides."


class ForecastStrip(QWidget):
    """One line. The button looks for the forecast again."""

    anew_wanted = Signal()

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._sign_name = ""
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setFixedHeight(HEIGHT)
        self.setAccessibleName("Forecast")
        self._sign = Label()
        self._sign.setFixedSize(QSize(SIGN, SIGN))
        self.words = Elided()
        self.words.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.anew = QPushButton("Forecast anew")
        self.anew.setToolTip(tip_text("Try the operation once more from where the run stands"))
        self.anew.clicked.connect(self.anew_wanted)
        row = QHBoxLayout(self)
        row.setContentsMargins(14, 2, 10, 2)
        row.setSpacing(8)
        row.addWidget(self._sign)
        row.addWidget(self.words, 1)
        row.addWidget(self.anew)
        self.hide()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._show_sign()

    def show_forecast(self, blueprint: Blueprint | None, view: ForecastView | None,
                      now: Values, at_work: bool) -> None:  # fmt: skip
        """Show a forecast. ``now`` are the sensed facts, and while the operation is ``at_work``
        they may differ from those before it.
        """
        self.setVisible(blueprint is not None and view is not None)
        if blueprint is None or view is None:
            return
        old = not at_work and view.found is not None and dict(now) != dict(view.before)
        self._sign_name, words = _words(blueprint, view, old)
        self.anew.setVisible(view.found is not None and not at_work)
        self.words.setText(plain_text(words))
        whole = f"{words}\n{EVIDENCE}"
        self.setToolTip(tip_text(whole))
        self.setAccessibleDescription(plain_text(whole))
        self._show_sign()

    def _show_sign(self) -> None:
        t = self._tokens
        inks: dict[str, QColor] = {"check": t.ok, "close": t.bad, "unknown": t.unk, "clock": t.tx2}
        if self._sign_name:
            ink = inks[self._sign_name]
            self._sign.setPixmap(
                pixmap(self._sign_name, ink, t.surf, SIGN, self.devicePixelRatioF())
            )


def _words(blueprint: Blueprint, view: ForecastView, old: bool) -> tuple[str, str]:
    """Return the sign of a forecast, and its sentence."""
    edge, found = view.edge, view.found
    branch = blueprint[edge.branch]
    name = branch.operation_note(edge.state, edge.operation).title or edge.operation
    if found is None:
        return "clock", f"Forecast of {name}: looking"
    if old:
        return "unknown", f"Forecast of {name}: out of date, facts have changed since"
    if found.verdict == AGREES:
        changes = "; ".join(
            _change(blueprint, key, view.before.get(key), value)
            for key, value in found.after.items()
            if view.before.get(key) != value
        )
        return "check", f"Forecast of {name}: agrees. {changes or 'No fact changes'}"
    if found.verdict == DIFFERS:
        return "close", f"Forecast of {name}: differs. {found.reason}"
    return "unknown", f"No forecast of {name}: {found.reason}"


def _change(blueprint: Blueprint, key: str, before: str | None, after: str | None) -> str:
    """Return the change of a fact in words, with its name and the names of its values."""
    fact = split_fact(key)
    if fact is None or fact[0] not in blueprint.branches:
        return f"{key}: {before or 'unknown'} → {after or 'unknown'}"
    branch, digit = blueprint[fact[0]], fact[1]
    note = branch.fact_note(digit)
    named = dict(note.values) if note is not None and note.values else {}
    told = [named.get(one, one) if one is not None else "unknown" for one in (before, after)]
    return f"{branch.fact_name(digit)}: {told[0]} → {told[1]}"
