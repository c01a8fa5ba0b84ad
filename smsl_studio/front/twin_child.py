"""The child in which the twin of a run forecasts: its world, the code of plugins and the driver.

It has a low priority, so that it takes no time from the run. It answers the commands ``prepare``,
``predict`` and ``onward``, and tells on the way how far a forecast is. The signal CALL_OFF ends the
forecast that is being made; the world is kept for the next one.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.forecasts import Poses
from smsl_studio.front.request import RunRequest
from smsl_studio.front.run_trust import RunTrust
from smsl_studio.front.twin import Twin
from smsl_studio.host.answers import CRASHED, LOADS, POSES
from smsl_studio.host.bounds import limit_process, settle_in
from smsl_studio.host.brief import brief, words_for
from smsl_studio.host.child import Recipe, live_with_parent, plugins_of, read_documents
from smsl_studio.host.codec import Codec, flag, one_of, text
from smsl_studio.host.compound import mapping, optional, record, row, several
from smsl_studio.host.confinement import confine
from smsl_studio.host.vocabulary import SECONDS, sentence
from smsl_studio.host.wire import ChildWire
from smsl_studio.library.prediction import AGREES, DIFFERS, NONE, Prediction
from smsl_studio.stop import Stopped, heeding

LOW = 10
"""How much lower the priority (nice) of the child is than that of the run."""
CALL_OFF = signal.SIGUSR1
EVERY = 0.05
"""Simulated seconds between two poses that are told."""
SPREAD = 0.1
"""Wall time (s) between two tellings: each of them takes a little time from the run."""
MOST_TOLD = 1_000
"""The largest number of poses in one telling."""

REFUSAL = sentence(2000)
TOLD = several(row(SECONDS, POSES), MOST_TOLD)
"""Moments of a forecast: the simulated seconds since it began, and the poses of the world."""


@dataclass(frozen=True, slots=True)
class TwinAsked:
    """What the child needs to build the twin of a run. ``levels`` are those of the run."""

    recipe: Recipe
    levels: Mapping[str, str]


def answer_of(blueprint: Blueprint) -> Codec[Prediction | None]:
    """Return the codec of a prediction for a blueprint. It can name no other facts."""
    facts = [f"{Address(one.name)}/{at}" for one in blueprint for at in range(one.num_facts)]
    fact = one_of(facts)
    return optional(
        record(
            Prediction,
            verdict=one_of((AGREES, DIFFERS, NONE)),
            after=mapping(fact, optional(text(1000)), len(facts)),
            reason=sentence(6000),
            by_people=flag(),
            apart=several(fact, len(facts)),
        )
    )


def main(pipe: int, beat: int) -> None:
    """Answer for a twin until the parent is gone. ``pipe`` and ``beat`` are file numbers."""
    settle_in()
    with contextlib.suppress(OSError):  # the system may have no priorities
        os.nice(LOW)
    confine(os.getppid())
    wire = ChildWire(socket.socket(fileno=pipe))
    threading.Thread(target=live_with_parent, args=(pipe, beat), daemon=True).start()
    child, me = _TwinVerbs(wire), os.getpid()
    signal.signal(CALL_OFF, child.call_off)
    with contextlib.suppress(EOFError, OSError):  # the parent is gone
        while True:
            verb, arguments = wire.receive()
            kind, body = child.answer(verb, arguments)
            if os.getpid() != me:  # library code has forked, and this process is the copy
                break
            wire.send(kind, body)
    os._exit(0)


class _TwinVerbs:
    """The verbs of the child. ``prepare`` comes first."""

    def __init__(self, wire: ChildWire) -> None:
        self._wire = wire
        self._called_off = False
        self._verbs: dict[str, Callable[..., bytes]] = {"prepare": self.prepare}

    def call_off(self, *_: object) -> None:
        """Note that nobody waits for the forecast that is being made."""
        self._called_off = True

    def answer(self, verb: str, arguments: tuple[Any, ...]) -> tuple[str, bytes]:
        """Carry out a command. Return the kind of the answer and its bytes."""
        self._called_off = False
        try:
            with heeding(self._heed):
                return "ok", self._verbs[verb](*arguments)
        except Stopped:
            return "refused", REFUSAL.encode("it was called off")
        except StudioError as error:
            return "refused", REFUSAL.encode(brief(error.sentence, 2000))
        except BaseException as error:  # SystemExit, and what compiled libraries raise
            return "crashed", CRASHED.encode(words_for(error))

    def prepare(self, asked: TwinAsked) -> bytes:
        """Read the blueprint and load the plugins. The world is built at the first forecast."""
        recipe = asked.recipe
        limit_process(recipe.memory)
        blueprint = read_documents(recipe.documents)
        loaded = plugins_of(recipe, lambda name: self._wire.send("loads", LOADS.encode(name)))
        request = RunRequest(
            blueprint,
            recipe.world,
            seed=recipe.seed,
            levels=dict(asked.levels),
            robot=recipe.robot,
            trust=RunTrust(bindings=recipe.bindings) if recipe.hardware else None,
        )
        self._twin = Twin(request, loaded)
        self._codec = answer_of(blueprint)
        self._verbs |= {"predict": self.predict, "onward": self.onward}
        return b""

    def predict(self, configuration: Mapping[str, str], edge: Address, watched: bool) -> bytes:
        """Carry out an operation from a configuration. The poses are told if it is watched."""
        telling = _Progress(self._wire, watched)
        found = self._twin.predict(configuration, edge, telling.watch)
        telling.tell()
        return self._codec.encode(found)

    def onward(self, edge: Address) -> bytes:
        """Carry out an operation from where the last forecast ended."""
        return self._codec.encode(self._twin.onward(edge, _Progress(self._wire, False).watch))

    def _heed(self) -> None:
        if self._called_off:
            raise Stopped


class _Progress:
    """Tells now and then that a forecast goes on, from its first step on, and with ``poses`` the
    moments since then."""

    def __init__(self, wire: ChildWire, poses: bool) -> None:
        self._wire, self._poses = wire, poses
        self._kept: list[tuple[float, tuple[float, ...]]] = []
        self._last = -EVERY
        self._due = 0.0

    def watch(self, seconds: float, poses: Poses) -> None:
        """Keep a moment if enough simulated time went by. Tell what is kept if it is due."""
        if self._poses and seconds - self._last >= EVERY:
            self._last = seconds
            self._kept.append((seconds, poses()))
        if time.monotonic() >= self._due or len(self._kept) >= MOST_TOLD:
            self.tell()

    def tell(self) -> None:
        """Tell what is kept."""
        self._wire.send("loads", TOLD.encode(tuple(self._kept)))
        self._kept, self._due = [], time.monotonic() + SPREAD
