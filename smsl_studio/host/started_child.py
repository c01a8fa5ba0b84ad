"""A child process, seen from its parent: it is started, watched, and ended with its own children.

A child is a fresh interpreter in a process group of its own. It inherits an empty standard input, a
pipe for its printed output, the wire for commands and answers, and a pipe for its heartbeat. Times
are wall time.
"""

from __future__ import annotations

import contextlib
import os
import select
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from typing import Any

from smsl_studio.host.bounds import Outlet
from smsl_studio.host.exit_words import exit_code
from smsl_studio.host.processor import ProcessorTime
from smsl_studio.host.wire import Wire, WireFrame

PATIENCE = 2.0
"""The time (s) that a child may take to end by itself."""

RELEASE = 0.1
"""The time (s) that a child may take to notice the closed wire, or to obey the request to end. The
end of a run waits for it, so it is short."""

LOOK = 0.05
"""The time (s) after which the sending thread checks whether it must stop."""

WORLD = "smsl_studio.host.child"

_CODE = "import sys; sys.path[:] = {path}; from {module} import main; main(*map(int, sys.argv[1:]))"
"""The first code of a child: it takes over the parent's import path. Before that it imports only
``sys``, which is built in, because Python would search the current folder first."""


class Child:
    """A started child process. ``prepared`` says that its recipe was sent already."""

    def __init__(self, process: subprocess.Popen[bytes], wire: Wire, said: int, beats: int) -> None:
        self.wire = wire
        self.prepared = False
        self.shut_out = False
        self.pid = process.pid
        self._process = process
        self._outlet = Outlet(said)
        self._beats = beats
        self._death = os.pidfd_open(process.pid)
        self._look = select.poll()
        for one in (wire.fileno(), said, self._death):
            self._look.register(one, select.POLLIN)
        self._given = ProcessorTime(time.monotonic())
        self._telling: threading.Thread | None = None
        self._told = threading.Event()

    def tell(self, verb: str, arguments: Sequence[Any] = ()) -> None:
        """Send a command without waiting for a child that is still starting."""
        with contextlib.suppress(OSError):  # the call that waits for the answer sees its end
            self.wire.send(verb, arguments)
        self._telling = threading.Thread(target=self._tell, daemon=True)
        self._telling.start()

    def _tell(self) -> None:
        ready = select.poll()
        ready.register(self.wire.fileno(), select.POLLOUT)
        with contextlib.suppress(OSError):
            while self.wire.sending and not self._told.is_set():
                if ready.poll(LOOK * 1000):
                    self.wire.flush()

    def told(self) -> None:
        """End the sending thread. ``heard`` sends the rest of the command."""
        self._told.set()
        if self._telling is not None:
            self._telling.join()

    def heard(self, seconds: float) -> WireFrame | None:
        """Return the next frame if it comes within ``seconds``, else None.

        Meanwhile the rest of a command is sent, and printed output is shown. ChildProcessError:
        the child has ended and all its frames were read. EOFError: the child closed the wire.
        NoAnswer: the bytes are no valid answer.
        """
        frame = self.wire.come()
        if frame is not None:
            return frame
        wire, outlet = self.wire.fileno(), self._outlet.fileno()
        if self.wire.sending:
            self._look.modify(wire, select.POLLIN | select.POLLOUT)
        ready = {one for one, _ in self._look.poll(seconds * 1000)}
        if self.wire.sending:
            self.wire.flush()
            self._look.modify(wire, select.POLLIN)
        if outlet in ready and not self._outlet.pass_on():
            self._look.unregister(outlet)
        if wire in ready:
            return self.wire.read()
        if self._death in ready:
            raise ChildProcessError
        return None

    def show(self) -> None:
        """Show the printed output of a child that has no command to answer."""
        self._outlet.pass_on()

    def beats(self) -> bool:
        """Whether there was a heartbeat since the last call."""
        try:
            return bool(os.read(self._beats, 2**16))
        except OSError:
            return False

    def starved(self) -> bool:
        """Whether the child has had too little processor time for a short answer since the last
        call. ``shut_out`` says then whether it has had next to none."""
        before, self._given = self._given, ProcessorTime.of(self.pid)
        self.shut_out = self._given.shut_out_since(before)
        return self._given.starved_since(before)

    @property
    def dead(self) -> bool:
        """Whether the child has ended. Its own children may still keep its pipes open."""
        try:
            return exit_code(self.pid) is not None
        except ChildProcessError:
            return True  # a signal interrupted ``kill`` after the child was reaped

    def ending(self) -> int | None:
        """Return its exit status, or the negative number of the signal that ended it. None if it
        still lives after ``PATIENCE``."""
        self._await(PATIENCE)
        return exit_code(self.pid)

    def dismiss(self) -> None:
        """Ask the child to end, and wait for at most ``RELEASE`` seconds."""
        if not self.dead:
            with contextlib.suppress(OSError):
                self.wire.send("close")
                self._await(RELEASE)

    def release(self) -> None:
        """Close the wire, give the child ``RELEASE`` seconds to end by itself, then kill it."""
        self.wire.hang_up()
        self._await(RELEASE)
        self.kill()

    def kill(self) -> None:
        """Kill the child and its process group, and free all resources."""
        with contextlib.suppress(OSError):
            os.killpg(self.pid, signal.SIGKILL)
        self._process.wait()
        self.told()
        self._outlet.close()
        self.wire.close()
        os.close(self._beats)
        os.close(self._death)

    def _await(self, seconds: float) -> None:
        """Wait for the end of the child, at most ``seconds``. Printed output is shown meanwhile."""
        until = time.monotonic() + seconds
        ends = select.poll()
        for one in (self._death, self._outlet.fileno()):
            ends.register(one, select.POLLIN)
        while (left := until - time.monotonic()) > 0:
            ready = {one for one, _ in ends.poll(left * 1000)}
            if self._death in ready:
                return
            if ready and not self._outlet.pass_on():
                ends.unregister(self._outlet.fileno())


