"""Texts and numbers from library code, made short and valid without ever raising an error.

What library code returns or raises may be of any size and kind, and its own ``__str__`` may raise.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import islice

WORDS = 500
"""Characters of the longest sentence that is taken from library code."""

VALUE = 1000
"""Characters of the longest value a sensor may read."""

FAR = 1e6
"""Metres beyond which nothing is drawn."""

LONGEST = 64
"""Bits of the largest whole number that is shown."""


def brief(text: str, most: int = WORDS) -> str:
    """The text, cut where it is too long, without characters that no file can hold."""
    cut = text if len(text) <= most else f"{text[:most]} ... ({len(text)} characters)"
    return cut.encode("utf-8", "replace").decode("utf-8")


def words_for(error: BaseException) -> str:
    """``ValueError: what it says``, whatever its ``__str__`` does."""
    try:
        said = str(error)
    except KeyboardInterrupt:
        raise
    except BaseException:
        said = "it cannot say what"
    return brief(f"{type(error).__name__}: {said}".removesuffix(": "))


def invalid(value: object) -> str:
    """Why what a sensor returned is no reading, empty where it is one or says itself that not."""
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
    """The poses, or those before them where one is no number or out of the world."""
    return poses if all(-FAR < figure < FAR for figure in poses) else before


def short_words(status: Mapping[str, str]) -> dict[str, str]:
    """Short words for people: at most so many, and none too long."""
    pairs = islice(status.items(), 20)
    return {brief(str(name), 60): brief(str(words), 200) for name, words in pairs}
