"""A recorded run in short: few lanes, and its events in words, beside what it is about."""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.recordings import Recording
from smsl_studio.front.views.event_marks import kind_of
from smsl_studio.front.views.timeline_lanes import Lane
from smsl_studio.picture.account_words import told
from smsl_studio.runlog import events as run
from smsl_studio.runlog.names import HeaderNames, names_of

QUIET = (run.Measured, run.RiskEstimated)
MOST = 500
"""The largest number of lines."""


@dataclass(frozen=True, slots=True)
class StoryLine:
    """An event: its simulated time (s), the kind of its mark (see ``event_marks``), its words, and
    its line in the log."""

    time: float
    kind: str
    words: str
    line: str


def story_lines(recording: Recording) -> tuple[StoryLine, ...]:
    """Return the events of a run in words, at most ``MOST``. Of a longer run the last ones."""
    names = HeaderNames.of_header(names_of(recording.blueprint))
    wanted = [one for one in recording.run.events if not _is_quiet(one)][-MOST:]
    return tuple(
        StoryLine(one.t, kind_of(one), told(one, COMMANDS, names=names).what, one.line())
        for one in wanted
    )


def _is_quiet(event: run.Event) -> bool:
    """Whether an event tells numbers alone, or what the facts are before anything has happened."""
    return isinstance(event, QUIET) or (isinstance(event, run.FactChanged) and event.t == 0.0)


def few_lanes(recording: Recording, facts: int) -> tuple[Lane, ...]:
    """Return the lanes of a run without those of facts that never changed. Of the rest at most
    ``facts`` are lanes of facts: those that changed most often."""
    moved = [one for one in recording.lanes if one.kind == "fact" and len(one.blocks) > 1]
    kept = sorted(moved, key=lambda one: -len(one.blocks))[:facts]
    return tuple(one for one in recording.lanes if one.kind != "fact" or one in kept)
