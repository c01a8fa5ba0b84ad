"""Recognises recorded runs by the first bytes of a file."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.runlog.log import FORMAT
from smsl_studio.smsl.inputs import read_ordinary

_FIRST = f'{{"log":"{FORMAT}",'.encode("ascii")


def is_recording(path: Path) -> bool:
    """Return whether a file begins like a run log. False if it cannot be read."""
    try:
        return read_ordinary(path, len(_FIRST)).raw.startswith(_FIRST)
    except (OSError, ValueError):
        return False
