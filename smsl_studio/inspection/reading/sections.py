"""The reading of a blueprint as frozen values: sections, lines and sentences."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from smsl_studio.blueprint.address import Address

Json = Any
NOTICE = "Not a medical device"
PROVISO = "Shown for this blueprint as written, if every operation does what its edge says"
"""The condition of every verdict. It stands once on each page that shows a verdict."""
MOST_LINES = 400
"""The largest number of lines of a section. Nobody reads more; the window shows the others."""


@dataclass(frozen=True)
class ReadingLine:
    """One thing that a reader approves or asks about.

    ``mark`` is the number of a step (``3``, ``3b``), ``or``, or empty. ``text`` are sentences.
    ``who`` says who does it, ``check`` how one knows that it is done. ``open_point`` says that
    something is not shown or missing, so that a person must look at it. ``about`` are the elements
    of the blueprint that it tells. ``inner`` are the lines of a sub-procedure. ``unnumbered`` is
    the heading with the text where both name other steps by their titles and not by their numbers,
    empty where no number stands in them. ``key`` stays as long as the line means the same.
    ``starts`` are the states in which a step of the way begins, one for each SB.
    """

    heading: str
    text: tuple[str, ...] = ()
    mark: str = ""
    who: str = ""
    check: str = ""
    open_point: bool = False
    about: tuple[Address, ...] = ()
    inner: tuple[ReadingLine, ...] = ()
    unnumbered: tuple[str, ...] = ()
    key: str = ""
    starts: tuple[Address, ...] = ()
    sources: tuple[str, ...] = ()
    """The quoted words of texts from which it was made, each with its place."""

    @property
    def words(self) -> tuple[str, ...]:
        """Everything that the line says, in the order in which it is read."""
        own = (self.mark, self.heading, *self.text, self.who, self.check, *self.sources)
        below = (words for line in self.inner for words in line.words)
        return tuple(words for words in (*own, *below) if words)


@dataclass(frozen=True)
class ReadingSection:
    """A part of the reading with a heading. ``key`` names it in files and links."""

    key: str
    heading: str
    lines: tuple[ReadingLine, ...] = ()
    lead: str = ""
    """One sentence that says what the section is about."""


@dataclass(frozen=True)
class Untitled:
    """How many elements have no title or name, so that the reading can only count them."""

    operations: int = 0
    states: int = 0
    facts: int = 0

    @property
    def sentence(self) -> str:
        """The numbers in words, empty if nothing lacks a title."""
        kinds = ((self.operations, "operation"), (self.states, "state"), (self.facts, "fact"))
        said = [f"{many:,} {noun}{'' if many == 1 else 's'}" for many, noun in kinds if many]
        if not said:
            return ""
        last = said.pop()
        listed = f"{', '.join(said)} and {last}" if said else last
        many = sum(count for count, _ in kinds)
        return f"{listed} {'has' if many == 1 else 'have'} no title or name of {_their(many)} own"


def _their(many: int) -> str:
    return "its" if many == 1 else "their"


@dataclass(frozen=True)
class BlueprintReading:
    """A whole blueprint in sentences. ``digest`` is that of its meaning, ``file`` its name."""

    title: str
    purpose: str
    file: str
    digest: str
    sections: tuple[ReadingSection, ...]
    untitled: Untitled = field(default_factory=Untitled)

    def lines(self) -> Iterator[tuple[ReadingSection, ReadingLine]]:
        """Yield every line that stands by itself, with its section."""
        for section in self.sections:
            for line in section.lines:
                yield section, line

    @property
    def open_points(self) -> int:
        """The number of lines that a person must look at."""
        return sum(line.open_point for _, line in self.lines())

    def as_json(self) -> dict[str, Json]:
        """Return the reading as plain values."""
        return {
            "title": self.title,
            "purpose": self.purpose,
            "file": self.file,
            "digest": self.digest,
            "untitled": self.untitled.sentence,
            "sections": [
                {
                    "key": section.key,
                    "heading": section.heading,
                    "lead": section.lead,
                    "lines": [{"key": line.key, **_plain(line)} for line in section.lines],
                }
                for section in self.sections
            ],
        }


def _plain(line: ReadingLine) -> dict[str, Json]:
    return {
        "mark": line.mark,
        "heading": line.heading,
        "text": list(line.text),
        "who": line.who,
        "check": line.check,
        "open": line.open_point,
        "about": [str(one) for one in line.about],
        "inner": [_plain(one) for one in line.inner],
        **({"sources": list(line.sources)} if line.sources else {}),
    }


def bounded(lines: Iterable[ReadingLine], many: int, noun: str) -> tuple[ReadingLine, ...]:
    """Return the lines of a section. Of very many the first are made, and a last line, which is an
    open point, counts the others.
    """
    shown = tuple(islice(lines, MOST_LINES))
    more = many - len(shown)
    if not more:
        return shown
    words = f"{more:,} more of the kind “{noun}” {'is' if more == 1 else 'are'} not told here"
    text = ("A reading of more lines would help nobody. They are in the drawing and in the file.",)
    return (*shown, ReadingLine(words, text, open_point=True))
