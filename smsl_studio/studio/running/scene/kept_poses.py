"""The poses of a run that was watched, kept so that a clip can be made of it."""

from __future__ import annotations

from bisect import bisect_right

import numpy as np
from numpy.typing import NDArray

EVERY = 0.1
"""Simulated seconds between two kept poses, as long as the run is short."""
MOST = 600
"""The largest number of poses that are kept. Of a longer run every second one is dropped."""


class KeptPoses:
    """Poses with their times, evenly spread over the run, oldest first.

    ``every`` is the time between two of them (simulated seconds), as long as the run is short.
    """

    def __init__(self, every: float = EVERY) -> None:
        self._first = every
        self.clear()

    def clear(self) -> None:
        """Forget all."""
        self._every = self._first
        self._times: list[float] = []
        self._poses: list[NDArray[np.float32]] = []

    def __len__(self) -> int:
        return len(self._times)

    def add(self, time: float, poses: tuple[float, ...]) -> None:
        """Keep poses (7 floats for each shape) if enough simulated seconds went by since the last
        ones. An earlier time begins anew."""
        if self._times and time < self._times[-1]:
            self.clear()
        if not poses or (self._times and time - self._times[-1] < self._every):
            return
        self._times.append(time)
        self._poses.append(np.array(poses, dtype=np.float32))
        if len(self._times) > MOST:
            self._times, self._poses = self._times[::2], self._poses[::2]
            self._every *= 2

    def spread(self, most: int) -> list[tuple[float, ...]]:
        """Return at most ``most`` poses, evenly chosen, the last among them."""
        last = len(self._poses) - 1
        count = min(most, last + 1)
        chosen = [round(n * last / max(count - 1, 1)) for n in range(count)]
        return [tuple(self._poses[n].tolist()) for n in chosen]

    def at(self, time: float) -> tuple[float, ...]:
        """Return the poses so many seconds after the first ones, mixed from those before and after.
        Empty if none are kept."""
        if not self._times:
            return ()
        time += self._times[0]
        after = min(bisect_right(self._times, time), len(self._times) - 1)
        before = max(after - 1, 0)
        span = self._times[after] - self._times[before]
        share = min(max((time - self._times[before]) / span, 0.0), 1.0) if span > 0 else 1.0
        low, high = (self._poses[n].reshape(-1, 7) for n in (before, after))
        # A quaternion and its negative are one rotation, so both are on one side before mixing.
        sign = np.where((low[:, 3:] * high[:, 3:]).sum(axis=1, keepdims=True) < 0, -1.0, 1.0)
        mixed = low + share * (np.hstack([high[:, :3], sign * high[:, 3:]]) - low)
        length = np.linalg.norm(mixed[:, 3:], axis=1, keepdims=True)
        mixed[:, 3:] /= np.where(length > 0, length, 1.0)
        return tuple(mixed.reshape(-1).tolist())

    @property
    def seconds(self) -> float:
        """The simulated seconds between the first and the last."""
        return self._times[-1] - self._times[0] if self._times else 0.0
