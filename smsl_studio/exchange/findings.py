"""What a form of another program cannot hold, told one by one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

MOST = 1_000
"""The largest number of findings that are told. Further ones are counted."""


class ExchangeFinding(NamedTuple):
    """One thing that a form does not hold, or that was changed on the way.

    ``kind`` is one word for it. ``address`` is that of the blueprint, or what the other program
    calls the element. Line and column are those of the file that was read, 0 if there is none.
    """

    kind: str
    address: str
    message: str
    line: int = 0
    column: int = 0

    @property
    def plain(self) -> dict[str, str | int]:
        """The finding as an object of JSON."""
        return self._asdict()


class ExchangeFindings:
    """Collects findings. Equal ones are told once."""

    def __init__(self) -> None:
        self._found: dict[ExchangeFinding, None] = {}
        self._more = 0

    def add(self, kind: str, address: str, message: str, place: tuple[int, int] = (0, 0)) -> None:
        """Add a finding, with the line and the column of its place."""
        if len(self._found) < MOST:
            self._found[ExchangeFinding(kind, address, message, *place)] = None
        else:
            self._more += 1

    def __iter__(self) -> Iterator[ExchangeFinding]:
        yield from self._found
        if self._more:
            yield ExchangeFinding("more", "", f"{self._more:,} further findings are not listed.")
