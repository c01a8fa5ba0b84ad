"""The form of a file: the files it imports, and the fields for which Studio has no form."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.editing import set_imports
from smsl_studio.smsl.document import Document
from smsl_studio.studio.base.controls import Elided, label, row
from smsl_studio.studio.base.lines.line import Sentence
from smsl_studio.studio.base.small_button import SmallButton
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.document.attempt import try_edit
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.panels.frame import Panel
from smsl_studio.studio.features.draw.panels.kept import KeptValues, kept_fields

KNOWN = ("_imports", "_hazards", "_properties", "_levels")
MOST = 64


class FileForm(Panel):
    """Edits ``_imports`` of the file that holds the SB that is shown.

    ``ask_file`` asks for a file, starting in a folder; None means cancelled.
    """

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("File", parent)
        self._session, self._tokens = session, tokens
        self.ask_file: Callable[[Path], Path | None] = lambda folder: None
        self.column.setContentsMargins(12, 8, 12, 16)
        self.column.setSpacing(6)
        self._name = Elided()
        self._name.setProperty("role", "second")
        self.column.addLayout(row(label("File", "heading"), self._name))
        self.add = QPushButton("Import a file")
        self.add.setProperty("role", "link")
        self.add.setToolTip("Import the State Branches of another file, named relative to this one")
        self.add.clicked.connect(self._add)
        self._list = QVBoxLayout()
        self._list.setSpacing(2)
        self.column.addLayout(self._list)
        self.refusal = Sentence("refusal")
        self.column.addWidget(self.refusal)
        self.column.addLayout(row(self.add, None))
        self.rows: list[tuple[QWidget, Elided, SmallButton]] = []
        self.kept = KeptValues("Kept in this file")
        self.column.addWidget(self.kept)
        changed = session.blueprint_changed, session.branch_changed
        session.afterwards.follow(self.show_file, *changed)
        self.show_file()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for _, _, gone in self.rows:
            gone.set_tokens(tokens)

    def show_file(self) -> None:
        """Show the imports and other fields of the file as they are now."""
        home = self._home
        self._name.setText(os.path.basename(home.file))  # noqa: PTH119
        self._name.setToolTip(tip_text(home.file))
        written = self._written()[:MOST]
        while len(self.rows) > len(written):
            frame, _, _ = self.rows.pop()
            self._list.removeWidget(frame)
            frame.hide()
            frame.deleteLater()
        while len(self.rows) < len(written):
            self.rows.append(self._new_row(len(self.rows)))
        for (_, name, _), file in zip(self.rows, written, strict=True):
            name.setText(f"imports {file}")
            name.setToolTip(tip_text(str(file)))
        self.kept.show_values(kept_fields(
            {k: v for k, v in home.values.items() if k.startswith("_")}, KNOWN))  # fmt: skip
        self.refusal.say("")

    def _new_row(self, at: int) -> tuple[QWidget, Elided, SmallButton]:
        frame, name = QWidget(), Elided()
        gone = SmallButton("Import this file no longer", "close", self._tokens)
        gone.clicked.connect(lambda: self._remove(at))
        frame.setLayout(row(name, gone, spacing=4))
        self._list.addWidget(frame)
        return frame, name, gone

    def _add(self) -> None:
        folder = Path(os.path.dirname(os.path.abspath(self._home.file)))  # noqa: PTH100, PTH120
        chosen = self.ask_file(folder)
        if chosen is None:
            return
        try:
            name = Path(os.path.relpath(chosen, folder)).as_posix()
        except ValueError:  # another drive has no relative path
            name = chosen.as_posix()
        self._write([*self._written(), name], f"Import {name}")

    def _remove(self, at: int) -> None:
        files = self._written()
        gone = files.pop(at)
        self._write(files, f"Import {gone} no longer")

    def _write(self, files: list[Any], step: str) -> None:
        file = self._home.file
        try_edit(self._session, step, lambda bp: set_imports(bp, files, file), self.refusal.say)

    @property
    def _home(self) -> Document:
        return self._session.blueprint.home(self._session.branch)

    def _written(self) -> list[Any]:
        written = self._home.values.get("_imports", [])
        return list(written) if isinstance(written, list) else []
