"""The child of the process host: a local host behind a pipe, without any state of its parent.

A command is a verb with arguments. The answer is a value that ``RunAnswers`` declares for the verb,
a StudioError, or the text of an unexpected error. The child ends on the command ``close``, and when
its parent is gone.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import socket
import threading
import time
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.generated_edges import with_edge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_gathered
from smsl_studio.errors import HostError, Place, StudioError
from smsl_studio.host.answers import CRASHED, LOADS, REFUSED, RunAnswers
from smsl_studio.host.bounds import limit_process, settle_in
from smsl_studio.host.brief import brief
from smsl_studio.host.codec import Codec, Unfit, nothing
from smsl_studio.host.confinement import confine
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Bound, OpenedWorld, Outcome, Tick
from smsl_studio.host.shut_in import shut_in
from smsl_studio.host.wire import ChildWire
from smsl_studio.library.bindings_file import BindingsFile
from smsl_studio.library.loaded import Loaded
from smsl_studio.library.loading import discover, refuse_hardware
from smsl_studio.smsl.forms import form_named
from smsl_studio.world.engines import TABLE, preload

HEARTBEAT = 0.1
PICTURE = 1.0 / 60.0
"""The shortest wall time (s) between two pictures. A screen shows no more."""

Poses = tuple[float, ...]
Status = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Recipe:
    """The data that a child needs to build the same world as its parent.

    The documents are triples (file, form, text), the blueprint's own document first. The texts
    are the texts that are open in the parent; the files on disk may differ.
    """

    documents: tuple[tuple[str, str, str], ...]
    world: str
    seed: int
    plugin_paths: tuple[str, ...]
    only: tuple[str, ...] | None = None
    """The locations of the plugins to load. None means all plugins."""
    memory: int | None = None
    """The largest memory of the child in bytes. None means half of the machine's memory."""
    signed: tuple[tuple[str, str], ...] | None = None
    """Locations of plugins, each with the SHA-256 of its signed code. None means that no code was
    signed."""
    bindings: BindingsFile | None = None
    """The bindings file that was signed. None means the one beside the blueprint."""
    hardware: bool = False
    """Whether the run was approved for a world that is hardware. Without it none is built."""
    parts: tuple[tuple[tuple[str, str, str], ...], ...] = ()
    """The documents of each procedure that the blueprint runs."""
    robot: str = ""
    """The robot to build the world with. Empty means the usual one of the world."""
    trial: bool = False
    """Whether generated functions that have not passed their sweep are tried."""


def main(pipe: int, beat: int) -> None:
    """Answer commands until the child must end. ``pipe`` and ``beat`` are file numbers."""
    settle_in()
    confine(os.getppid())
    wire = ChildWire(socket.socket(fileno=pipe))
    threading.Thread(target=live_with_parent, args=(pipe, beat), daemon=True).start()
    child, me = _Child(lambda name: wire.send("loads", LOADS.encode(name))), os.getpid()
    with contextlib.suppress(EOFError, OSError):  # the parent is gone
        while child.serving:
            kind, body = child.answer(*wire.receive())
            if os.getpid() != me:  # library code has forked, and this process is the copy
                break
            wire.send(kind, body)
    # End at once: threads and exit handlers of library code must not delay the end.
    os._exit(0)


def read_documents(documents: tuple[tuple[str, str, str], ...]) -> Blueprint:
    """Return the blueprint of the documents of a recipe."""
    return read_gathered([form_named(form).parse(text, file) for file, form, text in documents])


def plugins_of(recipe: Recipe, loads: Callable[[str], None], *, apart: bool = False) -> Loaded:
    """Load the plugins of a recipe. ``loads`` gets the name of each before it is loaded, and an
    empty one at the end. Generated functions come only to a process that is ``apart``: it is shut
    in before they run, so it builds its world once. WorldError for a world that is hardware and not
    approved."""
    loaded = Loaded()
    if recipe.world != TABLE:
        signed = None if recipe.signed is None else dict(recipe.signed)
        paths = [Path(path) for path in recipe.plugin_paths]
        loaded = discover(paths, recipe.only, lambda name, _: loads(name), signed, apart=apart)
        loads("")
    refuse_hardware(loaded, recipe.world, recipe.hardware)
    return loaded


