"""The plugin folders of the settings."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QListWidget, QPushButton, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.library.folders import plugin_path
from smsl_studio.studio.base.controls import NameDelegate, label, row
from smsl_studio.studio.base.file_dialogs import ask_folder
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.settings import Settings

HINT = (
    "Studio looks for plugins in these folders, too, at once and at each start. They are loaded "
    "without a further question, so add only folders whose code you trust."
)
ALSO = "Besides: {}"
HIGH = 90


class PluginPart(QWidget):
    """Adds and removes folders. ``give`` is called with all of them."""

    def __init__(self, settings: Settings, give: Callable[[tuple[str, ...]], object]) -> None:
        super().__init__()
        self._settings, self._give = settings, give
        self.ask: Callable[[], str] = self._ask
        """Asks for a folder; empty if the person cancels."""
        self.list = QListWidget()
        self.list.setItemDelegate(NameDelegate(self.list))
        self.list.setProperty("role", "list")
        self.list.setAccessibleName("Plugin folders")
        self.list.setFixedHeight(HIGH)
        self.add, self.remove = QPushButton("Add a folder…"), QPushButton("Remove")
        self.refusal = Sentence("refusal")
        for button in (self.add, self.remove):
            button.setAutoDefault(False)
            button.setProperty("role", "row")
        self.add.clicked.connect(self._add)
        self.remove.clicked.connect(self._remove)
        self.list.currentRowChanged.connect(lambda at: self.remove.setEnabled(at >= 0))
        own = settings.folder / "plugins"
        given = [str(one) for one in plugin_path() if str(one) not in settings.plugin_folders]
        also = label(ALSO.format(", ".join([str(own), *given])), "hint")
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(label(HINT, "hint"))
        column.addWidget(self.list)
        column.addLayout(row(self.add, self.remove, None))
        column.addWidget(self.refusal)
        column.addWidget(also)
        self._fill()

    def _ask(self) -> str:
        return ask_folder(self, "Add a plugin folder")

    def _fill(self) -> None:
        self.list.clear()
        self.list.addItems([plain_text(one) for one in self._settings.plugin_folders])
        self.remove.setEnabled(False)

    def _add(self) -> None:
        folder, known = self.ask(), self._settings.plugin_folders
        if not folder:
            return
        if not Path(folder).is_dir():
            self.refusal.say(f"{folder} is no folder. Choose one that exists.")
        elif folder in known:
            self.refusal.say(f"{folder} is in the list already.")
        else:
            self._put((*known, folder))

    def _remove(self) -> None:
        at, known = self.list.currentRow(), self._settings.plugin_folders
        if 0 <= at < len(known):
            self._put((*known[:at], *known[at + 1 :]))

    def _put(self, folders: tuple[str, ...]) -> None:
        self.refusal.say("")
        self._give(folders)
        self._fill()
