"""Silence: hides the output of compiled code that prints without asking Python."""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress


@contextmanager
def silence() -> Iterator[None]:
    """Discard standard output and error inside the block, because Bullet prints from C."""
    _flush()
    nowhere = os.open(os.devnull, os.O_WRONLY)
    kept: list[tuple[int, int]] = []
    for stream in (1, 2):
        with suppress(OSError):  # a program without a console may not have this stream
            kept.append((stream, os.dup(stream)))
            os.dup2(nowhere, stream)
    try:
        yield
    finally:
        _flush()
        for stream, copy in kept:
            os.dup2(copy, stream)
            os.close(copy)
        os.close(nowhere)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        with suppress(AttributeError, OSError, ValueError):
            stream.flush()
    with suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).fflush(None)
