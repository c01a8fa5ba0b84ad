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
"""Characters of a child that are shown on standard error, all in all."""

MOST_FILES = 1024
"""Files that a process of library code may have open."""

_PIECE = 2**16


class Outlet:
    """What a child prints, on its way to standard error: up to a limit, then a note of more.

    Control characters are shown as escapes, so that no terminal obeys them. The pipe does not
    block.
    """

    def __init__(self, pipe: int, most: int = MOST_SAID) -> None:
        self._pipe = pipe
        self._left = most
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")

    def fileno(self) -> int:
        """What is waited for."""
        return self._pipe

    def pass_on(self) -> bool:
        """Show one piece of what was printed; False where nothing more can come."""
        with contextlib.suppress(BlockingIOError):
            return self._show(os.read(self._pipe, _PIECE))
        return True

    def close(self) -> None:
        """Show what is left, as far as it goes, and let go of the pipe."""
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
    """Leave Ctrl-C to the parent, and send all that is printed to one place."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    sys.stdout = sys.stderr


def limit_process(memory: int | None = None) -> None:
    """Let this process, and each that it starts, have so many bytes of address space at most
    (None: half of what the machine has), so many open files, and leave no memory image behind.

    More memory is a MemoryError for who asks for it, more files are an OSError.
    """
    whole = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    limits = (
        (resource.RLIMIT_AS, memory or max(whole // 2, 2**31)),
        (resource.RLIMIT_NOFILE, MOST_FILES),
        (resource.RLIMIT_CORE, 0),
    )
    for what, limit in limits:
        with contextlib.suppress(ValueError, OSError):  # a lower one stands already
            resource.setrlimit(what, (limit, limit))
