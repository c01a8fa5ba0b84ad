"""LatePart: a part of the window that is made when it is first asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Generic, TypeVar

Made = TypeVar("Made")


class LatePart(Generic[Made]):
    """Called, it answers with the part. The first call makes it with ``make``."""

    def __init__(self, make: Callable[[], Made]) -> None:
        self._make = make
        self._then: list[Callable[[Made], object]] = []
        self.made: Made | None = None
        """The part; None as long as nobody has asked for it."""

    def __call__(self) -> Made:
        """The part; it is made now where it was not made before."""
        if self.made is None:
            self.made = self._make()
            for then in self._then:
                then(self.made)
        return self.made

    def when_made(self, then: Callable[[Made], object]) -> None:
        """Have ``then`` called with the part as soon as it is made."""
        self._then.append(then)
