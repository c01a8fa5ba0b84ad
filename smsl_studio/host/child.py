"""The child of the process host: a local host behind a pipe, with nothing of its parent's state.

Commands are a verb and its arguments; each is answered with what ``RunAnswers`` says of the verb,
with a StudioError, or with the words of what broke. The child ends when it is told to, and as soon
as its parent is gone.
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

from smsl_studio.blueprint.reading import read_gathered
from smsl_studio.errors import HostError, Place, StudioError
from smsl_studio.host.answers import CRASHED, LOADS, REFUSED, RunAnswers
from smsl_studio.host.bounds import limit_process, settle_in
from smsl_studio.host.brief import brief
from smsl_studio.host.codec import Codec, Unfit, nothing
from smsl_studio.host.confinement import confine
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import OpenedWorld, Outcome, Tick
from smsl_studio.host.wire import ChildWire
from smsl_studio.library.loading import Loaded, discover
from smsl_studio.smsl.forms import form_named
from smsl_studio.world.engines import TABLE, preload

HEARTBEAT = 0.1
PICTURE = 1.0 / 60.0
"""Wall seconds between two pictures; nobody sees more of them."""

Poses = tuple[float, ...]
Status = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Recipe:
    """All a child needs to build the same world: the blueprint's documents, world, seed, plugins.

    The documents are triples (file, form, text), the blueprint's own first: these are the texts
    that are open in the parent, not those on disk.
    """

    documents: tuple[tuple[str, str, str], ...]
    world: str
    seed: int
    plugin_paths: tuple[str, ...]
    only: tuple[str, ...] | None = None
    """Where the plugins stand that are loaded; None: all there are."""
    memory: int | None = None
    """Bytes that the child may have; None: half of the machine's memory."""


def main(pipe: int, beat: int) -> None:
    """Answer one command after the other until the child is to end."""
    settle_in()
    confine(os.getppid())
    wire = ChildWire(socket.socket(fileno=pipe))
    threading.Thread(target=_live_with_parent, args=(pipe, beat), daemon=True).start()
    child, me = _Child(lambda name: wire.send("loads", LOADS.encode(name))), os.getpid()
    with contextlib.suppress(EOFError, OSError):  # the parent is gone
        while child.serving:
            kind, body = child.answer(*wire.receive())
            if os.getpid() != me:  # library code has forked, and this is the copy
                break
            wire.send(kind, body)
    # End at once: threads and exit handlers of library code must not delay the end.
    os._exit(0)


class _Child:
    """The verbs of a child: ``prepare`` comes first, or ``warm`` and later ``prepare``."""

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
        """Do what a command says: the kind of the answer, and its bytes."""
        try:
            done = self._verbs[verb](*arguments)
            return "ok", self._answers[verb].encode(done)
        except StudioError as error:
            return "refused", REFUSED.encode(_plain(error))
        except Unfit as error:
            words = f"what the world told cannot be passed on ({verb}): {error}"
            return "refused", REFUSED.encode(HostError(words))
        except KeyboardInterrupt:  # no signal is heard here, so library code raised it
            return "crashed", CRASHED.encode("library code raised KeyboardInterrupt")
        except Exception:
            return "crashed", CRASHED.encode(traceback.format_exc(limit=-3))

    def warm(self) -> None:
        """Load what takes long to load."""
        with contextlib.suppress(ImportError):
            preload()

    def prepare(self, recipe: Recipe) -> None:
        """Read the blueprint and build the world; where that fails, ``open`` reports the fault."""
        limit_process(recipe.memory)
        documents = [form_named(form).parse(text, file) for file, form, text in recipe.documents]
        blueprint = read_gathered(documents)
        paths = [Path(path) for path in recipe.plugin_paths]
        loaded = Loaded()
        if recipe.world != TABLE:
            loaded = discover(paths, only=recipe.only, begins=lambda name, _: self._loads(name))
            self._loads("")
        self.host = LocalHost(blueprint, recipe.world, recipe.seed, paths, loaded)
        self._run = RunAnswers(blueprint)
        self._answers = self._run.of
        self._verbs |= {
            "open": self.open,
            "sense": self.host.sense,
            "begin": self.host.begin,
            "tick": self.tick,
            "cancel": self.host.cancel,
            "disturb": self.disturb,
            "inject": self.inject,
            "costs": self.host.costs,
        }
        with contextlib.suppress(StudioError):
            self.host.prepare()

    def open(self, start: Mapping[str, str]) -> tuple[OpenedWorld, Status, Poses]:
        """Put the world into its start; its first words and its first picture."""
        opened = self.host.open(start)
        self._run.opened(opened)
        self._status = dict(self.host.status())
        return opened, self._status, self.host.poses()

    def tick(self) -> tuple[Tick, Status | None, Poses | None]:
        """One tick, and the world's words and picture where it is time for new ones."""
        tick, now = self.host.tick(), time.monotonic()
        if now - self._drawn < PICTURE and tick.outcome in (Outcome.IDLE, Outcome.RUNNING):
            return tick, None, None
        self._drawn, before = now, self._status
        self._status = dict(self.host.status())
        return tick, (self._status if self._status != before else None), self.host.poses()

    def disturb(self, target: str, kind: str, parameters: dict[str, Any]) -> tuple[str, ...]:
        """Disturb the sensors of a name or a fact; the names of those that were met."""
        return self.host.disturb(target, kind, **parameters)

    def inject(self, fault: str, parameters: dict[str, Any]) -> None:
        """Make something go wrong in the world; UsageError for a fault that it does not have."""
        self.host.inject(fault, **parameters)

    def close(self) -> None:
        """Close the host, if there is one, and end after this answer."""
        self.serving = False
        if "open" in self._verbs:
            self.host.close()


def _plain(error: StudioError) -> StudioError:
    """The error as the parent knows it: a plugin may raise one of a class of its own."""
    known = next(kind for kind in type(error).__mro__ if kind.__module__ == StudioError.__module__)
    place = error.place if type(error.place) is Place else None
    plain = known(brief(str(error.sentence)), place, brief(str(error.advice)))
    assert isinstance(plain, StudioError)
    return plain


def _live_with_parent(pipe: int, beat: int) -> None:
    """Write a heartbeat while the parent lives; end the process at once when the parent is gone."""
    os.set_blocking(beat, False)
    parent = select.poll()
    parent.register(pipe, 0)
    while not parent.poll(HEARTBEAT * 1000):
        with contextlib.suppress(OSError):  # nobody has looked for long, or it was closed
            os.write(beat, b".")
    with contextlib.suppress(OSError):
        os.killpg(0, signal.SIGKILL)
    os._exit(1)
