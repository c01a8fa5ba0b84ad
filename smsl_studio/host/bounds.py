"""What a child may have and say at most, so that library code cannot drown the machine."""

from __future__ import annotations

import contextlib
import os
from typing import TextIO

MOST_SAID = 1_000_000
"""Characters that a child passes on to standard error, all in all."""


class Chatter:
    """A text stream that passes on so much and then says once that there was more."""

    def __init__(self, stream: TextIO | None, most: int = MOST_SAID) -> None:
        self._stream = stream
        self._left = most

    def write(self, text: str) -> int:
        """Pass the text on as long as there is room; it always counts as written."""
        if self._stream is not None and self._left > 0:
            passed = text[: self._left]
            self._left -= len(passed)
            with contextlib.suppress(OSError, ValueError):
                self._stream.write(passed)
                if self._left == 0:
                    self._stream.write("\n... more is printed, and not shown\n")
                self._stream.flush()
        return len(text)

    def flush(self) -> None:
        """Everything is flushed already."""

    def isatty(self) -> bool:
        """Never: it is no terminal."""
        return False

    def fileno(self) -> int:
        """The stream's own; OSError where there is none."""
        if self._stream is None:
            raise OSError("there is no standard error")
        return self._stream.fileno()


def limit_memory(size: int | None) -> None:
    """Let this process have so many bytes at most (None: half of what the machine has).

    More is a MemoryError for who asks for it. Where no such limit exists there is none.
    """
    try:
        import resource

        whole = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ImportError, AttributeError, ValueError, OSError):
        return
    with contextlib.suppress(ValueError, OSError):
        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (size or max(whole // 2, 2**31), hard))
