"""The remembered settings: theme, places of the panels, recent files. They are one small file.

It is in the user's folder of the platform, or in SMSL_STUDIO_HOME.
"""

from __future__ import annotations

import json
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QByteArray, QSettings

from smsl_studio.home import user_folder

RECENT = 10
SIZES = (100, 125, 150, 175, 200)
"""The sizes of letters and everything else (per cent)."""
KEYS = "keys"
"""The name under which chosen keys are stored."""
THEMES = ("light", "dark", "contrast", "system")


class Settings:
    """The remembered settings, read and written by name."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or user_folder()
        self._store = QSettings(str(self.folder / "window.ini"), QSettings.Format.IniFormat)

    @property
    def theme(self) -> str:
        """``light``, ``dark``, ``contrast`` or ``system``."""
        value = str(self._store.value("theme", "system"))
        return value if value in THEMES else "system"

    @theme.setter
    def theme(self, name: str) -> None:
        """Remember the theme."""
        self._store.setValue("theme", name)

    @property
    def recent(self) -> tuple[Path, ...]:
        """The files opened or saved last, newest first."""
        value = self._store.value("recent", [])
        paths = value if isinstance(value, list) else [value]
        return tuple(Path(str(path)) for path in paths if path)

    @property
    def record_runs(self) -> bool:
        """Whether each run of the window is written to a log in ``recordings``."""
        return self._store.value("record_runs", "true") in ("true", True)

    @record_runs.setter
    def record_runs(self, on: bool) -> None:
        """Remember whether runs are recorded."""
        self._store.setValue("record_runs", "true" if on else "false")

    @property
    def size(self) -> int:
        """The size of letters and everything else, in per cent; one of ``SIZES``."""
        value = str(self._store.value("size", "100"))
        return int(value) if value in map(str, SIZES) else 100

    @size.setter
    def size(self, per_cent: int) -> None:
        """Remember the size; a window that is open keeps its own."""
        self._store.setValue("size", str(per_cent))

    @property
    def calm(self) -> bool:
        """Whether views jump instead of gliding."""
        return self.text_of("calm") == "true"

    @calm.setter
    def calm(self, on: bool) -> None:
        """Remember whether views jump."""
        self.store_text("calm", "true" if on else "")

    @property
    def wheel_scrolls(self) -> bool:
        """Whether a mouse wheel scrolls a drawing; otherwise it zooms."""
        return self.text_of("wheel_scrolls") == "true"

    @wheel_scrolls.setter
    def wheel_scrolls(self, on: bool) -> None:
        """Remember what a mouse wheel does."""
        self.store_text("wheel_scrolls", "true" if on else "")

    @property
    def autosave(self) -> bool:
        """Whether a file is saved by itself some time after the last change."""
        return self.text_of("autosave") == "true"

    @autosave.setter
    def autosave(self, on: bool) -> None:
        """Remember whether files are saved by themselves."""
        self.store_text("autosave", "true" if on else "")

    @property
    def plugin_folders(self) -> tuple[str, ...]:
        """Further folders with plugins, in order."""
        value = self._store.value("plugin_folders", [])
        return tuple(str(one) for one in (value if isinstance(value, list) else [value]) if one)

    @plugin_folders.setter
    def plugin_folders(self, folders: tuple[str, ...]) -> None:
        """Remember further folders with plugins."""
        self._store.setValue("plugin_folders", list(folders))

    def policy_of(self, project: str) -> Path | None:
        """The trust policy that was chosen for a project (its folder); None if there is none.

        If the setting cannot be read, it is a file that is no policy, so that nothing runs.
        """
        try:
            found = self._policies().get(project)
        except (ValueError, AttributeError):
            return self.folder / "window.ini"
        return Path(found) if found else None

    def choose_policy(self, project: str, policy: Path | None) -> None:
        """Remember the trust policy of a project; None if its runs need no approval."""
        try:
            chosen = self._policies()
        except (ValueError, AttributeError):
            chosen = {}
        chosen.pop(project, None)
        if policy is not None:
            chosen[project] = str(policy)
        self.store_text("policies", json.dumps(chosen))

    def _policies(self) -> dict[str, str]:
        """The policy by project. ValueError or AttributeError if the setting cannot be read."""
        text = self.text_of("policies")
        return {name: str(file) for name, file in json.loads(text).items()} if text else {}

    @property
    def recordings(self) -> Path:
        """The folder of recorded runs; it may not exist yet."""
        return self.folder / "recordings"

    @property
    def wanted_recordings(self) -> Path | None:
        """The folder for recordings; None if runs are not recorded."""
        return self.recordings if self.record_runs else None

    def remember(self, path: Path) -> None:
        """Put a file first in the list of recent files."""
        others = [known for known in self.recent if known != path]
        kept = (path, *others)[:RECENT]
        self._store.setValue("recent", [str(p) for p in kept])
        times = {str(p): then for p in others if (then := self.opened(p)) is not None}
        times[str(path)] = datetime.now().astimezone()
        told = [f"{times[str(p)].isoformat()} {p}" for p in kept if str(p) in times]
        self._store.setValue("opened", told)

    def opened(self, path: Path) -> datetime | None:
        """When a recent file was opened or saved last; None if that is not known."""
        value = self._store.value("opened", [])
        for line in value if isinstance(value, list) else [value]:
            then, _, name = str(line).partition(" ")
            if name == str(path):
                try:
                    return datetime.fromisoformat(then).astimezone()
                except ValueError:
                    return None
        return None

    def forget(self, path: Path) -> None:
        """Remove a file from the list of recent files."""
        self._store.setValue("recent", [str(p) for p in self.recent if p != path])

    def bytes_of(self, key: str) -> QByteArray:
        """Stored bytes, such as the geometry of the window; empty if there are none."""
        value = self._store.value(key)
        return value if isinstance(value, QByteArray) else QByteArray()

    def store(self, key: str, value: QByteArray) -> None:
        """Store bytes under a key."""
        self._store.setValue(key, value)

    def text_of(self, key: str) -> str:
        """A stored text; empty if there is none."""
        return str(self._store.value(key, "") or "")

    def store_text(self, key: str, text: str) -> None:
        """Store a text under a key."""
        self._store.setValue(key, text)

    def sync(self) -> None:
        """Write to the disk now."""
        self._store.sync()
