"""The whole story of a recorded run, and the part of it that was over at a moment."""

from __future__ import annotations

from bisect import bisect_right

from smsl_studio.blueprint.address import Address
from smsl_studio.runlog.events import Committed
from smsl_studio.runlog.retelling import Retelling, Retold
from smsl_studio.studio.run.story import Span, Story


class WholeStory:
    """All spans and trails of a run, told once; ``until`` cuts them at a moment."""

    def __init__(self, retelling: Retelling) -> None:
        self.story = Story()
        self.story.tell(retelling.events)
        self._close(retelling.end)
        self._committed: dict[str, list[int]] = {}
        for index, event in enumerate(retelling.events, 1):
            if isinstance(event, Committed):
                for text in event.operations:
                    self._committed.setdefault(Address.split(text)[0], []).append(index)

    def until(self, told: Retold) -> Story:
        """What the story was then. Spans that went on have no end yet."""
        story = Story(time=told.time, finished=told.finished)
        story.states = {name: _until(lane, told.time) for name, lane in self.story.states.items()}
        story.risky, story.pruned = dict(told.risky), dict(told.pruned)
        for branch, trail in self.story.trail.items():
            count = bisect_right(self._committed.get(branch, []), told.index)
            # Who goes round and round leaves one trail.
            story.trail[branch] = list(dict.fromkeys(trail[:count]))
        return story

    def _close(self, end: float) -> None:
        """What still held when the run ended is shown until then."""
        lanes = (*self.story.states.values(), self.story.operations, *self.story.facts.values())
        for lane in lanes:
            if lane and lane[-1].end is None:
                lane[-1].end = end


def _until(lane: list[Span], time: float) -> list[Span]:
    return lane[: bisect_right(lane, time, key=lambda span: span.start)]
