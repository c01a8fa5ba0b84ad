"""Poses and a pulse in shared memory: the child writes, the parent reads, nobody waits.

Layout: the pulse (uint64, grows while the child lives), the sequence (uint64, odd while poses are
being written), then 7 doubles a shape.
"""

from __future__ import annotations

import struct
import threading
from collections.abc import Sequence
from multiprocessing.shared_memory import SharedMemory

_PULSE, _SEQUENCE, _POSES = 0, 8, 16
_TRIES = 64


class SharedPoses:
    """One block of shared memory. The side that made it frees it, also after the other has died."""

    def __init__(self, count: int, name: str | None = None) -> None:
        """Make a block for ``count`` floats, or attach to the one called ``name``."""
        self._form = struct.Struct(f"{count}d")
        self._owner = name is None
        size = _POSES + self._form.size
        self._block = SharedMemory(name, create=self._owner, size=size)
        self._buffer: memoryview | None = self._block.buf
        self._newest: tuple[float, ...] = (0.0,) * count
        self.name = self._block.name
        self._closing = threading.Lock()

    def beat(self, count: int) -> None:
        """Write the pulse (the child's side)."""
        if self._buffer is not None:
            struct.pack_into("Q", self._buffer, _PULSE, count)

    @property
    def pulse(self) -> int:
        """The newest pulse."""
        return self._number(_PULSE)

    def write(self, poses: Sequence[float]) -> None:
        """Write the poses (the child's side); as many floats as the block was made for."""
        if self._buffer is None:
            return
        sequence = self._number(_SEQUENCE)
        struct.pack_into("Q", self._buffer, _SEQUENCE, sequence + 1)
        self._form.pack_into(self._buffer, _POSES, *poses)
        struct.pack_into("Q", self._buffer, _SEQUENCE, sequence + 2)

    def read(self) -> tuple[float, ...]:
        """The newest whole poses; those read before, where the writer is always in between.

        Safe from another thread than the one that closes.
        """
        with self._closing:
            for _ in range(_TRIES):
                if self._buffer is None:
                    break
                before = self._number(_SEQUENCE)
                if before % 2:
                    continue
                found = self._form.unpack_from(self._buffer, _POSES)
                if self._number(_SEQUENCE) == before:
                    self._newest = found
                    break
            return self._newest

    def close(self) -> None:
        """Let go of the block, and free it if it was made here; twice is harmless."""
        with self._closing:
            if self._buffer is None:
                return
            self._buffer = None
            self._block.close()
            if self._owner:
                self._block.unlink()

    def _number(self, at: int) -> int:
        if self._buffer is None:
            return 0
        value: int = struct.unpack_from("Q", self._buffer, at)[0]
        return value
