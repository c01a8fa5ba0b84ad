"""The limits of a child process, so that library code cannot exhaust the machine."""

from __future__ import annotations

import codecs
import contextlib
import os
import resource
import signal
import sys

from smsl_studio.legible import whole_text

MOST_SAID = 1_000_000
"""The largest number of a child's printed characters that are shown on standard error."""

MOST_FILES = 1024
"""The largest number of open files of a process with library code."""

_PIECE = 2**16


class Outlet:
    """Passes a child's printed output on to standard error, up to a limit of characters.

    Control characters are shown as escapes, so that no terminal obeys them. Reading never blocks.
    """

    def __init__(self, pipe: int, most: int = MOST_SAID) -> None:
        self._pipe = pipe
        self._left = most
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")

    def fileno(self) -> int:
        """Return the number of the pipe, for ``poll``."""
        return self._pipe

    def pass_on(self) -> bool:
        """Show one piece of the output. False if no more output can come."""
        with contextlib.suppress(BlockingIOError):
            return self._show(os.read(self._pipe, _PIECE))
        return True

    def close(self) -> None:
        """Show the rest of the output up to the limit, and close the pipe."""
        with contextlib.suppress(BlockingIOError):
            while self._left > 0 and self._show(os.read(self._pipe, _PIECE)):
                pass
        os.close(self._pipe)

    def _show(self, piece: bytes) -> bool:
        if piece and self._left > 0:
            text = self._decoder.decode(piece).replace("\r", "")[: self._left]
            self._left -= len(text)
            text = whole_text(text)
            _print(text if self._left else f"{text}\n... more is printed, and not shown\n")
        return bool(piece)


def _print(text: str) -> None:
    if sys.stderr is not None:
        with contextlib.suppress(OSError, ValueError):
            sys.stderr.write(text)
            sys.stderr.flush()


def settle_in() -> None:
    """Ignore Ctrl-C, which the parent handles, and send all printed output to standard error."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.stdout = sys.stderr


def limit_process(memory: int | None = None) -> None:
    """Limit this process, and each process that it starts, and allow no core dump.

    ``memory`` is the address space in bytes (None: half of the machine's memory, at least 2 GiB).
    ``MOST_FILES`` limits open files. Code that asks for more memory gets a MemoryError, code that
    opens more files gets an OSError.
    """
    whole = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    limits = (
        (resource.RLIMIT_AS, memory or max(whole // 2, 2**31)),
        (resource.RLIMIT_NOFILE, MOST_FILES),
        (resource.RLIMIT_CORE, 0),
    )
    for what, limit in limits:
        with contextlib.suppress(ValueError, OSError):  # there is a lower limit already
            resource.setrlimit(what, (limit, limit))
