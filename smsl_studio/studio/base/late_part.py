"""LatePart: a part of the window that is made when it is first needed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

Made = TypeVar("Made")


class LatePart(Generic[Made]):
    """A callable that returns the part. The first call makes it with ``make``."""

    def __init__(self, make: Callable[[], Made]) -> None:
        self._make = make
        self._then: list[Callable[[Made], object]] = []
        self.made: Made | None = None
        """The part; None as long as it has not been needed."""

    def __call__(self) -> Made:
        """Return the part, and make it first if necessary."""
        if self.made is None:
            self.made = self._make()
            for then in self._then:
                then(self.made)
        return self.made

    def when_made(self, then: Callable[[Made], object]) -> None:
        """Call ``then`` with the part as soon as it is made."""
        self._then.append(then)
