"""The bar that disturbs a sensor on purpose: the kind of disturbance and its parameter."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QWidget

from smsl_studio.errors import UsageError
from smsl_studio.front.views.monitor_rows import GROUP, MonitorRow
from smsl_studio.legible import plain_text
from smsl_studio.monitor.disturbance import NONE, PARAMETERS, Parameter, checked
from smsl_studio.studio.base.controls import Combo, Elided, Field, label
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital

CHOOSE = "Choose a row to disturb its sensor"
NO_RUN = "Sensors can be disturbed while a run is there"
NO_SENSOR = "Nothing senses this fact, so nothing can be disturbed"


@dataclass(frozen=True)
class _Kind:
    words: str
    suffix: str
    tip: str


KINDS = {
    "stuck": _Kind("Stuck", "value", "It always reads this value; empty: its first reading"),
    "drift": _Kind("Drift", "s", "After each time this many seconds it reads the next value"),
    "noise": _Kind("Noise", "share", "This share of its samples, 0 to 1, reads a wrong value"),
    "dropout": _Kind("Dropout", "share", "This share of its samples, 0 to 1, is lost"),
    "delay": _Kind("Delay", "s", "Its samples arrive this many seconds late"),
}  # fmt: skip


class DisturbBar(QWidget):
    """A bar below the table, about the sensor of the selected row."""

    wanted = Signal(str, str, object)
    """(sensor or fact, kind, parameters)."""

    def __init__(self) -> None:
        super().__init__()
        self._row: MonitorRow | None = None
        self._shown: object = ""
        self.kind = Combo()
        self.kind.setAccessibleName("What goes wrong")
        for name, kind in KINDS.items():
            self.kind.addItem(kind.words, name)
        self.kind.setFixedWidth(104)
        self.kind.currentIndexChanged.connect(self._show_kind)
        self.parameter = Field()
        self.parameter.setFixedWidth(104)
        self.parameter.returnPressed.connect(self.switch)
        self.on = QPushButton("Disturb")
        self.on.clicked.connect(self.switch)
        self.off = QPushButton("End all")
        self.off.setToolTip("End every disturbance of this sensor")
        self.off.clicked.connect(lambda: self._ask(NONE, {}))
        for button in (self.on, self.off):
            button.setAutoDefault(False)
        self._who = Elided()
        self._refusal = label("", "refusal")
        self._refusal.setWordWrap(False)
        across = QHBoxLayout(self)
        across.setContentsMargins(12, 8, 12, 8)
        across.setSpacing(8)
        across.addWidget(self._who, 1)
        for part in (self._refusal, self.kind, self.parameter, self.on, self.off):
            across.addWidget(part)
        self._show_kind()
        self.show_row(None, False)

    def show_row(self, row: MonitorRow | None, runs: bool) -> None:
        """Set the row that the bar is about; ``runs`` says whether there is a run."""
        key = (row.key if row else None, runs)
        if key == self._shown:
            return
        self._row, self._shown = row, key
        nothing = row is None or row.kind == GROUP
        words = NO_RUN if not runs else CHOOSE if nothing else NO_SENSOR
        able = runs and row is not None and bool(row.sensor)
        if row is not None and able:
            several = "every sensor of " if "/" in row.sensor else ""
            words = f"Disturb {several}{row.sensor}"
        self._who.setText(words)
        self._who.setToolTip(tip_text(words))
        for part in (self.kind, self.parameter, self.on, self.off):
            part.setEnabled(able)
        self._refuse("")

    @property
    def refusal(self) -> str:
        """Why the typed parameter is refused; empty if it is not."""
        return self._refusal.text()

    def switch(self) -> None:
        """Ask for the chosen disturbance, if its parameter is valid."""
        kind = self.kind.currentData()
        try:
            parameters = self._parameters(kind)
            checked(kind, parameters)
        except UsageError as error:
            self._refuse(capital(error.sentence))
            return
        self._refuse("")
        self._ask(kind, parameters)

    def _ask(self, kind: str, parameters: dict[str, Parameter]) -> None:
        if self._row is not None and self._row.sensor:
            self.wanted.emit(self._row.sensor, kind, parameters)

    def _parameters(self, kind: str) -> dict[str, Parameter]:
        name, text = PARAMETERS[kind][0], self.parameter.text().strip()
        if not text:
            return {}
        if kind == "stuck":
            return {name: text}
        try:
            return {name: float(text)}
        except ValueError:
            raise UsageError(f"{text} is no number") from None

    def _show_kind(self) -> None:
        name = self.kind.currentData()
        kind, default = KINDS[name], PARAMETERS[name][1]
        self.kind.setToolTip(tip_text(kind.tip))
        self.parameter.setToolTip(tip_text(kind.tip))
        self.parameter.setAccessibleName(plain_text(f"{kind.words}, {kind.suffix}"))
        self.parameter.set_suffix(kind.suffix)
        self.parameter.settle("" if default is None else f"{default:g}")
        self._refuse("")

    def _refuse(self, words: str) -> None:
        self._refusal.setText(words)
        self._refusal.setVisible(bool(words))
        self.parameter.set_refused(bool(words))
