"""The strip with the forecast of the operation at hand: agrees, differs, or why there is none."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QSizePolicy, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.forecast_words import (
    Values,
    differs_words,
    operation_name,
    verdict_words,
)
from smsl_studio.legible import plain_text
from smsl_studio.library.prediction import AGREES, NONE
from smsl_studio.studio.base.controls import Elided, Label
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.supervise.card import CardForecast
from smsl_studio.studio.running.forecaster import ForecastView

HEIGHT, SIGN, ONWARD = 36, 16, 22
"""The height of the first line, its sign, and the height of the second line (pixels)."""
EVIDENCE = "A forecast is no evidence; the state check decides."


class ForecastStrip(QWidget):
    """One line, and a second one for the operations that follow on the route. The button looks for
    the forecast again.
    """

    anew_wanted = Signal()

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._sign_name = ""
        self._current: ForecastView | None = None
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
        first = QWidget()
        first.setFixedHeight(HEIGHT)
        row = QHBoxLayout(first)
        row.setContentsMargins(14, 2, 10, 2)
        row.setSpacing(8)
        row.addWidget(self._sign)
        row.addWidget(self.words, 1)
        row.addWidget(self.anew)
        self.onward = Elided()
        self.onward.setProperty("role", "second")
        self.onward.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.onward.setContentsMargins(14 + SIGN + 8, 0, 10, 4)
        self.onward.setFixedHeight(ONWARD)
        self.onward.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(first)
        column.addWidget(self.onward)
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
        self._current = None
        if blueprint is None or view is None:
            return
        old = not at_work and view.found is not None and dict(now) != dict(view.before)
        self._current = None if old else view
        self._sign_name, words = _words(blueprint, view, old)
        self.anew.setVisible(view.found is not None and not at_work)
        self.words.setText(plain_text(words))
        onward = "" if old else _onward(blueprint, view)
        self.onward.setText(plain_text(onward))
        self.onward.setVisible(bool(onward))
        self.setFixedHeight(HEIGHT + (ONWARD if onward else 0))
        lines = (words, view.found.reason if view.found is not None else "", onward, EVIDENCE)
        whole = "\n".join(line for line in lines if line)
        self.setToolTip(tip_text(whole))
        self.setAccessibleDescription(plain_text(whole))
        self._show_sign()

    def card_words(self, blueprint: Blueprint | None) -> CardForecast | None:
        """What the card of the operation says about its forecast. None if that says nothing."""
        view = self._current
        if blueprint is None or view is None or view.found is None or view.found.verdict == NONE:
            return None
        agrees = view.found.verdict == AGREES
        words = "" if agrees else differs_words(blueprint, view.found)
        return CardForecast(view.edge, agrees, words)

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
    found = view.found
    name = operation_name(blueprint, view.edge)
    if found is None:
        far = f", {view.so_far:.1f} s so far" if view.so_far else ""
        return "clock", f"Forecast of {name}: looking{far}"
    if old:
        return "unknown", f"Forecast of {name}: out of date, facts have changed since"
    if found.verdict == NONE:
        return "unknown", f"No forecast of {name}: {found.reason}"
    sign = "check" if found.verdict == AGREES else "close"
    return sign, f"Forecast of {name}: {verdict_words(blueprint, view.before, found)}"


def _onward(blueprint: Blueprint, view: ForecastView) -> str:
    """Return the forecasts of the operations that follow on the route, in one line."""
    told, before = [], view.found.after if view.found is not None else {}
    for number, (edge, found) in enumerate(view.then, 2):
        words = verdict_words(blueprint, before, found)
        told.append(f"{number}  {operation_name(blueprint, edge)} {words}")
        before = found.after
    return "    ".join(told)
