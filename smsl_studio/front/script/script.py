"""A script as values: acts with their moments."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.errors import Place

Json = Any
AT, WHEN, DURING, ASKED = "at", "when", "during", "asked"
EVERY = 0
"""The value of ``times`` that means every time."""

MOMENT = (AT, WHEN, DURING, "after", "times", "turn", "do", "by")
"""The keys of a line that say when, what and who. All others are arguments of the command."""

WITH = "with"
"""The key of an object with further arguments. An argument that has the name of a key of the moment
stands there."""


@dataclass(frozen=True, slots=True)
class Trigger:
    """The moment of an act.

    With ``at`` it is the simulated time ``seconds``. With ``when`` the state ``address`` has become
    active for the ``times``-th time. With ``during`` an operation has begun for the ``times``-th
    time, and still runs. With ``asked`` a fitting task has opened for the ``times``-th time. In
    these three cases the act comes ``seconds`` (simulated) later. ``turn`` counts the ticks from
    this moment on, because several ticks may have the same simulated time.
    """

    kind: str
    seconds: float = 0.0
    address: str = ""
    times: int = 1
    turn: int = 1


@dataclass(frozen=True, slots=True, eq=False)
class Act:
    """One line of a script.

    ``do`` is a word of ``words.WORDS``. ``given`` are its arguments, with full addresses. ``by`` is
    the person who acts. ``places`` has the place of each argument in the file.
    """

    place: Place
    trigger: Trigger
    do: str
    given: Mapping[str, Json]
    by: str
    places: Mapping[str, Place] = field(default_factory=dict)

    def __str__(self) -> str:
        """The command and its arguments in a few words, for people."""
        return " ".join((self.do.replace("_", " "), *map(str, self.given.values())))


@dataclass(frozen=True, slots=True)
class Script:
    """A checked script. ``levels`` are set before the start. ``digest`` is the SHA-256 of the
    file."""

    file: str = ""
    acts: tuple[Act, ...] = ()
    levels: Mapping[str, str] = field(default_factory=dict)
    digest: str = ""
