"""A running call: one generator of the Operation Library, which is resumed once per tick."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

from smsl_studio.host.brief import brief, words_of
from smsl_studio.host.guard_functions import refusal
from smsl_studio.host.protocol import RETURNED, RUNNING, Outcome
from smsl_studio.library.bound import BoundOperation


class Call:
    """The running library function of one edge, until it ends or is cancelled."""

    __slots__ = ("_bound", "_generator", "_subject")

    def __init__(self, bound: BoundOperation, subject: Any) -> None:
        self._bound = bound
        self._subject = subject
        self._generator: Generator[Any, Any, Any] | None = None

    def resume(self) -> tuple[Outcome, str]:
        """Run the function to its next ``yield``. Return its state and a message."""
        try:
            if self._generator is None:
                reason = refusal(self._bound, self._subject)
                if reason:
                    return Outcome.FAILED, f"{self._bound.name} is not available: {reason}"
                self._generator = self._bound.function(self._subject, **self._bound.arguments)
            next(self._generator)
        except StopIteration as end:
            if end.value is False:
                return Outcome.FAILED, f"{self._bound.name} says that it failed"
            return RETURNED, brief(end.value) if type(end.value) is str else ""
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # SystemExit, and what compiled libraries raise
            return Outcome.RAISED, words_of(error, self._bound.location)
        return RUNNING, ""

    def drop(self) -> None:
        """End the function at its current ``yield``. Errors that it raises then are ignored."""
        if self._generator is not None:
            try:
                self._generator.close()
            except KeyboardInterrupt:
                raise
            except BaseException:
                return
