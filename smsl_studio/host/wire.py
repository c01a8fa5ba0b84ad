"""The parent's end of a child's pipe: answers are read piece by piece and believed little.

A child that stops in the middle of an answer, sends what is none, or one that is endless, must not
hold or break the parent. So nothing here blocks, and only our own values are made of what comes.
"""

from __future__ import annotations

import io
import os
import pickle
import struct
from multiprocessing.connection import Connection
from typing import Any

LARGEST = 256 * 2**20
"""Bytes of the longest answer."""

PIECE = 2**16
_HEAD = struct.Struct("!i")

_BUILTINS = {"set", "frozenset", "complex", "bytearray", "range", "slice", "object"}


class NoAnswer(Exception):  # noqa: N818
    """What came is no answer."""


class Wire:
    """Commands out, answers in."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._come = bytearray()

    def fileno(self) -> int:
        """What ``multiprocessing.connection.wait`` waits for."""
        return self._connection.fileno()

    def send(self, message: object) -> None:
        """Send a command; OSError where nobody listens."""
        self._connection.send(message)

    def read(self) -> tuple[str, Any] | None:
        """One piece of an answer, to be asked when there is one; the answer once it is whole.

        EOFError at the end, NoAnswer where it can be none.
        """
        piece = os.read(self.fileno(), PIECE)
        if not piece:
            raise EOFError
        self._come += piece
        if len(self._come) < _HEAD.size:
            return None
        (size,) = _HEAD.unpack_from(self._come)
        if not 0 <= size <= LARGEST:
            raise NoAnswer
        if len(self._come) < _HEAD.size + size:
            return None
        whole = bytes(self._come[_HEAD.size : _HEAD.size + size])
        del self._come[: _HEAD.size + size]
        return _answer(whole)

    def close(self) -> None:
        """Let go of the pipe."""
        self._connection.close()


def _answer(written: bytes) -> tuple[str, Any]:
    try:
        kind, value = _Reader(io.BytesIO(written)).load()
    except Exception as error:  # pickle raises whatever it stumbles over
        raise NoAnswer from error
    if kind not in ("ok", "refused", "crashed"):
        raise NoAnswer
    return kind, value


class _Reader(pickle.Unpickler):
    """Makes values of our own classes and of Python's plain ones."""

    def find_class(self, module: str, name: str) -> Any:
        own = module.partition(".")[0] == "smsl_studio"
        if own or (module == "builtins" and name in _BUILTINS):
            return super().find_class(module, name)
        raise pickle.UnpicklingError(f"{module}.{name} is none of our values")
