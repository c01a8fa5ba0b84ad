"""Lines with typed values: a text, a number with its unit, a list."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from smsl_studio.studio.base.controls import Field
from smsl_studio.studio.base.lines.line import VARIOUS, FormLine, ShownValue, same


class TextLine(FormLine):
    """A line for a short text."""

    def __init__(self, words: str, tip: str, hint: str = "") -> None:
        self.field: Field = Field()
        super().__init__(words, self.field, tip)
        self._hint = hint
        self.field.editingFinished.connect(self._typed)

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show the text if the same is written in all entries; otherwise a placeholder."""
        super().show_values(shown)
        written = [one.written for one in shown]
        alike = bool(shown) and same(written) and written[0] is not None
        self.field.settle(self.text_of(written[0]) if alike else "")
        self.field.setPlaceholderText(self._placeholder(shown))

    def text_of(self, value: Any) -> str:
        """A value in the form in which a user types it."""
        return str(value)

    def value_of(self, text: str) -> Any:
        """The value of a typed text; ``ValueError`` with a sentence if it has none."""
        return text

    def _placeholder(self, shown: Sequence[ShownValue]) -> str:
        if not shown or not same([one.value for one in shown]):
            return VARIOUS if shown else ""
        first = shown[0]
        if first.standard in (None, "", ()):
            return self._hint
        words = self.text_of(first.standard)
        return f"{words} ({first.origin})" if first.origin else words

    def _typed(self) -> None:
        if not self.field.changed:
            return
        text = self.field.text().strip()
        try:
            value = self.value_of(text) if text else None
        except ValueError as error:
            self.refuse(str(error))
            return
        self.given.emit(value)


@dataclass(frozen=True)
class NumberBounds:
    """The allowed numbers: from ``least`` to ``most``."""

    least: float = 0.0
    open: bool = False
    """Whether ``least`` itself is not allowed."""
    most: float = 1e12
    whole: bool = False

    def sentence(self, text: str) -> str:
        """A sentence about why a text is no allowed number; empty if it is one."""
        kind, example = ("whole number", "2") if self.whole else ("number", "2.5")
        try:
            value = float(text)
        except ValueError:
            return f"“{text[:40]}” is no number. Write one such as {example}."
        if not math.isfinite(value) or value > self.most:
            return f"“{text[:40]}” is too large. Write {self.most:g} or less."
        if self.whole and not value.is_integer():
            return f"“{text[:40]}” is no whole number. Write one such as {example}."
        if value < self.least or (self.open and value == self.least):
            bound = f"a {kind} above {self.least:g}" if self.open else f"{self.least:g} or more"
            return f"“{text[:40]}” is too small. Write {bound}."
        return ""


class NumberLine(TextLine):
    """A line for a number. The field shows its unit."""

    def __init__(
        self, words: str, tip: str, bounds: NumberBounds, unit: str = "", hint: str = ""
    ) -> None:
        super().__init__(words, tip, hint)
        self._bounds, self._unit = bounds, unit
        self.field.set_suffix(unit)

    def text_of(self, value: Any) -> str:
        """A number in the form in which a user types it."""
        return number_text(value)

    def value_of(self, text: str) -> Any:
        """The typed number; raises ``ValueError`` with a sentence if it is not allowed."""
        text = text.replace(",", ".")
        sentence = self._bounds.sentence(text)
        if sentence:
            raise ValueError(sentence)
        value = float(text)
        return int(value) if value.is_integer() else value

    def said(self, value: Any) -> str:
        """The number with its unit."""
        return f"{number_text(value)} {self._unit}".strip()


class ListLine(TextLine):
    """A line for several texts, separated by commas; a text with a comma stands in quotes.

    ``once`` drops repeated texts.
    """

    def __init__(self, words: str, tip: str, hint: str = "", once: bool = True) -> None:
        super().__init__(words, tip, hint)
        self._once = once

    def text_of(self, value: Any) -> str:
        """The texts, separated by commas; a text with a comma in quotes."""
        out = io.StringIO()
        csv.writer(out, lineterminator="").writerow(value)
        return out.getvalue().replace(",", ", ") if _plain(value) else out.getvalue()

    def value_of(self, text: str) -> Any:
        """The typed texts; None if there are none."""
        cells = next(csv.reader([text.replace("\n", " ")], skipinitialspace=True), [])
        texts = [cell.strip() for cell in cells if cell.strip()]
        return (list(dict.fromkeys(texts)) if self._once else texts) or None

    def said(self, value: Any) -> str:
        """The texts, separated by commas."""
        return self.text_of(value)


def _plain(value: Sequence[str]) -> bool:
    return not any("," in text or '"' in text for text in value)


def number_text(value: float | None) -> str:
    """A number in the form in which a user types it; empty for None."""
    if value is None:
        return ""
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(value)
