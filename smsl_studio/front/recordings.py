"""Opens a recorded run: its log, its state at any time, and the blueprint that was run."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.generated_edges import with_edges
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.status_then import status_at
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.errors import ReadError, StudioError
from smsl_studio.front.inputs import read
from smsl_studio.front.views.event_marks import marks_of
from smsl_studio.front.views.timeline_lanes import Lane, lanes
from smsl_studio.runlog.causes import Causes
from smsl_studio.runlog.events import EdgeGenerated, Event, RunStarted
from smsl_studio.runlog.grammar.log_reader import Going, LoggedRun, read_log
from smsl_studio.runlog.history import RECORDED, RunHistory, Story
from smsl_studio.runlog.playback import Playback
from smsl_studio.smsl.forms import SUFFIXES

SUFFIX = ".jsonl"
READ, FOLDED, TOLD = 0.5, 0.75, 0.95
"""The shares of the whole time after which the log is read, folded, and its causes are found."""
ANOTHER = "It was recorded with another version of this blueprint"
NO_BLUEPRINT = "Open the blueprint of this run first, then the recording again."


def _nobody(share: float) -> None:
    """Ignore the progress."""


@dataclass(frozen=True)
class Recording:
    """A log that was read. ``differs`` says that ``blueprint`` is not the version that was run.

    ``causes`` names who caused each event (see ``Causes``). ``marks`` has the simulated time (s)
    and the kind of each marked event.
    """

    path: Path
    run: LoggedRun
    playback: Playback
    blueprint: Blueprint
    differs: bool
    history: RunHistory
    causes: tuple[str, ...]
    marks: tuple[tuple[float, str], ...]
    lanes: tuple[Lane, ...]

    @property
    def doubt(self) -> str:
        """Why the log is not verified. Empty if it is."""
        return str(self.run.doubt.sentence) if self.run.doubt is not None else ""

    def asked(self, key: str) -> Any:
        """Return a value of the header, or None if the header does not have it."""
        return self.run.header.get(key)


def open_recording(path: Path, drawn: Blueprint, going: Going = _nobody) -> Recording:
    """Read a log and find its blueprint: ``drawn``, or the file in the header, or that file beside
    the log.

    ReadError if the file is not a log, or if no blueprint has the states in which the run began.
    ``going`` is called with the share that is done (0 to 1). It may raise an error to end the
    reading.
    """
    run = read_log(path, COMMANDS, lambda share: going(share * READ))
    started = next((event for event in run.events if isinstance(event, RunStarted)), None)
    behaviour = _behaviour(run, started)
    found = [one for one in _candidates(path, run, drawn) if _fits(one, started)]
    same = next((one for one in found if one.behaviour == behaviour), None)
    blueprint = same or next(iter(found), None)
    if blueprint is None:
        name = Path(str(run.header.get("file", ""))).name or "its blueprint"
        raise ReadError(f"{name}, of which this is a run, is not found", advice=NO_BLUEPRINT)
    blueprint = with_edges(blueprint, _generated(run.events))
    events, by_hand = run.events, run.header.get("by_hand") is True
    count, share = max(len(events), 1), FOLDED - READ
    history = RunHistory(RECORDED)
    playback = Playback(events, by_hand, lambda told: going(READ + share * told / count), history)
    causes = Causes(COMMANDS, playback.at(len(events)).asked)
    by = tuple(causes.of(event) for event in events)
    going(TOLD)
    # The status before the first event has no running operation, so the lanes show only the
    # history.
    before = playback.at(0)
    rows = lanes(blueprint, status_at(blueprint, before), Story(before, history))
    marks = tuple(marks_of(events))
    return Recording(path, run, playback, blueprint, same is None, history, by, marks, rows)


def recordings_in(folder: Path, most: int = 30) -> tuple[Path, ...]:
    """Return the newest recordings of a folder, newest first, at most ``most``."""
    dated = []
    for path in folder.glob(f"*{SUFFIX}"):
        with suppress(OSError):  # a link to nothing, or a file that was just deleted
            dated.append((path.stat().st_mtime, path))
    return tuple(path for _, path in sorted(dated, reverse=True)[:most])


def recording_words(path: Path) -> str:
    """Return the text of a recording in a menu: its name and its date."""
    made = datetime.fromtimestamp(path.stat().st_mtime)
    return f"{path.stem}  ({made:%d %b %H:%M})"


def _generated(events: Sequence[Event]) -> dict[Address, str]:
    """Return the edges that people have let count in this run, with their targets."""
    made = (one for one in events if isinstance(one, EdgeGenerated))
    found = ((Address.read(one.address), one.target) for one in made)
    return {edge: target for edge, target in found if edge is not None and edge.operation}


def _behaviour(run: LoggedRun, started: RunStarted | None) -> str:
    digests = run.header.get("digests")
    said = digests.get("behaviour") if isinstance(digests, dict) else None
    return started.behaviour if started is not None else str(said or "")


def _candidates(path: Path, run: LoggedRun, drawn: Blueprint) -> Iterable[Blueprint]:
    yield drawn
    said = run.header.get("file")
    if not isinstance(said, str) or not said:
        return
    for place in (Path(said), path.parent / Path(said).name):
        if place.suffix.lower() not in SUFFIXES:
            continue  # a log comes from outside and may name any file
        try:
            yield read(place)
        except StudioError:
            continue


def _fits(blueprint: Blueprint, started: RunStarted | None) -> bool:
    """Return whether a blueprint has the states in which the run began."""
    if started is None:
        return bool(blueprint.state_count)
    return all(
        name in blueprint.branches and state in blueprint[name].table
        for name, state in started.start.items()
    )
