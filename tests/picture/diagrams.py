"""Readers of DOT and Mermaid, as the programs read them: a diagram as states and operations."""

from __future__ import annotations

import html
import re
from typing import NamedTuple

_DOT = re.compile(r'"(?:\\["\\]|[^"\\]|\\(?!["\\]))*"|->|[\w.]+|[{}\[\];=,]|\s+')
_STATE = re.compile(r'state "([^"]*)" as (\w+)( \{)?$')
_ARROW = re.compile(r"(s\d+|\[\*\]) --> (s\d+)(?: : ((?:#\d+;|[^:;\n])+))?$")
_CODE = re.compile(r"#(\d+);")


class Diagram(NamedTuple):
    """What a diagram shows: nodes as id and words, arrows as two ids and words."""

    nodes: dict[str, str]
    arrows: list[tuple[str, str, str]]
    groups: list[str]


def read_dot(text: str) -> Diagram:
    """Read DOT. A character that the grammar does not know fails."""
    tokens = _tokens(text)
    found = Diagram({}, [], [])
    at = 0
    while at < len(tokens):
        end = at
        while tokens[end] not in (";", "{", "}"):
            end += 1
        _statement(tokens[at:end], found)
        at = end + 1
    return found


def _tokens(text: str) -> list[str]:
    tokens, at = [], 0
    while at < len(text):
        found = _DOT.match(text, at)
        assert found, text[at : at + 40]
        tokens.append(found[0])
        at = found.end()
    return [token for token in tokens if token.strip()]


def _statement(tokens: list[str], found: Diagram) -> None:
    if not tokens or tokens[0] in ("digraph", "node", "subgraph"):
        return
    if tokens[:2] == ["label", "="]:
        found.groups.append(_words(tokens[2]))
        return
    label = _words(tokens[tokens.index("label") + 2])
    if tokens[1] == "->":
        found.arrows.append((tokens[0], tokens[2], label))
    else:
        assert tokens[0] not in found.nodes, "an id stands for one node"
        found.nodes[tokens[0]] = label


def _words(quoted: str) -> str:
    """A label as it is drawn: escapes first, then the entities of HTML."""
    inside = quoted[1:-1].replace('\\"', '"')
    drawn = re.sub(r"\\(.)", lambda one: one[1] if one[1] == "\\" else "<line end>", inside)
    return html.unescape(drawn)


def read_mermaid(text: str) -> Diagram:
    """Read a state diagram of Mermaid. A line of another kind fails."""
    # The program does this to lines about colours before it reads them.
    assert not re.search(r"(style|classDef).*:\S*#.*;", text)
    first, *lines = text.splitlines()
    assert first == "stateDiagram-v2"
    found = Diagram({}, [], [])
    for line in map(str.strip, lines):
        if state := _STATE.match(line):
            words = _decoded(state[1])
            if state[3]:
                found.groups.append(words)
            else:
                found.nodes[state[2]] = words
        elif arrow := _ARROW.match(line):
            if arrow[1] != "[*]":
                found.arrows.append((arrow[1], arrow[2], _decoded(arrow[3] or "")))
        else:
            assert line == "}" or re.match(r"class(Def)? [\w,]+ [\w :-]+$", line), line
    return found


def _decoded(text: str) -> str:
    plain = _CODE.sub("", text)
    assert not set(plain) & set('"#%;:<>[]{}&|\\`~\n'), text
    return _CODE.sub(lambda one: chr(int(one[1])), text)
