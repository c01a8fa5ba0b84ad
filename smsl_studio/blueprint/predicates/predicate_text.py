"""Reads the text of a predicate. It may come from anywhere, so its length and depth are limited."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from smsl_studio.blueprint.predicates.terms import (
    AbsTerm,
    AgeTerm,
    Clause,
    DistanceTerm,
    Dwell,
    Every,
    Expression,
    ExtremeTerm,
    Opposite,
    Some,
    SourceTerm,
    SumTerm,
    Threshold,
)
from smsl_studio.blueprint.predicates.units import NUMBER, SECOND, Unit, read_unit
from smsl_studio.errors import FormulaError

LONGEST = 2000
"""The largest length of a predicate, in characters."""
DEEPEST = 20
"""The largest depth of brackets."""
MOST_MEASURES = 100
"""The largest number of names of sources in one predicate."""
CALLS = ("age", "abs", "min", "max", "distance")
JOINTS = ("and", "or", "not", "for")
KEYWORDS = frozenset((*CALLS, *JOINTS))
_TOKEN = re.compile(
    r"""\s*(?:
      (?P<number>(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)
    | (?P<word>[^\W\d][\w.]*)
    | (?P<sign><=|>=|<|>|\(|\)|,|\+|-)
    | '(?P<quoted>(?:[^']|'')*)'
    )""",
    re.VERBOSE,
)
_UNIT = re.compile(r"\s*(?P<unit>[^\W\d][^\s(),<>+']*|[%°1][^\s(),<>+']*)")
_BARE = re.compile(r"[^\W\d][\w.]*")
_SHOWN = 24
MOST = 1e15
"""The largest number in a predicate."""
_FORM = "A predicate is such as: force > 2 N for 0.5 s and not gap > 3 mm."


class _Lexeme(NamedTuple):
    """One word of a predicate: its kind, its text and its offset."""

    kind: str
    text: str
    at: int
    end: int


@lru_cache(maxsize=1024)
def read_predicate(text: str) -> Clause:
    """Return the condition in a text. FormulaError says where it cannot be read, and why."""
    if len(text) > LONGEST:
        raise FormulaError(
            f"a predicate of {len(text):,} characters is too long",
            LONGEST,
            f"At most {LONGEST:,} characters are read.",
        )
    reader = _PredicateReader(text)
    found = reader.clause(0)
    reader.expect_end()
    return found


def written_source(name: str) -> str:
    """Return the name of a source as a predicate writes it: without quotes if possible."""
    if _BARE.fullmatch(name) and name not in KEYWORDS:
        return name
    return "'" + name.replace("'", "''") + "'"


class _PredicateReader:
    """Reads one predicate from left to right."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._at = self._measures = 0

    def clause(self, depth: int) -> Clause:
        """Read ``C { and C }`` or ``C { or C }``."""
        return self._joined(self._condition(depth), depth)

    def expect_end(self) -> None:
        """Raise FormulaError if there is more text."""
        token = self._look()
        if token.kind != "end":
            raise _unexpected(token, "'and', 'or' or the end is expected")

    def _joined(self, first: Clause, depth: int) -> Clause:
        parts, joint = [first], ""
        while (token := self._look()).text in ("and", "or") and token.kind == "word":
            if joint and token.text != joint:
                raise FormulaError(
                    "'and' and 'or' stand side by side",
                    token.at,
                    "Say with brackets which belong together: (a > 1 N or b > 1 N) and c > 1 N.",
                )
            joint = token.text
            self._take()
            parts.append(self._condition(depth))
        if not joint:
            return first
        return Every(tuple(parts)) if joint == "and" else Some(tuple(parts))

    def _condition(self, depth: int) -> Clause:
        negated = self._takes("not")
        found: Clause | None = None
        token = self._look()
        if token.text == "(" and token.kind == "sign":
            inner = self._bracket(depth)
            found = inner if isinstance(inner, Clause) else self._threshold(inner, depth)
        else:
            found = self._threshold(None, depth)
        if negated:
            found = Opposite(found)
        return self._timed(found)

    def _bracket(self, depth: int) -> Expression | Clause:
        """Read what stands in brackets: a condition, or an expression."""
        token = self._take()
        if depth == DEEPEST:
            raise FormulaError(
                f"brackets stand in each other more than {DEEPEST} deep",
                token.at,
                "Write it with fewer brackets.",
            )
        found: Expression | Clause
        first = self._look()
        if first.text == "not" and first.kind == "word":
            found = self.clause(depth + 1)
        elif first.text == "(" and first.kind == "sign":
            inner = self._bracket(depth + 1)
            if isinstance(inner, Clause):
                found = self._after_clause(inner, depth + 1)
            else:
                found = self._either(self._sum(inner, depth + 1), depth + 1)
        else:
            found = self._either(self._sum(None, depth + 1), depth + 1)
        self._expect(")")
        return found

    def _after_clause(self, inner: Clause, depth: int) -> Clause:
        """Read what follows a condition in brackets: a time, and further conditions."""
        return self._joined(self._timed(inner), depth)

    def _either(self, part: Expression, depth: int) -> Expression | Clause:
        """Read a whole condition if a comparison follows, else return the expression."""
        if self._look().text not in ("<", "<=", ">", ">="):
            return part
        return self._joined(self._timed(self._compared(part)), depth)

    def _timed(self, found: Clause) -> Clause:
        if not self._takes("for"):
            return found
        number, unit = self._number_and_unit()
        if not unit.fits(SECOND) or number.text.startswith("-"):
            raise FormulaError("a time is expected after 'for'", number.at, "Such as: for 0.5 s.")
        return Dwell(found, float(Fraction(number.text) * unit.factor))

    def _threshold(self, begun: Expression | None, depth: int) -> Threshold:
        return self._compared(self._sum(begun, depth))

    def _compared(self, part: Expression) -> Threshold:
        sign = self._take()
        if sign.text not in ("<", "<=", ">", ">="):
            raise _unexpected(sign, "'<', '<=', '>' or '>=' is expected")
        number, unit = self._number_and_unit()
        return Threshold(part, sign.text, number.text, unit, number.at)

    def _sum(self, begun: Expression | None, depth: int) -> Expression:
        found = self._part(depth) if begun is None else begun
        while (token := self._look()).text in ("+", "-") and token.kind == "sign":
            self._take()
            found = SumTerm(found, self._part(depth), token.text == "-")
        return found

    def _part(self, depth: int) -> Expression:
        token = self._look()
        self._measures += 1
        if self._measures > MOST_MEASURES:
            raise FormulaError(
                f"it names more than {MOST_MEASURES} measures",
                token.at,
                "Let one source make one number of several.",
            )
        if token.text == "(" and token.kind == "sign":
            inner = self._bracket(depth)
            if isinstance(inner, Clause):
                raise FormulaError(
                    "a condition stands where a measure is expected", token.at, _FORM
                )
            return inner
        self._take()
        if token.kind == "quoted":
            return SourceTerm(token.text, token.at)
        if token.kind != "word" or token.text in JOINTS:
            raise _unexpected(token, "the name of a source is expected")
        if self._look().text != "(" or self._look().kind != "sign":
            if token.text in CALLS:
                raise _unexpected(self._look(), f"'(' is expected after {token.text}")
            return SourceTerm(token.text, token.at)
        if token.text not in CALLS:
            raise FormulaError(
                f"there is no {token.text!r} that measures could be put into",
                token.at,
                f"There are {', '.join(CALLS)}.",
            )
        return self._call(token, depth)

    def _call(self, token: _Lexeme, depth: int) -> Expression:
        self._expect("(")
        if depth == DEEPEST:
            raise FormulaError(
                f"brackets stand in each other more than {DEEPEST} deep",
                token.at,
                "Write it with fewer brackets.",
            )
        found: Expression
        if token.text == "age":
            source = self._source()
            found = AgeTerm(source.name, source.at)
        elif token.text == "distance":
            first = self._source()
            self._expect(",")
            found = DistanceTerm(first, self._source())
        elif token.text == "abs":
            found = AbsTerm(self._sum(None, depth + 1))
        else:
            parts = [self._sum(None, depth + 1)]
            while self._takes(",", "sign"):
                parts.append(self._sum(None, depth + 1))
            found = ExtremeTerm(tuple(parts), token.text == "max")
        self._expect(")")
        return found

    def _source(self) -> SourceTerm:
        token = self._take()
        if token.kind != "quoted" and (token.kind != "word" or token.text in KEYWORDS):
            raise _unexpected(token, "the name of a source is expected")
        return SourceTerm(token.text, token.at)

    def _number_and_unit(self) -> tuple[_Lexeme, Unit]:
        sign = self._look()
        minus = sign.text == "-" and sign.kind == "sign"
        if minus:
            self._take()
        number = self._take()
        if number.kind != "number":
            raise _unexpected(number, "a number is expected")
        if not 0 <= float(number.text) <= MOST:
            raise FormulaError(f"{number.text} is too large", number.at, _FORM)
        if minus:
            number = number._replace(text=f"-{number.text}")
        match = _UNIT.match(self._text, self._at)
        if match is None or match["unit"] in JOINTS:
            return number, NUMBER
        try:
            unit = read_unit(match["unit"])
        except FormulaError as error:
            words = error.sentence.partition(": ")[2]
            raise FormulaError(words, match.start("unit"), error.advice) from None
        self._at = match.end()
        return number, unit

    def _look(self) -> _Lexeme:
        text, at = self._text, self._at
        match = _TOKEN.match(text, at)
        if match is not None:
            kind = match.lastgroup or ""
            part = match[kind]
            if kind == "quoted":
                return _Lexeme(kind, part.replace("''", "'"), match.start(kind) - 1, match.end())
            return _Lexeme(kind, part, match.start(kind), match.end())
        end = len(text.rstrip())
        if at >= end:
            return _Lexeme("end", "", end, len(text))
        while text[at].isspace():
            at += 1
        if text[at] == "'":
            raise FormulaError("' is not closed", at, "Write ' at its end too.")
        raise FormulaError(f"{text[at]!r} can be no part of a predicate", at, _FORM)

    def _take(self) -> _Lexeme:
        token = self._look()
        self._at = token.end
        return token

    def _takes(self, text: str, kind: str = "word") -> bool:
        """Take the next token if it is this word or sign."""
        token = self._look()
        if token.kind != kind or token.text != text:
            return False
        self._at = token.end
        return True

    def _expect(self, sign: str) -> None:
        token = self._take()
        if token.kind != "sign" or token.text != sign:
            raise _unexpected(token, f"{sign!r} is expected")


def _unexpected(token: _Lexeme, wanted: str) -> FormulaError:
    shown = token.text if len(token.text) <= _SHOWN else f"{token.text[:_SHOWN]}..."
    found = "the text ends" if token.kind == "end" else f"{shown!r} stands"
    return FormulaError(f"{wanted}, but {found} there", token.at, _FORM)
