"""The twin of a run: a world beside it, in which each operation is tried before it begins.

The twin is built like the world of the run, with the same seed and robot, and begins each forecast
anew in the configuration of the run. So it knows neither faults of the run's world nor how exactly
things lie there: if it is wrong, that is told after the operation.

``Twin`` has its world in this process, as the run ``--host local`` has it. Every other run has its
twin in a process of its own (see ``twin_process``).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.configuration import Hierarchy
from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.dispatcher import Dispatcher
from smsl_studio.dispatch.drive.foresight import ASKS
from smsl_studio.errors import HostError, StudioError, WorldError
from smsl_studio.front.forecasts import Forecast, Watch, carried, terms_of
from smsl_studio.front.hosts import known_world, make_host
from smsl_studio.front.request import RunRequest
from smsl_studio.host.protocol import Host
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.prediction import AGREES, DIFFERS, NONE, Prediction
from smsl_studio.stop import Stopped
from smsl_studio.world.engines import REMOTE, TABLE

HARDWARE = "a world that is hardware"
LIVES = 3
"""After so many lost worlds, no further one is built."""


class Twin:
    """Predicts operations of one run. The world is built at the first forecast, in this process.

    ``loaded`` are plugins that were found before (see ``make_host``).
    """

    def __init__(self, request: RunRequest, loaded: Loaded | None = None) -> None:
        self._request = replace(
            request, by_hand=True, attended=True, supervisor=None, agents=(), host="local"
        )
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

        ``watch`` hears how far it is. Stopped if nobody waits any more; the
        world is kept.
        """
        if self._lost >= LIVES:
            return Prediction(NONE, reason=self._why)
        try:
            return self._tried(configuration, edge, watch)
        except StudioError as error:
            self.close()
            self._lost, self._why = self._lost + 1, error.sentence
            return Prediction(NONE, reason=error.sentence)
        except Stopped:
            # It was heeded between two ticks, and the next forecast opens the world again.
            raise
        except BaseException:
            self.close()
            raise

    def onward(self, edge: Address, watch: Watch | None = None) -> Prediction | None:
        """Carry out an operation from where the last forecast ended. None if it is not at its
        source there: it was part of the step before, or the forecast has ended.
        """
        there = self._there
        if there is None or there.standing.configuration.get(edge.branch) != edge.state:
            return None
        try:
            return self._carried(there, edge, watch)
        except StudioError as error:
            self.close()
            return Prediction(NONE, reason=error.sentence)
        except Stopped:
            raise
        except BaseException:
            self.close()
            raise

    def extend(self, blueprint: Blueprint) -> None:
        """Predict from now on with a blueprint that has one more edge, in a world that is built
        anew."""
        self.close()
        self._request = replace(self._request, blueprint=blueprint)
        self._hierarchy = Hierarchy(blueprint)

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
            try:
                refuse_what_is_real(self._request, self._loaded)
            except WorldError:
                self._lost = LIVES
                raise
            self._host = make_host(self._request, self._loaded)
        terms = terms_of(configuration, self._request.seed)
        blueprint = self._hierarchy.blueprint
        levels = Levels(blueprint, self._request.levels)
        dispatcher = Dispatcher(blueprint, self._host, terms, levels=levels)
        dispatcher.open()
        if dispatcher.finished:
            return Prediction(NONE, reason=dispatcher.standing.sentence)
        return self._carried(dispatcher, edge, watch)

    def _carried(self, dispatcher: Dispatcher, edge: Address, watch: Watch | None) -> Prediction:
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


def refuse_what_is_real(request: RunRequest, loaded: Loaded | None) -> None:
    """Raise WorldError for a world that cannot be there twice: a forecast would move it. No code of
    plugins runs for this."""
    world = request.world
    if world not in (REMOTE, TABLE) and loaded is None:
        loaded = known_world(world, request.plugin_paths, "process")
    if not may_be_tried(world, loaded):
        what = "a program that is somewhere else" if world == REMOTE else HARDWARE
        raise WorldError(f"{what} cannot be tried beforehand")


def may_be_tried(world: str, loaded: Loaded | None) -> bool:
    """Return whether a world may be there twice, so that its operations can be tried beforehand.
    ``loaded`` are the plugins, None if they are not known. An unknown world may: to build it is
    refused with the reason."""
    if world in (REMOTE, TABLE) or loaded is None or world not in loaded.worlds:
        return world != REMOTE
    return not loaded.world(world)[1].hardware


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
