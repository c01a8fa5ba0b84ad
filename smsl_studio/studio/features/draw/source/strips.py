"""The strips above and below the text: the choice of files, the note on YAML, the faults."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QFrame, QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from smsl_studio.errors import ReadError
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Combo, label
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import as_it_is, counted

YAML_NOTE = "YAML is written whole: comments may move"
STANDS = "the graph shows the last version that could be read"
SALVAGED = "the graph shows what could be read"


class FileRow(QWidget):
    """The choice among the files of a blueprint; hidden if there is only one.

    ``chosen`` carries the file.
    """

    chosen = Signal(str)

    def __init__(self) -> None:
        super().__init__()
        self.setProperty("role", "bar")
        self.choice = Combo(height=26)
        self.choice.setAccessibleName("File whose text is shown")
        layout = QHBoxLayout(self)
        layout.setContentsMargins(12, 4, 12, 4)
        layout.addWidget(label("File", "small"))
        layout.addWidget(self.choice, 1)
        self.choice.activated.connect(lambda at: self.chosen.emit(self.choice.itemData(at)))
        self.hide()

    def show_files(self, files: Sequence[str], shown: str) -> None:
        """Offer these files by their names; the tooltip shows the folder."""
        known = [self.choice.itemData(at) for at in range(self.choice.count())]
        if known != list(files):
            self.choice.clear()
            for file in files:
                self.choice.addItem(PurePath(file).name or file, file)
        self.choice.setCurrentIndex(self.choice.findData(shown))
        self.choice.setToolTip(tip_text(shown))
        self.setVisible(len(files) > 1)


class Strip(QFrame):
    """One sentence with an icon, and the buttons for what can be done about it."""

    def __init__(self, icon: str, name: str) -> None:
        super().__init__()
        self.setProperty("role", "bar")
        self._icon = icon
        self._mark, self.said = label("", "small"), label("", "small")
        self.said.setWordWrap(True)
        self.setAccessibleName(plain_text(name))
        self.buttons = QHBoxLayout()
        self.buttons.setSpacing(6)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 5, 10, 5)
        layout.setSpacing(8)
        layout.addWidget(self._mark, 0, Qt.AlignmentFlag.AlignTop)
        inner = QVBoxLayout()
        inner.setSpacing(4)
        inner.addWidget(self.said)
        inner.addLayout(self.buttons)
        layout.addLayout(inner, 1)
        self.hide()

    def button(self, words: str, role: str = "row") -> QPushButton:
        """Add a button at the end."""
        made = QPushButton(words)
        made.setProperty("role", role)
        self.buttons.addWidget(made)
        return made

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme for the icon."""
        colour = tokens.bad if self._icon == "error" else tokens.risk
        self._mark.setPixmap(pixmap(self._icon, colour, tokens.surf, 14, self.devicePixelRatioF()))

    def minimumSizeHint(self) -> QSize:
        """At least 120 pixels wide: the sentence wraps."""
        return QSize(120, super().minimumSizeHint().height())


class FaultStrip(Strip):
    """Says why the text cannot be read, and which graph is shown instead.

    ``show_wanted`` and ``fix_wanted``: the person pressed this button.
    """

    show_wanted, fix_wanted = Signal(), Signal()

    def __init__(self) -> None:
        super().__init__("error", "Faults of the text")
        self.show_button = self.button("Show")
        self.fix_button = self.button("Fix", "soft")
        self.buttons.addStretch(1)
        self.show_button.clicked.connect(self.show_wanted)
        self.fix_button.clicked.connect(self.fix_wanted)

    def show_faults(self, error: ReadError | None, file: str, salvaged: bool) -> None:
        """Say how many faults there are and what the first one is; hidden for None."""
        self.setVisible(error is not None)
        if error is None:
            return
        where = f"line {error.place.line}, " if error.place else ""
        count = counted(len(error.faults), "fault")
        graph = SALVAGED if salvaged else STANDS
        name = f" in {PurePath(file).name}" if file else ""
        self.said.setText(f"{count}{name}: {where}{error.sentence}; {graph}.")
        self.said.setToolTip(tip_text(error.advice))
        first = next((fault for fault in error.faults if fault.fix), None)
        fix = first.fix if first else None
        line = first.place.line if first and first.place else 0
        # The sentence is about the first fault; a fix of another fault names its line.
        other = f"Line {line}: " if first is not error.faults[0] and line else ""
        self.fix_button.setVisible(fix is not None)
        self.fix_button.setText(as_it_is(f"{other}{fix.words}") if fix else "")


class YamlStrip(Strip):
    """Warns before the first edit of a YAML file. ``agreed``: the person pressed “Edit anyway”."""

    agreed = Signal()

    def __init__(self) -> None:
        super().__init__("warning", "About YAML")
        self.said.setText(f"{YAML_NOTE}.")
        self.edit_button = self.button("Edit anyway")
        self.buttons.addStretch(1)
        self.edit_button.clicked.connect(self.agreed)
