"""The questions of a dispatcher, checked. ChannelError if one is not valid."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from smsl_studio.channel.fields import (
    LONGEST_NAME,
    flag_of,
    number_of,
    objects_of,
    one_of,
    shown,
    text_of,
    words_of,
)
from smsl_studio.channel.frames import LARGEST, ChannelError, Frame

MOST_BRANCHES, MOST_FILES, MOST_PARAMETERS = 10_000, 1000, 100
_MOST_SEED = 10**100
_FORMS = ("json", "smsl", "yaml")


@dataclass(frozen=True)
class WrittenFile:
    """A file of a blueprint, as its text. ``form`` is json, smsl or yaml."""

    name: str
    form: str
    text: str


@dataclass(frozen=True)
class OpenQuestion:
    """What to open: the start (SB -> state), the seed, and the blueprint, its own file first.

    ``behaviour`` is the behaviour digest of the blueprint, empty if it is not said.
    """

    start: Mapping[str, str]
    seed: int
    files: tuple[WrittenFile, ...]
    behaviour: str


def read_open(frame: Frame) -> OpenQuestion:
    """Return the question ``open``."""
    seed = frame.get("seed", 0)
    if type(seed) is not int or not 0 <= seed < _MOST_SEED:
        raise ChannelError(f"seed is {shown(seed)}, not a whole number from 0 up")
    files = tuple(
        WrittenFile(
            text_of(one, "file"), one_of(one, "form", _FORMS), text_of(one, "text", LARGEST)
        )
        for one in objects_of(frame, "blueprint", MOST_FILES)
    )
    start = words_of(frame, "start", MOST_BRANCHES)
    return OpenQuestion(start, seed, files, text_of(frame, "behaviour", LONGEST_NAME, ""))


def read_parameters(frame: Frame) -> dict[str, float | str]:
    """Return the parameters of a fault: numbers and texts by their names."""
    value = frame.get("parameters", {})
    if not isinstance(value, dict) or len(value) > MOST_PARAMETERS:
        raise ChannelError(f"parameters is {shown(value)}, not an object")
    return {text_of({"name": name}, "name"): _parameter(one) for name, one in value.items()}


def _parameter(value: object) -> float | str:
    if isinstance(value, str):
        return text_of({"parameter": value}, "parameter")
    if isinstance(value, bool):
        return flag_of({"parameter": value}, "parameter", False)
    number = number_of({"parameter": value}, "parameter", -1e12, 1e12, None)
    return value if type(value) is int else number
