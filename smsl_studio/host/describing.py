"""What the plugins offer, without their code: a child loads them, and only words come back.

Loading a plugin runs its code, and that may end or hang the process it runs in. Who only wants to
know what there is (the window, ``plugins``, a run whose world lives in a child) asks ``describe``:
a plugin that takes the child down is one named fault, and the others are there all the same.
"""

from __future__ import annotations

import contextlib
import io
import json
import multiprocessing
import os
import pickle
import signal
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any, NoReturn

from smsl_studio.errors import HostError
from smsl_studio.host.bounds import Chatter
from smsl_studio.host.ending import ending_words
from smsl_studio.library.loading import Loaded, PluginFault, discover

LIMIT = 20.0
"""Wall seconds that one plugin may take to load."""

DONE = b"done:"
"""Begins the last message; every other names the plugin that is being loaded."""

LARGEST = 32 * 2**20
"""Bytes of the longest description that is read."""

_KNOWN = ("smsl_studio", "builtins", "re", "collections", "pathlib", "types", "copyreg", "_codecs")
"""Modules of values that a description may hold."""


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """Stands for code that is not here; calling it is a HostError."""

    name: str

    def __call__(self, *_: Any, **__: Any) -> NoReturn:
        raise HostError(f"{self.name} is not here: its code runs in the world's process")


def describe(plugin_paths: Sequence[Path] = (), limit: float = LIMIT) -> Loaded:
    """What ``discover`` finds, with ``Elsewhere`` in the place of all code.

    Takes about as long as starting Python. HostError where no child can be started.
    """
    lost: list[PluginFault] = []
    while True:
        skip = frozenset(fault.location for fault in lost)
        found, culprit = _asked(tuple(map(str, plugin_paths)), skip, limit)
        if found is not None:
            return replace(found, faults=(*found.faults, *lost))
        if culprit is None or culprit.location in skip:
            words = culprit.sentence if culprit else "it ended before it came to one"
            raise HostError(f"the plugins cannot be looked at: {words}")
        lost.append(culprit)


def _asked(
    paths: Sequence[str], skip: frozenset[str], limit: float
) -> tuple[Loaded | None, PluginFault | None]:
    """What a child tells, or the plugin it was at when it died or hung."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    child = context.Process(
        target=_serve, args=(theirs, paths, skip), name="smsl-studio-plugins", daemon=True
    )
    try:
        child.start()
    except OSError as error:
        ours.close()
        raise HostError(f"no process can be started: {error.strerror or error}") from None
    finally:
        theirs.close()
    at: tuple[str, str] | None = None
    try:
        while wait([ours], limit):
            told = ours.recv_bytes(LARGEST)
            if told.startswith(DONE):
                return _read(told.removeprefix(DONE)), None
            name, location = json.loads(told)
            at = (name, location)
        return None, _fault(at, f"it did not load within {limit:g} s")
    except (EOFError, OSError):
        child.join(2.0)
        return None, _fault(at, f"the process that loaded it {ending_words(child.exitcode)}")
    finally:
        ours.close()
        child.kill()
        child.join()
        child.close()


def _serve(connection: Connection, paths: Sequence[str], skip: frozenset[str]) -> None:
    """The child's whole life: load one plugin after the other, saying which, and describe them."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.stdout = sys.stderr = Chatter(sys.stderr)
    with contextlib.suppress(OSError):
        os.dup2(2, 1)

    def begins(name: str, location: str) -> None:
        connection.send_bytes(json.dumps((name, location)).encode())

    loaded = discover([Path(path) for path in paths], skip=skip, begins=begins)
    described = []
    faults = list(loaded.faults)
    for plugin in loaded.plugins:
        try:
            _read(_written(Loaded((plugin,))))
        except Exception as error:  # what a plugin keeps in its library may refuse in any way
            words = f"it cannot be described: {type(error).__name__}: {error}"
            faults.append(PluginFault(plugin.name, words, None, plugin.location))
        else:
            described.append(plugin)
    connection.send_bytes(DONE + _written(Loaded(tuple(described), tuple(faults))))
    # What a plugin registered to run at exit must not undo what was told.
    connection.close()
    os._exit(0)


def _fault(at: tuple[str, str] | None, words: str) -> PluginFault | None:
    return PluginFault(at[0], words, None, at[1]) if at else None


def _written(loaded: Loaded) -> bytes:
    file = io.BytesIO()
    _Words(file).dump(loaded)
    return file.getvalue()


def _read(written: bytes) -> Loaded:
    loaded = _Reader(io.BytesIO(written)).load()
    if not isinstance(loaded, Loaded):
        raise pickle.UnpicklingError("no description of plugins")
    return loaded


class _Words(pickle.Pickler):
    """Writes values; functions and classes that are a plugin's own are only named."""

    def reducer_override(self, value: Any) -> Any:
        if not isinstance(value, type) and not callable(value):
            return NotImplemented
        module = getattr(value, "__module__", "") or ""
        if isinstance(value, type):
            return NotImplemented if _is_known(module) else (_any_type, ())
        if isinstance(value, Elsewhere) or (_is_known(module) and hasattr(value, "__qualname__")):
            return NotImplemented
        name = getattr(value, "__name__", type(value).__name__)
        return (Elsewhere, (str(name),))


class _Reader(pickle.Unpickler):
    """Reads values of our own classes and Python's plain ones, and nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        if not _is_known(module):
            raise pickle.UnpicklingError(f"{module}.{name} is not known here")
        return super().find_class(module, name)


def _is_known(module: str) -> bool:
    return module.partition(".")[0] in _KNOWN


def _any_type() -> type:
    """Stands for a type that only the plugin knows."""
    return object
