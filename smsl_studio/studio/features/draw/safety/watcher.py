"""Watches files, also those that other programs replace.

The system stops watching a file when another one replaces it. So the folders are watched too, and
the folders above them, because a moved folder is not reported itself. After each event all files
are watched anew. The receiver has to find out what has changed.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from PySide6.QtCore import QElapsedTimer, QFileSystemWatcher, QObject, QTimer, Signal

SETTLED = 150
"""Milliseconds without an event before ``stirred``: a program may write in several pieces."""
LATEST = 1000
"""Milliseconds after which ``stirred`` is emitted even if events go on."""


class Watcher(QObject):
    """Watches a set of files that may change."""

    stirred = Signal()
    """Something may have happened to a file, a short time ago."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._system = QFileSystemWatcher(self)
        self._system.fileChanged.connect(self.stir)
        self._system.directoryChanged.connect(self.stir)
        self._files: frozenset[Path] = frozenset()
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(SETTLED)
        self._timer.timeout.connect(self._settled)
        self._since = QElapsedTimer()

    def watch(self, files: Iterable[Path]) -> None:
        """Watch these files and no others."""
        files = frozenset(files)
        if files != self._files:
            self._files = files
            self._renew()

    def stop(self) -> None:
        """End watching."""
        self._timer.stop()
        self.watch(())

    def stir(self) -> None:
        """Emit ``stirred`` soon, as if something had happened."""
        if not self._timer.isActive():
            self._since.start()
        if self._since.elapsed() < LATEST:
            self._timer.start()

    def _settled(self) -> None:
        self._renew()
        self.stirred.emit()

    def _renew(self) -> None:
        wanted = {str(path) for path in self._files if path.is_file()}
        folders = {folder for path in self._files for folder in (path.parent, path.parent.parent)}
        wanted |= {str(folder) for folder in folders if folder.is_dir()}
        present = {*self._system.files(), *self._system.directories()}
        if present - wanted:
            self._system.removePaths(sorted(present - wanted))
        if wanted - present:
            self._system.addPaths(sorted(wanted - present))
