"""A child process of the parent's side: started, watched, ended with all that it started itself."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import threading
from collections.abc import Iterator
from typing import Any

from smsl_studio.host.child import serve
from smsl_studio.host.wire import Wire

PATIENCE = 2.0
"""Seconds that a child may take to end by itself."""


class Child:
    """A started child; ``prepared`` says that it was told its recipe already."""

    def __init__(self, process: Any, wire: Wire) -> None:
        self.wire = wire
        self.prepared = False
        self.pid: int = process.pid
        self.sentinel: int = process.sentinel
        self._process = process
        self._telling: threading.Thread | None = None

    def tell(self, message: object) -> None:
        """Send a command without waiting until a child that is still starting takes it in."""
        self._telling = threading.Thread(target=self._tell, args=(message,), daemon=True)
        self._telling.start()

    def _tell(self, message: object) -> None:
        with contextlib.suppress(OSError):  # its end is seen by whoever waits for the answer
            self.wire.send(message)

    def told(self) -> None:
        """Wait until it has taken in what it was told."""
        if self._telling is not None:
            self._telling.join()

    @property
    def dead(self) -> bool:
        """Whether it has ended; also where something it started keeps its pipes open."""
        return not self._process.is_alive()

    def ending(self) -> int | None:
        """How it ended: its exit status, or the number of the signal as a negative one."""
        self._process.join(PATIENCE)
        code: int | None = self._process.exitcode
        return code

    def dismiss(self) -> None:
        """Ask it to end, and give it a moment for that."""
        if self._process.is_alive():
            with contextlib.suppress(OSError):
                self.wire.send(("close", ()))
                self._process.join(PATIENCE)

    def kill(self) -> None:
        """End it and what it started, whatever they do, and free everything."""
        # It leads a group of its own from its first line on; before that it has started nothing.
        with contextlib.suppress(OSError, AttributeError):
            os.killpg(self.pid, signal.SIGKILL)
        self._process.kill()
        self._process.join()
        self._process.close()
        self.told()
        self.wire.close()


def start_child() -> Child:
    """Spawn a child that waits for commands; OSError where none can be started."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=serve, args=(theirs,), name="smsl-studio-world", daemon=True)
    try:
        with _ctrl_c_is_ours():
            process.start()
    except OSError:
        ours.close()
        raise
    finally:
        theirs.close()
    return Child(process, Wire(ours))


@contextlib.contextmanager
def _ctrl_c_is_ours() -> Iterator[None]:
    """A child started here is born deaf to Ctrl-C; signals can only be set in the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    kept = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, kept)