class _Child:
    """The verbs of a child. ``prepare`` comes first, or ``warm`` and then ``prepare``."""

    def __init__(self, loads: Callable[[str], None]) -> None:
        self.serving = True
        self._loads = loads
        self._drawn = 0.0
        self._status: Status = {}
        self._verbs: dict[str, Callable[..., Any]] = {
            "warm": self.warm,
            "prepare": self.prepare,
            "close": self.close,
        }
        self._answers: Mapping[str, Codec[Any]] = dict.fromkeys(self._verbs, nothing())

    def answer(self, verb: str, arguments: tuple[Any, ...]) -> tuple[str, bytes]:
        """Carry out a command. Return the kind of the answer and its bytes."""
        try:
            done = self._verbs[verb](*arguments)
            return "ok", self._answers[verb].encode(done)
        except StudioError as error:
            return "refused", REFUSED.encode(_plain(error))
        except Unfit as error:
            words = f"what the world told cannot be passed on ({verb}): {error}"
            return "refused", REFUSED.encode(HostError(words))
        except KeyboardInterrupt:  # the child ignores SIGINT, so library code raised it
            return "crashed", CRASHED.encode("library code raised KeyboardInterrupt")
        except Exception:
            return "crashed", CRASHED.encode(traceback.format_exc(limit=-3))

    def warm(self) -> None:
        """Import the modules that take long to import."""
        with contextlib.suppress(ImportError):
            preload()

    def prepare(self, recipe: Recipe) -> None:
        """Read the blueprint and build the world. If the build fails, ``open`` reports the
        fault."""
        limit_process(recipe.memory)
        blueprint, *parts = map(read_documents, (recipe.documents, *recipe.parts))
        paths = [Path(path) for path in recipe.plugin_paths]
        loaded = plugins_of(recipe, self._loads, apart=True)
        file = recipe.bindings
        self.host = LocalHost(blueprint, recipe.world, recipe.seed, paths, loaded, file)
        self.host.choose(recipe.robot)
        if recipe.trial:
            self.host.try_out()
        self.host.carry(parts)
        self._blueprint, self._parts = blueprint, parts
        self._run = RunAnswers(blueprint, *parts)
        self._answers = self._run.of
        self._verbs |= {
            "open": self.open,
            "sense": self.host.sense,
            "begin": self.begin,
            "tick": self.tick,
            "cancel": self.host.cancel,
            "disturb": self.disturb,
            "inject": self.inject,
            "costs": self.host.costs,
            "suppose": self.host.suppose,
            "extend": self.extend,
        }
        with contextlib.suppress(StudioError):
            self.host.prepare()

    def open(self, start: Mapping[str, str]) -> tuple[OpenedWorld, Status, Poses]:
        """Put the world into its start states. Return also its first status and first picture."""
        opened = self.host.open(start)
        self._run.opened(opened)
        self._world = opened
        self._status = dict(self.host.status())
        return opened, self._status, self.host.poses()

    def begin(self, edge: Address) -> None:
        """Start the function of an edge. Before generated code begins, this process is shut in for
        ever: its world stands, and nothing in it needs a file, a connection or a process more."""
        if self.host.is_generated(edge):
            shut_in()
        self.host.begin(edge)

    def tick(self) -> tuple[Tick, Status | None, Poses | None]:
        """Advance by one tick. Add status and picture if it is time for new ones."""
        tick, now = self.host.tick(), time.monotonic()
        if now - self._drawn < PICTURE and tick.outcome in (Outcome.IDLE, Outcome.RUNNING):
            return tick, None, None
        self._drawn, before = now, self._status
        self._status = dict(self.host.status())
        return tick, (self._status if self._status != before else None), self.host.poses()

    def extend(self, edge: Address, target: str) -> tuple[Bound | None, bool]:
        """Bind one more edge. Later answers may name it."""
        found = self.host.extend(edge, target)
        self._blueprint = with_edge(self._blueprint, edge, target)
        self._run = RunAnswers(self._blueprint, *self._parts)
        self._run.opened(self._world)
        self._answers = self._run.of
        return found

    def disturb(self, target: str, kind: str, parameters: dict[str, Any]) -> tuple[str, ...]:
        """Disturb the sensors of a name or a fact, and return their names."""
        return self.host.disturb(target, kind, **parameters)

    def inject(self, fault: str, parameters: dict[str, Any]) -> None:
        """Cause a fault of the world. UsageError if the world does not have this fault."""
        self.host.inject(fault, **parameters)

    def close(self) -> None:
        """Close the host if there is one, and end the child after this answer."""
        self.serving = False
        if "open" in self._verbs:
            self.host.close()


def _plain(error: StudioError) -> StudioError:
    """Return the error as a class that the parent knows. A plugin may raise a subclass."""
    known = next(kind for kind in type(error).__mro__ if kind.__module__ == StudioError.__module__)
    place = error.place if type(error.place) is Place else None
    plain = known(brief(str(error.sentence)), place, brief(str(error.advice)))
    assert isinstance(plain, StudioError)
    return plain


def live_with_parent(pipe: int, beat: int) -> None:
    """Write a heartbeat while the parent lives; end the process at once when the parent is gone."""
    os.set_blocking(beat, False)
    parent = select.poll()
    parent.register(pipe, 0)
    while not parent.poll(HEARTBEAT * 1000):
        with contextlib.suppress(OSError):  # the pipe is full or closed
            os.write(beat, b".")
    with contextlib.suppress(OSError):
        os.killpg(0, signal.SIGKILL)
    os._exit(1)
