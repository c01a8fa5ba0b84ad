"""Lines with a choice: one of a few values, or yes and no."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from PySide6.QtWidgets import QPushButton

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Combo, Switch, label
from smsl_studio.studio.base.lines.line import NOT_SAID, VARIOUS, FormLine, ShownValue, same
from smsl_studio.studio.base.tips import tip_text

Choices = tuple[tuple[str, str], ...]
_STANDARD, _VARIOUS = object(), object()


class ChoiceLine(FormLine):
    """A choice of one of a few values, given as pairs (words, value)."""

    def __init__(self, words: str, tip: str, choices: Choices, none: str = NOT_SAID) -> None:
        self.field: Combo = Combo()
        super().__init__(words, self.field, tip)
        self._choices, self._none = choices, none
        self._values: list[Any] = []
        self.field.activated.connect(self._chosen)

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Offer the choices and select the one that is written, or say that the entries differ."""
        super().show_values(shown)
        self.field.clear()
        alike = bool(shown) and same(list(shown))
        first = shown[0] if shown else ShownValue()
        # A default appears once: as the value that applies if nothing is written.
        plain = [c for c in self._choices if first.origin or c[1] != first.standard]
        self._values = [_STANDARD, *(value for _, value in plain)]
        self.field.addItem(self._standard_words(shown))
        self.field.addItems([words for words, _ in plain])
        if not alike and not same([one.value for one in shown]):
            self._values.append(_VARIOUS)
            self.field.addItem(VARIOUS)
            self.field.setCurrentIndex(len(self._values) - 1)
            return
        written = first.written in self._values
        self.field.setCurrentIndex(self._values.index(first.written) if written else 0)

    def said(self, value: Any) -> str:
        """The words of a value; the value itself if no choice has it."""
        return next((words for words, one in self._choices if one == value), str(value))

    def _standard_words(self, shown: Sequence[ShownValue]) -> str:
        if not shown or not same([(one.standard, one.origin) for one in shown]):
            return self._none
        first = shown[0]
        if first.standard is None:
            return self._none
        return f"{self.said(first.standard)} ({first.origin or 'default'})"

    def _chosen(self, at: int) -> None:
        if self._values[at] is not _VARIOUS:
            self.given.emit(None if self._values[at] is _STANDARD else self._values[at])


class SwitchLine(FormLine):
    """A switch for yes or no. Clear removes the written answer."""

    def __init__(self, words: str, tip: str) -> None:
        self.field: Switch = Switch()
        self.answer = label("", "second")
        self.clear = QPushButton("Clear")
        self.clear.setProperty("role", "link")
        self.clear.setToolTip(tip_text(f"{words}: leave it to the default"))
        self.clear.setAccessibleName(plain_text(f"Clear: {words}"))
        super().__init__(words, self.field, tip, self.answer, None, self.clear)
        self.field.clicked.connect(lambda on: self.given.emit(on))
        self.clear.clicked.connect(lambda: self.given.emit(None))

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show yes if all entries say yes, and offer Clear if an answer is written."""
        super().show_values(shown)
        values = [one.value for one in shown]
        self.field.setChecked(bool(values) and all(values))
        self.answer.setText(self._answer(shown, values))
        self.clear.setVisible(any(one.written is not None for one in shown))

    def said(self, value: Any) -> str:
        """ "yes" or "no"."""
        return "yes" if value else "no"

    def _answer(self, shown: Sequence[ShownValue], values: Sequence[Any]) -> str:
        if not same(values):
            return VARIOUS
        words = {True: "Yes", False: "No", None: NOT_SAID}[values[0] if values else None]
        inherited = shown and shown[0].written is None and shown[0].origin
        return f"{words} ({shown[0].origin})" if inherited else words
