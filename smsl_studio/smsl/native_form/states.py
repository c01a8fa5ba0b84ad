"""Reads states: well-formed ones at once, others token by token with all their faults."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from smsl_studio.errors import TextFix
from smsl_studio.smsl.native_form import names, strays, tokens
from smsl_studio.smsl.native_form.faults import Faults
from smsl_studio.smsl.native_form.fields import HashFields
from smsl_studio.smsl.native_form.lines import line_at
from smsl_studio.smsl.native_form.tokens import decoded, skip_gap, skip_separator

Json = Any

_NEXT_STATE = re.compile(rf"{tokens.NAME}{tokens.GAP}:{tokens.GAP}[\[{{]")
_CLOSED = re.compile(r"[^\r\n\[\]{}:#]*+\]")
_ARROW = re.compile(rf"{tokens.GAP}->")
_NOT_ARROW = re.compile(r"(?:[=~\u2013\u2014]++|-\s++)?>|[=→⇒⟶➔]++>?|:|--?(?=\s)")


class ReadState(NamedTuple):
    """A state that was read, and the offset after it. ``key`` is None if no state was
    recognized.
    """

    key: str | None
    value: dict[str, Json]
    end: int


class StateReader:
    """Reads the states of one text."""

    def __init__(self, text: str, faults: Faults, keeping: HashFields) -> None:
        self._text, self._faults, self._keeping = text, faults, keeping
        self._match = tokens.state.match
        self._same: dict[str, str] = {}

    def whole(self, at: int) -> tuple[str, dict[str, Json], int] | None:
        """Return the state at ``at`` if it is well formed and has only edges, else None."""
        match = self._match(self._text, at)
        if match is None:
            return None
        key, body = match.groups()
        pairs = tokens.edges.findall(body)
        same = self._same.setdefault
        try:
            if '"' in body:
                pairs = [(decoded(name), decoded(target)) for name, target in pairs]
            key = decoded(key)
        except ValueError:
            return None
        if key == "HEADER":
            return None
        table: dict[str, Json] = {same(name, name): same(to, to) for name, to in pairs}
        if len(table) != len(pairs):
            self._keeping.doubled = True
        return key, table, match.end()

    def odd(self, at: int) -> ReadState:
        """Read what is at ``at`` in the place of a state, as far as possible. Faults are
        reported.
        """
        key, at, closer = self._head(at)
        if closer is None:
            return ReadState(key, {}, at)
        table: dict[str, Json] = {}
        at = self._edges(at, closer, key or "", table)
        return ReadState(key, table, at)

    def _head(self, at: int) -> tuple[str | None, int, str | None]:
        """Read name, colon and bracket. Return the name, the offset after them, and the closing
        bracket.

        The closing bracket is None if no bracket opens the state.
        """
        text, faults = self._text, self._faults
        found = names.read(text, at, faults, names.BEFORE_BRACKET)
        if found is None:
            return None, *self._nameless(at)
        key, behind = found
        if key == "HEADER":
            advice = "Choose another name; header lines are written # KEY: value."
            faults.add(at, behind, "HEADER cannot be the name of a state", advice)
        colon = skip_gap(text, behind)
        bracket = colon
        if text[colon : colon + 1] == ":":
            bracket = skip_gap(text, colon + 1)
        elif text[colon : colon + 1] == "[":
            fix = TextFix("Put : behind the name", behind, behind, ":")
            sentence = f"{key!r} is a state, and : is missing behind its name"
            faults.add(colon, colon + 1, sentence, "A state is State0: [Operation -> State1].", fix)
        else:
            return None, strays.no_state(text, at, behind, key, faults), None
        return key, *self._bracket(bracket, colon + 1, key)

    def _bracket(self, at: int, colon: int, key: str) -> tuple[int, str | None]:
        """Return the offset after the bracket that opens a state, and the closing bracket.

        The closing bracket is None if no bracket opens the state.
        """
        text, faults = self._text, self._faults
        mark = text[at : at + 1]
        if mark == "[":
            return at + 1, "]"
        advice = "A state is State0: [Operation -> State1], or State0: [ ]."
        if mark == "{":
            fix = TextFix("Write [", at, at + 1, "[")
            faults.add(at, at + 1, "the operations of a state stand in [ ]", advice, fix)
            return at + 1, "}"
        if tokens.edge.match(text, at) or _CLOSED.match(text, at):
            fix = TextFix("Put [ before it", at, at, "[")
            faults.add(at, at + 1, f"[ is missing behind the state {key!r}", advice, fix)
            return at, "]"
        fix = TextFix("Write [ ]", colon, colon, " [ ]")
        faults.add(colon - 1, colon, f"the state {key!r} has no [ ]", advice, fix)
        return (at if at > colon else colon), None

    def _nameless(self, at: int) -> tuple[int, str | None]:
        """Report a bracket or colon in the place of a state's name. Return as ``_bracket`` does."""
        text, faults = self._text, self._faults
        opened = at
        if text[at] == ":":
            opened = skip_gap(text, at + 1)
        if text[opened : opened + 1] != "[":
            return strays.inside(text, at, faults), None
        sentence = "a state without a name"
        faults.add(at, at + 1, sentence, "Write its name and a colon before [.")
        return opened + 1, "]"

    def _edges(self, at: int, closer: str, key: str, table: dict[str, Json]) -> int:
        """Read the content of a state, from after its bracket. Return the offset after its closing
        bracket.
        """
        text = self._text
        opened, last = at - 1, at
        before: tuple[int, int] | None = None  # The span of the last target.
        while True:
            at = skip_separator(text, last)
            match = tokens.edge.match(text, at)
            if match is not None and (pair := self._pair(match)):
                self._keeping.keep(table, *pair)
                last, before = match.end(), match.span(2)
                continue
            mark = text[at : at + 1]
            if mark in ("]", closer):
                if mark == "}":
                    fix = TextFix("Write ]", at, at + 1, "]")
                    words = "the operations of a state stand in [ ]"
                    self._faults.add(at, at + 1, words, "Write ] here.", fix)
                return at + 1
            if mark in ("", "{", "}") or self._begins_other(at):
                strays.state_not_closed(text, opened, last, at, key, self._faults)
                return at
            last = self._line(at, table) if mark == "#" else self._odd_edge(at, before, table)
            before = None

    def _begins_other(self, at: int) -> bool:
        """Return whether a new state, or a line that is in no state, begins at ``at``."""
        if self._text[at] == "#":
            line = line_at(self._text, at)
            return line is not None and line.level != "field"
        return _NEXT_STATE.match(self._text, at) is not None

    def _line(self, at: int, table: dict[str, Json]) -> int:
        """Read a ``# _KEY: json`` line in a state. Return the offset after it."""
        line = line_at(self._text, at)
        if line is None:
            return strays.broken_line(self._text, at, self._faults)
        return self._keeping.line(table, line, 3)

    def _odd_edge(self, at: int, before: tuple[int, int] | None, table: dict[str, Json]) -> int:
        """Report something in a state that is not a correct edge. Return the offset after it."""
        text, faults = self._text, self._faults
        if before and (fixed := names.torn_target(text, before, at, faults)):
            return fixed
        if text[at] == "[":
            fix = TextFix("Take it away", at, at + 1, "")
            faults.add(at, at + 1, "this [ opens a second time", "Take it away.", fix)
            return at + 1
        if _ARROW.match(text, at):
            advice = "An operation is Operation -> State."
            faults.add(at, at + 2, "an operation needs a name before ->", advice)
            behind = skip_gap(text, at + 2)
            target = names.read(text, behind, faults, names.BEFORE_COMMA)
            return target[1] if target else at + 2
        found = names.read(text, at, faults, names.BEFORE_ARROW)
        if found is None:
            return strays.inside(text, at, faults)
        return self._rest_of_edge(at, *found, table)

    def _rest_of_edge(self, at: int, name: str, behind: int, table: dict[str, Json]) -> int:
        """Read an edge with a fault, from after its name. Return the offset after it."""
        text, faults = self._text, self._faults
        arrow = skip_gap(text, behind)
        advice = "An operation is Operation -> State."
        if text.startswith("->", arrow):
            target_at = skip_gap(text, arrow + 2)
        else:
            if text[behind - 1 : behind] in ("=", "~", "-") and text[behind : behind + 1] == ">":
                # In a=>b the sign was read as a part of the name.
                arrow, name = behind - 1, name[:-1]
            wrong = _NOT_ARROW.match(text, arrow)
            next_name = tokens.name.match(text, arrow)
            if wrong:
                fix = TextFix("Write ->", arrow, wrong.end(), " -> ")
                faults.add(arrow, wrong.end(), f"-> is expected, not {wrong[0]}", advice, fix)
                target_at = skip_gap(text, wrong.end())
            elif (
                next_name
                and "\n" not in text[behind:arrow]
                and not _ARROW.match(text, next_name.end())
            ):
                fix = TextFix("Put -> between them", behind, behind, " ->")
                faults.add(arrow, arrow + 1, f"-> is missing behind {name!r}", advice, fix)
                target_at = arrow
            else:
                sentence = f"the operation {name!r} leads to no state"
                faults.add(at, behind, sentence, advice)
                return behind
        target = names.read(text, target_at, faults, names.BEFORE_COMMA)
        if target is None:
            faults.add(at, behind, f"the operation {name!r} leads to no state", advice)
            return target_at
        self._keeping.keep(table, name, target[0])
        return target[1]

    def _pair(self, match: re.Match[str]) -> tuple[str, str] | None:
        try:
            return decoded(match[1]), decoded(match[2])
        except ValueError:
            return None
