"""The process host: world and library code run in a child, so that the dispatcher outlives them.

The child is spawned, never forked. Commands go through a pipe, in lock with the dispatcher; poses
come through shared memory. A child that dies is seen at once, one that hangs after ``hang_limit``
seconds in one command, one that is frozen after ``silence_limit`` seconds without a pulse: each is
a HostError, and every later call says the same. Times here are wall time.

One thread drives the host. ``poses``, ``status``, ``pid`` and ``close`` may be called from any
other: a close ends what the driving thread waits for.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping, Sequence
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import HostError
from smsl_studio.host.child import Recipe
from smsl_studio.host.ending import ending_words
from smsl_studio.host.protocol import Happened, Opened, Priced, Tick
from smsl_studio.host.shared_poses import SharedPoses
from smsl_studio.host.spare import Spare
from smsl_studio.host.starting import Child, start_child
from smsl_studio.host.wire import NoAnswer
from smsl_studio.monitor.sample import Sample

LOOK = 0.1
"""How often (s) a waiting parent looks at the child's pulse."""


class ProcessHost:
    """A child process with the world and the code bound to a blueprint in it.

    A script that uses it must guard its own start with ``if __name__ == "__main__":``, because a
    spawned child imports it.
    """

    def __init__(
        self,
        blueprint: Blueprint,
        world: str,
        seed: int = 0,
        plugin_paths: Sequence[Path] = (),
        *,
        hang_limit: float = 10.0,
        silence_limit: float = 3.0,
        open_limit: float = 60.0,
        memory: int | None = None,
        spare: Spare | None = None,
    ) -> None:
        texts = tuple((one.file, one.form, one.text) for one in blueprint.documents)
        paths = tuple(str(path) for path in plugin_paths)
        self._recipe = Recipe(texts, world, seed, paths, memory)
        self._hang_limit = hang_limit
        self._silence_limit = silence_limit
        self._open_limit = open_limit
        self._spare = spare
        self._child: Child | None = None
        self._shared: SharedPoses | None = None
        self._status: Mapping[str, str] = {}
        self._gone: HostError | None = None
        self._doing = ""
        self._pulse = (-1, 0.0)
        self._using = threading.RLock()
        self._closing = False

    @property
    def pid(self) -> int | None:
        """The child's process number, None where there is none."""
        return self._child.pid if self._child is not None else None

    @property
    def recipe(self) -> Recipe:
        """What a spare child is prepared with, to be quick for this run or one like it."""
        return self._recipe

    def open(self, start: Mapping[str, str]) -> Opened:
        """Start the child if there is none, and have it open its world (see ``LocalHost.open``)."""
        with self._using:
            if self._child is None and self._gone is None:
                self._start()
            opened: Opened = self._ask("open", dict(start), limit=self._open_limit)
            if self._shared is None:
                self._share(7 * len(opened.shapes))
            return opened

    def sense(self) -> tuple[Sample, ...]:
        """Every sensor once, now, without moving the time."""
        samples: tuple[Sample, ...] = self._ask("sense")
        return samples

    def begin(self, edge: Address) -> None:
        """Start the library function bound to an edge; it first moves at the next tick."""
        self._doing = f" in the middle of {edge}"
        self._ask("begin", edge)

    def tick(self) -> Tick:
        """Let the world and the running call go on for one tick."""
        tick, status = self._ask("tick")
        if status is not None:
            self._status = status
        if tick.outcome.value != "running":
            self._doing = ""
        found: Tick = tick
        return found

    def cancel(self, mode: str) -> None:
        """End the running call as ``LocalHost.cancel`` does."""
        self._ask("cancel", mode)
        self._doing = ""

    def disturb(self, target: str, kind: str, **parameters: float | str) -> tuple[str, ...]:
        """From now on disturb a sensor, or all of one fact, as ``LocalHost.disturb`` does."""
        met: tuple[str, ...] = self._ask("disturb", target, kind, parameters)
        return met

    def inject(self, fault: str, **parameters: float | str) -> None:
        """Let something go wrong in the world, as ``LocalHost.inject`` does."""
        self._ask("inject", fault, parameters)

    def costs(self, scene: Mapping[str, str | None], happened: Sequence[Happened]) -> Priced:
        """Ask the cost functions, as ``LocalHost.costs`` does."""
        priced: Priced = self._ask("costs", dict(scene), tuple(happened))
        return priced

    def poses(self) -> tuple[float, ...]:
        """The newest poses for drawing; the last ones, where the child is gone."""
        return self._shared.read() if self._shared is not None else ()

    def status(self) -> Mapping[str, str]:
        """The world's newest short words for people."""
        return self._status

    def check(self) -> None:
        """Look at the child while nothing is asked of it: HostError where it died or is frozen."""
        with self._using:
            if self._gone is not None:
                raise HostError(self._gone.sentence, advice=self._gone.advice)
            if self._child is None or self._shared is None:
                return
            if self._child.dead:
                raise self._died()
            now, newest = time.monotonic(), self._shared.pulse
            if newest != self._pulse[0]:
                self._pulse = (newest, now)
            elif now - self._pulse[1] > self._silence_limit:
                silent = f"{now - self._pulse[1]:.1f} s{self._doing}"
                raise self._lost(f"the simulation process has shown no pulse for {silent}")

    def close(self) -> None:
        """End the child, also one that hangs, and free everything; twice is harmless."""
        self._closing = True
        with self._using:
            if self._child is not None:
                self._child.dismiss()
            self._gone = self._gone or HostError("the host is closed")
            self._end()

    def _start(self) -> None:
        """Take the spare child if there is a fitting one, else start one."""
        self._child = self._spare.take(self._recipe) if self._spare is not None else None
        if self._child is not None:
            try:
                self._answer("open", self._open_limit)  # to what the spare was asked when it began
            except HostError:
                if self._closing:
                    raise
                self._gone = self._child = None  # whatever ended the spare, a new child may live
        if self._child is None:
            self._child = self._started()
        if not self._child.prepared:
            self._ask("prepare", self._recipe, limit=self._open_limit)

    def _started(self) -> Child:
        try:
            return start_child()
        except OSError as error:
            words = error.strerror or error
            raise self._lost(f"the simulation process cannot be started: {words}") from None

    def _share(self, count: int) -> None:
        """Have the child draw into a block of shared memory from now on."""
        try:
            self._shared = SharedPoses(count)
        except OSError as error:
            words = error.strerror or error
            raise self._lost(f"there is no shared memory for the poses: {words}") from None
        self._status = self._ask("share", self._shared.name, count)

    def _ask(self, verb: str, *arguments: Any, limit: float | None = None) -> Any:
        with self._using:
            if self._gone is not None:
                raise HostError(self._gone.sentence, advice=self._gone.advice)
            if self._child is None:
                raise HostError("the host is not open")
            try:
                self._child.wire.send((verb, arguments))
            except OSError:
                raise self._died() from None
            return self._answer(verb, limit or self._hang_limit)

    def _answer(self, verb: str, limit: float) -> Any:
        """The answer to what was asked; HostError where none can be expected any more."""
        assert self._child is not None
        try:
            kind, value = self._wait(self._child, verb, limit)
        except (EOFError, OSError):
            raise self._died() from None
        except NoAnswer:
            raise self._lost(
                f"the simulation process said what is no answer{self._doing}"
            ) from None
        if kind == "crashed":
            words = f"the simulation process broke{self._doing}: {str(value).strip()}"
            raise self._lost(words)
        if kind == "refused":
            raise value
        return value

    def _wait(self, child: Child, verb: str, limit: float) -> tuple[str, Any]:
        began = heard = time.monotonic()
        pulse = -1
        while True:
            ready = wait([child.wire.fileno(), child.sentinel], LOOK)
            if child.wire.fileno() in ready:
                answer = child.wire.read()
                if answer is not None:
                    return answer
            elif ready or child.dead:
                raise self._died()
            if self._closing:
                raise self._lost("the host is closed")
            now = time.monotonic()
            newest = self._shared.pulse if self._shared is not None else None
            if newest is None or newest != pulse or verb == "open":
                pulse, heard = newest if newest is not None else -1, now
            if now - began > limit:
                raise self._lost(
                    f"the simulation process did not answer for {now - began:.1f} s{self._doing}"
                )
            if now - heard > self._silence_limit:
                silent = f"{now - heard:.1f} s{self._doing}"
                raise self._lost(f"the simulation process has shown no pulse for {silent}")

    def _died(self) -> HostError:
        assert self._child is not None
        how = ending_words(self._child.ending())
        return self._lost(f"the simulation process {how}{self._doing}")

    def _lost(self, sentence: str) -> HostError:
        """The child is given up: what to raise now, and at every later call."""
        self._gone = HostError(sentence, advice="Start a new run.")
        self._end()
        return self._gone

    def _end(self) -> None:
        if self._child is not None:
            self._child.kill()
        if self._shared is not None:
            self._shared.read()
            self._shared.close()
        self._child = None
