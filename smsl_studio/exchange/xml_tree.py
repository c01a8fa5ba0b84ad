"""Reads XML of other programs as a tree: without entities, without fetches, with bounds.

A document type is refused, because entities and default attributes can make gigabytes of a short
text. Nothing that the XML names is opened.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any
from xml.etree.ElementTree import ParseError

from smsl_studio.errors import Place, ReadError
from smsl_studio.smsl.document.limits import MAX_VALUES, most_values
from smsl_studio.stop import heed

MOST_DEPTH = 200
"""The largest depth of elements: a machine of twenty levels needs forty."""


@dataclass
class XmlElement:
    """One element: its name without and with its namespace, attributes, text and place."""

    name: str
    space: str
    attributes: dict[str, str]
    place: tuple[int, int]
    children: list[XmlElement] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)

    @property
    def text(self) -> str:
        """The text directly in this element."""
        return "".join(self.texts)

    def get(self, name: str) -> str:
        """Return an attribute, empty if there is none. Another namespace stands as ``{...}``."""
        return self.attributes.get(name, "")

    def named(self, *names: str) -> Iterator[XmlElement]:
        """Yield the children with one of these names."""
        return (one for one in self.children if one.name in names)


class _Builder:
    """Makes the tree. It stops at the first bound that is met."""

    def __init__(self, file: str, most: int) -> None:
        self.root: XmlElement | None = None
        self.parser: Any = None
        self._file, self._left = file, most
        self._open: list[XmlElement] = []

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self._left -= 1 + len(attributes)
        if self._left < 0:
            raise self._refused("too many elements and attributes stand in it")
        if len(self._open) >= MOST_DEPTH:
            raise self._refused(f"elements stand deeper than {MOST_DEPTH} levels")
        if self._left % 1024 == 0:
            heed()
        space, _, name = tag.rpartition("}")
        one = XmlElement(name, space.removeprefix("{"), dict(attributes), self.place())
        if self._open:
            self._open[-1].children.append(one)
        elif self.root is None:
            self.root = one
        self._open.append(one)

    def end(self, tag: str) -> None:
        self._open.pop()

    def data(self, text: str) -> None:
        if self._open:
            self._open[-1].texts.append(text)

    def close(self) -> None:
        """The tree is complete."""

    def place(self) -> tuple[int, int]:
        """Return the line and the column that are read now."""
        return self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1

    def _refused(self, words: str) -> ReadError:
        return ReadError(words, Place(self._file, *self.place()), "Split the file.")


def xml_tree(text: str, file: str) -> XmlElement:
    """Return the root element of an XML text. ReadError, with its place, if it cannot be read."""
    from defusedxml.common import DefusedXmlException
    from defusedxml.ElementTree import DefusedXMLParser

    builder = _Builder(file, min(most_values(text), MAX_VALUES))
    parser = DefusedXMLParser(target=builder, forbid_dtd=True)
    builder.parser = parser.parser
    try:
        parser.feed(text.removeprefix("\ufeff"))
        parser.close()
    except DefusedXmlException:
        place = Place(file, *builder.place())
        advice = "Remove the line that begins with <!DOCTYPE, and write the values out."
        raise ReadError("a document type or an entity stands in it", place, advice) from None
    except ParseError as error:
        line, column = error.position
        words = str(error).partition(":")[0]
        advice = "Save it again with the program that made it."
        raise ReadError(
            f"no well formed XML: {words}", Place(file, line, column + 1), advice
        ) from None
    except ValueError as error:
        place = Place(file, *builder.place())
        raise ReadError(f"no XML: {error}", place, "Save it as UTF-8 again.") from None
    if builder.root is None:
        raise ReadError("it holds no element", Place(file, 1, 1), "Name another file.")
    return builder.root
