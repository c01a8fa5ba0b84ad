"""What may stand at a place of a predicate that is being typed."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from smsl_studio.blueprint.predicates.predicate_text import CALLS, read_predicate, written_source
from smsl_studio.blueprint.predicates.units import SECOND, Unit, read_unit, symbols
from smsl_studio.blueprint.properties.completion import Offers, fitting
from smsl_studio.errors import FormulaError

LOOKED_AT = 400
"""The number of characters before the caret that decide about the offers."""
SIGNS = ("<", ">", "<=", ">=")
_NUMBER = r"-?(?:\d+(?:\.\d*)?|\.\d+)"
_UNIT = re.compile(
    rf"(?P<before>[^<>]*)(?P<sign>[<>]=?|\bfor)\s*{_NUMBER}\s+(?P<typed>[^\s(),<>+'\d]*)$"
)
_SOURCE = re.compile(
    r"""(?:^|[(,+]|\s-|\b(?:and|or|not)\s)\s*(?P<typed>'(?:[^']|'')*|[^\W\d][\w.]*|)$"""
)
_JOINT = re.compile(r"""[\s)'](?P<typed>[a-z]*|[<>]=?)$""")
_LAST = re.compile(r"""(?:'(?P<quoted>(?:[^']|'')*)'|(?P<word>[^\W\d][\w.]*))[\s)]*$""")


def predicate_offers(text: str, caret: int, sources: Mapping[str, str]) -> Offers:
    """Return what may be typed at a caret: sources, signs, units that fit, and words.

    ``sources`` are those of the fact, by name, each with its unit.
    """
    left = max(caret - LOOKED_AT, 0)
    before = text[left:caret]
    match = _UNIT.search(before)
    if match is not None:
        units = tuple(_units(match, sources))
        if "1" not in units[:1]:
            return fitting(left, match, units)
    match = _SOURCE.search(before)
    if match is not None:
        return fitting(left, match, _subjects(sources))
    match = _JOINT.search(before)
    if match is None:
        return Offers(caret, ())
    whole = _is_whole(text[: left + match.start("typed")])
    return fitting(left, match, ("and", "or", "for") if whole else SIGNS)


def unit_offers(text: str, caret: int) -> Offers:
    """Return the units that begin with what was typed, the usual ones first."""
    typed = text[:caret]
    found = tuple(one for one in symbols() if one.startswith(typed))
    return Offers(0, () if text in found else found, more=False)


def _subjects(sources: Mapping[str, str]) -> Iterator[str]:
    yield from map(written_source, sources)
    yield "not"
    yield from (f"{word}(" for word in CALLS)


def _units(match: re.Match[str], sources: Mapping[str, str]) -> Iterator[str]:
    """Yield the unit of what stands before the sign, then others of its kind."""
    if match["sign"] == "for":
        yield from ("s", "ms", "min")
        return
    unit = _unit_before(match["before"], sources)
    if unit is None:
        yield from symbols()
        return
    yield unit.text
    yield from (one for one in symbols() if one != unit.text and read_unit(one).fits(unit))


def _unit_before(text: str, sources: Mapping[str, str]) -> Unit | None:
    """Return the unit of the last source in a text, and of an age; None if there is none."""
    found = _LAST.search(text)
    if found is None:
        return None
    name = found["word"] or (found["quoted"] or "").replace("''", "'")
    if text[: found.start()].endswith("age("):
        return SECOND
    try:
        return read_unit(sources[name])
    except (KeyError, FormulaError):
        return None


def _is_whole(text: str) -> bool:
    """Return whether a text ends with a whole comparison."""
    text = text.rstrip()
    try:
        read_predicate(text + ")" * (text.count("(") - text.count(")")))
    except FormulaError:
        return False
    return True
