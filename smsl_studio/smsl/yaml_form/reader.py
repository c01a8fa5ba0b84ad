"""Reads YAML: from a tree of nodes to values.

Names (keys, targets, INITIAL, ACTIVATING) are texts in any case. All other values follow the YAML
1.2 core schema.
"""

from __future__ import annotations

import re
from typing import Any

from smsl_studio.errors import Place, ReadError, TextFix
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.document.conflict_markers import is_marked, told_of_markers
from smsl_studio.smsl.document.limits import MAX_CHARACTERS, TOO_LONG
from smsl_studio.smsl.yaml_form import scalars
from smsl_studio.smsl.yaml_form.faults import YamlFault, as_error, shown
from smsl_studio.smsl.yaml_form.levels import FILE, FREE, NAME, below, is_map, members, strangers
from smsl_studio.smsl.yaml_form.nodes import Tree, YamlNode
from smsl_studio.smsl.yaml_form.spans import YamlSpans

Json = Any

_JOINED = re.compile(r"[^\s:]+?(\s*->\s*|:|\s*=\s*)[^\s:]+")
_LEVELS = {0: "the file", 1: "a State Branch", 2: "a state", 3: "a HEADER"}


def parse(text: str, file: str) -> Document:
    """Read a YAML text. ReadError, with all its faults and their file:line:column, if it is not
    valid.

    A doubled key is no error: the last value counts, in the place of the first.
    """
    if is_marked(text):
        # YAML would take markers inside a flow map for a part of a name.
        place = Place(file, 1, 1)
        raise told_of_markers(ReadError("conflict markers", place), text, file)
    document, faults = _read(text, file, recovers=False)
    if faults:
        raise as_error(faults, document)
    return document


def recover(text: str, file: str) -> Document:
    """Return a document with what can be read of a faulty text.

    After a fault, reading goes on at the next name at the beginning of a line.
    """
    return _read(text, file, recovers=True)[0]


def form_within(_text: str) -> str:
    """Return the empty text: nearly every text is YAML, so a text that is not is in no other
    form.
    """
    return ""


def _read(text: str, file: str, recovers: bool) -> tuple[Document, list[YamlFault]]:
    if len(text) > MAX_CHARACTERS:
        fault = YamlFault(0, 1, *TOO_LONG)
        return Document(text, file, "yaml", {}, lambda _: YamlSpans(Tree(""))), [fault]
    tree = Tree(text)
    reading = _Reading(tree.faults)
    values: dict[str, Json] = {}
    for root in tree.roots if recovers or not tree.is_beyond_budget else ():
        if is_map(root, FILE) and not _is_nothing(root):
            reading.fill(values, root, FILE)
        elif not tree.faults:
            reading.fault(root, "the file holds no State Branches", _WHOLE)
    if not tree.faults and (not tree.roots or _is_nothing(tree.roots[0])):
        at = len(text) - len(text.removeprefix("\ufeff").lstrip())
        tree.faults.append(
            YamlFault(at, 1, "the file is empty", "An empty blueprint is written {}.")
        )
    spans = YamlSpans(tree)
    return Document(text, file, "yaml", values, lambda _: spans, reading.doubled), tree.faults


_WHOLE = "An SMSL file is one map whose members are State Branches."


def _parted(node: YamlNode) -> TextFix | None:
    """Return the repair of a name and a value without a colon and a space. None if it is not so."""
    found = _JOINED.fullmatch(node.value) if node.kind == "text" and node.plain else None
    if found is None or len(node.value) != node.end - node.start:
        return None
    start, end = node.start + found.start(1), node.start + found.end(1)
    return TextFix("Write a colon and a space", start, end, ": ")


def _is_nothing(node: YamlNode) -> bool:
    return node.kind == "text" and node.plain and scalars.is_null(node.value)


class _Reading:
    """Reads values from nodes. A node that cannot be a value is a fault."""

    def __init__(self, faults: list[YamlFault]) -> None:
        self._faults = faults
        self._told = {fault.start for fault in faults}
        self.doubled = False

    def fault(self, node: YamlNode, sentence: str, advice: str, fix: TextFix | None = None) -> None:
        """Add a fault at a node, unless the text already has one there."""
        if node.start not in self._told:
            self._faults.append(YamlFault(node.start, node.end - node.start, sentence, advice, fix))

    def fill(self, values: dict[str, Json], node: YamlNode, level: int) -> dict[str, Json]:
        """Put the members of a map into ``values``."""
        for stranger in strangers(node):
            words = f"an element of the list that {_LEVELS[level]} is written as has no name"
            fix = _parted(stranger)
            self.fault(stranger, words, "Write each element as NAME: VALUE.", fix)
        for key, value in members(node, level):
            name = self._name(key)
            if name is None:
                continue
            if name in values:
                self.doubled = True
            values[name] = self._value(value, below(level, name))
        return values

    def _name(self, node: YamlNode) -> str | None:
        real = node.real
        if real.kind != "text":
            self.fault(node, "a name is a text", "Put it in quotes.")
            return None
        found: str = real.value
        return found

    def _value(self, node: YamlNode, level: int) -> Json:
        real = node.real
        if real.kind == "map" or is_map(real, level):
            return self.fill({}, real, level)
        if real.kind == "list":
            return [self._value(item, FREE) for item in real.value]
        text: str = real.value
        if not real.plain and not real.tag:
            return text
        if level == NAME and real.plain:
            return text or None
        try:
            return scalars.tagged(text, real.tag) if real.tag else scalars.resolved(text)
        except ValueError as problem:
            words = f"{problem}: {shown(text)}" if real.tag else str(problem)
            self.fault(node, words, "Put it in quotes, if it is a text.")
            return None
