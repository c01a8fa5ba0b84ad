"""The parts of every line in a form: a name at the left, a field, and sentences below."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QHBoxLayout, QLabel, QVBoxLayout, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label, row
from smsl_studio.studio.base.tips import tip_text

LABEL = 80
NOT_SAID, VARIOUS = "Not set", "Various"


@dataclass(frozen=True)
class ShownValue:
    """The value of one word of the notes in one entry, and where it comes from.

    ``written`` is the value in the entry itself (None: nothing is written). ``standard`` applies
    without it. ``origin`` says where ``standard`` comes from, such as ``all Op_1b``; empty for a
    plain default.
    """

    written: Any = None
    standard: Any = None
    origin: str = ""

    @property
    def value(self) -> Any:
        """The value that applies."""
        return self.standard if self.written is None else self.written


class Sentence(Label):
    """A label with a role of the style sheet that takes no room while it is empty."""

    def __init__(self, role: str, left: int = 0) -> None:
        super().__init__()
        self.setProperty("role", role)
        self.setWordWrap(True)
        self.setContentsMargins(left, 0, 0, 2)
        self.hide()

    def say(self, sentence: str) -> None:
        """Show a sentence; empty hides the label."""
        self.setText(sentence)
        self.setVisible(bool(sentence))


class FormLine(QWidget):
    """One line of a form.

    ``given`` carries a new value; None means that nothing shall be written.
    """

    given = Signal(object)

    def __init__(self, words: str, field: QWidget, tip: str, *beside: QWidget | None) -> None:
        super().__init__()
        self.words, self.field = words, field
        self.remark: str | None = None
        """The hint in place of the one about inherited values; None for that one."""
        field.setAccessibleName(plain_text(words))
        field.setToolTip(tip_text(tip))
        self.hint, self.refusal = Sentence("hint", LABEL), Sentence("refusal", LABEL)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        self.name: QLabel = _name_of(words, field)
        line = row(self.name, field, spacing=0)
        for widget in beside:
            line.addSpacing(8) if widget is not None else line.addStretch(1)
            if widget is not None:
                line.addWidget(widget)
        column.addLayout(line)
        column.addWidget(self.hint)
        column.addWidget(self.refusal)

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show the values of all entries that the form is about.

        Subclasses put them into their field.
        """
        self.refuse("")
        self.say(_origin_words(shown, self.said) if self.remark is None else self.remark)

    def said(self, value: Any) -> str:
        """A value in words, for the history and for hints."""
        return f"“{value}”"

    def say(self, sentence: str) -> None:
        """Show a hint below the field; empty hides it."""
        self.hint.say(sentence)

    def refuse(self, sentence: str) -> None:
        """Show below the field why a value was refused; empty hides the sentence."""
        self.refusal.say(sentence)
        mark = getattr(self.field, "set_refused", None)
        if mark is not None:
            mark(bool(sentence))


def labelled(words: str, field: QWidget) -> QHBoxLayout:
    """A field with its name at the left."""
    return row(_name_of(words, field), field, spacing=0)


def _name_of(words: str, field: QWidget) -> QLabel:
    name = label(words, "label")
    name.setFixedWidth(LABEL)
    name.setBuddy(field)
    return name


def same(values: Sequence[Any]) -> bool:
    """Whether all values are equal."""
    return all(value == values[0] for value in values[1:])


def _origin_words(shown: Sequence[ShownValue], said: Any) -> str:
    """A hint that this entry overrides an inherited value; empty if it does not."""
    if len(shown) != 1 or shown[0].written is None or not shown[0].origin:
        return ""
    standard = shown[0].standard
    other = said(standard) if standard not in (None, "", ()) else "nothing"
    return f"This edge only; {shown[0].origin}: {other}."
