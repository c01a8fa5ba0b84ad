"""The page Sensors of the monitor: every sensor, node and state check of the run."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QMenu, QStackedWidget, QToolButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.check import FactKey
from smsl_studio.front.views.measure_traces import measured_of
from smsl_studio.front.views.monitor_rows import (
    Estimates,
    MonitorRow,
    monitor_rows,
    of_lost,
    summary,
)
from smsl_studio.monitor.disturbance import NONE
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.regulation import Commanded, FaultInjected
from smsl_studio.studio.base.controls import Elided, label, row, rule
from smsl_studio.studio.base.headed_page import HeadedPage
from smsl_studio.studio.base.panels import empty_panel, panel
from smsl_studio.studio.base.rows import RowsView
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital
from smsl_studio.studio.features.monitor.checks import Checks
from smsl_studio.studio.features.monitor.disturb_bar import KINDS, DisturbBar
from smsl_studio.studio.features.monitor.drift import DriftPanel
from smsl_studio.studio.features.monitor.fault_bar import FaultBar
from smsl_studio.studio.features.monitor.network import network_rows
from smsl_studio.studio.features.monitor.table import MonitorTable
from smsl_studio.studio.running.frames import head, split
from smsl_studio.studio.running.measure_plot import MeasurePlot
from smsl_studio.studio.running.run_session import RunSession

SIZE = 1240, 720
SIDE = 330
EMPTY = (
    "Starts with the run. Every sensor of every fact stands here then: what it reads, "
    "how old that is, and who says otherwise."
)


class MonitorPage(HeadedPage):
    """What is sensed in the present run of its window. ``head`` belongs above it."""

    def __init__(self, run: RunSession, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAccessibleName("Monitor")
        self._run = run
        self._estimates = Estimates()
        self._build(tokens)
        self.set_tokens(tokens)
        run.changed.connect(self.refresh)
        run.opened.connect(self._new_run)
        run.events_told.connect(self._hear)

    def _build(self, tokens: Tokens) -> None:
        self.words, self._refusal = Elided(), label("", "refusal")
        self._refusal.setWordWrap(False)
        self._time = label("", "second")
        self.table = MonitorTable(tokens)
        self.network = RowsView(tokens)
        self.network.setAccessibleName("Nodes and broker")
        self.network.setSelectionMode(RowsView.SelectionMode.NoSelection)
        self.checks, self.drift = Checks(tokens), DriftPanel(self._run, tokens)
        self.bar, self.faults = DisturbBar(), FaultBar()
        empty = label(EMPTY, "hint")
        empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        empty.setContentsMargins(48, 0, 48, 0)
        self._pages = QStackedWidget()
        self._pages.addWidget(self.table)
        self._pages.addWidget(empty)
        self.plot = MeasurePlot(tokens)
        self.setFocusProxy(self.table)
        self.table.row_chosen.connect(self._choose)
        self.table.disturb_wanted.connect(self._open_menu)
        self.bar.wanted.connect(self._disturb)
        self.faults.wanted.connect(self._inject)
        self.apart = QToolButton()
        self.apart.setProperty("role", "small")
        self.apart.setText("Own window")
        self.apart.setToolTip(tip_text("Open the monitor beside this window, or on another screen"))
        self.head.setLayout(row(self.words, self._refusal, self._time, self.apart))
        left, column = empty_panel()
        self._column = column
        for part in (self._pages, self.plot, rule(), self.bar, rule(), self.faults):
            column.addWidget(part, 1 if part is self._pages else 0)
        side = split(
            Qt.Orientation.Vertical,
            (panel(self.network), panel(head("State checks"), self.checks), self.drift),
            (250, 400, 260),
            (2, 3, 2),
        )
        side.setMinimumWidth(180)
        across = split(Qt.Orientation.Horizontal, (left, side), (SIZE[0] - SIDE, SIDE), (1, 0))
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addWidget(across, 1)

    # What is shown.

    def choose_fact(self, fact: FactKey) -> None:
        """Choose the row of a fact, so that its measures are plotted."""
        self.refresh()
        self.table.choose((fact[0], str(fact[1])))
        # The plot takes room of the table.
        self._column.activate()
        self.table.show_chosen()

    @property
    def rows(self) -> tuple[MonitorRow, ...]:
        """The rows of the table."""
        return self.table.model_of_rows.rows

    def refresh(self) -> None:
        """Show the present state of the run; nothing is computed while the page is hidden."""
        if not self.isVisible():
            return
        run = self._run
        status, blueprint = run.status, run.blueprint
        if status is None or blueprint is None or not status.configuration:
            self._show_nothing()
            return
        if run.phase == "failed":
            status = of_lost(status)
        estimates = self._estimates.of(blueprint, status)
        rows = monitor_rows(blueprint, status, estimates, self._kinds())
        self._pages.setCurrentIndex(0)
        self.table.show_rows(rows)
        self.checks.show_checks(blueprint, status, estimates)
        self._show_network()
        over = "" if run.exists else ". The run is over; this is how it ended"
        self.words.setText(f"{summary(rows)}{over}")
        self._time.setText(f"at {status.time:.1f} s")
        self._show_bar()
        self._show_plot()

    def _show_nothing(self) -> None:
        self._pages.setCurrentIndex(1)
        self.table.show_rows(())
        self.checks.show_checks(None, None, {})
        self._show_network()
        self.words.setText("Opening the world" if self._run.exists else "No run")
        self._time.setText("")
        self._show_bar()
        self._show_plot()

    def _show_network(self) -> None:
        self.drift.refresh()
        run = self._run
        world = run.choice.world if run.choice else ""
        rows = network_rows(world, run.exists, run.sensors, run.remote())
        self.network.show_rows(rows)

    def _choose(self, row: MonitorRow | None) -> None:
        """Show what the chosen row is about."""
        self._show_bar()
        self._show_plot()
        if row is not None and len(row.key) > 2:
            self.plot.choose(row.key[2])

    def _show_plot(self) -> None:
        """Plot the sources of the chosen fact, if predicates decide it."""
        run, row = self._run, self.table.chosen
        if run.blueprint is None or row is None or len(row.key) < 2:
            self.plot.show_measured(None)
            return
        fact = row.key[0], int(row.key[1])
        self.plot.show_measured(measured_of(run.blueprint, fact, run.story.history, run.time))

    def _show_bar(self) -> None:
        self.bar.show_row(self.table.chosen, self._run.exists)
        self.faults.show_faults(self._run.faults, self._run.exists)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        for part in (self.table, self.plot, self.network, self.checks, self.drift):
            part.set_tokens(tokens)
        self.refresh()

    def showEvent(self, event: QShowEvent) -> None:
        """Show the present state of the run."""
        super().showEvent(event)
        self.refresh()

    # Disturbing.

    def _kinds(self) -> dict[str, str]:
        disturbed = self._run.story.moment.disturbed
        return {sensor: ", ".join(kinds) for sensor, kinds in disturbed.items()}

    def _new_run(self) -> None:
        self._refusal.setText("")
        self.refresh()

    def _hear(self, events: tuple[Event, ...]) -> None:
        for event in events:
            if isinstance(event, Commanded) and event.command == "disturb":
                self._refusal.setText(capital(event.refused))
            elif isinstance(event, FaultInjected):
                self.faults.tell(event.fault, event.t)
            elif isinstance(event, Commanded) and event.command == "inject":
                self.faults.refuse(capital(event.refused))

    def _disturb(self, sensor: str, kind: str, parameters: dict[str, float | str]) -> None:
        self._run.disturb(sensor, kind, by=self._run.who(), **parameters)

    def _inject(self, fault: str, parameters: dict[str, float | str]) -> None:
        self._run.inject(fault, by=self._run.who(), **parameters)

    def _open_menu(self, chosen: MonitorRow, at: QPoint) -> None:
        """Offer every disturbance with its default parameter; the bar below can set another one."""
        if not chosen.sensor or not self._run.exists:
            return
        menu = QMenu(self)
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        for name, kind in KINDS.items():
            action = menu.addAction(kind.words, partial(self._disturb, chosen.sensor, name, {}))
            action.setToolTip(tip_text(kind.tip))
        menu.addSeparator()
        menu.addAction("End all", partial(self._disturb, chosen.sensor, NONE, {}))
        menu.popup(at)
