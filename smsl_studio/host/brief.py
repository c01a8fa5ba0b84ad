"""Makes texts and numbers from library code short and valid. These functions never raise an error.

A value or an error from library code may have any size and type, and its ``__str__`` may raise.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

from smsl_studio.library.plugin_package import where

WORDS = 500
"""The largest length of a sentence from library code, in characters."""

VALUE = 1000
"""The largest length of a value that a sensor returns, in characters."""

FAR = 1e6
"""The distance from the origin beyond which nothing is drawn, in metres."""

LONGEST = 64
"""The size of the largest whole number that is shown, in bits."""


def brief(text: str, most: int = WORDS) -> str:
    """Cut the text after ``most`` characters, and replace characters that UTF-8 cannot encode."""
    cut = text if len(text) <= most else f"{text[:most]} ... ({len(text)} characters)"
    return cut.encode("utf-8", "replace").decode("utf-8")


def words_for(error: BaseException) -> str:
    """Write an error as ``ValueError: message``, even if its ``__str__`` raises."""
    try:
        said = str(error)
    except KeyboardInterrupt:
        raise
    except BaseException:
        said = "it cannot say what"
    return brief(f"{type(error).__name__}: {said}".removesuffix(": "))


def words_of(error: BaseException, location: str) -> str:
    """Describe an error and its place in the code. The words are the same on every machine."""
    return words_for(error) + (where(error, location) if location else "")


def invalid(value: object) -> str:
    """Say why the value that a sensor returned is no valid reading.

    The text is empty for a valid reading, and for None: the sensor itself says that it has no
    reading.
    """
    if value is None or (type(value) is str and value.isascii() and len(value) <= VALUE):
        return ""
    if type(value) is not str:
        plain = type(value) in (bool, float) or _is_small(value)
        shown = repr(value) if plain else f"a value of type {brief(type(value).__name__, 60)}"
        return f"it reads {shown}, which is no text"
    if len(value) > VALUE:
        return f"it reads a text of {len(value)} characters, more than {VALUE}"
    try:
        value.encode("utf-8")
    except UnicodeEncodeError:
        return "it reads a text that cannot be written"
    return ""


def _is_small(value: object) -> bool:
    return type(value) is int and value.bit_length() <= LONGEST


def finite(poses: tuple[float, ...], before: tuple[float, ...]) -> tuple[float, ...]:
    """Return the poses, or the poses ``before`` if a number is not finite or beyond ``FAR``."""
    return poses if all(-FAR < figure < FAR for figure in poses) else before


def short_words(status: Mapping[str, str]) -> dict[str, str]:
    """Return status texts for people: at most 20, with names of 60 and texts of 200 characters."""
    pairs = islice(status.items(), 20)
    return {brief(str(name), 60): brief(str(words), 200) for name, words in pairs}
