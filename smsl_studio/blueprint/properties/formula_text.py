"""Reads the text of a formula. It may come from anywhere, so its depth is limited."""

from __future__ import annotations

import re
from typing import NamedTuple

from smsl_studio.blueprint.properties.formula import (
    AllOf,
    AnyOf,
    FactTerm,
    Formula,
    Negation,
    Span,
    StateTerm,
    Term,
)
from smsl_studio.errors import FormulaError
from smsl_studio.stop import heed

DEEPEST = 100
"""The largest depth of brackets."""
WORDS = frozenset(("and", "or", "not", "in"))
_TOKEN = re.compile(
    r"""\s*(?:
      (?P<sign>!=|=|\(|\)|/)
    | '(?P<quoted>(?:[^']|'')*)'
    | "(?P<plain>(?:[^"]|"")*)"
    | (?P<bare>(?:[^\s{}\[\]:,\#/"()>'=!]|!(?!=))+)
    )""",
    re.VERBOSE,
)
_SHOWN = 24
_MOST_DIGITS = 6


class _Token(NamedTuple):
    """One word of a formula. ``kind`` is ``sign``, ``word``, ``name`` (bare or in single quotes),
    ``plain`` (in double quotes) or ``end``."""

    kind: str
    text: str
    span: Span
    bare: bool = False

    @property
    def at(self) -> int:
        """The offset of its begin."""
        return self.span[0]


_NONE = _Token("none", "", (0, 0))


def read_formula(text: str) -> Formula:
    """Return the formula in a text. FormulaError says where it cannot be read, and why."""
    reader = _Reader(text)
    found = reader.either(0)
    reader.expect_end()
    return found


class _Reader:
    """Reads one formula from left to right."""

    def __init__(self, text: str) -> None:
        self._tokens = _tokens(text)
        self._next = 0

    def either(self, depth: int) -> Formula:
        """Read ``T { or T }``."""
        parts = [self._both(depth)]
        while self._takes("or"):
            parts.append(self._both(depth))
        return parts[0] if len(parts) == 1 else AnyOf(tuple(parts))

    def expect_end(self) -> None:
        """Raise FormulaError if there is more text."""
        token = self._look()
        if token.kind != "end":
            raise _fault(token, "'and', 'or' or the end is expected")

    def _both(self, depth: int) -> Formula:
        parts = [self._part(depth)]
        while self._takes("and"):
            parts.append(self._part(depth))
        return parts[0] if len(parts) == 1 else AllOf(tuple(parts))

    def _part(self, depth: int) -> Formula:
        heed()
        negated = False
        while self._takes("not"):
            heed()
            negated = not negated
        token = self._look()
        if self._takes("("):
            if depth == DEEPEST:
                raise FormulaError(f"brackets stand in each other more than {DEEPEST} deep",
                                   token.at, "Write it with fewer brackets.")  # fmt: skip
            found = self.either(depth + 1)
            if not self._takes(")"):
                raise _fault(self._look(), "')' is expected")
        else:
            found = self._term()
        return Negation(found) if negated else found

    def _term(self) -> Term:
        """Read a comparison of a fact, or ``SB in STATE``."""
        first = self._take()
        if first.kind not in ("name", "plain"):
            raise _fault(first, "a fact, an SB, 'not' or '(' is expected")
        branch, fact = _NONE, first
        if first.kind == "name" and self._takes("/"):
            branch, fact = first, self._take()
            if fact.kind != "plain" and not _is_digit(fact):
                raise _fault(fact, f'a digit of {first.text} or a plain name in "..." is expected')
        elif first.kind == "name" and self._takes("in"):
            state = self._name("a state")
            return StateTerm(first.text, state.text, (first.span, state.span))
        sign = self._take()
        if sign.kind != "sign" or sign.text not in ("=", "!="):
            wanted = "'=' or '!='" if branch.text or fact.kind == "plain" else "'=', '!=' or 'in'"
            raise _fault(sign, f"{wanted} is expected")
        value, equal = self._name("a value"), sign.text == "="
        if fact.kind == "name" and not _is_digit(fact):
            branch, fact = fact, _NONE
        digit = int(fact.text) if fact.kind == "name" else None
        name = fact.text if fact.kind == "plain" else ""
        spans = branch.span, fact.span, value.span
        return FactTerm(branch.text, digit, name, value.text, equal, spans)

    def _name(self, what: str) -> _Token:
        token = self._take()
        if token.kind != "name":
            raise _fault(token, f"{what} is expected")
        return token

    def _look(self) -> _Token:
        return self._tokens[self._next]

    def _take(self) -> _Token:
        token = self._look()
        if token.kind != "end":
            self._next += 1
        return token

    def _takes(self, text: str) -> bool:
        """Take the next token if it is this word or sign."""
        token = self._look()
        if token.kind not in ("word", "sign") or token.text != text:
            return False
        self._next += 1
        return True


def _tokens(text: str) -> list[_Token]:
    found, at = [], 0
    end = len(text.rstrip())
    while at < end:
        heed()
        match = _TOKEN.match(text, at, end)
        if match is None:
            raise _unreadable(text, at)
        kind = match.lastgroup or ""
        part = match[kind]
        if kind == "bare":
            word = part in WORDS
            found.append(_Token("word" if word else "name", part, match.span(kind), bare=True))
        elif kind == "sign":
            found.append(_Token("sign", part, match.span(kind)))
        else:
            span = match.start(kind) - 1, match.end(kind) + 1
            sign = "'" if kind == "quoted" else '"'
            name = part.replace(sign * 2, sign)
            found.append(_Token("name" if kind == "quoted" else "plain", name, span))
        at = match.end()
    return [*found, _Token("end", "", (end, end))]


def _unreadable(text: str, at: int) -> FormulaError:
    while text[at].isspace():
        at += 1
    if text[at] in "'\"":
        return FormulaError(f"{text[at]} is not closed", at, f"Write {text[at]} at its end too.")
    return FormulaError(
        f"{text[at]!r} can be no part of a name here", at, "Put the name in single quotes: '...'."
    )


def _fault(token: _Token, wanted: str) -> FormulaError:
    shown = token.text if len(token.text) <= _SHOWN else f"{token.text[:_SHOWN]}..."
    found = "the text ends" if token.kind == "end" else f"{shown!r} stands"
    return FormulaError(f"{wanted}, but {found} there", token.at, FORM)


FORM = (
    'A condition is such as: SB1/0 = a and not (SB2 in State_1 or "Clamp fixed" != 1). '
    "Other names than letters, digits, _ and - stand in '...'."
)
"""The advice where a condition cannot be read."""


def written_name(name: str) -> str:
    """Return a name as a formula writes it: without quotes if possible."""
    match = _TOKEN.fullmatch(name)
    if match is not None and match["bare"] == name and name not in WORDS:
        return name
    return "'" + name.replace("'", "''") + "'"


def written_plain(name: str) -> str:
    """Return the plain name of a fact as a formula writes it."""
    return '"' + name.replace('"', '""') + '"'


def _is_digit(token: _Token) -> bool:
    text = token.text
    return token.bare and text.isascii() and text.isdecimal() and len(text) <= _MOST_DIGITS
