"""The whole story of a recorded run, and the part of it that was over at a moment."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from itertools import chain

from smsl_studio.blueprint.address import Address
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.picture.account_words import Causes
from smsl_studio.runlog.events import Committed
from smsl_studio.runlog.playback import Playback
from smsl_studio.runlog.retold import Retold
from smsl_studio.studio.features.replay.marks import marks_of
from smsl_studio.studio.running.story import Span, Story


class WholeStory:
    """All spans, trails and marks of a run, told once; ``until`` says what was at a moment.

    Who goes round and round leaves one trail, so that any moment of a long run is as near.
    """

    def __init__(self, retelling: Playback) -> None:
        self.story = Story()
        self.story.tell(retelling.events)
        self.marks = tuple(marks_of(retelling.events))
        causes = Causes(COMMANDS)
        self.causes = tuple(causes.of(event) for event in retelling.events)
        """Whose command each event answers."""
        self._close(retelling.end)
        self._visits = {name: _first(lane) for name, lane in self.story.states.items()}
        self._starts = {
            name: [span.start for span in lane] for name, lane in self.story.states.items()
        }
        self._trail: dict[str, dict[Address, int]] = {}
        for index, event in enumerate(retelling.events, 1):
            for text in event.operations if isinstance(event, Committed) else ():
                address = Address.read(text)
                if address is None:
                    continue
                self._trail.setdefault(address.branch, {}).setdefault(address, index)

    def until(self, told: Retold) -> Story:
        """What the story was then: which states were visited, the trail, what was shut out."""
        story = Story(time=told.time, finished=told.finished)
        story.risky, story.pruned = dict(told.risky), dict(told.pruned)
        for name, lane in self.story.states.items():
            visited = [span for span in self._visits[name] if span.start <= told.time]
            now = bisect_right(self._starts[name], told.time)
            story.states[name] = [*visited, *lane[now - 1 : now]] if now else []
        for branch, trail in self._trail.items():
            story.trail[branch] = [edge for edge, index in trail.items() if index <= told.index]
        return story

    def _close(self, end: float) -> None:
        """What still held when the run ended is shown until then."""
        last = (lane[-1:] for lane in (*self.story.states.values(), *self.story.facts.values()))
        for span in chain(self.story.operations, *last):
            if span.end is None:
                span.end = end


def _first(lane: Iterable[Span]) -> list[Span]:
    """The first time of each state."""
    found: dict[str, Span] = {}
    for span in lane:
        found.setdefault(span.words, span)
    return list(found.values())
