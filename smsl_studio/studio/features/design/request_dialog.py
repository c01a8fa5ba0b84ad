"""The dialog From text: which texts, who answers, and where the blueprint goes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QDialog,
    QGridLayout,
    QLineEdit,
    QListWidget,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.errors import StudioError, UsageError
from smsl_studio.front.design.generation import BY_HAND, READER, REPLAY, GenerationRequest
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Combo, NameDelegate, label, name_parts, row
from smsl_studio.studio.base.file_dialogs import ask_folder, ask_to_open, ask_to_save
from smsl_studio.studio.base.screens import open_at
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import refusal_words

TEXT_KINDS = "Texts (*.md *.txt *.pdf);;All files (*)"
SERVER = "server"
ANSWERS = {
    "Reader, no model": READER,
    "You, by hand": BY_HAND,
    "Kept answers": REPLAY,
    "A server, by its base URL": SERVER,
}
FIRST = (
    "Add what somebody has written who knows the procedure: Markdown, plain text or a PDF. Each "
    "part of the blueprint will cite its lines."
)
_TOLD = {
    READER: "The reader needs no model. The same text gives the same blueprint. Nothing leaves "
    "this computer.",
    BY_HAND: "Prompts are written into a folder. You put the answers there, and ask again.",
    REPLAY: "An answers.json that was kept. The same answers give the same blueprint.",
    SERVER: "The prompts, and with them these texts, are sent to this URL and nowhere else. The "
    "key stands in SMSL_TEXT_KEY.",
}
_FIELD = {BY_HAND: "Folder of answers", REPLAY: "File of answers", SERVER: "Base URL"}


@dataclass(frozen=True)
class FileQuestions:
    """How the dialog asks for files; tests answer in their place."""

    text: Callable[[QWidget, str], str]
    folder: Callable[[QWidget, str], str]
    target: Callable[[QWidget, str], str]


def _ask_text(parent: QWidget, title: str) -> str:
    return ask_to_open(parent, title, str(Path.home()), TEXT_KINDS)


def _ask_target(parent: QWidget, suggested: str) -> str:
    return ask_to_save(parent, "Where the blueprint goes", suggested, "Blueprints (*.json)")[0]


ASKED = FileQuestions(_ask_text, ask_folder, _ask_target)


class RequestDialog(QDialog):
    """Asks for a generation. ``request`` is what was chosen, as soon as it is accepted.

    With a ``target`` the blueprint is there already, and only what it is made of is asked for.
    """

    def __init__(
        self, before: GenerationRequest, known: bool, parent: QWidget,
        asked: FileQuestions = ASKED,
    ) -> None:  # fmt: skip
        super().__init__(parent)
        self.setWindowTitle("From text")
        self.request, self._asked, self._known = before, asked, known
        self.texts = QListWidget()
        self.texts.setProperty("role", "list")
        self.texts.setItemDelegate(NameDelegate(self.texts))
        self.hardware, self.require = QLineEdit(), QLineEdit()
        self.who, self.where, self.target = Combo(), QLineEdit(), QLineEdit(str(before.target))
        for words, provider in ANSWERS.items():
            self.who.addItem(words, provider)
        for text in before.texts:
            self.texts.addItem(str(text))
        self.hardware.setText(str(before.hardware or ""))
        self.require.setText(str(before.require or ""))
        self.add, self.remove = QPushButton("Add…"), QPushButton("Remove")
        for button in (self.add, self.remove):
            button.setAutoDefault(False)
        self.told, self.refusal = label("", "hint"), label("", "refusal")
        self.told.setMinimumHeight(34)
        self.refusal.setMinimumHeight(20)
        self._where_words = label("", "second")
        self.cancel, self.begin = QPushButton("Cancel"), QPushButton("Generate")
        self.begin.setProperty("role", "primary")
        self.begin.setDefault(True)
        self._build()
        self._set_provider(before)
        self.who.currentIndexChanged.connect(lambda *_: self._show_provider())
        for part in (self.hardware, self.require, self.where, self.target):
            part.textChanged.connect(lambda *_: self._judge())
        self.add.clicked.connect(self._add_text)
        self.remove.clicked.connect(self._remove_text)
        self.cancel.clicked.connect(self.reject)
        self.begin.clicked.connect(self.accept)
        open_at(self, 640, 470)
        self._show_provider()

    def _build(self) -> None:
        grid = QGridLayout()
        grid.setHorizontalSpacing(10)
        grid.setVerticalSpacing(8)
        grid.setColumnStretch(1, 1)
        grid.setRowStretch(0, 1)
        beside = QVBoxLayout()
        beside.addWidget(self.add)
        beside.addWidget(self.remove)
        beside.addStretch(1)
        grid.addLayout(beside, 0, 2)
        self._where_button = self._chooser(self._choose_where)
        named = (
            ("Texts", self.texts, None, "What somebody has written who knows the procedure"),
            ("Hardware", self.hardware, self._chooser(self._choose_hardware),
             "A list of the hardware that is there. It may be left out"),
            ("Requirements", self.require, self._chooser(self._choose_require),
             "What must be fulfilled (TOML). It may be left out"),
            ("Who answers", self.who, None, "The reader, a person, kept answers, or a server"),
            ("", self.where, self._where_button, "Where the answers come from"),
            ("Blueprint", self.target, self._chooser(self._choose_target),
             "The file that is made. What each stage gave is put beside it"),
        )  # fmt: skip
        for at, (words, part, button, tip) in enumerate(named):
            said = label(words, "second") if words else self._where_words
            top = Qt.AlignmentFlag.AlignTop if at == 0 else Qt.AlignmentFlag.AlignVCenter
            grid.addWidget(said, at, 0, top)
            grid.addWidget(part, at, 1)
            part.setAccessibleName(words or "Where the answers come from")
            part.setToolTip(tip_text(tip))
            if button is not None:
                grid.addWidget(button, at, 2)
            if words == "Blueprint" and self._known:
                for one in (said, part, button):
                    assert one is not None
                    one.setVisible(False)
        column = QVBoxLayout(self)
        column.addLayout(grid, 1)
        column.addWidget(self.told)
        column.addWidget(self.refusal)
        column.addLayout(row(None, self.cancel, self.begin, spacing=8))
        name_parts(self)

    def _chooser(self, call: Callable[[], None]) -> QPushButton:
        made = QPushButton("Choose…")
        made.setAutoDefault(False)
        made.clicked.connect(call)
        return made

    # What is chosen.

    @property
    def provider(self) -> str:
        """Who answers: the kind alone."""
        return str(self.who.currentData())

    def chosen(self) -> GenerationRequest:
        """Return what is chosen now. UsageError if something is missing."""
        where, provider = self.where.text().strip(), self.provider
        if provider == REPLAY and not where:
            raise UsageError("no file of answers is chosen", advice="Choose an answers.json.")
        if provider == SERVER and not where:
            raise UsageError("the base URL is empty", advice="Write http://127.0.0.1:8080/v1.")
        named = {REPLAY: f"{REPLAY}{where}", SERVER: where}.get(provider, provider)
        by_hand = Path(where) if provider == BY_HAND and where else None
        hardware, require = self.hardware.text().strip(), self.require.text().strip()
        return GenerationRequest(
            tuple(Path(self.texts.item(at).text()) for at in range(self.texts.count())),
            Path(self.target.text().strip() or "."),
            Path(hardware) if hardware else None,
            Path(require) if require else None,
            named,
            by_hand,
        ).checked()

    def accept(self) -> None:
        """Keep what is chosen, if nothing is missing."""
        try:
            self.request = self.chosen()
        except StudioError as error:
            self.refusal.setText(refusal_words(error))
            return
        super().accept()

    def _set_provider(self, before: GenerationRequest) -> None:
        kind, where = before.provider, ""
        if kind.startswith(REPLAY):
            kind, where = REPLAY, kind.removeprefix(REPLAY)
        elif kind == BY_HAND:
            where = str(before.by_hand or "")
        elif kind != READER:
            kind, where = SERVER, kind
        self.who.setCurrentIndex(max(0, self.who.findData(kind)))
        self.where.setText(where)

    def _show_provider(self) -> None:
        kind = self.provider
        needed = kind in _FIELD
        self._where_words.setText(_FIELD.get(kind, ""))
        for part in (self._where_words, self.where):
            part.setVisible(needed)
        self._where_button.setVisible(needed and kind != SERVER)
        self._judge()

    def _judge(self) -> None:
        """Say what is missing, as soon as a text was chosen."""
        self.told.setText(_TOLD[self.provider] if self.texts.count() else FIRST)
        try:
            self.chosen()
        except StudioError as error:
            self.begin.setEnabled(False)
            self.refusal.setText(refusal_words(error) if self.texts.count() else "")
            return
        self.begin.setEnabled(True)
        self.refusal.setText("")

    # Asking for files.

    def add_text(self, path: Path) -> None:
        """Add a text. The first one gives the blueprint its name."""
        if not self.texts.count() and not self._known:
            folder = path.parent / f"{path.stem}-blueprint"
            self.target.setText(str(folder / f"{path.stem}.json"))
        self.texts.addItem(plain_text(str(path)))
        self._judge()

    def _add_text(self) -> None:
        name = self._asked.text(self, "Choose a text")
        if name:
            self.add_text(Path(name))

    def _remove_text(self) -> None:
        for item in self.texts.selectedItems() or [self.texts.item(self.texts.count() - 1)]:
            if item is not None:
                self.texts.takeItem(self.texts.row(item))
        self._judge()

    def _choose_hardware(self) -> None:
        self._fill(self.hardware, self._asked.text(self, "Choose the list of hardware"))

    def _choose_require(self) -> None:
        self._fill(self.require, self._asked.text(self, "Choose the requirements"))

    def _choose_where(self) -> None:
        if self.provider == BY_HAND:
            self._fill(self.where, self._asked.folder(self, "Choose a folder for the answers"))
        else:
            self._fill(self.where, self._asked.text(self, "Choose an answers.json"))

    def _choose_target(self) -> None:
        self._fill(self.target, self._asked.target(self, self.target.text()))

    def _fill(self, field: QLineEdit, name: str) -> None:
        if name:
            field.setText(name)
