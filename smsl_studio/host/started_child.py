"""A child process of the parent's side: started, watched, ended with all that it started itself.

A child is a fresh interpreter, in a process group of its own, that inherits four things: nothing to
read, a pipe for all it prints, the wire, and a pipe for its pulse.
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
"""Seconds that a child may take to end by itself."""

RELEASE = 0.1
"""Seconds that a child may take to see that nobody listens to it any more, or to obey the request
to end: who closes a run waits for that."""

LOOK = 0.05
"""Seconds after which a thread that tells a child something looks whether it still shall."""

WORLD = "smsl_studio.host.child"

_CODE = "import sys; sys.path[:] = {path}; from {module} import main; main(*map(int, sys.argv[1:]))"
"""What a child does first: to import from where its parent does. Before that it imports nothing
but ``sys``, which is built in: Python itself would look in the current folder first."""


class Child:
    """A started child; ``prepared`` says that it was told its recipe already."""

    def __init__(self, process: subprocess.Popen[bytes], wire: Wire, said: int, beats: int) -> None:
        self.wire = wire
        self.prepared = False
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
        """Send a command without waiting until a child that is still starting takes it in."""
        with contextlib.suppress(OSError):  # its end is seen by whoever waits for the answer
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
        """Leave what is left of a command to ``heard``; no other thread sends it from now on."""
        self._told.set()
        if self._telling is not None:
            self._telling.join()

    def heard(self, seconds: float) -> WireFrame | None:
        """The next frame, where it is there within so many seconds; sends and shows meanwhile.

        ChildProcessError where the child has ended and told all it had to tell, EOFError where it
        let go of the wire, NoAnswer where what it says is none.
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
        """Show what it has printed, where nothing is asked of it."""
        self._outlet.pass_on()

    def beats(self) -> bool:
        """Whether there was a heartbeat since this was asked last."""
        try:
            return bool(os.read(self._beats, 2**16))
        except OSError:
            return False

    def starved(self) -> bool:
        """Whether, since this was asked last, the machine gave it too little time to work."""
        before, self._given = self._given, ProcessorTime.of(self.pid)
        return self._given.starved_since(before)

    @property
    def dead(self) -> bool:
        """Whether it has ended; also where something it started keeps its pipes open."""
        try:
            return exit_code(self.pid) is not None
        except ChildProcessError:
            return True  # a signal broke off its end after it was waited for

    def ending(self) -> int | None:
        """How it ended: its exit status, or the number of the signal as a negative one."""
        self._await(PATIENCE)
        return exit_code(self.pid)

    def dismiss(self) -> None:
        """Ask it to end, and give it a moment for that."""
        if not self.dead:
            with contextlib.suppress(OSError):
                self.wire.send("close")
                self._await(RELEASE)

    def release(self) -> None:
        """Let go of it: a child that only waits ends what it does by itself, and soon."""
        self.wire.hang_up()
        self._await(RELEASE)
        self.kill()

    def kill(self) -> None:
        """End it and what it started, whatever they do, and free everything."""
        with contextlib.suppress(OSError):
            os.killpg(self.pid, signal.SIGKILL)
        self._process.wait()
        self.told()
        self._outlet.close()
        self.wire.close()
        os.close(self._beats)
        os.close(self._death)

    def _await(self, seconds: float) -> None:
        """Wait until it has ended, at most so long; what it prints meanwhile is shown."""
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
    """Start a child that runs ``main`` of a module; OSError where none can be started."""
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


def _pipe(ours: contextlib.ExitStack, theirs: contextlib.ExitStack) -> tuple[int, int]:
    read, write = os.pipe()
    ours.callback(os.close, read)
    theirs.callback(os.close, write)
    os.set_blocking(read, False)
    return read, write


def _python() -> list[str]:
    """The interpreter with the flags of this one; what it prints is not held back."""
    flags = ["-u", *["-B"] * sys.dont_write_bytecode, *["-O"] * sys.flags.optimize]
    return [sys.executable, *flags]


def _code(module: str) -> str:
    return _CODE.format(module=module, path=[str(entry) for entry in sys.path])
