"""The tree of expected errors. Any other error is a fault of this program, and is not caught.

::

    StudioError              what is wrong, where, and what to do about it
    ├── ReadError            a text or file cannot be opened as SMSL        (exit 2)
    ├── ConvertError         the other form has no spelling for it          (exit 2)
    ├── SaveError            a file could not be written; the old one stands (exit 2)
    │   └── FileChanged      somebody else has written it since it was read
    ├── AddressError         nothing stands at that address                  (exit 2)
    ├── UsageError           a command or call that makes no sense           (exit 2)
    ├── EditRefused          an edit that would leave nonsense; nothing was changed
    ├── PluginError          a plugin that cannot be loaded or bound
    ├── WorldError           a world that is unknown or cannot be built
    ├── HostError            the place where library code runs is gone or silent
    ├── RunRefused           a guard at the start said no; nothing moved     (exit 1)
    └── PlanningError        a plan was sought as far as is sensible         (exit 1)
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice
from typing import NamedTuple


class Place(NamedTuple):
    """A point in a file; lines and columns count from 1, columns in characters."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


class StudioError(Exception):
    """An expected error: a clear sentence, its place where it has one, and an advice."""

    def __init__(self, sentence: str, place: Place | None = None, advice: str = "") -> None:
        super().__init__(sentence)
        self.sentence = sentence
        self.place = place
        self.advice = advice

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else ""
        return f"{where}{self.sentence}"


class TextFix(NamedTuple):
    """A repair of a text: words for its button, and what stands between two offsets after it."""

    words: str
    start: int
    end: int
    text: str


class ReadError(StudioError):
    """A text or file that cannot be opened as SMSL.

    ``length`` characters from its place on are at fault. ``fix`` repairs this one fault, where
    that is possible. ``more`` are the further faults of the same text, in the order of the text.
    """

    def __init__(
        self,
        sentence: str,
        place: Place | None = None,
        advice: str = "",
        *,
        length: int = 1,
        fix: TextFix | None = None,
        more: Sequence[ReadError] = (),
    ) -> None:
        super().__init__(sentence, place, advice)
        self.length, self.fix, self.more = length, fix, tuple(more)

    @classmethod
    def of(cls, faults: Sequence[ReadError]) -> ReadError:
        """One error that tells several: the first, with the others behind it."""
        first, *more = faults
        return cls(
            first.sentence, first.place, first.advice, length=first.length, fix=first.fix, more=more
        )

    @property
    def faults(self) -> tuple[ReadError, ...]:
        """This fault and all further ones."""
        return (self, *self.more)


class ConvertError(StudioError):
    """Something that another written form has no spelling for; nothing was written."""


class SaveError(StudioError):
    """A file that could not be written; what stood there before still stands."""


class FileChanged(SaveError):  # noqa: N818
    """A file that was not replaced, because it is no longer the one that was read."""

    def __init__(self, file: str) -> None:
        super().__init__(
            f"{file} was not saved: another program has written it since it was read",
            advice="What the other program wrote still stands. Read it, then save again.",
        )
        self.file = file


class AddressError(StudioError):
    """Nothing in the blueprint stands at that address."""


class UsageError(StudioError):
    """A command or call whose parts do not fit together."""


class EditRefused(StudioError):  # noqa: N818
    """An edit that would leave nonsense; nothing was changed."""


class PluginError(StudioError):
    """A plugin that cannot be loaded, or an operation that cannot be bound."""


class WorldError(StudioError):
    """A world that is unknown or cannot be built."""


class HostError(StudioError):
    """The place where library code runs is gone or does not answer."""


class RunRefused(StudioError):  # noqa: N818
    """A guard at the start of a run said no; nothing has moved."""


class PlanningError(StudioError):
    """A plan may exist, but the search was given up: there are too many joint configurations."""


_MANY = 5000
"""At most so many known names are compared."""

_LONGEST = 200
"""Longer names are not compared, because the time grows with the square of their length."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """An advice naming the closest known name, or the empty text."""
    near = nearest(name, islice(known, _MANY))
    return f"Did you mean {near}?" if near else ""


def nearest(name: str, known: Iterable[str]) -> str:
    """The known name most like ``name``, or the empty text.

    Of equally close names it is the one with the most equal characters at equal positions.
    """
    if len(name) > _LONGEST:
        return ""
    from difflib import SequenceMatcher, get_close_matches  # needed only where a name is wrong

    def alike(other: str) -> tuple[float, int]:
        """How like a known name is: the ratio of ``difflib``, then the equal characters."""
        same = sum(a == b for a, b in zip(name, other, strict=False))
        return SequenceMatcher(None, other, name).ratio(), same

    close = get_close_matches(name, list(known), n=8, cutoff=0.6)
    return max(close, key=alike, default="")
