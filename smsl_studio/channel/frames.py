"""Frames: a length (uint32, big-endian), then one JSON object in UTF-8. Every frame from outside is
checked, and its size is bounded before its bytes are kept."""

from __future__ import annotations

import json
import struct
from typing import Any

from smsl_studio.seal.strict_json import strict_decoder

Json = Any
Frame = dict[str, Any]

VERSION = 1
"""The version of the protocol."""

LARGEST = 4 << 20
"""The largest size of any frame, in bytes."""

LARGEST_HELLO = 4096
"""The largest first frame of a program that has not shown its token, in bytes."""

LARGEST_QUESTION = 65536
"""The largest question after ``open``, in bytes."""

_LENGTH = struct.Struct("!I")


class ChannelError(Exception):
    """The connection is lost, or the other side has not kept to the protocol. The text says why."""


_JSON = strict_decoder(ChannelError, "a key stands twice in one object")


def frame_bytes(frame: Frame) -> bytes:
    """Return the bytes of a frame. ChannelError if it is too large."""
    written = json.dumps(frame, separators=(",", ":"), allow_nan=False).encode()
    if len(written) > LARGEST:
        raise ChannelError(f"a frame of {len(written):,} bytes is larger than {LARGEST:,}")
    return _LENGTH.pack(len(written)) + written


class FrameBuffer:
    """Collects bytes from the other side, and cuts them into frames.

    ``largest`` is the size of the largest frame that may come now, in bytes.
    """

    def __init__(self, largest: int) -> None:
        self.largest = largest
        self._bytes = bytearray()

    def __len__(self) -> int:
        """The number of bytes that are not yet part of a frame that was taken."""
        return len(self._bytes)

    def add(self, piece: bytes) -> None:
        """Keep bytes that have come."""
        self._bytes += piece

    def take(self) -> Frame | None:
        """Return the next frame, None if it has not come completely. ChannelError if the bytes are
        no frame, or if the frame is too large."""
        if len(self._bytes) < _LENGTH.size:
            return None
        (size,) = _LENGTH.unpack_from(self._bytes)
        if not 0 < size <= self.largest:
            raise ChannelError(f"a frame of {size:,} bytes, not of 1 to {self.largest:,}")
        end = _LENGTH.size + size
        if len(self._bytes) < end:
            return None
        raw = bytes(self._bytes[_LENGTH.size : end])
        del self._bytes[:end]
        return _read(raw)


def _read(raw: bytes) -> Frame:
    try:
        found = _JSON.decode(raw.decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise ChannelError(f"a frame that is no JSON: {str(error)[:80]}") from None
    if not isinstance(found, dict):
        raise ChannelError("a frame that is no JSON object")
    return found
