"""Replay as a feature: a mode that is offered while a recording is open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.front.recording_file import is_recording
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Page, Shell
from smsl_studio.studio.base.late_part import LatePart
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.replay.actions import replay_actions
from smsl_studio.studio.running.window_parts import WindowParts

if TYPE_CHECKING:
    from smsl_studio.studio.features.replay.playback import ReplayVerbs


class ReplayFeature(Feature):
    """Replay mode. Closing the recording leads back to Run mode.

    ``untouched`` says whether nothing was drawn, so that a recording may also open its blueprint.
    The parts are made when the first recording is opened.
    """

    def __init__(self, parts: WindowParts, shell: Shell, untouched: Callable[[], bool]) -> None:
        self._parts, self._shell, self._untouched = parts, shell, untouched
        self._tokens = parts.tokens
        self._wanted: Path | None = None
        """A recording that is being read and whose blueprint shall be opened too."""
        self.part = LatePart(self._make)
        self.pages = {"replay": self._page}
        self.submenus = {"open_recording": ("Recordings", lambda menu: self.verbs.fill(menu))}

    @property
    def verbs(self) -> ReplayVerbs:
        """The object that opens and shows recordings."""
        return self.part()

    def _page(self) -> Page:
        transport = self.verbs.transport
        return Page(self.verbs.pane, transport.scrubber, transport)

    def _make(self) -> ReplayVerbs:
        from smsl_studio.studio.features.replay.playback import ReplayVerbs

        parts, session = self._parts, self._parts.session
        verbs = ReplayVerbs(
            lambda: session.blueprint, parts.settings.recordings, self._tokens, parts.window
        )
        verbs.opened.connect(self._enter)
        verbs.closed.connect(self._leave)
        verbs.refused.connect(parts.toast.refuse)
        return verbs

    @property
    def is_open(self) -> bool:
        """Whether a recording is open."""
        return self.part.made is not None and self.part.made.is_open

    @property
    def file(self) -> str:
        """The name of the open recording; empty for none."""
        recording = self.part.made.replay.recording if self.part.made is not None else None
        return recording.path.name if recording is not None else ""

    def actions(self) -> tuple[Action, ...]:
        """The rows about recorded runs."""
        return replay_actions(self, self._shell.program, self._shell)

    def open(self) -> None:
        """Ask for a recording and show it."""
        self.verbs.open()

    def turn(self) -> None:
        """Pause if it plays, else play."""
        self.verbs.replay.turn()

    def pause(self) -> None:
        """Pause at the present moment."""
        self.verbs.replay.pause()

    def step(self, events: int = 1) -> None:
        """Go so many events forward, or back if negative."""
        self.verbs.replay.step(events)

    def open_path(self, path: Path) -> bool:
        """Show a recorded run, and also its blueprint if nothing was drawn.

        False for other files.
        """
        if not is_recording(path):
            return False
        self._wanted = path if self._untouched() else None
        self.verbs.open(path)
        return True

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """End all work, because the window closes."""
        if self.part.made is not None:
            self.part.made.stop()

    def _enter(self) -> None:
        self._shell.show_segment("mode_replay", True)
        self._shell.set_mode("replay")
        recording, wanted = self.verbs.replay.recording, self._wanted
        self._wanted = None
        if recording is None or recording.path != wanted or not self._untouched():
            return
        if Path(recording.blueprint.file).is_file():
            self._parts.files.open(Path(recording.blueprint.file))

    def _leave(self) -> None:
        self._shell.show_segment("mode_replay", False)
        self._shell.set_mode("run" if self._shell.mode == "replay" else self._shell.mode)
