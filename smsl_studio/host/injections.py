"""Faults that are injected into a world on purpose, and those that still go on."""

from __future__ import annotations

import inspect
from collections.abc import Generator, Mapping
from typing import Any

from smsl_studio.errors import HostError, PluginError, StudioError, UsageError, did_you_mean
from smsl_studio.host.call import words_of
from smsl_studio.library.operation_library import FaultEntry


class Injections:
    """The faults that a world offers by name; ``location`` is the folder of their code."""

    def __init__(self, world: str, offered: Mapping[str, FaultEntry], location: str = "") -> None:
        self._world = world
        self._offered = dict(offered)
        self._location = location
        self._going: list[tuple[str, Generator[Any, Any, Any]]] = []

    @property
    def names(self) -> tuple[str, ...]:
        """What can be injected."""
        return tuple(self._offered)

    def inject(self, subject: Any, name: str, parameters: Mapping[str, Any]) -> None:
        """Let a fault begin now; UsageError where it is unknown or cannot be done as asked.

        HostError where its code breaks: nobody knows then what it has done to the world.
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
            ongoing = inspect.isgenerator(begun) and _goes_on(begun)
        except StudioError as error:
            raise UsageError(f"the fault {name}: {error.sentence}", advice=error.advice) from None
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # SystemExit, and what compiled libraries raise
            raise self._broke(name, error) from None
        if ongoing:
            self._going.append((name, begun))

    def resume(self) -> None:
        """Let every fault that goes on do its share of this tick."""
        if not self._going:
            return
        going, self._going = self._going, []
        for name, generator in going:
            try:
                if _goes_on(generator):
                    self._going.append((name, generator))
            except KeyboardInterrupt:
                raise
            except BaseException as error:
                raise self._broke(name, error) from None

    def drop(self) -> None:
        """Forget what goes on: the world begins anew."""
        self._going = []

    def _broke(self, name: str, error: BaseException) -> HostError:
        words = words_of(error, self._location)
        return HostError(f"the fault {name!r} of the world {self._world!r} broke: {words}")


def _goes_on(generator: Generator[Any, Any, Any]) -> bool:
    try:
        next(generator)
    except StopIteration:
        return False
    return True
