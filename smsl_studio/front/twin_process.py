"""The process of a twin, seen from the run: it is asked for forecasts, and ended if it hangs.

World, code of plugins and driver of the twin are all in the child. So while a forecast is made, the
run only hears now and then how far it is. A child that dies or hangs costs that forecast.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.continuum import FORECAST_LEVELS
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.drive.foresight import Foresight
from smsl_studio.errors import HostError, StudioError, UsageError, did_you_mean
from smsl_studio.front.hosts import recipe_of
from smsl_studio.front.request import RunRequest
from smsl_studio.front.twin import LIVES, Twin, refuse_what_is_real
from smsl_studio.front.twin_child import CALL_OFF, REFUSAL, TOLD, TwinAsked, answer_of
from smsl_studio.host.answers import CRASHED, LOADS
from smsl_studio.host.codec import Unfit
from smsl_studio.host.exit_words import ending_words
from smsl_studio.host.patience import Patience
from smsl_studio.host.started_child import Child, start_child
from smsl_studio.host.wire import NoAnswer, WireFrame
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.prediction import NONE, Prediction
from smsl_studio.stop import Stopped, heed, starving, unheeding

Watch = Callable[[float, tuple[float, ...]], None]
"""Gets the simulated seconds since an operation began and the poses of the world (see
``Host.poses``), for some moments of a forecast."""
CHILD = "smsl_studio.front.twin_child"
OPEN_LIMIT = 60.0
"""The time (s) without a word from the child while it loads the plugins, and until the first word
of a forecast for which it may have to build the world. All limits are wall time in which it could
have worked."""
HANG_LIMIT = 10.0
"""The time (s) without a word from the child in a forecast once its world stands."""
LOOK = 0.05
"""The wall time (s) between two looks at the child and at a stop."""


class TwinProcess:
    """Predicts operations of one run in a child process. It starts at the first forecast.

    ``loaded`` are plugins that were found before. One thread asks; any thread may call ``close``.
    """

    def __init__(self, request: RunRequest, loaded: Loaded | None = None) -> None:
        self._request, self._loaded = request, loaded
        self._codec = answer_of(request.blueprint)
        self._asks: TwinAsked | None = None
        self._child: Child | None = None
        self._owed: str = ""
        """The verb of a command whose answer nobody has read yet."""
        self._stands = False
        """Whether the child has a world. It builds another one after a forecast that broke."""
        self._lost = 0
        self._why = ""
        self._closing = False
        self._using = threading.RLock()

    @property
    def pid(self) -> int | None:
        """The process number of the child. None if there is no child."""
        child = self._child
        return child.pid if child is not None else None

    def begin(self) -> None:
        """Let a child load the plugins, if there is none. It does not wait for that."""
        with self._using, suppress(StudioError):  # the forecast tells it
            if self._child is None and self._lost < LIVES:
                self._start()

    def predict(
        self, configuration: Mapping[str, str], edge: Address, watch: Watch | None = None
    ) -> Prediction:
        """Carry out an operation from a configuration. A child that is lost gives no forecast.

        ``watch`` gets the poses of the world on the way. Stopped if nobody waits any more; the
        child is kept.
        """
        if self._lost >= LIVES:
            return Prediction(NONE, reason=self._why)
        asked = ("predict", dict(configuration), edge, watch is not None)
        found = self._found(asked, watch)
        return found if found is not None else Prediction(NONE, reason="it gave no forecast")

    def onward(self, edge: Address) -> Prediction | None:
        """Carry out an operation from where the last forecast ended (see ``Twin.onward``)."""
        return self._found(("onward", edge)) if self._child is not None else None

    def extend(self, blueprint: Blueprint) -> None:
        """Predict from now on with a blueprint that has one more edge, in another child."""
        self.close()
        with self._using:
            self._request = replace(self._request, blueprint=blueprint)
            self._codec, self._asks = answer_of(blueprint), None

    def close(self) -> None:
        """End the child. A second call does nothing; a later forecast starts another one."""
        self._closing = True
        with self._using:
            self._closing = False
            self._end()

    def _found(self, asked: tuple[object, ...], watch: Watch | None = None) -> Prediction | None:
        with self._using:
            try:
                return self._asked(asked, watch)
            except StudioError as error:
                self._lost, self._why = self._lost + 1, error.sentence
                return Prediction(NONE, reason=error.sentence)
            except Stopped:
                self._call_off()
                raise
            except BaseException:
                self._end()
                raise

    def _asked(self, asked: tuple[object, ...], watch: Watch | None) -> Prediction | None:
        """Return the answer to a command. HostError if the child is lost, WorldError and others if
        there cannot be a twin."""
        if self._child is None:
            self._start()
        assert self._child is not None
        verb, *arguments = asked
        try:
            if self._owed:
                self._settle(self._child)
            self._child.wire.send(str(verb), arguments)
            self._owed = str(verb)
            frame = self._heard(self._child, watch)
            if frame.kind == "ok":
                found = self._codec.decode(frame.body)
                self._stands = found is None or found.verdict != NONE
                return found
            raise NoAnswer(f"it says {frame.kind}")
        except TimeoutError as error:
            raise self._lose(f"did not answer for {error}") from None
        except (EOFError, OSError):
            raise self._lose(ending_words(self._child.ending())) from None
        except (NoAnswer, Unfit) as error:
            raise self._lose(f"said what is no forecast: {error}") from None

    def _start(self) -> None:
        asked = self._asks or self._what_is_asked()
        try:
            self._child = start_child(CHILD)
        except OSError as error:
            words = error.strerror or error
            raise HostError(f"the forecast process cannot be started: {words}") from None
        self._child.tell("prepare", (asked,))
        self._owed = "prepare"

    def _what_is_asked(self) -> TwinAsked:
        request = self._request
        try:
            refuse_what_is_real(request, self._loaded)
            recipe = recipe_of(request, self._loaded)
        except StudioError:
            self._lost = LIVES - 1  # it does not change
            raise
        self._asks = TwinAsked(recipe, dict(request.levels))
        return self._asks

    def _settle(self, child: Child) -> None:
        """Read the answer to the command before. HostError if the plugins cannot be loaded."""
        loading = self._owed == "prepare"
        child.told()
        frame = self._heard(child)
        if loading and frame.kind == "refused":
            words = REFUSAL.decode(frame.body)
            self._end()
            raise HostError(words)

    def _heard(self, child: Child, watch: Watch | None = None) -> WireFrame:
        """Return the frame that ends the answer, and tell ``watch`` what comes before it.
        TimeoutError with the time if nothing is heard for too long."""
        loading = self._owed == "prepare"
        silence = Patience(HANG_LIMIT if self._stands else OPEN_LIMIT)
        child.starved()  # only time from now on counts
        while True:
            frame = child.heard(LOOK)
            if self._closing:
                raise Stopped
            if frame is not None and frame.kind != "loads":
                self._owed = ""
                if frame.kind == "crashed":
                    raise self._lose(f"broke: {CRASHED.decode(frame.body)}")
                return frame
            if frame is not None:
                self._hear(frame, loading, watch)
                self._stands = not loading
                silence = Patience(HANG_LIMIT if self._stands else OPEN_LIMIT)
            with starving(child.starved()):
                heed()
            silence.look(shut_out=child.shut_out)
            if silence.over:
                raise TimeoutError(silence.words)

    @staticmethod
    def _hear(frame: WireFrame, loading: bool, watch: Watch | None) -> None:
        if loading:
            LOADS.decode(frame.body)
            return
        for seconds, poses in TOLD.decode(frame.body):
            if watch is not None:
                watch(seconds, poses)

    def _call_off(self) -> None:
        """Let the child end the forecast. Its answer is read before the next command."""
        child = self._child
        if self._closing or child is None:
            self._end()
        elif self._owed not in ("", "prepare"):
            with suppress(OSError):
                os.kill(child.pid, CALL_OFF)

    def _lose(self, words: str) -> HostError:
        self._end()
        return HostError(f"the forecast process {words}")

    def _end(self) -> None:
        child, self._child, self._owed, self._stands = self._child, None, "", False
        if child is not None:
            with unheeding():
                child.kill()


def foresight_of(request: RunRequest, loaded: Loaded | None) -> Foresight:
    """Return the forecasts of a run. UsageError for an unknown level. The empty level leaves it to
    the blueprint. The twin is in a process of its own if the world of the run is."""
    if request.forecast not in ("", *FORECAST_LEVELS):
        near = did_you_mean(request.forecast, FORECAST_LEVELS)
        near = near or f"There are {', '.join(FORECAST_LEVELS)}."
        raise UsageError(f"there is no level of forecasts {request.forecast!r}", advice=near)
    make = Twin if request.host == "local" else TwinProcess
    return Foresight(make(request, loaded), request.forecast)
