"""Finding: what a rule has to say about one place, or about several of one cause."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any, NamedTuple

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.smsl.document import Document

LISTED = 100
"""So many places of one SB a rule lists at most; the finding says how many more there are."""

LISTED_IN_ALL = 1000
"""So many places a rule lists at most in all SBs together."""


class Severity(Enum):
    """E blocks approval, W needs a written disposition, I is a note."""

    ERROR = "E"
    WARNING = "W"
    NOTE = "I"


@dataclass(frozen=True, slots=True)
class Fix:
    """A quick fix: the words on its button, and the edit it makes (undoable as one step).

    ``certain`` says that it loses nothing that is written and that nothing else can be meant. A
    fix that deletes or guesses is not: each of those is decided by a person.
    """

    words: str
    apply: Callable[[Blueprint], Blueprint] = field(compare=False)
    certain: bool = False


class Remark(NamedTuple):
    """What a rule says, before anybody has looked where it stands.

    A rule may have very many of them, so that a remark is cheap to make: only those that are
    listed become findings, with their places and fixes. It stands at the key of ``address``, at
    the key ``below`` it (HEADER, INITIAL), or at the ``spot`` (a place, or a path in a document).
    ``others`` are further addresses or places of the same cause. Advice and fix that take time to
    work out are what the function ``remedy`` gives.
    """

    rule: str
    severity: Severity
    address: Address
    message: str
    advice: str = ""
    fix: Fix | None = None
    below: tuple[str, ...] = ()
    spot: Place | tuple[Document, tuple[str, ...]] | None = None
    others: Sequence[Address | Place] = ()
    remedy: Callable[[], tuple[str, Fix | None]] | None = None


class Spot(NamedTuple):
    """A further place of a finding."""

    address: Address
    place: Place


@dataclass(frozen=True, slots=True)
class Finding:
    """One finding: rule, severity, where (address and place), a sentence, an advice, a fix.

    ``others`` are further places of the same cause; ``more`` are not listed, only counted.
    """

    rule: str
    severity: Severity
    address: Address
    place: Place
    message: str
    advice: str = ""
    fix: Fix | None = None
    others: tuple[Spot, ...] = ()
    more: int = 0

    @property
    def addresses(self) -> tuple[Address, ...]:
        """Every address that it is about, each once."""
        return tuple(dict.fromkeys((self.address, *(spot.address for spot in self.others))))

    def places_in(self, file: str) -> tuple[Place, ...]:
        """Every place in one file that it is about."""
        places = (self.place, *(spot.place for spot in self.others))
        return tuple(place for place in places if place.file == file)

    @property
    def also(self) -> str:
        """Where else, in words: ``also at 3:5, 7:5 and 12 more places``; or the empty text."""
        shown = [f"{spot.place.line}:{spot.place.column}" for spot in self.others[:_SHOWN]]
        left = len(self.others) - len(shown) + self.more
        if left:
            shown.append(f"{left:,} more {'place' if left == 1 else 'places'}")
        first, last = ", ".join(shown[:-1]), "".join(shown[-1:])
        return f"also at {first} and {last}" if first else f"also at {last}" if last else ""

    def __str__(self) -> str:
        words = "; ".join(filter(None, (self.message, self.advice, self.also)))
        return f"{self.place} {self.rule} {self.address}: {words}"

    def as_json(self) -> dict[str, Any]:
        """The finding as the command line reports it; ``others`` where it has several places."""
        found: dict[str, Any] = {
            "rule": self.rule,
            "severity": self.severity.value,
            "address": str(self.address),
            "line": self.place.line,
            "column": self.place.column,
            "message": self.message,
            "advice": self.advice,
            "fix": self.fix.words if self.fix else None,
        }
        if self.others or self.more:
            found["others"] = [
                {"address": str(spot.address), "line": spot.place.line, "column": spot.place.column}
                for spot in self.others
            ]
            found["more"] = self.more
        return found


_SHOWN = 5
"""So many further places are told in words."""
