"""An element in the notation of the paper, on demand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.notation import notation_of
from smsl_studio.errors import AddressError
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label

SHOW, HIDE = "Show it as the paper writes it", "Hide the notation of the paper"


class NotationPart(QWidget):
    """A button, and below it the definitions. They are written only while they are shown."""

    def __init__(self) -> None:
        super().__init__()
        self._about: Callable[[], Sequence[str]] | None = None
        self.button = QPushButton(SHOW)
        self.button.setProperty("role", "link")
        self.button.setCheckable(True)
        self.button.toggled.connect(lambda _: self._write())
        self.words = Label()
        self.words.setProperty("role", "mono")
        self.words.setWordWrap(True)
        self.words.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.words.hide()
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 4, 0, 0)
        column.setSpacing(4)
        column.addWidget(self.button, 0, Qt.AlignmentFlag.AlignLeft)
        column.addWidget(self.words)

    def show_element(self, blueprint: Blueprint, address: str) -> None:
        """Set what it is about; an empty address hides it."""
        self.show_lines(partial(_lines, blueprint, address) if address else None)

    def show_lines(self, about: Callable[[], Sequence[str]] | None) -> None:
        """Set what returns the definitions; None hides it."""
        self._about = about
        self.setVisible(about is not None)
        self._write()

    def _write(self) -> None:
        shown = self.button.isChecked() and self._about is not None
        self.button.setText(HIDE if shown else SHOW)
        self.words.setVisible(shown)
        if not shown or self._about is None:
            return
        self.words.setText("\n".join(map(plain_text, self._about())))


def _lines(blueprint: Blueprint, address: str) -> tuple[str, ...]:
    try:
        return notation_of(blueprint, address)
    except AddressError as error:
        return (error.sentence,)
