"""Sample: what one source says of one fact at one instant."""

from __future__ import annotations

from typing import NamedTuple

from smsl_studio.blueprint.check import FactKey

GOOD, UNCERTAIN, BAD = "good", "uncertain", "bad"
"""What a source thinks of its own reading. Only a good one is evidence."""


class Sample(NamedTuple):
    """One reading on its way to the monitor. It is a light value, because most are never used.

    ``value`` None means the source has no valid reading (its ``reason`` says why). ``time`` is the
    source's clock in seconds, which never goes back; ``sequence`` grows with every sample of a
    (source, boot), ``boot`` with every start of the source. ``received`` is when a sample of a
    sensor that is elsewhere came in, on this computer's monotonic clock; None: it is the run's own.
    ``node`` is the program elsewhere that says so; empty for those of this program.
    """

    branch: str
    digit: int
    source: str
    value: str | None
    time: float
    sequence: int
    boot: int = 0
    reason: str = ""
    quality: str = GOOD
    received: float | None = None
    node: str = ""

    @property
    def fact(self) -> FactKey:
        """The fact it speaks of."""
        return self.branch, self.digit

    @property
    def order(self) -> tuple[int, int]:
        """What must grow from one sample of a source to the next one that counts."""
        return self.boot, self.sequence
