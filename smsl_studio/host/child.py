"""The child of the process host: a local host behind a pipe, and nothing of its parent's.

Messages are ``(verb, arguments)``; answers ``("ok", value)``, ``("refused", StudioError)`` or
``("crashed", text)``. The child ends when it is told to, and as soon as its parent is gone.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import Place, StudioError
from smsl_studio.host.bounds import Chatter, limit_memory
from smsl_studio.host.brief import brief
from smsl_studio.host.local import LocalHost
from smsl_studio.host.protocol import Outcome, Tick
from smsl_studio.host.shared_poses import SharedPoses
from smsl_studio.smsl.forms import form_named

HEARTBEAT = 0.1
PICTURE = 1.0 / 60.0
"""Wall seconds between two pictures: more often nobody looks."""


@dataclass(frozen=True, slots=True)
class Recipe:
    """All a child needs to build the same world: the blueprint's documents, world, seed, plugins.

    The documents are triples (file, form, text), the blueprint's own first: what is open in the
    parent counts, whatever stands on disk.
    """

    documents: tuple[tuple[str, str, str], ...]
    world: str
    seed: int
    plugin_paths: tuple[str, ...]
    memory: int | None = None
    """Bytes that the child may have; None: half of the machine's memory."""


def serve(connection: Connection) -> None:
    """The child's whole life: answer one command after the other."""
    _settle_in()
    shared = _Shared()
    threading.Thread(target=_live_with_parent, args=(shared,), daemon=True).start()
    child = _Child(shared)
    try:
        while child.serving:
            verb, arguments = connection.recv()
            connection.send(_answer(child, verb, arguments))
    except (EOFError, OSError):  # the parent is gone
        pass
    finally:
        connection.close()
    # Threads that library code left behind, and what it registered for the exit, hold up nothing.
    os._exit(0)


def _answer(child: _Child, verb: str, arguments: tuple[Any, ...]) -> tuple[str, Any]:
    try:
        return "ok", child.verbs[verb](*arguments)
    except StudioError as error:
        return "refused", _plain(error)
    except KeyboardInterrupt:  # no signal is heard here, so library code raised it
        return "crashed", "library code raised KeyboardInterrupt"
    except Exception:
        return "crashed", brief(traceback.format_exc(limit=-3), 5000)


def _plain(error: StudioError) -> StudioError:
    """The error as the parent knows it: a plugin may raise one of a class of its own."""
    known = next(kind for kind in type(error).__mro__ if kind.__module__ == StudioError.__module__)
    place = error.place if type(error.place) is Place else None
    plain = known(brief(str(error.sentence)), place, brief(str(error.advice)))
    assert isinstance(plain, StudioError)
    return plain


class _Shared:
    """The block both sides know, once there is one; the thread of the pulse writes to it too, so
    that it stays open until the child ends."""

    def __init__(self) -> None:
        self.block: SharedPoses | None = None


class _Child:
    """The verbs of a child: ``prepare`` comes first, or ``warm`` and later ``prepare``."""

    def __init__(self, shared: _Shared) -> None:
        self.serving = True
        self._shared = shared
        self._drawn = 0.0
        self._status: Mapping[str, str] = {}
        self.verbs: dict[str, Callable[..., Any]] = {
            "warm": self.warm,
            "prepare": self.prepare,
            "close": self.close,
        }

    def warm(self) -> None:
        """Load what takes long to load."""
        with contextlib.suppress(ImportError):
            import_module("smsl_studio.world.bullet")

    def prepare(self, recipe: Recipe) -> None:
        """Read the blueprint, and build the world as far as it goes: ``open`` tells of faults."""
        limit_memory(recipe.memory)
        documents = [form_named(form).parse(text, file) for file, form, text in recipe.documents]
        blueprint = read_blueprint(documents[0], opened=documents[1:])
        paths = [Path(path) for path in recipe.plugin_paths]
        self.host = LocalHost(blueprint, recipe.world, recipe.seed, paths)
        self.verbs |= {
            "open": self.host.open,
            "share": self.share,
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

    def share(self, name: str, count: int) -> Mapping[str, str]:
        """Draw into this block from now on; the world's first words."""
        self._shared.block = SharedPoses(count, name)
        self._draw()
        return self._status

    def tick(self) -> tuple[Tick, Mapping[str, str] | None]:
        """One tick, and the world's words where they are new."""
        tick, before = self.host.tick(), self._status
        now = time.monotonic()
        if now - self._drawn >= PICTURE or tick.outcome not in (Outcome.IDLE, Outcome.RUNNING):
            self._drawn = now
            self._draw()
        return tick, (self._status if self._status != before else None)

    def disturb(self, target: str, kind: str, parameters: dict[str, Any]) -> tuple[str, ...]:
        return self.host.disturb(target, kind, **parameters)

    def inject(self, fault: str, parameters: dict[str, Any]) -> None:
        self.host.inject(fault, **parameters)

    def close(self) -> None:
        self.serving = False
        if "open" in self.verbs:
            self.host.close()

    def _draw(self) -> None:
        if self._shared.block is not None:
            self._shared.block.write(self.host.poses())
        self._status = dict(self.host.status())


def _settle_in() -> None:
    """Ctrl-C is the parent's to answer; nothing here may write to the parent's standard output."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(OSError, AttributeError):
        os.setpgid(0, 0)  # so that all it may start can be ended with it
    sys.stdout = sys.stderr = Chatter(sys.stderr)
    with contextlib.suppress(OSError):
        os.dup2(2, 1)


def _live_with_parent(shared: _Shared) -> None:
    """Show a pulse while the parent lives; end at once, in whatever library code, when it dies."""
    parent = multiprocessing.parent_process()
    beats = 0
    while parent is None or not wait([parent.sentinel], timeout=HEARTBEAT):
        beats += 1
        if shared.block is not None:
            shared.block.beat(beats)
    with contextlib.suppress(OSError, AttributeError):
        if os.getpgid(0) == os.getpid():
            os.killpg(0, signal.SIGKILL)
    os._exit(1)
