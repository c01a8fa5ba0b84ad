"""An exploration of physics in a process of its own, for the window. The window never runs the code
of plugins.

The process gets one line with what is asked, and tells one line for each state that was tried, and
one for the end. It works on a copy of the start, so that what is drawn and not saved counts. The
window believes no line that does not fit.
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError, UsageError, WorldError
from smsl_studio.front.attempts import TriedState, Values
from smsl_studio.front.child_lines import told_lines
from smsl_studio.front.explored_part import tried_line, tried_of_line
from smsl_studio.front.inputs import read
from smsl_studio.front.physics import LIMIT, generate_explore
from smsl_studio.host.started_child import environment_of_child
from smsl_studio.stop import Stopped, heeding

Json = Any
Tried = Callable[[Values, TriedState], None]
LONGEST = 1 << 20
"""The largest size of a line (bytes)."""
PATIENCE = 5.0
"""How long (s) the process may take to end."""
CODE = "from smsl_studio.front.exploration_child import serve; serve()"


@dataclass(frozen=True, slots=True)
class ExplorationRequest:
    """What is explored. ``part`` is the file that keeps what was tried."""

    start: Blueprint
    world: str
    part: Path
    repeats: int = 1
    limit: int = LIMIT
    plugin_paths: Sequence[Path] = ()


class ExplorationChild:
    """The process of one exploration. WorldError if it dies, UsageError if it is refused."""

    def __init__(self, request: ExplorationRequest) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="smsl-explore-")
        start = Path(self._folder.name, Path(request.start.file).name or "start.json")
        start.write_bytes(request.start.document.encoded())
        told = {
            "start": str(start),
            "world": request.world,
            "part": str(request.part),
            "repeats": request.repeats,
            "limit": request.limit,
            "plugin_paths": [str(one) for one in request.plugin_paths],
        }
        self._child = subprocess.Popen(
            [sys.executable, "-P", "-c", f"import sys; sys.path[:] = {sys.path!r}; {CODE}"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment_of_child(),
            process_group=0,
        )
        assert self._child.stdin is not None
        try:
            self._child.stdin.write(json.dumps(told).encode() + b"\n")
            self._child.stdin.close()
        except OSError:
            raise _dead() from None

    def close(self) -> None:
        """End the process now. The states that were tried are kept."""
        self._child.terminate()
        try:
            self._child.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._child.kill()
            self._child.wait()
        if self._child.stdout is not None:
            self._child.stdout.close()
        self._folder.cleanup()

    def follow(self, tried: Tried) -> None:
        """Tell ``tried`` each state with its operations, until the exploration ends."""
        for told in self._lines():
            if "refused" in told:
                words, advice = str(told["refused"])[:1000], str(told.get("advice") or "")[:1000]
                raise UsageError(words, advice=advice)
            if "end" in told:
                return
            row = tried_of_line(told)
            if row is None:
                raise _dead()
            tried(*row)
        raise _dead()

    def _lines(self) -> Iterator[dict[str, Json]]:
        pipe = self._child.stdout
        assert pipe is not None
        return told_lines(pipe, LONGEST, _dead)


def _dead() -> WorldError:
    return WorldError(
        "the process of the exploration has died",
        advice="Begin again: it goes on from what was tried.",
    )


def serve() -> None:
    """Carry out what stands in the one line of the standard input."""
    ending = False

    def end(*_: object) -> None:
        """Note that the exploration shall end."""
        nonlocal ending
        ending = True

    def look() -> None:
        """Raise Stopped if the exploration shall end."""
        if ending:
            raise Stopped

    def tell(**told: Json) -> None:
        """Write one line."""
        sys.stdout.write(json.dumps(told) + "\n")
        sys.stdout.flush()

    signal.signal(signal.SIGTERM, end)
    signal.signal(signal.SIGINT, end)
    asked = json.loads(sys.stdin.buffer.readline())
    try:
        with heeding(look):
            found = generate_explore(
                read(Path(asked["start"])),
                asked["world"],
                repeats=asked["repeats"],
                limit=asked["limit"],
                plugin_paths=[Path(one) for one in asked["plugin_paths"]],
                part=Path(asked["part"]),
                tried=lambda values, tried: tell(**tried_line(values, tried)),
            )
        tell(end={"bound": found.bound})
    except Stopped:
        return
    except StudioError as error:
        place = f"{error.place}: " if error.place is not None else ""
        tell(refused=f"{place}{error.sentence}", advice=error.advice)
