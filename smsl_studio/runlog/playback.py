"""A run that is known from its events alone, live or recorded.

``RunObserver`` is told the events of a live run. ``Playback`` has a whole run, with snapshots
between its events, so any moment of a long run is found quickly. No world, blueprint or dispatcher
is needed.
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
"""The least number of events between two snapshots. It is larger if the run has many values, so
that all snapshots together are no larger than its log.
"""


class RunObserver:
    """A live run. ``story`` is its state and its history."""

    def __init__(self, by_hand: bool = False) -> None:
        self._history = RunHistory()
        self._fold = RunFold(by_hand=by_hand, history=self._history)
        self.story = Story(self._fold.moment(), self._history)

    def tell(self, events: Iterable[Event]) -> None:
        """Go on with the next events."""
        for event in events:
            take(self._fold, event)
        self.story = Story(self._fold.moment(), self._history)


class Playback:
    """A whole run. ``at`` gives its state after a number of events, ``index_at`` the number at a
    time.

    ``by_hand`` is the mode at the beginning, from the header of the log. ``history`` is filled if
    it is given. ``going`` is called with the number of events that were read so far, and may raise.
    """

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
        """The simulated seconds of the whole run."""
        return self._times[-1] if self._times else 0.0

    def at(self, index: int) -> RunMoment:
        """Return the state after the first ``index`` events. An index out of range counts as the
        nearest one.
        """
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
        """Return the number of events until a time (simulated s), with those at this time."""
        return bisect_right(self._times, time)

    def time_of(self, index: int) -> float:
        """Return the simulated time of the last of the first ``index`` events, 0 for none."""
        return self._times[min(index, len(self._times)) - 1] if index > 0 and self._times else 0.0
