"""The two ends of a child's pipe. The parent trusts no message and never waits for one here.

A command is a length (uint32) and a pickled ``(number, verb, arguments)``: the child trusts its
parent. A frame of the child is a length, the number of the command it belongs to (uint32 each), its
kind (one byte) and its bytes; what they mean is a ``Codec``'s. All are big-endian.
"""

from __future__ import annotations

import contextlib
import pickle
import socket
import struct
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

LARGEST: Final = 64 * 2**20
"""Bytes of the longest frame."""

PIECE = 2**16
KINDS = ("ok", "refused", "crashed", "loads")
"""The last one says what the child is at, and may come often; the others end the answer."""

_LENGTH, _HEAD = struct.Struct("!I"), struct.Struct("!IIB")


class NoAnswer(Exception):  # noqa: N818
    """What came is no answer; the text says why."""


class WireFrame(NamedTuple):
    """One piece of an answer, not looked into."""

    kind: str
    body: bytes


class Wire:
    """The parent's end: commands out, frames in, one command at a time."""

    def __init__(self, end: socket.socket, largest: int = LARGEST) -> None:
        end.setblocking(False)
        self._end = end
        self._largest = largest
        self._number = 0
        self._awaiting = False
        self._out = memoryview(b"")
        self._come = bytearray()

    def fileno(self) -> int:
        """What is waited for."""
        return self._end.fileno()

    @property
    def sending(self) -> bool:
        """Whether there is still something to be sent."""
        return len(self._out) > 0

    def send(self, verb: str, arguments: Sequence[Any] = ()) -> None:
        """Begin to send a command, and send as much as is taken in at once.

        OSError where nobody listens.
        """
        self._number += 1
        self._awaiting = True
        written = pickle.dumps((self._number, verb, tuple(arguments)))
        self._out = memoryview(_LENGTH.pack(len(written)) + written)
        self.flush()

    def flush(self) -> None:
        """Send on what is taken in now; OSError where nobody listens."""
        with contextlib.suppress(BlockingIOError):
            while self._out:
                self._out = self._out[self._end.send(self._out) :]

    def read(self) -> WireFrame | None:
        """Read one piece, without waiting; the next frame, where it is whole now.

        EOFError at the end, NoAnswer where it can be none.
        """
        try:
            piece = self._end.recv(PIECE)
        except BlockingIOError:
            return None
        if not piece:
            raise EOFError
        self._come += piece
        return self.come()

    def come(self) -> WireFrame | None:
        """The next frame, where it was read already; NoAnswer where it can be none."""
        if len(self._come) < _HEAD.size:
            return None
        size, number, kind = _HEAD.unpack_from(self._come)
        if size > self._largest:
            raise NoAnswer(f"it has {size} bytes, more than {self._largest}")
        if kind >= len(KINDS):
            raise NoAnswer(f"it is of kind {kind}, which there is not")
        if number != self._number or not self._awaiting:
            raise NoAnswer("nothing was asked that it answers")
        end = _HEAD.size + size
        if len(self._come) < end:
            return None
        body = bytes(self._come[_HEAD.size : end])
        del self._come[:end]
        self._awaiting = KINDS[kind] == "loads"
        if self._come and not self._awaiting:
            raise NoAnswer("something stands behind it")
        return WireFrame(KINDS[kind], body)

    def hang_up(self) -> None:
        """Close both directions of the pipe, which the child notices."""
        with contextlib.suppress(OSError):
            self._end.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """Let go of the pipe."""
        self._end.close()


class ChildWire:
    """The child's end: it waits for commands, and answers each of them."""

    def __init__(self, end: socket.socket) -> None:
        self._end = end
        self._number = 0

    def fileno(self) -> int:
        """The pipe, to see when the parent is gone."""
        return self._end.fileno()

    def receive(self) -> tuple[str, tuple[Any, ...]]:
        """The next command and its arguments; EOFError or OSError where the parent is gone."""
        (size,) = _LENGTH.unpack(self._exactly(_LENGTH.size))
        # The parent is trusted, and so are its values.
        self._number, verb, arguments = pickle.loads(self._exactly(size))
        return verb, arguments

    def send(self, kind: str, body: bytes) -> None:
        """A frame about the command that was received last."""
        self._end.sendall(_HEAD.pack(len(body), self._number, KINDS.index(kind)) + body)

    def close(self) -> None:
        """Let go of the pipe."""
        self._end.close()

    def _exactly(self, size: int) -> bytes:
        found = bytearray()
        while len(found) < size:
            piece = self._end.recv(min(size - len(found), 2**20))
            if not piece:
                raise EOFError
            found += piece
        return bytes(found)
