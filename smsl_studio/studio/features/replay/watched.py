"""The target of the keys of a run: the replay in Replay mode, the campaign on its page, else the
run of the window.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from smsl_studio.studio.features.replay.actions import ReplayActions
from smsl_studio.studio.running.run_actions import RunActions


class Paged(Protocol):
    """A page of Run that takes the keys of a run while it is shown."""

    def play(self) -> None:
        """Go on."""

    def pause(self) -> None:
        """Pause."""


class Watched:
    """Passes actions on to the replay in Replay mode, else to the run. ``page`` returns the page of
    Run that takes the keys now, None for the run itself.
    """

    def __init__(
        self,
        run: RunActions,
        replay: ReplayActions,
        mode: Callable[[], str],
        page: Callable[[], Paged | None],
    ) -> None:
        self._run, self._replay, self._mode, self._page = run, replay, mode, page

    @property
    def _replays(self) -> bool:
        return self._mode() == "replay"

    def play(self) -> None:
        """Play or pause the replay; else continue the run."""
        if self._replays:
            self._replay.turn()
        elif (page := self._page()) is not None:
            page.play()
        else:
            self._run.play()

    def pause(self) -> None:
        """Pause the replay or the run."""
        if self._replays:
            self._replay.pause()
        elif (page := self._page()) is not None:
            page.pause()
        else:
            self._run.pause()

    def step(self) -> None:
        """Go to the next event of the replay; else carry out one operation of the run."""
        if self._replays:
            self._replay.step()
        else:
            self._run.step()

    def show_monitor(self) -> None:
        """Show the monitor page of the run, also in Replay mode."""
        self._run.show_monitor()
