"""Forecasts beside a run: an operation is tried in a twin of its world, in another process of low
priority. The run never waits for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

from PySide6.QtCore import QObject, QTimer, Signal

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.drive.foresight import sensed_values
from smsl_studio.dispatch.execution.status import DispatchStatus
from smsl_studio.front.request import RunRequest
from smsl_studio.front.views.forecast_words import Values
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.prediction import AGREES, Prediction
from smsl_studio.runlog.events import Event, ForecastTold, RunStarted
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.running.scene.ghost import EVERY
from smsl_studio.studio.running.scene.kept_poses import KeptPoses

QUIET = 150
"""Milliseconds without a change before a forecast begins."""
PACE = 500
"""Milliseconds between two looks at how far a forecast is."""
AHEAD = 3
"""So many operations of the route are forecast, the one at hand included."""
PARTS = 24
"""So many edges of the route are looked at for them: a step may have several."""

RESTS = ("ready", "paused", "waiting", "no_route", "fault_hold")
"""The run states in which an operation is proposed, and nothing is carried out."""


@dataclass(frozen=True)
class ForecastView:
    """The forecast of an operation from a configuration, None while it is looked for.

    ``before`` has the sensed facts (``SB/digit``) at the moment when it was asked for. ``then`` are
    the operations that follow on the route, each from where the one before ends. It ends at the
    first that differs or has no forecast. ``frames`` are the poses of the world on the way; None
    until it is found.
    """

    edge: Address
    before: Values
    found: Prediction | None = None
    then: tuple[tuple[Address, Prediction], ...] = ()
    frames: KeptPoses | None = None
    so_far: float = 0.0
    """How much of the operation was tried already, while it is looked for (simulated seconds)."""


def proposed(status: DispatchStatus | None) -> Address | None:
    """Return the operation that would begin next, while the run waits for somebody. None if there
    is none."""
    if status is None or status.phase not in RESTS or status.carrying is not None:
        return None
    return next(iter(status.route), None)


class Forecaster(QObject):
    """Keeps one forecast: that of the operation that was asked for last.

    The world of a run is built once, and kept until ``clear``.
    """

    changed = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        from smsl_studio.front.twin_process import TwinProcess

        self.view: ForecastView | None = None
        self.compared: list[ForecastTold] = []
        """What the run has told of its own forecasts."""
        self._make = TwinProcess
        self._twin: TwinProcess | None = None
        self._leaving: list[TwinProcess] = []
        """Twins that were given up and are not closed yet."""
        self._request: RunRequest | None = None
        self._key: tuple[object, ...] | None = None
        self._wanted: tuple[Mapping[str, str], Address] | None = None
        self._route: tuple[Address, ...] = ()
        self._left: list[Address] = []
        self._beside = Beside(self)
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.setInterval(QUIET)
        self._quiet.timeout.connect(self._look)
        self._looked = KeptPoses(EVERY)
        self._pace = QTimer(self)
        self._pace.setInterval(PACE)
        self._pace.timeout.connect(self._tell_pace)

    def hear(self, events: tuple[Event, ...]) -> None:
        """Keep what a run tells of its own forecasts, until another run begins."""
        if any(isinstance(one, RunStarted) for one in events):
            self.compared.clear()
        self.compared += [one for one in events if isinstance(one, ForecastTold)]

    def follow(
        self,
        asked: tuple[RunRequest, Loaded | None] | None,
        status: DispatchStatus | None,
        edge: Address | None,
    ) -> None:
        """Forecast this operation of this run, if that is not known or looked for already. None of
        the three ends it.
        """
        if asked is None or status is None or edge is None:
            self.clear()
            return
        request, loaded = asked
        key = (request, tuple(status.configuration.items()), edge)
        if key == self._key:
            return
        if request is not self._request:
            self._leave()
            self._request = request
            self._twin = self._make(request, loaded)
        self._key, self._wanted = key, (dict(status.configuration), edge)
        route = status.route
        self._route = route[route.index(edge) + 1 :][:PARTS] if edge in route else ()
        self.view = ForecastView(edge, sensed_values(status.scene))
        self._beside.drop()
        if self._twin is not None:
            self._beside.do(self._twin.begin, lambda _: None)
        self._quiet.start()
        self.changed.emit()

    def anew(self, status: DispatchStatus | None) -> None:
        """Look again for the forecast that is shown."""
        if self.view is not None and status is not None and self._wanted is not None:
            self.view = ForecastView(self.view.edge, sensed_values(status.scene))
            self._beside.drop()
            self._quiet.start()
            self.changed.emit()

    def clear(self) -> None:
        """Show no forecast, and give the world up."""
        if self._key is not None or self._twin is not None:
            self._leave()
            self._key = self._wanted = self._request = self.view = None
            self.changed.emit()

    def close(self) -> None:
        """Give everything up; no further result arrives."""
        self._leave()
        self._beside.stop()
        for twin in self._leaving:
            # Not in the thread that uses it, which takes no further task.
            twin.close()
        self._leaving.clear()

    def _tell_pace(self) -> None:
        """Tell how far the forecast is that is looked for."""
        if self.view is None or self.view.found is not None:
            self._pace.stop()
        elif self._looked.seconds > self.view.so_far:
            self.view = replace(self.view, so_far=self._looked.seconds)
            self.changed.emit()

    def _leave(self) -> None:
        self._quiet.stop()
        self._pace.stop()
        self._beside.drop()
        twin, self._twin = self._twin, None
        if twin is not None:
            # In the thread that uses it.
            self._leaving.append(twin)
            self._beside.do(twin.close, lambda _: self._leaving.remove(twin))

    def _look(self) -> None:
        twin, wanted = self._twin, self._wanted
        if twin is not None and wanted is not None:
            self._left = [*self._route]
            frames = self._looked = KeptPoses(EVERY)
            self._pace.start()
            self._beside.do(lambda: twin.predict(*wanted, frames.add), partial(self._take, frames))

    def _take(self, frames: KeptPoses, found: Prediction) -> None:
        if self.view is not None:
            self.view = replace(self.view, found=found, then=(), frames=frames)
            self.changed.emit()
            self._go_on()

    def _go_on(self) -> None:
        """Look for the forecast of the next operation of the route."""
        view, twin = self.view, self._twin
        if view is None or twin is None or not self._left or len(view.then) >= AHEAD - 1:
            return
        last = view.then[-1][1] if view.then else view.found
        if last is not None and last.verdict == AGREES:
            edge = self._left.pop(0)
            self._beside.do(lambda: twin.onward(edge), partial(self._take_next, edge))

    def _take_next(self, edge: Address, found: Prediction | None) -> None:
        if self.view is None:
            return
        if found is not None:
            self.view = replace(self.view, then=(*self.view.then, (edge, found)))
            self.changed.emit()
        self._go_on()
