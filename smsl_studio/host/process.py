"""The process host: world and library code run in a child, so that the dispatcher outlives them.

The child is a fresh interpreter. Commands and answers go through a pipe, in lockstep with the
dispatcher. ``answers`` declares the format of each answer; any other bytes raise HostError.
HostError is also raised at once for a child that has died, after ``hang_limit`` seconds for a child
that hangs in one command, and after ``silence_limit`` seconds for a child without a heartbeat.
Every later call raises the same error. Times here are wall time in which the child could have
worked (see ``patience``).

One thread drives the host. Any thread may call ``poses``, ``status``, ``pid`` and ``close``. A
close ends the wait of the driving thread.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.generated_edges import with_edge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import HostError
from smsl_studio.host.answers import CRASHED, LOADS, REFUSED, RunAnswers
from smsl_studio.host.child import Recipe
from smsl_studio.host.codec import Unfit
from smsl_studio.host.exit_words import ending_words
from smsl_studio.host.patience import Patience
from smsl_studio.host.protocol import (
    Bound,
    Happened,
    OpenedWorld,
    Outcome,
    Priced,
    Tick,
)
from smsl_studio.host.spare import Spare
from smsl_studio.host.started_child import Child, start_child
from smsl_studio.host.wire import NoAnswer, WireFrame
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.monitor.sample import Sample
from smsl_studio.stop import LONGEST, BrokenOff, StopListener, Stopped, heed, starving

LOOK = 0.05
"""The interval (s) at which a waiting parent checks the heartbeat of the child and the stop."""

LAST_LOOK = 0.025
"""The time (s) that a child has to finish its answer after a stop. Together with ``LOOK`` it is
less than the grace of a signal (see ``stop``)."""

_QUICK = frozenset(("sense", "begin", "tick", "costs", "suppose", "disturb", "inject"))
"""The verbs that are answered at once. A run that is stopped may still wait for these answers."""


@dataclass(frozen=True, slots=True)
class ChildTerms:
    """What a child may load, and its limits.

    ``only`` has the locations of the plugins to load; None means all plugins. The limits of time
    are in seconds of wall time: ``hang_limit`` for one answer, ``open_limit`` for the first answer,
    and ``silence_limit`` for the time without a pulse. ``memory`` is in bytes; None means half of
    the computer's memory. ``signed`` has the SHA-256 of signed code, by location; other code at
    these locations is not loaded. ``bindings`` is the bindings file that was signed; None means the
    one beside the blueprint. ``hardware`` says that the run was approved for a world that is
    hardware; without it none is built. ``robot`` is the robot to build the world with. ``trial``
    says that generated functions are tried that have not passed their sweep.
    """

    only: tuple[str, ...] | None = None
    hang_limit: float = 10.0
    silence_limit: float = 3.0
    open_limit: float = 60.0
    memory: int | None = None
    signed: Mapping[str, str] | None = None
    bindings: BindingsFile | None = None
    hardware: bool = False
    parts: tuple[Blueprint, ...] = ()
    robot: str = ""
    trial: bool = False


USUAL = ChildTerms()


def _texts(blueprint: Blueprint) -> tuple[tuple[str, str, str], ...]:
    return tuple((one.file, one.form, one.text) for one in blueprint.documents)


class ProcessHost:
    """A child process that contains a world and the code that is bound to a blueprint.

    ``spare`` has a child in waiting, which serves the run if it was prepared for that run.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        world: str,
        seed: int = 0,
        plugin_paths: Sequence[Path] = (),
        terms: ChildTerms = USUAL,
        spare: Spare | None = None,
    ) -> None:
        texts = _texts(blueprint)
        paths = tuple(str(path) for path in plugin_paths)
        signed = None if terms.signed is None else tuple(sorted(terms.signed.items()))
        self._recipe = Recipe(
            texts,
            world,
            seed,
            paths,
            terms.only,
            terms.memory,
            signed,
            terms.bindings,
            terms.hardware,
            tuple(map(_texts, terms.parts)),
            terms.robot,
            terms.trial,
        )
        self._terms = terms
        self._blueprint = blueprint
        self._answers: RunAnswers | None = None
        self._spare = spare
        self._child: Child | None = None
        self._ticks, self._step = 0, 0.0
        self._poses: tuple[float, ...] = ()
        self._status: Mapping[str, str] = {}
        self._gone: HostError | None = None
        self._doing = ""
        self._opened = False
        self._world: OpenedWorld | None = None
        self._generated: frozenset[Address] = frozenset()
        self._shut_in = False
        self._idle = Patience(terms.silence_limit)
        self._using = threading.RLock()
        self._closing = False

    @property
    def pid(self) -> int | None:
        """The process number of the child. None if there is no child."""
        return self._child.pid if self._child is not None else None

    @property
    def recipe(self) -> Recipe:
        """The recipe of this run. A spare child that is prepared for it makes an equal run start
        fast."""
        return self._recipe

    def open(self, start: Mapping[str, str]) -> OpenedWorld:
        """Start the child if there is none, and let it open its world (see ``LocalHost.open``)."""
        with self._using:
            if self._shut_in:
                # A child that has run generated code may not do what building a world needs.
                self._end()
                self._opened = self._shut_in = False
            if self._child is None and self._gone is None:
                self._start()
            opened: OpenedWorld
            asked = self._ask("open", dict(start), limit=self._terms.open_limit)
            opened, self._status, self._poses = asked
            if opened.world != self._recipe.world:
                raise self._lost(f"the simulation process opened the world {opened.world!r}")
            assert self._answers is not None
            self._answers.opened(opened)
            self._world = opened
            self._ticks, self._step = 0, opened.tick
            self._generated = frozenset(e for e, one in opened.bound.items() if one.generated)
            self._opened, self._idle = True, self._pulse()
            return opened

    def sense(self) -> tuple[Sample, ...]:
        """Read every sensor once. The simulated time does not move."""
        samples: tuple[Sample, ...] = self._ask("sense")
        return samples

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge; it first moves at the next tick."""
        self._doing = f" in the middle of {edge}"
        self._shut_in = self._shut_in or edge in self._generated
        self._ask("begin", edge)

    def tick(self) -> Tick:
        """Advance the world and the running call by one tick."""
        found: Tick
        found, status, poses = self._ask("tick")
        self._ticks += 1
        if found.time != self._ticks * self._step:
            raise self._lost(f"the simulation process told a wrong time{self._doing}")
        if status is not None:
            self._status = status
        if poses is not None:
            self._poses = poses
        if found.outcome is not Outcome.RUNNING:
            self._doing = ""
        return found

    def cancel(self, mode: str) -> None:
        """End the running call as ``LocalHost.cancel`` does."""
        self._ask("cancel", mode)
        self._doing = ""

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """Disturb a sensor, or all sensors of one fact, as ``LocalHost.disturb`` does."""
        met: tuple[str, ...] = self._ask("disturb", target, kind, parameters)
        return met

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Cause a fault of the world, as ``LocalHost.inject`` does."""
        self._ask("inject", fault, parameters)

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions, as ``LocalHost.costs`` does."""
        priced: Priced = self._ask("costs", dict(scene), tuple(happened))
        return priced

    def suppose(self, edge: Address) -> None:
        """Make the guard of an edge agree, as ``LocalHost.suppose`` does."""
        self._ask("suppose", edge)

    def extend(self, edge: Address, target: str) -> tuple[Bound | None, bool]:
        """Bind one more edge, as ``LocalHost.extend`` does. The child may name it from then on."""
        found: tuple[Bound | None, bool] = self._ask("extend", edge, target)
        self._blueprint = with_edge(self._blueprint, edge, target)
        assert self._world is not None, "the world is open"
        self._answers = RunAnswers(self._blueprint, *self._terms.parts)
        self._answers.opened(self._world)
        return found

    def poses(self) -> tuple[float, ...]:
        """Return the newest poses that the child has sent."""
        return self._poses

    def status(self) -> Mapping[str, str]:
        """Return the newest status texts that the child has sent."""
        return self._status

    def check(self) -> None:
        """Check the child between two commands. HostError if it has died or has no heartbeat."""
        with self._using:
            if self._gone is not None:
                raise HostError(self._gone.sentence, advice=self._gone.advice)
            if self._child is None or not self._opened:
                return
            if self._child.dead:
                raise self._died()
            self._child.show()
            self._idle.look()
            if self._child.beats():
                self._idle = self._pulse()
            self._check(self._idle)

    def close(self) -> None:
        """End the child, even if it hangs, and free everything. A second call does nothing."""
        self._closing = True
        with self._using:
            if self._child is not None:
                self._child.dismiss()
            self._gone = self._gone or HostError("the host is closed")
            self._end()

    def _start(self) -> None:
        """Take the spare child if it fits, else start a new child."""
        self._child = self._spare.take(self._recipe) if self._spare is not None else None
        if self._child is not None:
            verb = "prepare" if self._child.prepared else "warm"
            try:
                # The answer to the command that the spare got.
                self._answer(verb, self._terms.open_limit)
            except HostError:
                if self._closing:
                    raise
                self._gone = self._child = None  # the spare has ended; a new child may work
        if self._child is None:
            self._child = self._started()
        if not self._child.prepared:
            self._ask("prepare", self._recipe, limit=self._terms.open_limit)

    def _started(self) -> Child:
        try:
            return start_child()
        except OSError as error:
            words = error.strerror or error
            raise self._lost(f"the simulation process cannot be started: {words}") from None

    def _ask(self, verb: str, *arguments: Any, limit: float | None = None) -> Any:
        with self._using:
            if self._gone is not None:
                raise HostError(self._gone.sentence, advice=self._gone.advice)
            if self._child is None:
                raise HostError("the host is not open")
            try:
                self._child.wire.send(verb, arguments)
            except OSError:
                raise self._died() from None
            return self._answer(verb, limit or self._terms.hang_limit)

    def _answer(self, verb: str, limit: float) -> Any:
        """Return the answer to the last command. HostError if no answer can come any more."""
        assert self._child is not None
        if self._answers is None:
            self._answers = RunAnswers(self._blueprint, *self._terms.parts)
        try:
            frame = self._wait(self._child, verb, limit)
        except Stopped:
            # A late answer would be taken for the answer to the next command.
            self._lost(f"the simulation process was ended{self._doing}: it did not answer")
            raise
        except (EOFError, OSError):
            raise self._died() from None
        except NoAnswer as error:
            raise self._unfit(verb, error) from None
        try:
            if frame.kind == "ok":
                return self._answers.of[verb].decode(frame.body)
            if frame.kind == "refused":
                raise REFUSED.decode(frame.body)
            words = f"broke{self._doing}: {CRASHED.decode(frame.body).strip()}"
        except Unfit as error:
            raise self._unfit(verb, error) from None
        raise self._lost(f"the simulation process {words}")

    def _unfit(self, verb: str, error: Exception) -> HostError:
        words = f"said what is no answer{self._doing}: {verb} {error}"
        return self._lost(f"the simulation process {words}")

    def _wait(self, child: Child, verb: str, limit: float) -> WireFrame:
        """Return the frame that ends the answer. No other code waits for the child."""
        answer, pulse = Patience(limit, strict=self._terms.hardware), self._pulse()
        late: StopListener | None = None
        if verb == "cancel":
            child.starved()  # resets the measurement: only time from now on counts
        while True:
            frame = child.heard(LOOK if late is None else LAST_LOOK)
            if frame is not None and frame.kind != "loads":
                return frame
            if frame is not None:
                name = LOADS.decode(frame.body)
                self._doing = f" while the plugin {name!r} was loaded" if name else ""
            if self._closing:
                raise self._lost("the host is closed")
            with starving(child.starved()):
                late = _heeded(late, verb)
            answer.look(shut_out=child.shut_out)
            pulse.look(shut_out=child.shut_out)
            if answer.over:
                words = f"did not answer for {answer.words}{self._doing}"
                raise self._lost(f"the simulation process {words}")
            if child.beats() or not self._opened or verb == "open":
                pulse = self._pulse()
            self._check(pulse)

    def _pulse(self) -> Patience:
        """Return a new wait for a sign of life."""
        return Patience(self._terms.silence_limit, strict=self._terms.hardware)

    def _check(self, pulse: Patience) -> None:
        if pulse.over:
            words = f"has shown no pulse for {pulse.words}{self._doing}"
            raise self._lost(f"the simulation process {words}")

    def _died(self) -> HostError:
        assert self._child is not None
        how = ending_words(self._child.ending())
        return self._lost(f"the simulation process {how}{self._doing}")

    def _lost(self, sentence: str) -> HostError:
        """End the child. Return the error to raise now and at every later call."""
        self._gone = HostError(sentence, advice="Start a new run.")
        self._end()
        return self._gone

    def _end(self) -> None:
        if self._child is not None:
            self._child.kill()
        self._child = None


def _heeded(late: StopListener | None, verb: str) -> StopListener | None:
    """Check whether a stop was asked for. ``late`` is None until then.

    After a stop the world may still finish a quick answer until the returned listener runs out.
    The world may only be slow, and a stop should brake the world, not end its process.
    """
    if late is not None:
        late.heed()
        return late
    try:
        heed()
    except BrokenOff:
        raise
    except Stopped:
        if verb not in _QUICK:
            raise
        return StopListener(1, LONGEST)
    return None
