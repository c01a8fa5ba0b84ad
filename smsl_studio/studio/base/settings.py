"""What the window remembers: theme, places of the panels, recent files. One small file.

It lies in the platform's user directory, or in SMSL_STUDIO_HOME.
"""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QByteArray, QSettings

from smsl_studio.home import user_folder

RECENT = 10
THEMES = ("light", "dark", "system")


class Settings:
    """The remembered choices, each read and written by name."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder or user_folder()
        self._store = QSettings(str(self.folder / "window.ini"), QSettings.Format.IniFormat)

    @property
    def theme(self) -> str:
        """``light``, ``dark`` or ``system``."""
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
        """Whether every run of the window is written to a log in ``recordings``."""
        return self._store.value("record_runs", "true") in ("true", True)

    @record_runs.setter
    def record_runs(self, on: bool) -> None:
        """Remember whether runs are recorded."""
        self._store.setValue("record_runs", "true" if on else "false")

    @property
    def recordings(self) -> Path:
        """The folder of recorded runs; it need not exist."""
        return self.folder / "recordings"

    @property
    def wanted_recordings(self) -> Path | None:
        """The folder into which runs are to be recorded; None: they are not."""
        return self.recordings if self.record_runs else None

    def remember(self, path: Path) -> None:
        """Put a file in front of the recent ones."""
        others = [known for known in self.recent if known != path]
        self._store.setValue("recent", [str(p) for p in (path, *others)[:RECENT]])

    def forget(self, path: Path) -> None:
        """Take a file that is gone from the recent ones."""
        self._store.setValue("recent", [str(p) for p in self.recent if p != path])

    def bytes_of(self, key: str) -> QByteArray:
        """A stored shape (of the window, or of a mode's panels); empty where none is stored."""
        value = self._store.value(key)
        return value if isinstance(value, QByteArray) else QByteArray()

    def store(self, key: str, value: QByteArray) -> None:
        """Remember bytes under a key, such as the places of the panels."""
        self._store.setValue(key, value)

    def text_of(self, key: str) -> str:
        """A stored text; empty where none is stored."""
        return str(self._store.value(key, "") or "")

    def store_text(self, key: str, text: str) -> None:
        """Remember a text under a key."""
        self._store.setValue(key, text)

    def sync(self) -> None:
        """Write to the disk now."""
        self._store.sync()
