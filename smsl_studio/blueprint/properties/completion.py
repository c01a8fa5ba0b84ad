"""What may stand at a place of a formula that is being typed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import NamedTuple

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.properties.formula import FactTerm
from smsl_studio.blueprint.properties.formula_text import read_formula, written_name, written_plain
from smsl_studio.blueprint.properties.meaning import fact_of, values_of
from smsl_studio.errors import FormulaError

MOST, LOOKED_AT, LOOKED_THROUGH = 200, 400, 4096
"""The largest number of offers, of characters before the caret that decide about them, and of names
that are looked through."""
_NAME = r"""(?:'(?:[^']|'')*'|[^\s()='"!/]+)"""
_FACT = rf"""(?:{_NAME}/)?(?:"(?:[^"]|"")*"|{_NAME})"""
_TYPED = r"""(?P<typed>'(?:[^']|'')*|[^\s()='"!]*)"""
_VALUE = re.compile(rf"(?P<fact>{_FACT})\s*!?=\s*{_TYPED}$")
_STATE = re.compile(rf"(?P<branch>{_NAME})\s+in\s+{_TYPED}$")
_SUBJECT = re.compile(
    r"""(?:^|[(]|\b(?:and|or|not)\s)\s*(?P<typed>(?:[^\s()='"!]*|'(?:[^']|'')*'?/)"""
    r"""(?:"[^"]*"?)?|'[^']*)$"""
)
_JOINT = re.compile(r"""(?:[\s)'"])(?P<typed>[a-z]*)$""")


class Offers(NamedTuple):
    """The texts that may replace what stands from ``start`` to the caret."""

    start: int
    texts: tuple[str, ...]
    more: bool = True
    """Whether something follows the text, so that a space stands behind it."""


def offers_at(text: str, caret: int, blueprint: Blueprint) -> Offers:
    """Return what may be typed at a caret: facts by name, values, states, SBs, and words."""
    left = max(caret - LOOKED_AT, 0)
    before = text[left:caret]
    for pattern, found in ((_VALUE, _values), (_STATE, _states)):
        match = pattern.search(before)
        if match is not None:
            return fitting(left, match, found(match, blueprint))
    match = _SUBJECT.search(before)
    if match is not None:
        return fitting(left, match, _subjects(blueprint))
    match = _JOINT.search(before)
    if match is None:
        return Offers(caret, ())
    words = ("and", "or") if _is_whole(text[: left + match.start("typed")]) else ("=", "!=", "in")
    return fitting(left, match, iter(words))


def _values(match: re.Match[str], blueprint: Blueprint) -> Iterator[str]:
    try:
        term = read_formula(f"{match['fact']} = 0")
    except FormulaError:
        return
    fact = fact_of(term, blueprint) if isinstance(term, FactTerm) else None
    if fact is not None:
        yield from map(written_name, values_of(blueprint[fact[0]], fact[1]))


def _states(match: re.Match[str], blueprint: Blueprint) -> Iterator[str]:
    name = match["branch"]
    if name.startswith("'"):
        name = name[1:-1].replace("''", "'")
    if name in blueprint.branches:
        yield from map(written_name, blueprint[name].table)


def _subjects(blueprint: Blueprint) -> Iterator[str]:
    """Yield facts, then SBs, then the words that a comparison may begin with."""
    for branch in blueprint:
        for digit in range(len(branch.alphabet)):
            note = branch.fact_note(digit)
            fact = written_plain(note.name) if note and note.name else str(digit)
            yield f"{written_name(branch.name)}/{fact}"
    for branch in blueprint:
        yield f"{written_name(branch.name)} in"
    yield from ("not", "(")


def _is_whole(text: str) -> bool:
    """Return whether a text ends with a whole comparison."""
    text = text.rstrip()
    try:
        read_formula(text + ")" * (text.count("(") - text.count(")")))
    except FormulaError:
        return False
    return True


def fitting(left: int, match: re.Match[str], texts: Iterable[str]) -> Offers:
    """Return the texts that contain what is typed, which begins ``left`` and the match's ``typed``
    characters into the text. None if one of them is typed already."""
    start, typed = left + match.start("typed"), match["typed"]
    wanted, known = _plain(typed), tuple(islice(texts, LOOKED_THROUGH))
    if typed in known:
        return Offers(start, ())
    found = (text for text in known if wanted in _plain(text))
    return Offers(start, tuple(islice(found, MOST)))


def _plain(text: str) -> str:
    return re.sub(r"""['"]""", "", text).casefold()
