"""Around every call of library code: errors become a HostError, prints go to standard error."""

from __future__ import annotations

import sys

from smsl_studio.errors import HostError
from smsl_studio.host.brief import words_of


class HostErrors:
    """Turns errors of library code into a HostError. It is entered at every tick, so it is a class
    with slots, and no generator."""

    __slots__ = ("_location", "_passes", "_what")

    def __init__(self, what: str, location: str, passes: type[BaseException]) -> None:
        self._what, self._location, self._passes = what, location, passes

    def __enter__(self) -> None: ...

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        if error is not None:
            self.mend(error)

    def mend(self, error: BaseException) -> None:
        """Raise a HostError about ``error``, unless the error passes."""
        # BaseException: library code may also raise SystemExit or errors of compiled libraries.
        if not isinstance(error, (KeyboardInterrupt, self._passes)):
            raise HostError(f"{self._what}: {words_of(error, self._location)}") from None


class prints_aside:  # noqa: N801 -- used as contextlib's own are
    """Sends printed output to standard error."""

    __slots__ = ("_kept",)

    def __enter__(self) -> None:
        self._kept, sys.stdout = sys.stdout, sys.stderr

    def __exit__(self, *_: object) -> None:
        sys.stdout = self._kept
