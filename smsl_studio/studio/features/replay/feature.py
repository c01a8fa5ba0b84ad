"""Replay as one feature: a mode while a recording is open."""

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
    """Replay is a mode while a recording is open; letting go of it leads back to Run.

    ``untouched`` says whether nothing is drawn, so that a recording may bring its blueprint. What
    shows recordings is made when the first one is opened.
    """

    def __init__(self, parts: WindowParts, shell: Shell, untouched: Callable[[], bool]) -> None:
        self._parts, self._shell, self._untouched = parts, shell, untouched
        self._tokens = parts.tokens
        self._wanted: Path | None = None
        """A recording that is being read, whose blueprint shall be drawn too."""
        self.part = LatePart(self._make)
        self.pages = {"replay": self._page}
        self.submenus = {"open_recording": ("Recordings", lambda menu: self.verbs.fill(menu))}

    @property
    def verbs(self) -> ReplayVerbs:
        """What opens and shows recordings."""
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
        """The name of the recording that is open; the empty text for none."""
        recording = self.part.made.replay.recording if self.part.made is not None else None
        return recording.path.name if recording is not None else ""

    def actions(self) -> tuple[Action, ...]:
        """What concerns recorded runs."""
        return replay_actions(self, self._shell.program, self._shell)

    def open(self) -> None:
        """Ask for a recording and show it."""
        self.verbs.open()

    def turn(self) -> None:
        """Play where it rests, rest where it plays."""
        self.verbs.replay.turn()

    def pause(self) -> None:
        """Stay at this moment."""
        self.verbs.replay.pause()

    def step(self, events: int = 1) -> None:
        """So many events on, or back."""
        self.verbs.replay.step(events)

    def open_path(self, path: Path) -> bool:
        """Show a recorded run, and its blueprint too where nothing is drawn."""
        if not is_recording(path):
            return False
        self._wanted = path if self._untouched() else None
        self.verbs.open(path)
        return True

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self._tokens = tokens
        if self.part.made is not None:
            self.part.made.set_tokens(tokens)

    def stop(self) -> None:
        """Nobody waits for a recording any more."""
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
