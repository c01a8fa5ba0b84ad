"""The File menu."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.feature import AllWindows, Shell
from smsl_studio.studio.document.files.files import Files
from smsl_studio.studio.document.session import Session


def file_actions(
    files: Files,
    session: Session,
    windows: AllWindows,
    shell: Shell,
    close: Callable[[], object],
) -> tuple[Action, ...]:
    """The rows of the File menu. ``close`` closes this window."""

    def open_home() -> None:
        """Open the file that holds the SB that is shown."""
        files.open(Path(session.blueprint.home(session.branch).file))

    return (
        Action("new", "New blueprint", files.new, "File", "file", ("Ctrl+N",),
               tip="An empty blueprint with one State Branch"),
        Action("new_window", "New window", shell.new_window, "File", "", ("Ctrl+Alt+N",),
               tip="Another window, for another blueprint; what is copied can be pasted there"),
        Action("open", "Open…", files.open, "File", "folder", ("Ctrl+O",)),
        Action("open_home", "Open the file of this State Branch", open_home, "File", "",
               enabled=lambda: session.branch in session.blueprint.imported,
               tip="Open the imported file in which the State Branch that is shown is written"),
        Action("save", "Save", files.save, "File", "save", ("Ctrl+S",),
               lambda: files.is_open, section=1),
        Action("save_as", "Save as…", files.save_as, "File", "", ("Ctrl+Shift+S",),
               lambda: files.is_open, section=1),
        Action("close", "Close window", close, "File", "", ("Ctrl+W",), section=2,
               tip="Close this window; it asks first if work could be lost"),
        Action("quit", "Quit", windows.quit, "File", "", ("Ctrl+Q",), section=2),
    )  # fmt: skip
