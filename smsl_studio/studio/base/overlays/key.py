"""The key to the short texts of compact nodes and labels."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

from smsl_studio.legible import plain_text
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.paint.ink import Type, draw_veil
from smsl_studio.studio.base.theme import Tokens, mono_font, text_font

ROW = 18
LONGEST = 46


class Key(QWidget):
    """Explains short texts at the top right while nodes show only their facts."""

    def __init__(self, parent: QWidget, tokens: Tokens) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self._code, self._words = Type(mono_font(12, 500)), Type(text_font(12))
        self._rows: tuple[tuple[str, str], ...] = ()
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    @property
    def rows(self) -> tuple[tuple[str, str], ...]:
        """Pairs of a short text and its meaning."""
        return self._rows

    def show_picture(self, picture: Picture | None, compact: bool) -> None:
        """Explain the short texts of a picture with one example for states and one for operations;
        hidden if all names are written out."""
        rows: list[tuple[str, str]] = []
        if picture is not None and len(picture) and compact:
            branch = picture.branch
            state = picture.first_shortened
            if state >= 0:
                names = [branch.fact_name(d) for d in range(branch.num_facts)]
                noted = any(branch.fact_note(d) for d in range(branch.num_facts))
                words = ", ".join(names) if noted else ""
                if not words or len(words) > LONGEST:
                    words = f"short for {picture.names[state]}"
                rows.append((picture.face(state).short, words))
            if picture.prefix:
                edge = next(e for e in range(len(picture.operations)) if picture.is_cut(e))
                rows.append((picture.label(edge), f"short for {picture.operations[edge]}"))
        self._rows = tuple(rows)
        self.setAccessibleName(plain_text("; ".join(f"{code}: {words}" for code, words in rows)))
        self.resize(self.sizeHint())
        self.setVisible(bool(rows))
        self.update()

    def sizeHint(self) -> QSize:
        """Wide enough for the longest row."""
        widths = [self._code.width(c) + 8 + self._words.width(w) for c, w in self._rows]
        return QSize(int(max(widths, default=0.0)) + 4, ROW * len(self._rows))

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the rows against the right edge, on a background that half hides the drawing."""
        painter = QPainter(self)
        draw_veil(painter, self.rect(), self.tokens)
        for i, (code, words) in enumerate(self._rows):
            y = i * ROW + ROW / 2
            x = self.width() - self._words.width(words) - 2
            self._words.draw_from(painter, x, y, words, self.tokens.tx2)
            self._code.draw_from(painter, x - 8 - self._code.width(code), y, code, self.tokens.tx)
        painter.end()
