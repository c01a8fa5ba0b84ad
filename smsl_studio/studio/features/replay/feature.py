"""Replay as one feature: a mode while a recording is open."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from smsl_studio.front.recordings import is_recording
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import Feature, Page, Shell
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.features.replay.actions import replay_actions
from smsl_studio.studio.features.replay.playback import ReplayVerbs
from smsl_studio.studio.running.window_parts import WindowParts


class ReplayFeature(Feature):
    """Replay is a mode while a recording is open; letting go of it leads back to Run.

    ``untouched`` says whether nothing is drawn, so that a recording may bring its blueprint.
    """

    def __init__(self, parts: WindowParts, shell: Shell, untouched: Callable[[], bool]) -> None:
        session, settings = parts.session, parts.settings
        self._shell, self._files, self._untouched = shell, parts.files, untouched
        self._wanted: Path | None = None
        """A recording that is being read, whose blueprint shall be drawn too."""
        self.verbs = ReplayVerbs(
            lambda: session.blueprint, settings.recordings, parts.tokens, parts.window
        )
        pane, transport = self.verbs.pane, self.verbs.transport
        self.pages = {"replay": Page(pane, transport.scrubber, transport)}
        self.submenus = {"open_recording": ("Recordings", self.verbs.fill)}
        self.verbs.opened.connect(self._enter)
        self.verbs.closed.connect(self._leave)
        self.verbs.refused.connect(parts.toast.refuse)

    @property
    def file(self) -> str:
        """The name of the recording that is open; the empty text for none."""
        recording = self.verbs.replay.recording
        return recording.path.name if recording is not None else ""

    def actions(self) -> tuple[Action, ...]:
        """What concerns recorded runs."""
        return replay_actions(self.verbs, self._shell.program, self._shell)

    def open_path(self, path: Path) -> bool:
        """Show a recorded run, and its blueprint too where nothing is drawn."""
        if not is_recording(path):
            return False
        self._wanted = path if self._untouched() else None
        self.verbs.open(path)
        return True

    def set_tokens(self, tokens: Tokens) -> None:
        """Take other colours."""
        self.verbs.set_tokens(tokens)

    def stop(self) -> None:
        """Nobody waits for a recording any more."""
        self.verbs.stop()

    def _enter(self) -> None:
        self._shell.show_segment("mode_replay", True)
        self._shell.set_mode("replay")
        recording, wanted = self.verbs.replay.recording, self._wanted
        self._wanted = None
        if recording is None or recording.path != wanted or not self._untouched():
            return
        if Path(recording.blueprint.file).is_file():
            self._files.open(Path(recording.blueprint.file))

    def _leave(self) -> None:
        self._shell.show_segment("mode_replay", False)
        self._shell.set_mode("run" if self._shell.mode == "replay" else self._shell.mode)
