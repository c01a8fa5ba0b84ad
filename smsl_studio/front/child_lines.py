"""The lines that a process of ours tells, each a JSON object."""

from __future__ import annotations

import json
import os
import select
from collections.abc import Callable, Iterator
from typing import IO, Any

from smsl_studio.stop import heed

WAIT = 0.05
"""The interval (s) at which a waiting reader looks whether it shall stop."""
PIECE = 1 << 20
"""The most bytes that are read at once."""


def told_lines(
    pipe: IO[bytes], longest: int, dead: Callable[[], Exception]
) -> Iterator[dict[str, Any]]:
    """Yield what a process tells, until it tells no more or a line has over ``longest`` bytes.
    Raises what ``dead`` returns for a line that is no JSON object, and Stopped."""
    heard = b""
    while True:
        heed()
        if not select.select([pipe], [], [], WAIT)[0]:
            continue
        part = os.read(pipe.fileno(), PIECE)
        if not part or len(heard) > longest:
            return
        *whole, heard = (heard + part).split(b"\n")
        for line in whole:
            try:
                told = json.loads(line)
            except (ValueError, RecursionError):
                raise dead() from None
            if not isinstance(told, dict):
                raise dead()
            yield told
