"""The fields of a message, each with its kind. ChannelError says which field is wrong, and how."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite

from smsl_studio.channel.frames import ChannelError, Frame, Json
from smsl_studio.legible import one_line

LONGEST_NAME = 1000
LONGEST_SENTENCE = 2000
"""The largest length of names and of sentences, in characters."""

LATEST = 1e12
"""The largest time, in seconds."""


def text_of(frame: Frame, name: str, most: int = LONGEST_NAME, usual: str | None = None) -> str:
    """Return a text that can be written in UTF-8. A field that is left out has its ``usual``
    value; without one it must be there."""
    value = frame.get(name, usual)
    if not isinstance(value, str) or len(value) > most or not is_writable(value):
        raise ChannelError(f"{name} is {shown(value)}, not a text of at most {most} characters")
    return value


def flag_of(frame: Frame, name: str, usual: bool) -> bool:
    """Return true or false."""
    value = frame.get(name, usual)
    if not isinstance(value, bool):
        raise ChannelError(f"{name} is {shown(value)}, not true or false")
    return value


def number_of(frame: Frame, name: str, least: float, most: float, usual: float | None) -> float:
    """Return a finite number from ``least`` to ``most``."""
    value = frame.get(name, usual)
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise ChannelError(f"{name} is {shown(value)}, not a number")
    if not least <= value <= most or not isfinite(value):
        raise ChannelError(f"{name} is {shown(value)}, not a number from {least:g} to {most:g}")
    return float(value)


def count_of(frame: Frame, name: str) -> int:
    """Return a whole number from 0 to 2^53 - 1, which every JSON reader reads exactly."""
    value = frame.get(name)
    if type(value) is not int or not 0 <= value < 2**53:
        raise ChannelError(f"{name} is {shown(value)}, not a count")
    return value


def one_of(frame: Frame, name: str, options: tuple[str, ...], usual: str | None = None) -> str:
    """Return one of several words."""
    value = frame.get(name, usual)
    if not isinstance(value, str) or value not in options:
        raise ChannelError(f"{name} is {shown(value)}, not one of {', '.join(options)}")
    return value


def list_of(frame: Frame, name: str, most: int) -> list[Json]:
    """Return a list of at most ``most`` values, empty if it is left out."""
    value = frame.get(name, [])
    if not isinstance(value, list) or len(value) > most:
        raise ChannelError(f"{name} is {shown(value)}, not a list of at most {most:,}")
    return value


def texts_of(frame: Frame, name: str, most: int) -> tuple[str, ...]:
    """Return a list of names."""
    return tuple(text_of({name: one}, name) for one in list_of(frame, name, most))


def objects_of(frame: Frame, name: str, most: int) -> list[Frame]:
    """Return a list of JSON objects."""
    found = list_of(frame, name, most)
    for one in found:
        if not isinstance(one, dict):
            raise ChannelError(f"{name} has {shown(one)}, not an object")
    return found


def words_of(frame: Frame, name: str, most: int) -> Mapping[str, str]:
    """Return an object whose values are texts."""
    value = frame.get(name, {})
    if not isinstance(value, dict) or len(value) > most:
        raise ChannelError(f"{name} is {shown(value)}, not an object of at most {most:,}")
    return {
        text_of({name: key}, name): text_of({name: one}, name, LONGEST_SENTENCE)
        for key, one in value.items()
    }


def is_writable(text: str) -> bool:
    """Whether UTF-8 can encode a text. JSON may hold half of a surrogate pair."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def shown(value: object) -> str:
    """Return a value from outside, short, for a sentence."""
    plain = value is None or isinstance(value, bool | float)
    small = isinstance(value, int) and value.bit_length() <= 64
    if plain or small:
        return repr(value)
    if isinstance(value, str):
        return repr(one_line(value[:40].encode("utf-8", "replace").decode("utf-8")))
    return f"a value of type {type(value).__name__}"
