"""Faults that are injected into a world on purpose. A fault may last for several ticks."""

from __future__ import annotations

import inspect
from collections.abc import Generator, Mapping
from typing import Any

from smsl_studio.errors import HostError, PluginError, StudioError, UsageError, did_you_mean
from smsl_studio.host.brief import words_of
from smsl_studio.library.entries import FaultEntry


class Injections:
    """The faults that a world offers, by name. ``location`` is the folder of their code."""

    def __init__(self, world: str, offered: Mapping[str, FaultEntry], location: str = "") -> None:
        self._world = world
        self._offered = dict(offered)
        self._location = location
        self.ongoing: list[tuple[str, Generator[Any, Any, Any]]] = []
        """The faults that last, with the code that goes on at the next tick."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the faults that can be injected."""
        return tuple(self._offered)

    def inject(self, subject: Any, name: str, parameters: Mapping[str, Any]) -> None:
        """Begin a fault now.

        An unknown fault, or parameters that do not fit, raise UsageError. An error in the code of
        the fault raises HostError, because the state of the world is then unknown.
        """
        if name not in self._offered:
            there = f"There are {', '.join(self._offered)}." if self._offered else ""
            near = did_you_mean(name, self._offered) or there
            raise UsageError(f"the world {self._world!r} has no fault {name!r}", advice=near)
        entry = self._offered[name]
        try:
            arguments = entry.signature.checked(parameters)
        except PluginError as error:
            raise UsageError(f"the fault {name}: {error.sentence}", advice=error.advice) from None
        try:
            begun = entry.function(subject, **arguments)
            lasts = inspect.isgenerator(begun) and _resume(begun)
        except StudioError as error:
            raise UsageError(f"the fault {name}: {error.sentence}", advice=error.advice) from None
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # SystemExit, and what compiled libraries raise
            raise self._broke(name, error) from None
        if lasts:
            self.ongoing.append((name, begun))

    def resume(self) -> None:
        """Advance every fault that lasts by one tick."""
        ongoing, self.ongoing = self.ongoing, []
        for name, generator in ongoing:
            try:
                if _resume(generator):
                    self.ongoing.append((name, generator))
            except KeyboardInterrupt:
                raise
            except BaseException as error:
                raise self._broke(name, error) from None

    def drop(self) -> None:
        """Forget the faults that last, because the world begins anew."""
        self.ongoing = []

    def _broke(self, name: str, error: BaseException) -> HostError:
        words = words_of(error, self._location)
        return HostError(f"the fault {name!r} of the world {self._world!r} broke: {words}")


def _resume(generator: Generator[Any, Any, Any]) -> bool:
    """Run a fault to its next ``yield``. False if it has ended."""
    try:
        next(generator)
    except StopIteration:
        return False
    return True
