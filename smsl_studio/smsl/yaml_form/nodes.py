"""Reads a YAML text as a tree of nodes, each with its place. ``reader`` reads their meaning later.

The events come from libyaml (through PyYAML), which constructs nothing. Anchors are resolved and
aliases are counted, so that a small text cannot expand to a huge one. After a fault, reading goes
on at the next name at the beginning of a line.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import islice
from typing import Any

import yaml

from smsl_studio.errors import TextFix
from smsl_studio.smsl.document.limits import MAX_DEPTH, TOO_DEEP, most_values, too_many_values
from smsl_studio.smsl.yaml_form.faults import YamlFault, shown, syntax_fault

MAX_REPEATED = 250_000
"""The most characters and nodes that all aliases together may repeat."""

_RESUMES = 20
_ODD = re.compile(
    "[^\t\n\r\x20-\x7e\x85\xa0-\ud7ff\ue000-\ufefe\uff00-\ufffd\U00010000-\U0010ffff]"
)
_NAME_AT_MARGIN = re.compile(r"^[^\s#\[\]{},%@`|>*&!?:'\"-][^\n\r]*?:(?=\s|$)", re.MULTILINE)
_TAGS = {f"tag:yaml.org,2002:{name}": name for name in ("str", "int", "float", "bool", "null")} | {
    "tag:yaml.org,2002:seq": "seq",
    "tag:yaml.org,2002:map": "map",
    "!": "str",
}
_TAG = re.compile(r"(?:&\S+\s+)?(\S+)\s*")
_PARSER: Any = yaml.CSafeLoader if yaml.__with_libyaml__ else yaml.SafeLoader


class YamlNode:
    """One value as written, from ``start`` to ``end``.

    ``kind`` is ``text``, ``list``, ``map`` or ``alias``. ``value`` is the text, the nodes, the
    pairs of nodes, or the node that the alias repeats. ``tag`` is a core tag that was written. A
    text is ``plain`` if it has no tag and no quotes, so that it may be a number.
    """

    __slots__ = ("end", "flow", "height", "kind", "plain", "start", "tag", "value", "weight")

    def __init__(self, kind: str, start: int, end: int, value: Any, tag: str = "") -> None:
        self.kind, self.start, self.end, self.value, self.tag = kind, start, end, value, tag
        self.plain = self.flow = False
        self.height, self.weight = 0, 1

    @property
    def real(self) -> YamlNode:
        """The node itself, or the node that an alias repeats."""
        node = self
        while node.kind == "alias":
            node = node.value
        return node


class Tree:
    """The nodes of one text, and its faults.

    ``roots`` has one node for a valid text. After a fault it has more.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.faults: list[YamlFault] = []
        self.roots: list[YamlNode] = []
        self.count = 0
        self._most = most_values(text)
        self._anchors: dict[str, YamlNode] = {}
        self._repeated = 0
        self._read()

    @property
    def is_beyond_budget(self) -> bool:
        """Whether the text has more names and values than allowed. The rest was not read."""
        return self.count > self._most

    def add(self) -> bool:
        """Count one more member or element. Return whether it is the first one too many."""
        self.count += 1
        return self.count == self._most + 1

    def _read(self) -> None:
        text = self.text
        at = 1 if text.startswith("\ufeff") else 0
        odd = islice(_ODD.finditer(text, at), _RESUMES)
        self.faults.extend(map(_odd_character, odd))
        if self.faults:
            text = text[:at] + _ODD.sub("\ufffd", text[at:])
        for _ in range(_RESUMES):
            stopped = self._read_from(text, at)
            if stopped is None or self.is_beyond_budget:
                return
            following = _NAME_AT_MARGIN.search(text, _next_line(text, max(stopped - 1, at)))
            if following is None:
                return
            at = following.start()

    def _read_from(self, text: str, at: int) -> int | None:
        """Read from an offset. Return the offset at which reading stopped, None at the end of the
        text.
        """
        building = _Building(self, text, at)
        parser = _PARSER(text[at:])
        try:
            while not building.done:
                building.take(parser.get_event())
        except yaml.YAMLError as error:
            fault = syntax_fault(error, text, at)
            self.faults.append(fault)
            building.close_all(fault.start)
            return fault.start
        finally:
            parser.dispose()
        return building.stopped

    def target(self, anchor: str, start: int, end: int, depth: int) -> YamlNode:
        """Return the node that an alias repeats. If it is not allowed, report it and return an
        empty one.
        """
        found = self._anchors.get(anchor)
        sentence = advice = ""
        if found is None:
            sentence, advice = f"nothing is anchored as &{anchor}", "Write the value itself."
        elif found.end < 0:
            sentence, advice = f"*{anchor} stands inside what it stands for", "Write it out."
        elif depth + found.height > MAX_DEPTH:
            sentence, advice = TOO_DEEP
        else:
            told = self._repeated > MAX_REPEATED
            self._repeated += found.weight
            if self._repeated > MAX_REPEATED:
                sentence = "the aliases of this file stand for too much"
                advice = "Write the values out instead of repeating them."
            if told:
                return YamlNode("text", start, end, "", "null")
        if found is None or sentence:
            self.faults.append(YamlFault(start, end - start, sentence, advice))
            return YamlNode("text", start, end, "", "null")
        return found

    def anchor(self, name: str, node: YamlNode) -> None:
        """Keep a node under its anchor."""
        self._anchors[name] = node


