"""The wire: both ends of the pipe between parent and child.

The parent trusts no message from the child, and its end never blocks. A command is a length
(uint32) and a pickled ``(number, verb, arguments)``; the child trusts its parent. A frame from the
child is a length and the number of its command (uint32 each), its kind (one byte), and its body.
A ``Codec`` reads the body. The numbers are big-endian.
"""

from __future__ import annotations

import contextlib
import pickle
import socket
import struct
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

LARGEST: Final = 64 * 2**20
"""The largest body of a frame, in bytes."""

PIECE = 2**16
KINDS = ("ok", "refused", "crashed", "loads")
"""The kinds of frames. ``loads`` reports progress and may come often; the others end the answer."""

_LENGTH, _HEAD = struct.Struct("!I"), struct.Struct("!IIB")


class NoAnswer(Exception):  # noqa: N818
    """The received bytes are no valid answer. The text says why."""


class WireFrame(NamedTuple):
    """A frame from the child: its kind and its body, which is not decoded yet."""

    kind: str
    body: bytes


class Wire:
    """The parent's end: it sends commands and reads frames, one command at a time."""

    def __init__(self, end: socket.socket, largest: int = LARGEST) -> None:
        end.setblocking(False)
        self._end = end
        self._largest = largest
        self._number = 0
        self._awaiting = False
        self._out = memoryview(b"")
        self._come = bytearray()

    def fileno(self) -> int:
        """Return the file number of the pipe, for ``poll``."""
        return self._end.fileno()

    @property
    def sending(self) -> bool:
        """Whether a part of the command is not sent yet."""
        return len(self._out) > 0

    def send(self, verb: str, arguments: Sequence[Any] = ()) -> None:
        """Begin to send a command, and send as much as the pipe accepts now.

        OSError if the child has closed its end.
        """
        self._number += 1
        self._awaiting = True
        written = pickle.dumps((self._number, verb, tuple(arguments)))
        self._out = memoryview(_LENGTH.pack(len(written)) + written)
        self.flush()

    def flush(self) -> None:
        """Send as much as the pipe accepts now. OSError if the child has closed its end."""
        with contextlib.suppress(BlockingIOError):
            while self._out:
                self._out = self._out[self._end.send(self._out) :]

    def read(self) -> WireFrame | None:
        """Read one piece without waiting. Return the next frame if it is complete, else None.

        EOFError if the child has closed its end. NoAnswer if the bytes are no valid frame.
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
        """Return the next frame if all its bytes were read already, else None. NoAnswer if the
        bytes are no valid frame."""
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
        """Close both directions of the pipe, so that the child notices the end."""
        with contextlib.suppress(OSError):
            self._end.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        """Close this end of the pipe."""
        self._end.close()


class ChildWire:
    """The child's end: it waits for commands and answers each of them."""

    def __init__(self, end: socket.socket) -> None:
        self._end = end
        self._number = 0

    def fileno(self) -> int:
        """Return the file number of the pipe, for ``poll``."""
        return self._end.fileno()

    def receive(self) -> tuple[str, tuple[Any, ...]]:
        """Wait for the next command and return its verb and arguments. EOFError or OSError if the
        parent is gone."""
        (size,) = _LENGTH.unpack(self._exactly(_LENGTH.size))
        # The child trusts its parent, so it may unpickle the values.
        self._number, verb, arguments = pickle.loads(self._exactly(size))
        return verb, arguments

    def send(self, kind: str, body: bytes) -> None:
        """Send a frame that answers the last command."""
        self._end.sendall(_HEAD.pack(len(body), self._number, KINDS.index(kind)) + body)

    def close(self) -> None:
        """Close this end of the pipe."""
        self._end.close()

    def _exactly(self, size: int) -> bytes:
        found = bytearray()
        while len(found) < size:
            piece = self._end.recv(min(size - len(found), 2**20))
            if not piece:
                raise EOFError
            found += piece
        return bytes(found)
