"""Checks the names, times and truth values that a plugin registers.

Library code may pass any object. These functions return a plain text, float or truth value.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping

from smsl_studio.blueprint.predicates import read_unit
from smsl_studio.errors import FormulaError, PluginError
from smsl_studio.legible import DIRECTIONS

LONGEST = 300
"""The largest length of a name, in characters."""


def unfit_name(value: object, most: int = LONGEST) -> str:
    """Say why a value cannot be shown as a name. The text is empty for a proper name.

    A name is a text without control characters, surrogates, line breaks, and characters that
    change the direction of writing.
    """
    if type(value) is not str:
        return f"is a value of type {type(value).__name__[:60]!r}, not a text"
    if not value:
        return "is empty"
    if len(value) > most:
        return f"has {len(value)} characters, more than {most}"
    if value.isascii() and value.isprintable():
        return ""
    for character in value:
        if unicodedata.category(character) in ("Cc", "Cs", "Zl", "Zp") or character in DIRECTIONS:
            return f"has the character U+{ord(character):04X}, which no name may have"
    return ""


def proper_name(value: object, what: str) -> str:
    """Return the name. PluginError if the value is no proper name. ``what`` is its subject."""
    wrong = unfit_name(value)
    if wrong:
        raise PluginError(f"the name of {what} {wrong}")
    return str(value)


def seconds(value: object, what: str, zero: bool = False) -> float:
    """Return a time in seconds, above 0 or infinite. ``zero`` allows 0, too. PluginError for any
    other value."""
    if isinstance(value, (int, float)) and type(value) is not bool:
        try:
            time = float(value)
        except OverflowError:
            time = 0.0
        if time > 0 or (zero and time == 0):
            return time
        shown = repr(time)
    else:
        shown = f"of type {type(value).__name__!r}"
    least = "of at least" if zero else "above"
    raise PluginError(f"{what} is {shown}, not a time {least} 0 s")


def truth(value: object, what: str) -> bool:
    """Return True or False. PluginError for any other value."""
    if type(value) is not bool:
        raise PluginError(f"{what} is of type {type(value).__name__!r}, not True or False")
    return value


def words_of_values(words: Mapping[str, str]) -> dict[str, str]:
    """Return the words that explain values to people. PluginError if they are no texts."""
    found = dict(words)
    for value, word in found.items():
        if type(value) is not str or type(word) is not str:
            raise PluginError("words does not map texts to texts")
    return found


def conditions_of(predicate: object) -> dict[str, str]:
    """Return the condition of each value. PluginError if they are no texts, or none."""
    if not isinstance(predicate, Mapping) or not predicate:
        raise PluginError('predicate is no map, such as {"0": "force < 1 N"}')
    found = {proper_name(value, "a value"): text for value, text in predicate.items()}
    for value, text in found.items():
        if type(text) is not str:
            raise PluginError(f"the predicate of {value} is no text")
    return found


def unit_of_measure(value: object, fact: str) -> str:
    """Return the unit of a sensor that measures, empty for any other. PluginError if it is no unit,
    or if the sensor also names a ``fact``, whose values are no numbers.
    """
    if type(value) is not str:
        raise PluginError(f"unit is a value of type {type(value).__name__[:60]!r}, not a text")
    if not value:
        return ""
    try:
        read_unit(value)
    except FormulaError as error:
        raise PluginError(error.sentence, advice=error.advice) from None
    if fact:
        raise PluginError(
            f"a sensor in {value} cannot tell {fact!r} by itself",
            advice="Leave fact out, and let predicates of the blueprint decide.",
        )
    return value
