"""Which file a window shows: a blueprint, or a recorded run in Replay mode."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.studio.base.feature import Shell
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.features.draw.safety.safety import Safety
from smsl_studio.studio.features.replay.playback import ReplayVerbs
from smsl_studio.studio.features.replay.recorded_run import is_recording
from smsl_studio.studio.shell.frame.mode_bar import Segments


class ShownFile:
    """Replay is a mode while a recording is open; letting go of it leads back to Run."""

    def __init__(
        self,
        shell: Shell,
        files: Files,
        replaying: ReplayVerbs,
        safety: Safety,
        segments: Segments,
    ) -> None:
        self._shell, self._files = shell, files
        self._replaying, self._safety, self._segments = replaying, safety, segments
        self._wanted: Path | None = None
        """A recording that is being read, whose blueprint shall be drawn too."""
        replaying.opened.connect(self._enter)
        replaying.closed.connect(self._leave)

    def open(self, path: Path) -> None:
        """Show a blueprint or a recorded run; of that the blueprint too where nothing is drawn."""
        if not is_recording(path):
            self._files.open(path)
            return
        self._wanted = path if self._safety.untouched else None
        self._replaying.open(path)

    def _enter(self) -> None:
        self._segments.show_segment("mode_replay", True)
        self._shell.set_mode("replay")
        recording, wanted = self._replaying.replay.recording, self._wanted
        self._wanted = None
        if recording is None or recording.path != wanted or not self._safety.untouched:
            return
        if Path(recording.blueprint.file).is_file():
            self._files.open(Path(recording.blueprint.file))

    def _leave(self) -> None:
        self._segments.show_segment("mode_replay", False)
        self._shell.set_mode("run" if self._shell.mode == "replay" else self._shell.mode)
