"""The layout of a native text, and new elements in that layout."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice, pairwise
from typing import Any

from smsl_studio.smsl.document import Document
from smsl_studio.smsl.native_form.elements import Element
from smsl_studio.smsl.native_form.json_values import one_line
from smsl_studio.smsl.native_form.spans import NativeSpans
from smsl_studio.smsl.native_form.spellings import (
    edge_text,
    header_key,
    header_value,
    must_be_map,
)
from smsl_studio.smsl.native_form.tokens import spelled

Json = Any
_SAMPLED = 40
_ARROW = re.compile(r"[ \t]*->[ \t]*")
_COLON = re.compile(r"[ \t]*:[ \t]*")
_EMPTY = re.compile(r"\[ *\]")


@dataclass(frozen=True, slots=True)
class NativeStyle:
    """The layout of a text: line end, one step of indentation, and signs with the space around
    them.

    ``single`` is true if the only edge of a state is on its own line. ``several`` is true if two or
    more edges are.
    """

    newline: str = "\n"
    unit: str = "    "
    mark: str = "# "
    key_colon: str = ": "
    colon: str = ": "
    arrow: str = " -> "
    empty: str = "[ ]"
    single: bool = False
    several: bool = True
    edge_commas: bool = True
    state_commas: bool = True
    branch_commas: bool = True

    def field(self, key: str, value: Json) -> str:
        """Return a ``# _KEY: json`` line."""
        return f"{self.mark}{spelled(key)}{self.key_colon}{one_line(value)}"

    def header(self, branch: str, key: str, value: Json) -> str:
        """Return a header line. ConvertError if its value cannot be written."""
        text = header_value(branch, key, value)
        return f"{self.mark}{header_key(key)}{self.key_colon}{text}"

    def edge(self, branch: str, state: str, name: str, target: Json) -> str:
        """Return an operation. ConvertError if its target is not a text."""
        return edge_text(branch, state, name, target, self.arrow)

    def state(self, branch: str, name: str, value: Json, indent: str) -> str:
        """Return a state. ``indent`` is the indentation of its line."""
        return f"{spelled(name)}{self.colon}{self.brackets(branch, name, value, indent)}"

    def brackets(self, branch: str, name: str, value: Json, indent: str) -> str:
        """Return the content of a state with its brackets."""
        must_be_map((branch, name), value, "a state")
        if not value:
            return self.empty
        edges = [key for key in value if not key.startswith("_")]
        broken = self.single if len(edges) == 1 else self.several
        comma = "," if self.edge_commas else ""
        if not broken and len(edges) == len(value):
            inner = (self.edge(branch, name, key, value[key]) for key in edges)
            return f"[{f'{comma} '.join(inner)}]"
        start = f"{self.newline}{indent}{self.unit}"
        pieces = ["["]
        for key, inside in value.items():
            if key.startswith("_"):
                pieces += (start, self.field(key, inside))
            else:
                pieces += (start, self.edge(branch, name, key, inside))
                pieces += comma if key != edges[-1] else ""
        return "".join([*pieces, self.newline, indent, "]"])

    def branch(self, name: str, value: Json, indent: str = "") -> str:
        """Return a State Branch with its braces. An empty HEADER is left out."""
        must_be_map((name,), value, "a State Branch")
        header = value.get("HEADER", {})
        must_be_map((name, "HEADER"), header, "a HEADER")
        inner = indent + self.unit
        lines = ["{", f"{inner}{self.mark}NAME{self.key_colon}{spelled(name)}"]
        lines += [f"{inner}{self.header(name, key, inside)}" for key, inside in header.items()]
        states = [key for key in value if not key.startswith("_") and key != "HEADER"]
        for key, inside in value.items():
            if key == "HEADER":
                continue
            if key.startswith("_"):
                lines.append(f"{inner}{self.field(key, inside)}")
                continue
            if key == states[0] and len(lines) > 2:
                lines.append("")
            comma = "," if self.state_commas and key != states[-1] else ""
            lines.append(f"{inner}{self.state(name, key, inside, inner)}{comma}")
        return self.newline.join([*lines, indent + "}"])


