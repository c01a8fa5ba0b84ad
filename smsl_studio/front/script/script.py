"""A script as values: acts, each with the moment at which it comes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from smsl_studio.errors import Place

Json = Any
AT, WHEN, DURING, ASKED = "at", "when", "during", "asked"
EVERY = 0
"""Of ``times``: each time anew."""


@dataclass(frozen=True, slots=True)
class Trigger:
    """The moment of an act.

    ``at``: ``seconds`` is the simulated time. ``when``: a state (``address``) became active for the
    ``times``-th time; ``during``: an operation has begun for the ``times``-th time, and still runs;
    ``asked``: a task like the one to be answered was opened for the ``times``-th time; each
    ``seconds`` later.
    """

    kind: str
    seconds: float = 0.0
    address: str = ""
    times: int = 1


@dataclass(frozen=True, slots=True, eq=False)
class Act:
    """One line of a script: ``do`` is a word of ``words.WORDS``, ``given`` what stands with it,
    addresses written out. ``by`` is who does it, ``places`` where each value of ``given`` stands.
    """

    place: Place
    trigger: Trigger
    do: str
    given: Mapping[str, Json]
    by: str
    places: Mapping[str, Place] = field(default_factory=dict)

    def __str__(self) -> str:
        """What it does, in a few words for people."""
        return " ".join((self.do.replace("_", " "), *map(str, self.given.values())))


@dataclass(frozen=True, slots=True)
class Script:
    """A checked script. ``levels`` are set before the start; ``digest`` is the file's SHA-256."""

    file: str = ""
    acts: tuple[Act, ...] = ()
    levels: Mapping[str, str] = field(default_factory=dict)
    digest: str = ""
