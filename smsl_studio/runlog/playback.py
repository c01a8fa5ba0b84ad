"""A run from its events alone, while it goes on and when it is over.

``changes.take`` is one step of the fold. ``RunObserver`` hears a run that goes on, ``Playback`` has
a whole one, with snapshots in between so that any moment of a long run is near. No world, no
blueprint and no dispatcher is asked.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Sequence

from smsl_studio.runlog.changes import take
from smsl_studio.runlog.events import Event
from smsl_studio.runlog.fold import RunFold
from smsl_studio.runlog.history import RunHistory, Story
from smsl_studio.runlog.moment import RunMoment

EVERY = 64
"""Events between two snapshots, at least. A run that holds many values has them further apart, so
that all snapshots together are no larger than its log."""


class RunObserver:
    """A run that goes on; ``story`` is how it stands and what has been."""

    def __init__(self, by_hand: bool = False) -> None:
        self._history = RunHistory()
        self._fold = RunFold(by_hand=by_hand, history=self._history)
        self.story = Story(self._fold.moment(), self._history)

    def tell(self, events: Iterable[Event]) -> None:
        """Go on with what happened next."""
        for event in events:
            take(self._fold, event)
        self.story = Story(self._fold.moment(), self._history)


class Playback:
    """A whole run: ``at`` says how it stood after so many events, ``index_at`` after how many at
    a time. ``by_hand`` is how it began, which stands in the header of its log. ``history`` is
    written along. ``going`` hears meanwhile how many events are told, and may raise."""

    def __init__(
        self,
        events: Sequence[Event],
        by_hand: bool = False,
        going: Callable[[int], None] | None = None,
        history: RunHistory | None = None,
    ) -> None:
        self.events = tuple(events)
        self._times: list[float] = []
        self._snapshots = [RunMoment(by_hand=by_hand)]
        fold, due = RunFold(by_hand=by_hand, history=history), EVERY
        for event in self.events:
            take(fold, event)
            self._times.append(fold.time)
            if fold.index >= due:
                self._snapshots.append(fold.moment())
                due = fold.index + max(EVERY, fold.size)
                if going is not None:
                    going(fold.index)
        if history is not None:
            history.close(self.end)

    def __len__(self) -> int:
        return len(self.events)

    @property
    def end(self) -> float:
        """Simulated seconds of the whole run."""
        return self._times[-1] if self._times else 0.0

    def at(self, index: int) -> RunMoment:
        """How it stood after the first ``index`` events, held to 0 and their number."""
        index = min(max(index, 0), len(self.events))
        near = bisect_right(self._snapshots, index, key=lambda told: told.index) - 1
        told = self._snapshots[near]
        if told.index == index:
            return told
        fold = RunFold.of(told)
        for event in self.events[told.index : index]:
            take(fold, event)
        return fold.moment()

    def index_at(self, time: float) -> int:
        """How many events have happened until a time (simulated s), those at it included."""
        return bisect_right(self._times, time)

    def time_of(self, index: int) -> float:
        """When the event before ``index`` happened."""
        return self._times[min(index, len(self._times)) - 1] if index > 0 and self._times else 0.0