CANONICAL = NativeStyle()


def style_of(document: Document, spans: NativeSpans) -> NativeStyle:
    """Return the style of a text, from its first elements."""
    text = document.text
    learnt: dict[str, Any] = {"newline": document.newline}
    branches = [element for element in islice(spans.elements, 8) if element.kind == "branch"]
    for branch in branches:
        _learn_lines(text, branch, learnt)
        states = [e for e in islice(branch.elements, _SAMPLED) if e.kind == "state"]
        _learn_commas(text, states, "state_commas", learnt)
        for state in states:
            _learn_state(text, state, spans.inside(state), learnt)
    _learn_commas(text, branches, "branch_commas", learnt)
    return NativeStyle(**learnt)


def _learn_lines(text: str, branch: Element, learnt: dict[str, Any]) -> None:
    first = branch.elements[0]
    before = text[branch.start + 1 : first.start]
    if "\n" in before or "\r" in before:
        inner, outer = indent_of(text, first.start), indent_of(text, branch.start)
        if len(inner) > len(outer):
            learnt.setdefault("unit", inner[len(outer) :])
    for line in branch.elements:
        if line.kind != "state":
            learnt.setdefault("mark", text[line.start : line.key_start])
            learnt.setdefault("key_colon", text[line.key_end : line.value_start])
            return


def _learn_state(
    text: str, state: Element, inside: tuple[Element, ...], learnt: dict[str, Any]
) -> None:
    colon = text[state.key_end : state.value_start]
    if _COLON.fullmatch(colon):
        learnt.setdefault("colon", colon)
    brackets = text[state.value_start : state.value_end]
    if not inside:
        if _EMPTY.fullmatch(brackets):
            learnt.setdefault("empty", brackets)
        return
    edges = [element for element in inside if element.kind == "edge"]
    for edge in edges[:1]:
        arrow = text[edge.key_end : edge.value_start]
        if _ARROW.fullmatch(arrow):
            learnt.setdefault("arrow", arrow)
    _learn_commas(text, edges, "edge_commas", learnt)
    if len(edges) == len(inside):
        broken = "\n" in brackets or "\r" in brackets
        learnt.setdefault("single" if len(edges) == 1 else "several", broken)


def _learn_commas(text: str, elements: list[Element], name: str, learnt: dict[str, Any]) -> None:
    if name in learnt:
        return
    gaps = pairwise(elements)
    found = [has_comma(text[one.end : other.start]) for one, other in gaps]
    if found:
        learnt[name] = any(found)


def has_comma(gap: str) -> bool:
    """Return whether a comma is between two elements, outside of comments."""
    return "," in "".join(without_comments(gap))


def without_comments(gap: str) -> Iterator[str]:
    """Yield the pieces of a gap between its comments."""
    at = 0
    for comment in re.finditer(r"//[^\r\n]*+", gap):
        yield gap[at : comment.start()]
        at = comment.end()
    yield gap[at:]


def indent_of(text: str, at: int) -> str:
    """Return the indentation of the line of the offset ``at``."""
    start = max(text.rfind("\n", 0, at), text.rfind("\r", 0, at)) + 1
    if start == 0 and text.startswith("\ufeff"):
        start = 1
    line = text[start:at]
    return line[: len(line) - len(line.lstrip())]


def values_text(values: Mapping[str, Json], style: NativeStyle) -> str:
    """Return values as a new text."""
    pieces: list[str] = []
    branches = [key for key in values if not key.startswith("_")]
    line_before = False
    for key, value in values.items():
        if key.startswith("_"):
            pieces.append(style.field(key, value))
        else:
            if line_before:
                pieces.append(style.newline)
            comma = "," if style.branch_commas and key != branches[-1] else ""
            pieces.append(f"{style.branch(key, value)}{comma}")
        pieces.append(style.newline)
        line_before = key.startswith("_")
    return "".join(pieces)