def start_child(module: str = WORLD) -> Child:
    """Start a child that runs ``main`` of a module. OSError if no process can be started."""
    with contextlib.ExitStack() as theirs, contextlib.ExitStack() as ours:
        near, far = socket.socketpair()
        ours.callback(near.close)
        theirs.callback(far.close)
        beats, beat = _pipe(ours, theirs)
        said, out = _pipe(ours, theirs)
        pipes = (far.fileno(), beat)
        process = subprocess.Popen(
            [*_python(), "-c", _code(module), *map(str, pipes)],
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=out,
            pass_fds=pipes,
            env=environment_of_child(),
            process_group=0,
        )
        try:
            child = Child(process, Wire(near), said, beats)
        except OSError:
            process.kill()
            process.wait()
            raise
        ours.pop_all()
        return child


def environment_of_child() -> dict[str, str]:
    """Return the environment of this process without passphrases: whoever runs code of plugins has
    no use for them."""
    return {
        name: value
        for name, value in os.environ.items()
        if not (name.startswith("SMSL_") and name.endswith("PASSPHRASE"))
    }


def _pipe(ours: contextlib.ExitStack, theirs: contextlib.ExitStack) -> tuple[int, int]:
    read, write = os.pipe()
    ours.callback(os.close, read)
    theirs.callback(os.close, write)
    os.set_blocking(read, False)
    return read, write


def _python() -> list[str]:
    """Return the command of the interpreter, with the flags of this one and unbuffered output."""
    flags = ["-u", *["-B"] * sys.dont_write_bytecode, *["-O"] * sys.flags.optimize]
    return [sys.executable, *flags]


def _code(module: str) -> str:
    return _CODE.format(module=module, path=[str(entry) for entry in sys.path])