class _Building:
    """Builds the nodes of one stream from its events."""

    def __init__(self, tree: Tree, text: str, shift: int) -> None:
        self._tree, self._text, self._shift = tree, text, shift
        self._open: list[YamlNode] = []
        self._names: list[YamlNode | None] = []
        self._documents = 0
        self.done = False
        self.stopped: int | None = None
        self._takes: dict[type, Callable[[Any], None]] = {
            yaml.ScalarEvent: self._scalar,
            yaml.MappingStartEvent: self._begin_map,
            yaml.SequenceStartEvent: self._begin_list,
            yaml.MappingEndEvent: self._end,
            yaml.SequenceEndEvent: self._end,
            yaml.AliasEvent: self._alias,
            yaml.DocumentStartEvent: self._document,
            yaml.StreamEndEvent: self._end_stream,
        }

    def take(self, event: Any) -> None:
        """Handle one event of the parser. Events without a meaning here are ignored."""
        take = self._takes.get(type(event))
        if take is not None:
            take(event)

    def close_all(self, at: int) -> None:
        """Close all open nodes, because the text is not valid YAML after ``at``."""
        while self._open:
            self._finish(at)

    def _stop(self, at: int, sentence: str, advice: str) -> None:
        """Stop reading and report a fault, because the rest would cost too much."""
        self._tree.faults.append(YamlFault(at, 1, sentence, advice))
        self.close_all(at)
        self.done, self.stopped = True, at

    def _span(self, event: Any) -> tuple[int, int]:
        return event.start_mark.index + self._shift, event.end_mark.index + self._shift

    def _document(self, event: Any) -> None:
        self._documents += 1
        if self._documents > 1:
            start, end = self._span(event)
            self._tree.faults.append(
                YamlFault(
                    start, end - start, "a second document begins here", "Keep one in a file."
                )
            )
            self.done = True

    def _end_stream(self, _event: Any) -> None:
        self.done = True

    def _alias(self, event: Any) -> None:
        start, end = self._span(event)
        found = self._tree.target(event.anchor, start, end, len(self._open))
        node = YamlNode("alias", start, end, found)
        node.height, node.weight = found.height, found.weight
        self._put(node)

    def _tag(self, name: str, start: int) -> str:
        """Return the core tag with this name, written after ``start``. Report any other tag."""
        tag = _TAGS.get(name)
        if tag is None:
            written = _TAG.match(self._text, start)
            begin, end = written.span(1) if written else (start, start + 1)
            words = f"the tag {shown(self._text[begin:end])} is not read"
            fix = TextFix("Remove the tag", begin, written.end() if written else end, "")
            self._tree.faults.append(
                YamlFault(begin, end - begin, words, "Leave the tag out.", fix)
            )
        return tag or ""

    def _scalar(self, event: Any) -> None:
        start, end = self._span(event)
        if event.style in ("|", ">"):
            end = start + len(self._text[start:end].rstrip())
        text = event.value
        node = YamlNode("text", start, end, text)
        if event.tag is not None:
            node.tag = self._tag(event.tag, start)
        node.plain = not node.tag and event.implicit[0]
        node.weight = 1 + len(text)
        if event.anchor is not None:
            self._tree.anchor(event.anchor, node)
        self._put(node)

    def _begin_map(self, event: Any) -> None:
        self._begin(event, "map")

    def _begin_list(self, event: Any) -> None:
        self._begin(event, "list")

    def _begin(self, event: Any, kind: str) -> None:
        start = event.start_mark.index + self._shift
        if len(self._open) >= MAX_DEPTH:
            self._stop(start, *TOO_DEEP)
            return
        node = YamlNode(kind, start, -1, [])
        if event.tag is not None:
            node.tag = self._tag(event.tag, start)
        node.height = 1
        if event.flow_style:
            node.flow = event.end_mark.index + self._shift > start
        if event.anchor is not None:
            self._tree.anchor(event.anchor, node)
        self._open.append(node)
        self._names.append(None)

    def _end(self, event: Any) -> None:
        self._finish(event.end_mark.index + self._shift)

    def _finish(self, end: int) -> None:
        node, name = self._open.pop(), self._names.pop()
        if name is not None:  # The text ended between a name and its value.
            node.value.append((name, YamlNode("text", name.end, name.end, "", "null")))
        if not node.flow:
            last = node.value[-1] if node.value else None
            end = (last[1] if isinstance(last, tuple) else last).end if last else node.start
        node.end = end
        self._put(node)

    def _put(self, node: YamlNode) -> None:
        if not self._open:
            if self._documents < 2:
                self._tree.roots.append(node)
            return
        above = self._open[-1]
        above.weight += node.weight
        if above.height <= node.height:
            above.height = node.height + 1
        if above.kind == "list":
            above.value.append(node)
            self._count(node)
            return
        name = self._names[-1]
        if name is None:
            self._names[-1] = node
            return
        # An empty value has the place of what follows it, so it is moved to its colon.
        if node.start == node.end:
            colon = self._text.find(":", name.end, node.start)
            node.start = node.end = colon + 1 if colon >= 0 else name.end
        above.value.append((name, node))
        self._names[-1] = None
        self._count(name)

    def _count(self, node: YamlNode) -> None:
        """Count one more member or element. Stop reading if there are too many."""
        if self._tree.add():
            self._stop(node.start, *too_many_values(self._tree.text))


def _odd_character(match: re.Match[str]) -> YamlFault:
    at = match.start()
    return YamlFault(
        at,
        1,
        f"the character U+{ord(match[0]):04X} cannot stand in YAML",
        f'Write it as "\\u{ord(match[0]):04X}" in double quotes, or leave it out.',
        TextFix("Remove the character", at, at + 1, ""),
    )


def _next_line(text: str, at: int) -> int:
    found = text.find("\n", at)
    return len(text) if found < 0 else found + 1
