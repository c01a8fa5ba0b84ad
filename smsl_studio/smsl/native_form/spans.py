"""The places in a native text that is known to be valid.

The elements of a container are found when they are first needed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

from smsl_studio.smsl.document import LatestMembers, Member, Path
from smsl_studio.smsl.json_form.spans import scan_container
from smsl_studio.smsl.native_form import tokens
from smsl_studio.smsl.native_form.elements import Element, ElementShapes, PlacedShapes
from smsl_studio.smsl.native_form.lines import HashLine, entries, line_at, read_value
from smsl_studio.smsl.native_form.tokens import content_start, decoded, skip_separator


class _Branch(NamedTuple):
    """The elements of a branch: its header lines, and its lines, states and fields by key."""

    lines: tuple[Element, ...]
    headers: dict[str, Element]
    latest: dict[str, Element]


class NativeSpans:
    """The places in one valid native text. ``known`` are the elements of the file if they are
    known.
    """

    def __init__(self, text: str, known: ElementShapes | None = None) -> None:
        self._text, self._known = text, known
        self._inside: dict[int, tuple[Element, ...]] = {}
        self._branches: dict[int, _Branch] = {}
        self._scanned: dict[int, dict[str, Member]] = {}
        self._members: dict[Path, tuple[Member, ...]] = {}
        self._latest_members = LatestMembers(self.members)

    @property
    def root(self) -> int:
        """The offset at which the content begins."""
        return content_start(self._text)

    @cached_property
    def elements(self) -> Sequence[Element]:
        """The branches and lines of the file."""
        if self._known is None:
            return tuple(_file_elements(self._text))
        return tuple(PlacedShapes(self._known, 0))

    @cached_property
    def shapes(self) -> ElementShapes:
        """The branches and lines of the file as lengths."""
        return ElementShapes.of(self.elements, 0) if self._known is None else self._known

    @cached_property
    def _latest(self) -> dict[str, Element]:
        """The branches and lines of the file by key, the last one of a doubled key."""
        return by_key(self.elements)

    def members(self, path: Path) -> tuple[Member, ...]:
        """Return the members at a path (see ``Spans``).

        The key of a branch is its NAME. HEADER is all its header lines.
        """
        if len(path) > 1:
            return self._find(path)
        if path not in self._members:
            self._members[path] = self._find(path)
        return self._members[path]

    def member(self, path: Path) -> Member:
        """See ``Spans``."""
        return self._latest_members.member(path)

    def _find(self, path: Path) -> tuple[Member, ...]:
        if not path:
            return tuple(element.member for element in self.elements)
        first = self._latest[path[0]]
        if first.kind != "branch":
            return self._values(first.value_start, path[1:])
        if len(path) == 1:
            inside = first.elements
            return (*header_member(inside), *(e.member for e in in_values(inside)))
        lines, headers, latest = self._branch(first)
        if path[1] == "HEADER":
            if not lines:
                raise KeyError(path)
            if len(path) == 2:
                return tuple(line.member for line in lines)
            return self._values(headers[path[2]].value_start, path[3:])
        second = latest[path[1]]
        if second.kind != "state":
            return self._values(second.value_start, path[2:])
        if len(path) == 2:
            return tuple(element.member for element in self.inside(second))
        third = by_key(self.inside(second))[path[2]]
        if third.kind != "field":
            raise KeyError(path)
        return self._values(third.value_start, path[3:])

    def _branch(self, branch: Element) -> _Branch:
        if branch.start not in self._branches:
            lines = tuple(element for element in branch.elements if element.kind == "header")
            latest = by_key(in_values(branch.elements))
            self._branches[branch.start] = _Branch(lines, by_key(lines), latest)
        return self._branches[branch.start]

    def inside(self, state: Element) -> tuple[Element, ...]:
        """Return the edges and lines of a state."""
        if state.start not in self._inside:
            found, _ = _state_elements(self._text, state.value_start + 1)
            self._inside[state.start] = tuple(found)
        return self._inside[state.start]

    def doubles(self) -> Iterator[tuple[Path, tuple[int, ...]]]:
        """Yield the doubled keys (see ``Spans``)."""
        yield from _doubled((), tuple(element.member for element in self.elements))
        for element in self.elements:
            path = (element.key,)
            if element.kind != "branch":
                yield from self._doubled_values(path, element.value_start)
                continue
            lines = self._branch(element).lines
            yield from _doubled((*path, "HEADER"), tuple(line.member for line in lines))
            for line in lines:
                yield from self._doubled_values((*path, "HEADER", line.key), line.value_start)
            inside = in_values(element.elements)
            yield from _doubled(path, tuple(one.member for one in inside))
            for one in inside:
                below = (*path, one.key)
                if one.kind == "field":
                    yield from self._doubled_values(below, one.value_start)
                else:
                    yield from self._doubled_state(below, one)

    def _doubled_state(self, path: Path, state: Element) -> Iterator[tuple[Path, tuple[int, ...]]]:
        inside = self.inside(state)
        yield from _doubled(path, tuple(element.member for element in inside))
        for element in inside:
            if element.kind == "field":
                yield from self._doubled_values((*path, element.key), element.value_start)

    def _doubled_values(self, path: Path, start: int) -> Iterator[tuple[Path, tuple[int, ...]]]:
        if self._text[start : start + 1] not in ("{", "[", "("):
            return
        members = self._values(start, ())
        yield from _doubled(path, members)
        for member in members:
            yield from self._doubled_values((*path, member.key), member.value_start)

    def _values(self, start: int, path: Path) -> tuple[Member, ...]:
        """Return the members of the map or list that opens at ``start``, or of one inside it."""
        for key in path:
            if start not in self._scanned:
                self._scanned[start] = {member.key: member for member in self._scan(start)}
            start = self._scanned[start][key].value_start
        return tuple(self._scan(start))

    def _scan(self, start: int) -> Iterator[Member]:
        if self._text[start : start + 1] == "(":
            return entries(self._text, start)
        return scan_container(self._text, start)


def in_values(elements: Iterable[Element]) -> tuple[Element, ...]:
    """Return the elements of a branch that are no part of its header."""
    return tuple(element for element in elements if element.is_member)


def header_member(elements: Iterable[Element]) -> tuple[Member, ...]:
    """Return the HEADER of a branch as one member: its first header lines. Empty if it has none."""
    first: Element | None = None
    end = 0
    for element in elements:
        if element.kind == "header":
            first = first or element
            end = element.value_end
        elif first and element.kind == "state":
            break
    return (Member("HEADER", first.start, first.start, first.start, end),) if first else ()


def by_key(elements: Iterable[Element]) -> dict[str, Element]:
    """Return elements by their keys, the last one of a doubled key."""
    return {element.key: element for element in elements}


def _doubled(path: Path, members: tuple[Member, ...]) -> Iterator[tuple[Path, tuple[int, ...]]]:
    places: dict[str, list[int]] = {}
    for member in members:
        places.setdefault(member.key, []).append(member.key_start)
    for key, found in places.items():
        if len(found) > 1:
            yield (*path, key), tuple(found)


def _file_elements(text: str) -> Iterator[Element]:
    at = skip_separator(text, 1 if text.startswith("\ufeff") else 0)
    while at < len(text):
        element = _branch(text, at) if text[at] == "{" else _line(text, at, 1)
        yield element
        at = skip_separator(text, element.end)


def _branch(text: str, start: int) -> Element:
    found: list[Element] = []
    name: Element | None = None
    at = skip_separator(text, start + 1)
    while text[at] != "}":
        element = _line(text, at, 2) if text[at] == "#" else _state(text, at)
        if element.kind == "name":
            name = element
        found.append(element)
        at = skip_separator(text, element.end)
    assert name is not None, "the text was parsed before it is scanned"
    key = decoded(text[name.value_start : name.value_end])
    return Element(
        "branch", key, start, at + 1, name.value_start, name.value_end, start, at + 1, tuple(found)
    )


def _state(text: str, at: int) -> Element:
    match = tokens.state.match(text, at)
    if match:
        opened, end = match.start(2) - 1, match.end()
    else:
        match = tokens.opening.match(text, at)
        assert match is not None, "the text was parsed before it is scanned"
        opened = match.end() - 1
        end = _state_elements(text, match.end())[1]
    return Element("state", decoded(match[1]), at, end, at, match.end(1), opened, end)


def _state_elements(text: str, at: int) -> tuple[list[Element], int]:
    """Return the edges and lines after the bracket before ``at``, and the offset after its end."""
    found: list[Element] = []
    at = skip_separator(text, at)
    while text[at] != "]":
        found.append(_line(text, at, 3) if text[at] == "#" else _edge(text, at))
        at = skip_separator(text, found[-1].end)
    return found, at + 1


def _edge(text: str, at: int) -> Element:
    match = tokens.edge.match(text, at)
    assert match is not None, "the text was parsed before it is scanned"
    (key_start, key_end), (start, end) = match.span(1), match.span(2)
    return Element("edge", decoded(match[1]), at, end, key_start, key_end, start, end)


def _line(text: str, at: int, depth: int) -> Element:
    line = line_at(text, at)
    assert line is not None, "the text was parsed before it is scanned"
    return line_element(text, line, depth)


def line_element(text: str, line: HashLine, depth: int) -> Element:
    """Return a ``#`` line as an element."""
    end = read_value(text, line, depth).end
    start = line.value_start
    return Element(line.level, line.key, line.start, end, line.key_start, line.key_end, start, end)


def elements_between(text: str, at: int, end: int) -> Iterator[Element]:
    """Yield the lines and states of a branch between two offsets."""
    at = skip_separator(text, at)
    while at < end:
        element = _line(text, at, 2) if text[at] == "#" else _state(text, at)
        yield element
        at = skip_separator(text, element.end)
