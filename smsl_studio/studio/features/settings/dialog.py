"""The dialog of the settings. Everything takes effect at once, except where its line says when."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QButtonGroup,
    QDialog,
    QPushButton,
    QRadioButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.controls import Combo, Switch, label, row
from smsl_studio.studio.base.feature import AllWindows
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.settings import SIZES
from smsl_studio.studio.features.settings.key_part import KeyPart
from smsl_studio.studio.features.settings.plugin_part import PluginPart

THEMES = (
    ("light", "Light"),
    ("dark", "Dark"),
    ("contrast", "High contrast"),
    ("system", "As the desktop"),
)
SIZE = "The size of letters, buttons and the drawing. It takes effect when Studio starts next."
CALM = "The view jumps where it would glide. What a run moves still moves."
WHEEL = (
    "Otherwise it zooms about the pointer. With Ctrl it always zooms, with Shift it scrolls "
    "sideways, and two fingers on a touchpad always scroll."
)
KEPT = (
    "Unsaved work is in a journal on this machine within a second, always. After a crash the next "
    "start offers it."
)
SAVING = (
    "One minute after the last change, if the drawing has a file. It never overwrites what another "
    "program wrote, and it never asks."
)
RECORDED = "Each run of the window is written to a log in the folder {}."
PRIVACY = (
    "Nothing leaves this machine. Studio sends no reports and no figures about its use, looks for "
    "no updates, and opens no page of the network by itself. The help is on this machine.",
    "Two things talk to others, and only if you name them: a broker for sensors elsewhere (MQTT), "
    "and code of plugins that you have allowed. A link to the network opens only when you press "
    "“Open outside”. git is asked about a file without network.",
    "Your settings, the journals of unsaved work and recorded runs are in the folder {}.",
)


class SettingsDialog(QDialog):
    """All settings of the program, one below the other."""

    def __init__(self, program: AllWindows, actions: Actions, parent: QWidget) -> None:
        super().__init__(parent)
        self._program = program
        self.setWindowTitle("Settings")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        open_at(self, 640, 620)
        self.themes = QButtonGroup(self)
        self.size_choice: Combo = Combo()
        self.switches: dict[str, Switch] = {}
        self.keys = KeyPart(actions, program.set_keys)
        self.plugins = PluginPart(program.settings, program.set_plugin_folders)
        self._column = QVBoxLayout()
        self._column.setContentsMargins(20, 16, 20, 16)
        self._column.setSpacing(8)
        self._add_looks()
        self._add("Keys", self.keys)
        self._add_saving()
        self._add("Plugin folders", self.plugins)
        folder = program.settings.folder
        self._add("Privacy", *(label(said.format(folder), "second") for said in PRIVACY))
        self._column.addStretch(1)
        self._finish()

    def _add(self, heading: str, *parts: QWidget) -> None:
        self._column.addWidget(label(heading, "heading"))
        for part in parts:
            if part.property("role") == "second":
                part.setProperty("wordWrap", True)
            self._column.addWidget(part)
        self._column.addSpacing(10)

    def _add_looks(self) -> None:
        program = self._program
        across = QWidget()
        buttons = []
        for name, words in THEMES:
            button = QRadioButton(words)
            button.setChecked(program.theme == name)
            button.toggled.connect(partial(self._choose_theme, name))
            self.themes.addButton(button)
            buttons.append(button)
        across.setLayout(row(*buttons, None, spacing=16))
        self._add("Theme", across)
        self.size_choice.addItems([f"{size} %" for size in SIZES])
        self.size_choice.setCurrentIndex(SIZES.index(program.settings.size))
        self.size_choice.setAccessibleName("Size")
        self.size_choice.setMaximumWidth(120)
        self.size_choice.activated.connect(self._choose_size)
        self._add("Size", self.size_choice, label(SIZE, "hint"))
        calm = self._switch("Less motion", program.settings.calm, program.set_calm)
        self._add("Motion", calm, label(CALM, "hint"))
        wheel = self._switch(
            "The mouse wheel scrolls", program.settings.wheel_scrolls, program.set_wheel_scrolls
        )
        self._add("Mouse wheel", wheel, label(WHEEL, "hint"))

    def _add_saving(self) -> None:
        settings = self._program.settings
        saving = self._switch("Save the file by itself", settings.autosave, self._choose_saving)
        recording = self._switch("Record runs", settings.record_runs, self._choose_recording)
        recorded = RECORDED.format(settings.recordings)
        self._add("Saving", label(KEPT, "second"), saving, label(SAVING, "hint"),
                  recording, label(recorded, "hint"))  # fmt: skip

    def _switch(self, words: str, on: bool, call: Callable[[bool], object]) -> QWidget:
        """A switch with its words, which are its name for assistive tools."""
        line, switch = QWidget(), Switch()
        switch.setChecked(on)
        switch.setAccessibleName(plain_text(words))
        switch.toggled.connect(call)
        self.switches[words] = switch
        line.setLayout(row(switch, label(words, "second"), None, spacing=10))
        return line

    def _choose_theme(self, name: str, chosen: bool) -> None:
        if chosen:
            self._program.set_theme(name)

    def _choose_size(self, at: int) -> None:
        self._program.settings.size = SIZES[at]

    def _choose_saving(self, on: bool) -> None:
        self._program.settings.autosave = on

    def _choose_recording(self, on: bool) -> None:
        self._program.settings.record_runs = on

    def _finish(self) -> None:
        inner = QWidget()
        inner.setLayout(self._column)
        area = QScrollArea()
        area.setWidgetResizable(True)
        area.setFrameShape(QScrollArea.Shape.NoFrame)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(inner)
        close = QPushButton("Close")
        close.setAutoDefault(False)
        close.clicked.connect(self.accept)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.addWidget(area, 1)
        foot = row(None, close)
        foot.setContentsMargins(20, 8, 20, 16)
        whole.addLayout(foot)
