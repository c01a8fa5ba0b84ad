"""Reading the blueprint a command is asked about; ``-`` is standard input."""

from __future__ import annotations

import sys

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.reading import read, read_bytes

STDIN = "<stdin>"


def read_argument(file: str) -> Blueprint:
    """The blueprint in a file, or on standard input."""
    if file != "-":
        return read(file)
    stream = getattr(sys.stdin, "buffer", None)
    return read_bytes(stream.read() if stream else sys.stdin.read().encode(), STDIN)
