"""What the keys of a run reach: the run of the window, or the replay while that is shown."""

from __future__ import annotations

from collections.abc import Callable

from smsl_studio.studio.features.replay.actions import ReplayActions
from smsl_studio.studio.running.run_actions import RunActions


class Watched:
    """A transport: it asks of the replay what is asked while Replay mode is shown."""

    def __init__(self, run: RunActions, replay: ReplayActions, mode: Callable[[], str]) -> None:
        self._run, self._replay, self._mode = run, replay, mode

    @property
    def _replays(self) -> bool:
        return self._mode() == "replay"

    def play(self) -> None:
        """Play or pause the replay; else let the run go on."""
        if self._replays:
            self._replay.turn()
        else:
            self._run.play()

    def pause(self) -> None:
        """Pause the replay or the run."""
        if self._replays:
            self._replay.pause()
        else:
            self._run.pause()

    def step(self) -> None:
        """Go to the next step of the replay; else do one operation of the run."""
        if self._replays:
            self._replay.step()
        else:
            self._run.step()

    def show_monitor(self) -> None:
        """Show the monitor page of the run, in Replay mode too."""
        self._run.show_monitor()
