"""The tree of expected errors. Any other error is a fault of this program and is not caught.

::

    StudioError              what is wrong, where, and what to do about it
    ├── ReadError            a text or file cannot be opened as SMSL        (exit 2)
    ├── ConvertError         the other form has no spelling for it          (exit 2)
    ├── SaveError            a file could not be written; the old one stands (exit 2)
    │   └── FileChanged      somebody else has written it since it was read
    ├── FormulaError         the text of a condition cannot be read or names nothing
    ├── AddressError         nothing stands at that address                  (exit 2)
    ├── UsageError           a command or call that makes no sense           (exit 2)
    ├── EditRefused          an edit that would leave nonsense; nothing was changed
    ├── PluginError          a plugin that cannot be loaded or bound
    ├── WorldError           a world that is unknown or cannot be built
    ├── HostError            the place where library code runs is gone or silent
    ├── SealError            an envelope, a signature or a key is not as it must be
    ├── ApprovalRefused      nothing was signed, because something is open   (exit 1)
    ├── RunRefused           a guard at the start said no; nothing moved     (exit 1)
    └── PlanningError        a plan was sought as far as is sensible         (exit 1)
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import islice
from typing import NamedTuple


class Place(NamedTuple):
    """A place in a file. Lines and columns count from 1, columns in characters."""

    file: str
    line: int
    column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


class StudioError(Exception):
    """An expected error: a clear sentence, its place if it has one, and an advice."""

    def __init__(self, sentence: str, place: Place | None = None, advice: str = "") -> None:
        super().__init__(sentence)
        self.sentence = sentence
        self.place = place
        self.advice = advice

    def __str__(self) -> str:
        where = f"{self.place}: " if self.place else ""
        return f"{where}{self.sentence}"


class TextFix(NamedTuple):
    """A repair of a text: the words on its button, and the new text between two offsets."""

    words: str
    start: int
    end: int
    text: str


class ReadError(StudioError):
    """A text or file cannot be opened as SMSL.

    The fault has ``length`` characters, from its place on. ``fix`` repairs this one fault, if that
    is possible. ``more`` are the further faults of the same text, in the order of the text.
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
        """Return one error for several faults: the first fault, with the others in ``more``."""
        first, *more = faults
        return cls(
            first.sentence, first.place, first.advice, length=first.length, fix=first.fix, more=more
        )

    @property
    def faults(self) -> tuple[ReadError, ...]:
        """This fault and all further faults."""
        return (self, *self.more)


class ConvertError(StudioError):
    """Another written form cannot express a part of the blueprint. No file was written."""


class SaveError(StudioError):
    """A file could not be written. Its old content is still there."""


class FileChanged(SaveError):  # noqa: N818
    """A file was not replaced, because it has changed since it was read."""

    def __init__(self, file: str) -> None:
        super().__init__(
            f"{file} was not saved: another program has written it since it was read",
            advice="What the other program wrote still stands. Read it, then save again.",
        )
        self.file = file


class FormulaError(StudioError):
    """The text of a condition cannot be read, or it names something that does not exist.

    ``at`` is the offset in the text, counted from 0. The sentence says the character, from 1.
    ``instead`` is a wrong word and the right one, if they are known.
    """

    def __init__(
        self, sentence: str, at: int, advice: str = "", *, instead: tuple[str, str] = ("", "")
    ) -> None:
        super().__init__(f"character {at + 1:,}: {sentence}", advice=advice)
        self.at, self.instead = at, instead


class AddressError(StudioError):
    """The blueprint has no element at this address."""


class UsageError(StudioError):
    """The parts of a command or call do not fit together."""


class EditRefused(StudioError):  # noqa: N818
    """An edit would make the blueprint invalid. Nothing was changed."""


class PluginError(StudioError):
    """A plugin cannot be loaded, or an operation cannot be bound."""


class WorldError(StudioError):
    """A world is unknown or cannot be built."""


class HostError(StudioError):
    """The host of library code is gone or does not answer."""


class SealError(StudioError):
    """An envelope, a signature, a key or another signed file is not valid."""


class ApprovalRefused(StudioError):  # noqa: N818
    """Nothing was signed, because an error, a warning or another point is still open."""


class RunRefused(StudioError):  # noqa: N818
    """A check at the start of a run has refused it. Nothing has moved.

    If a policy guards the run, ``refusals`` has the reasons. Each reason is a code and a sentence
    (see ``inspection.approval``).
    """

    def __init__(
        self,
        sentence: str,
        place: Place | None = None,
        advice: str = "",
        *,
        refusals: Sequence[tuple[str, str]] = (),
    ) -> None:
        super().__init__(sentence, place, advice)
        self.refusals = tuple(refusals)

    @property
    def words(self) -> str:
        """The sentence with its advice, in the form for the end of a run."""
        return f"{self.sentence}. {self.advice}".strip()

    @property
    def told(self) -> tuple[dict[str, str], ...]:
        """The refusals, in the form for the end of a run."""
        return tuple({"code": code, "sentence": words} for code, words in self.refusals)


class PlanningError(StudioError):
    """The search for a plan was given up, because there are too many joint configurations. A plan
    may exist."""


_MANY = 5000
"""The largest number of known names that are compared."""

_LONGEST = 200
"""The largest length of a name that is compared. The time grows with the square of the length."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return an advice with the most similar known name, or the empty text."""
    near = nearest(name, islice(known, _MANY))
    return f"Did you mean {near}?" if near else ""


def instead_of(name: str, known: Iterable[str]) -> tuple[str, str]:
    """Return a wrong name and the known one that was meant: the same in other capitals, or the most
    similar one. The second is empty if there is none."""
    names = list(islice(known, _MANY))
    same = (one for one in names if one.casefold() == name.casefold())
    return name, next(same, "") or nearest(name, names)


def nearest(name: str, known: Iterable[str]) -> str:
    """Return the known name that is most similar to ``name``, or the empty text.

    Of equally similar names it is the one with the most equal characters at equal positions.
    """
    if len(name) > _LONGEST:
        return ""
    from difflib import SequenceMatcher, get_close_matches  # needed only where a name is wrong

    def alike(other: str) -> tuple[float, int]:
        """Return the similarity of a known name: the ratio of ``difflib``, then the number of equal
        characters."""
        same = sum(a == b for a, b in zip(name, other, strict=False))
        return SequenceMatcher(None, other, name).ratio(), same

    close = get_close_matches(name, list(known), n=8, cutoff=0.6)
    return max(close, key=alike, default="")
