"""The question whether a plugin may be loaded, asked before any of its code has run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtWidgets import (
    QDialog,
    QFormLayout,
    QLabel,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.errors import StudioError
from smsl_studio.studio.base.controls import label, row
from smsl_studio.studio.base.screens import room
from smsl_studio.studio.shell.windows import Windows

if TYPE_CHECKING:
    from smsl_studio.library.survey import FoundPlugin

WIDTH, TALLEST = 620, 280
BESIDES = 190
"""Height of the question, its explanation and the buttons (pixels)."""
WHY = (
    "Its code would run with your rights, each time the window opens and in every run. "
    "Allow it only if you know where it comes from. Until then nothing of it runs."
)


class PluginQuestion(QDialog):
    """The question about one plugin; ``decided`` carries ``allow`` or ``forbid``.

    Escape and closing decide nothing.
    """

    decided = Signal(str)

    def __init__(self, found: FoundPlugin, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle("Allow a plugin")
        most = room(self)
        self.setFixedWidth(min(WIDTH, most.width()))
        self.found = found
        changed = found.is_changed
        what = "has changed since you allowed it" if changed else "is new"
        heading = label(f"The plugin {found.name} {what}. Allow it?", "heading")
        why = label(WHY, "second")
        self.allow, self.forbid = QPushButton("Allow"), QPushButton("Forbid")
        self.later = QPushButton("Not now")
        self.later.setDefault(True)
        self.allow.setAutoDefault(False)
        self.forbid.setAutoDefault(False)
        self.allow.clicked.connect(lambda: self._decide("allow"))
        self.forbid.clicked.connect(lambda: self._decide("forbid"))
        self.later.clicked.connect(self.reject)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(20, 18, 20, 16)
        whole.setSpacing(12)
        for words in (heading, why):
            words.setWordWrap(True)
        whole.addWidget(heading)
        whole.addWidget(_facts_of(found, self.width(), min(TALLEST, most.height() - BESIDES)))
        whole.addWidget(why)
        whole.addLayout(row(self.forbid, None, self.later, self.allow))
        high = whole.totalHeightForWidth(self.width())
        self.setMinimumHeight(min(high, most.height()))
        self.later.setFocus()

    def _decide(self, what: str) -> None:
        self.decided.emit(what)
        self.accept()


class PluginQuestions(QObject):
    """Asks about all undecided plugins, one after the other.

    If there are several windows, the one in front asks. ``refused`` carries the error if a decision
    could not be stored.
    """

    refused = Signal(StudioError)

    def __init__(self, windows: Windows, window: QWidget) -> None:
        super().__init__(window)
        self._windows, self._window = windows, window
        self._plugins = windows.plugins
        self._question: PluginQuestion | None = None
        self._decided = False
        self._plugins.changed.connect(self._found)

    def _found(self) -> None:
        if self._windows.is_in_front(self._window):
            self._ask()

    def _ask(self) -> None:
        """Ask about the next undecided plugin, if there is one.

        After the last question the plugins are searched again, if something was decided.
        """
        if self._question is not None:
            return
        found = self._plugins.unasked()
        if found is not None:
            self._question = PluginQuestion(found, self._window)
            self._question.decided.connect(self._decide)
            self._question.finished.connect(self._go_on)
            self._question.open()
        elif self._decided:
            self._decided = False
            self._plugins.look()

    def _decide(self, what: str) -> None:
        from smsl_studio.library.permission import allow, forbid

        assert self._question is not None
        try:
            (allow if what == "allow" else forbid)(self._question.found)
        except StudioError as error:
            self.refused.emit(error)
        else:
            self._decided = True

    def _go_on(self) -> None:
        self._question = None
        self._ask()


def _facts_of(found: FoundPlugin, wide: int, tallest: int) -> QWidget:
    """What is known of a plugin without running it.

    ``wide`` is the width of the dialog (pixels).
    """
    words = found.manifest
    assert words is not None
    facts = {"Version": words.version, "From": found.location, "About": words.description}
    said = {kind.capitalize(): ", ".join(names) for kind, names in words.registers.items()}
    if not any(said.values()):
        said = {"Registers": "its plugin.toml does not say what"}
    facts |= {**said, "Files": f"SHA-256 {found.digest}" if found.digest else ""}
    inner = QWidget()
    form = QFormLayout(inner)
    form.setContentsMargins(0, 0, 0, 0)
    form.setVerticalSpacing(6)
    for name, value in facts.items():
        if value:
            form.addRow(label(name, "small"), _wrapped(value))
    area = QScrollArea()
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setWidget(inner)
    area.setFixedHeight(min(inner.heightForWidth(wide - 60) + 4, tallest))
    area.setAccessibleName("What is known of the plugin")
    return area


def _wrapped(text: str) -> QLabel:
    """A label that wraps its text and lets a person select and copy it."""
    made = label(text, "second")
    made.setWordWrap(True)
    made.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
    return made
