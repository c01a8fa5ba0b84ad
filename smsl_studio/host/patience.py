"""How long a program waits for a child process: the time in which the child could have worked."""

from __future__ import annotations

import time

STALL = 0.1
"""The longest wall time (s) between two looks at a child that counts whole. After a longer one the
machine gave this program itself no processor time."""

SPARED = 10.0
"""How much more wall time is left out at most, in multiples of the limit."""


class Patience:
    """One wait for a child. Its ``limit`` (s) counts only the time in which the child could have
    worked.

    A busy machine may give a child next to no processor time for seconds. Such time is left out, so
    that the trace of a run does not depend on what else the machine does. It is left out up to
    ``SPARED`` times the limit, for a child may take its time from itself. A ``strict`` wait counts
    all wall time. It is for hardware, which moves on while nobody watches it.
    """

    def __init__(self, limit: float, *, strict: bool = False) -> None:
        self._began = self._at = time.monotonic()
        self._limit = limit
        self._spare = 0.0 if strict else SPARED * limit
        self._left_out = 0.0

    def look(self, *, shut_out: bool = False) -> None:
        """Look at the clock again. ``shut_out`` says that the child had next to no processor time
        since the last look."""
        now = time.monotonic()
        passed, self._at = now - self._at, now
        out = passed if shut_out else max(0.0, passed - STALL)
        self._left_out += min(out, self._spare - self._left_out)

    @property
    def over(self) -> bool:
        """Whether the limit is passed."""
        return self._at - self._began - self._left_out > self._limit

    @property
    def words(self) -> str:
        """How long the wait has lasted, and how much of it was left out."""
        whole = f"{self._at - self._began:.1f} s"
        if self._left_out < 1.0:
            return whole
        return f"{whole} ({self._left_out:.0f} s of it without processor time)"
