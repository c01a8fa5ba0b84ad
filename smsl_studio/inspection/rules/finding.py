"""Finding: the result of a rule at one place, or at several places that have one cause."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from functools import partial
from typing import Any, NamedTuple

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place
from smsl_studio.smsl.document import Document

LISTED = 100
"""The largest number of places of one SB that a rule lists. A finding tells the number of the
others."""

LISTED_IN_ALL = 1000
"""The largest number of places that a rule lists in all SBs together."""


class Severity(Enum):
    """E is an error and blocks approval. W is a warning and needs a written disposition. I is a
    note."""

    ERROR = "E"
    WARNING = "W"
    NOTE = "I"


@dataclass(frozen=True, slots=True)
class Fix:
    """A quick fix: the words on its button, and its edit, which is one step to undo.

    A fix is ``certain`` if it loses nothing that is written and if there is no other possible
    meaning. A fix that deletes or guesses is not certain; a person decides about it.
    """

    words: str
    apply: Callable[[Blueprint], Blueprint] = field(compare=False)
    certain: bool = False


def edit(name: str, /, **arguments: Any) -> Callable[[Blueprint], Blueprint]:
    """The edit of that name of ``blueprint.editing`` with these arguments, for a ``Fix``.

    It is loaded when it is applied: most findings are only read.
    """
    return partial(_edited, name, arguments)


def _edited(name: str, arguments: dict[str, Any], blueprint: Blueprint) -> Blueprint:
    edited: Blueprint = getattr(editing, name)(blueprint, **arguments)
    return edited


class Remark(NamedTuple):
    """The result of a rule, without its place in the text.

    A rule may make very many remarks, so a remark is cheap. Only the remarks that are listed
    become findings, with places and fixes. A remark belongs to the key of ``address``, to the key
    ``below`` it (HEADER, INITIAL), or to the ``spot`` (a place, or a path in a document).
    ``others`` are further addresses or places of the same cause. The function ``remedy`` returns
    advice and fix where they take time to compute.
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
    """One finding: rule, severity, address, place in the text, a sentence, an advice, a fix.

    ``others`` are further places of the same cause. ``more`` is the number of places that are not
    listed.
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
        """The addresses of the finding, each once."""
        return tuple(dict.fromkeys((self.address, *(spot.address for spot in self.others))))

    def places_in(self, file: str) -> tuple[Place, ...]:
        """Return the places of the finding in one file."""
        places = (self.place, *(spot.place for spot in self.others))
        return tuple(place for place in places if place.file == file)

    @property
    def also(self) -> str:
        """The further places in words, such as ``also at 3:5, 7:5 and 12 more places`` (line and
        column). The text is empty if there are none."""
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
        """Return the finding as ``check --json`` writes it. ``others`` and ``more`` are present
        only if the finding has several places."""
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
"""The largest number of further places that ``Finding.also`` names."""
