"""The twin of a run: a world beside it, in which each operation is tried before it begins.

The twin is built like the world of the run, with the same seed and robot, and begins each forecast
anew in the configuration of the run. So it knows neither faults of the run's world nor how exactly
things lie there: if it is wrong, that is told after the operation. It is a world of its own, and
with ``host="process"`` a process of its own, so nothing in it touches the run.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.continuum import FORECAST_LEVELS
from smsl_studio.blueprint.levels import Levels
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.foresight import ASKS, Foresight
from smsl_studio.errors import HostError, StudioError, UsageError, WorldError, did_you_mean
from smsl_studio.front.forecasts import Forecast, Watch, carried, terms_of
from smsl_studio.front.hosts import known_world, make_host
from smsl_studio.front.request import RunRequest
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.prediction import AGREES, DIFFERS, NONE, Prediction
from smsl_studio.world.engines import REMOTE, TABLE

LOW = 10
"""The priority (nice) of a gentle twin."""
TURN = 0.0005
"""Seconds after which the thread of a gentle twin lets others of the program have the interpreter.
With Python's own 5 ms, ticks of the run began late while a forecast was made beside it."""
USUAL_TURN = sys.getswitchinterval()
HARDWARE = "a world that is hardware"
LIVES = 3
"""After so many lost worlds, no further one is built."""


class Twin:
    """Predicts operations of one run. The world is built at the first forecast.

    ``loaded`` are plugins that were found before (see ``make_host``). A ``gentle`` twin in a
    process of its own has a low priority, and its thread lets the others go first often, so that
    it takes no time from the run.
    """

    def __init__(
        self, request: RunRequest, loaded: Loaded | None = None, gentle: bool = False
    ) -> None:
        self._gentle = gentle
        self._request = replace(request, by_hand=True, attended=True, supervisor=None, agents=())
        self._hierarchy = Hierarchy(request.blueprint)
        self._loaded = loaded
        self._host: Host | None = None
        self._there: Dispatcher | None = None
        """The run in which the last forecast ended, None if it does not go on from there."""
        self._lost = 0
        self._why = ""

    def predict(
        self, configuration: Mapping[str, str], edge: Address, watch: Watch | None = None
    ) -> Prediction:
        """Carry out an operation from a configuration. A world that breaks gives no forecast.

        ``watch`` gets the poses of the world on the way.
        """
        if self._lost >= LIVES:
            return Prediction(NONE, reason=self._why)
        try:
            with _short_turns(self._gentle):
                return self._tried(configuration, edge, watch)
        except StudioError as error:
            self.close()
            self._lost, self._why = self._lost + 1, error.sentence
            return Prediction(NONE, reason=error.sentence)
        except BaseException:
            self.close()
            raise

    def onward(self, edge: Address) -> Prediction | None:
        """Carry out an operation from where the last forecast ended. None if it is not at its
        source there: it was part of the step before, or the forecast has ended.
        """
        there = self._there
        if there is None or there.standing.configuration.get(edge.branch) != edge.state:
            return None
        try:
            with _short_turns(self._gentle):
                return self._carried(there, edge)
        except StudioError as error:
            self.close()
            return Prediction(NONE, reason=error.sentence)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Free the world. A second call does nothing; a later forecast builds it again."""
        host, self._host, self._there = self._host, None, None
        if host is not None:
            host.close()

    def _tried(
        self, configuration: Mapping[str, str], edge: Address, watch: Watch | None
    ) -> Prediction:
        self._there = None
        if self._host is None:
            self._refuse_what_is_real()
            self._host = make_host(self._request, self._loaded)
        terms = terms_of(configuration, self._request.seed)
        blueprint = self._hierarchy.blueprint
        levels = Levels(blueprint, self._request.levels)
        dispatcher = Dispatcher(blueprint, self._host, terms, levels=levels)
        dispatcher.open()
        if self._gentle:
            _yield_to_others(self._host)
        if dispatcher.finished:
            return Prediction(NONE, reason=dispatcher.standing.sentence)
        return self._carried(dispatcher, edge, watch)

    def _carried(
        self, dispatcher: Dispatcher, edge: Address, watch: Watch | None = None
    ) -> Prediction:
        assert self._host is not None, "the world of the dispatcher is open"
        self._there = None
        found = carried(self._hierarchy, self._host, dispatcher, edge, watch)
        if dispatcher.finished:
            raise HostError(dispatcher.standing.sentence)
        if dispatcher.phase == "waiting":
            return ASKS
        told = _compared(found)
        if told.verdict == AGREES:
            self._there = dispatcher
        return told

    def _refuse_what_is_real(self) -> None:
        """Raise WorldError for a world that cannot be there twice: a forecast would move it."""
        world, paths = self._request.world, self._request.plugin_paths
        loaded = self._loaded
        if world not in (REMOTE, TABLE) and loaded is None:
            loaded = known_world(world, paths, "process")
        if not may_be_tried(world, loaded):
            self._lost = LIVES
            what = "a program that is somewhere else" if world == REMOTE else HARDWARE
            raise WorldError(f"{what} cannot be tried beforehand")


def may_be_tried(world: str, loaded: Loaded | None) -> bool:
    """Return whether a world may be there twice, so that its operations can be tried beforehand.
    ``loaded`` are the plugins, None if they are not known. An unknown world may: to build it is
    refused with the reason."""
    if world in (REMOTE, TABLE) or loaded is None or world not in loaded.worlds:
        return world != REMOTE
    return not loaded.world(world)[1].hardware


@contextmanager
def _short_turns(gentle: bool) -> Iterator[None]:
    """Let the threads of this program take shorter turns for a while, if ``gentle``."""
    if gentle:
        sys.setswitchinterval(TURN)
    try:
        yield
    finally:
        sys.setswitchinterval(USUAL_TURN)


def _yield_to_others(host: Host) -> None:
    """Give the process of a host a low priority, if it has one."""
    pid = getattr(host, "pid", None)
    if isinstance(pid, int):
        with suppress(OSError):  # it may have ended, or the system has no priorities
            os.setpriority(os.PRIO_PROCESS, pid, LOW)


def foresight_of(request: RunRequest, loaded: Loaded | None) -> Foresight:
    """Return the forecasts of a run. UsageError for an unknown level. The empty level leaves it to
    the blueprint."""
    if request.forecast not in ("", *FORECAST_LEVELS):
        near = did_you_mean(request.forecast, FORECAST_LEVELS)
        near = near or f"There are {', '.join(FORECAST_LEVELS)}."
        raise UsageError(f"there is no level of forecasts {request.forecast!r}", advice=near)
    return Foresight(Twin(request, loaded), request.forecast)


def _compared(found: Forecast) -> Prediction:
    """Return a forecast as supervisors see it, with what differs in words."""
    apart = tuple(key for key, value in found.declared.items() if found.after.get(key) != value)
    words = [
        f"{key} will be {found.after[key] or 'unknown'}, not {found.declared[key] or 'unknown'}"
        for key in apart
    ]
    if found.sentence:
        words.append(found.sentence)
    if found.hazard:
        words.append(f"the hazard {found.hazard} will be met")
    good = found.agrees and not found.hazard
    if good:
        return Prediction(AGREES, found.after)
    return Prediction(DIFFERS, found.after, "; ".join(words), apart=apart)
