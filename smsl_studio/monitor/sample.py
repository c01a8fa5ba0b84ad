"""Sample: what one source says of one fact at one instant."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sample:
    """One reading on its way to the monitor.

    ``value`` None means the source has no valid reading (its ``reason`` says why). ``time`` is the
    source's clock in seconds; ``sequence`` grows with every sample of a (source, boot).
    """

    branch: str
    digit: int
    source: str
    value: str | None
    time: float
    sequence: int
    boot: int = 0
    reason: str = ""
