"""The right column: changes since the last signature, hazards, and the part in which one signs."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QFrame, QPushButton, QScrollArea, QVBoxLayout, QWidget

from smsl_studio.front.approval_badge import ApprovalWords
from smsl_studio.front.review_matter import ReviewMatter
from smsl_studio.inspection.review.reviewed import ReviewedLine, ReviewedReading
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Label, label, row
from smsl_studio.studio.base.icons import icon, pixmap
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text

WIDE = 372
"""The width of the column at the usual text size (pixels)."""
MOST = 40
"""At most so many changes are listed; the report has all of them."""
HAZARDS = "hazards"
NEVER = "Never signed. Everything is new."


class SideColumn(QWidget):
    """What a person must know before signing, and the button for it."""

    hazard_wanted = Signal(str)
    """str: the key of the line of a hazard."""
    sign_wanted = Signal()
    reject_wanted = Signal()

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setProperty("role", "side")
        self.changes, self.hazards = (
            _TitledRows("Since the last signature"),
            _TitledRows("Hazards and controls"),
        )
        inner = QWidget()
        inner.setProperty("role", "side")
        inside = QVBoxLayout(inner)
        inside.setContentsMargins(20, 16, 16, 16)
        inside.setSpacing(20)
        inside.addWidget(self.changes)
        inside.addWidget(self.hazards)
        inside.addStretch(1)
        above = QScrollArea()
        above.setWidgetResizable(True)
        above.setAccessibleName("Changes and hazards")
        above.setWidget(inner)
        self.sign = QPushButton(" Sign")
        self.sign.setProperty("role", "primary")
        self.sign.clicked.connect(self.sign_wanted)
        self.reject = QPushButton("Reject…")
        self.reject.setToolTip(tip_text("Sign that this procedure must not be used"))
        self.reject.clicked.connect(self.reject_wanted)
        self.why = label("", "sideText")
        self.why.setWordWrap(True)
        self._signers = QVBoxLayout()
        below = QWidget()
        below.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        below.setProperty("role", "signPart")
        sign = QVBoxLayout(below)
        sign.setContentsMargins(20, 14, 16, 16)
        sign.setSpacing(8)
        sign.addWidget(label("Sign", "sideTitle"))
        sign.addLayout(self._signers)
        sign.addWidget(self.why)
        buttons = row(self.sign, self.reject)
        buttons.setStretch(0, 1)
        sign.addLayout(buttons)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(above, 1)
        column.addWidget(below)
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.sign.setIcon(icon("pencil", tokens, 16, tokens.tx3))

    def show_matter(self, matter: ReviewMatter | None, seen: ReviewedReading | None) -> None:
        """Show changes and hazards."""
        self.changes.show_rows(self._changes(matter))
        hazards = () if seen is None else seen.of_section(HAZARDS)
        hazards = tuple(sorted(hazards, key=lambda one: not one.line.open_point))
        self.hazards.show_rows(self._hazard(one) for one in hazards)
        self.hazards.setVisible(bool(hazards))

    def show_signing(self, reasons: tuple[str, ...], approval: ApprovalWords, person: str) -> None:
        """Show who has signed, and whether this person can sign now."""
        _empty(self._signers)
        reasons_ = (one.rstrip(".") for one in approval.reasons[:3])
        told = ". ".join((approval.words, *reasons_))
        self._signers.addWidget(_signer(told, approval.is_good))
        if not any(words.startswith(f"{person} (") for words in approval.reasons):
            self._signers.addWidget(_signer(f"{person}, you: not yet signed", False))
        self.why.setText(
            "You cannot sign yet. " + " ".join(reasons)
            if reasons
            else "Every line has your answer, and no comment is open."
        )
        self.sign.setEnabled(not reasons)
        colour = self._tokens.onacc if not reasons else self._tokens.tx3
        self.sign.setIcon(icon("pencil", self._tokens, 16, colour))

    def _changes(self, matter: ReviewMatter | None) -> Iterator[QWidget]:
        if matter is None:
            return
        if matter.fault:
            yield _text(matter.fault)
            return
        if not matter.former:
            yield _text(NEVER)
            return
        yield _text(f"Compared with {matter.former}")
        if not matter.since:
            yield _text("Nothing has changed.")
        tokens = self._tokens
        for line in matter.since[:MOST]:
            kind = line.heading.partition(":")[0]
            name, ink = {
                "Removed": ("minus", tokens.bad),
                "Added": ("plus", tokens.ok),
            }.get(kind, ("loop", tokens.acc))
            yield self._row(name, ink, line.heading, " ".join(line.text))
        if len(matter.since) > MOST:
            yield _text(f"And {len(matter.since) - MOST:,} more; the report has them.")

    def _hazard(self, one: ReviewedLine) -> QWidget:
        tokens, line = self._tokens, one.line
        name, ink = ("warning", tokens.risk) if line.open_point else ("shield", tokens.ok)
        words = line.text[-1] if line.open_point and line.text else " ".join(line.text[-3:-1])
        if line.open_point:
            words = next((text for text in line.text if text.startswith("Open:")), words)
            words += " Noted." if one.approval is not None else " Your remark is needed."
        else:
            words = next(
                (text for text in line.text if text in ("Controlled.", "Shown to hold.")), words
            )
        link = QPushButton("Show the line")
        link.setProperty("role", "link")
        link.setAccessibleName(plain_text(f"Show the line: {line.heading}"))
        link.clicked.connect(lambda: self.hazard_wanted.emit(line.key))
        return self._row(name, ink, line.heading, words, link)

    def _row(
        self, name: str, ink: QColor, heading: str, words: str, link: QWidget | None = None
    ) -> QWidget:
        made = QWidget()
        across = row(spacing=10)
        made.setLayout(across)
        picture = Label()
        picture.setPixmap(pixmap(name, ink, self._tokens.surf, 18, self.devicePixelRatioF()))
        across.addWidget(picture, 0, Qt.AlignmentFlag.AlignTop)
        column = QVBoxLayout()
        column.setSpacing(2)
        column.addWidget(_text(heading, "sideStrong"))
        if words:
            column.addWidget(_text(words))
        if link is not None:
            column.addWidget(link)
        across.addLayout(column, 1)
        return made


class _TitledRows(QWidget):
    """A title with rows below it."""

    def __init__(self, title: str) -> None:
        super().__init__()
        self._rows = QVBoxLayout()
        self._rows.setSpacing(10)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(10)
        column.addWidget(label(title, "sideTitle"))
        column.addLayout(self._rows)

    def show_rows(self, rows: Iterator[QWidget]) -> None:
        """Replace the rows."""
        _empty(self._rows)
        for one in rows:
            self._rows.addWidget(one)


def _empty(layout: QVBoxLayout) -> None:
    while (item := layout.takeAt(0)) is not None:
        widget = item.widget()
        if widget is not None:
            widget.hide()
            widget.deleteLater()


def _signer(words: str, signed: bool) -> QFrame:
    made = QFrame()
    made.setProperty("role", "signer")
    made.setProperty("kind", "signed" if signed else "")
    column = QVBoxLayout(made)
    column.setContentsMargins(10, 8, 10, 8)
    column.addWidget(_text(words))
    return made


def _text(words: str, role: str = "sideText") -> Label:
    made = label(words, role)
    made.setWordWrap(True)
    return made
