"""The File menu."""

from __future__ import annotations

from smsl_studio.studio.actions import Action
from smsl_studio.studio.files import Files
from smsl_studio.studio.windows import Windows


def file_actions(files: Files, windows: Windows) -> tuple[Action, ...]:
    return (
        Action("new", "New blueprint", files.new, "File", "file", ("Ctrl+N",),
               tip="An empty blueprint with one State Branch"),
        Action("open", "Open…", files.open, "File", "folder", ("Ctrl+O",)),
        Action("save", "Save", files.save, "File", "save", ("Ctrl+S",), section=1),
        Action("save_as", "Save as…", files.save_as, "File", "", ("Ctrl+Shift+S",), section=1),
        Action("quit", "Quit", windows.quit, "File", "", ("Ctrl+Q",), section=2),
    )  # fmt: skip
