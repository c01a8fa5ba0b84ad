"""The right side of the page: the chosen stage with its buttons, and what stands beside it."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import datetime

from PySide6.QtCore import QPointF, QSize, Qt, Signal
from PySide6.QtGui import QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QFrame,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.front.design.stages import CODE, EMPTY, FSM, HARDWARE, DesignStage
from smsl_studio.studio.base.badge import BadgeLook, badge_width
from smsl_studio.studio.base.controls import Elided, label, row, rule
from smsl_studio.studio.base.icons import icon, pixmap
from smsl_studio.studio.base.panels import empty_panel
from smsl_studio.studio.base.theme import CONTROL, Tokens, text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.design.card import paint_disc
from smsl_studio.studio.features.design.looks import (
    FEET,
    MAKERS,
    digest_words,
    foot_colours,
    when_words,
)
from smsl_studio.studio.features.design.sections import SideSection
from smsl_studio.studio.features.design.side_rows import PartRow, PlainRow
from smsl_studio.studio.features.design.stage_acts import ACTS, AGAIN, FROM_TEXT

BESIDE = 32
"""Words that are longer than this stand below the title of a section (characters)."""


class StageSide(QWidget):
    """Shows one stage. It asks for what its buttons say and does nothing by itself."""

    act_wanted = Signal(int)
    edit_wanted = Signal(int)
    open_wanted = Signal(int)
    holds_wanted = Signal(int)
    read_wanted = Signal(int)
    line_wanted = Signal(str, int, int)
    """(str, int, int): name, line and page of a text."""
    element_wanted = Signal(str)

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self.stage = DesignStage(FSM)
        self._sections: tuple[SideSection, ...] = ()
        self._disc = _StageNumber(tokens)
        self.title, self.badge = Elided(), _Standing(tokens)
        self.title.setProperty("role", "title")
        self._by, self.maker = label("", "second"), Elided()
        self.maker.setProperty("role", "second")
        self.act, self.edit, self.open = (QPushButton() for _ in range(3))
        self.holds = QPushButton(" Still holds")
        self.holds.setToolTip(tip_text("Say that you have looked at the change of the earlier "
                                       "stage, and that this one needs none"))  # fmt: skip
        self.read = QPushButton(" Read functions…")
        self.read.setToolTip(tip_text("Read the generated functions, and allow what you have read"))
        self.digest = label("", "mono")
        self.hint = label("", "hint")
        self.rows: list[PlainRow | PartRow] = []
        for button, wanted in (
            (self.act, self.act_wanted), (self.edit, self.edit_wanted),
            (self.open, self.open_wanted), (self.holds, self.holds_wanted),
            (self.read, self.read_wanted),
        ):  # fmt: skip
            button.setAutoDefault(False)
            button.clicked.connect(lambda _=False, w=wanted: w.emit(self.stage.number))
        self.act.setProperty("role", "soft")
        self.act.setFixedHeight(CONTROL)
        self._build()
        self.setAccessibleName("Chosen stage")

    def _build(self) -> None:
        made, column = empty_panel()
        upper = QVBoxLayout()
        upper.setContentsMargins(14, 12, 14, 10)
        upper.setSpacing(8)
        upper.addLayout(row(self._disc, self.title, self.badge))
        upper.addLayout(row(self._by, self.maker))
        upper.addLayout(row(self.act, self.edit, self.open, self.holds, self.read, None))
        upper.addLayout(row(self.digest, None))
        upper.addWidget(self.hint)
        column.addLayout(upper)
        self.bar = QVBoxLayout()
        column.addLayout(self.bar)
        column.addWidget(rule())
        self._inner, self._column = empty_panel()
        self.area = QScrollArea()
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setWidgetResizable(True)
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.area.setWidget(self._inner)
        column.addWidget(self.area, 1)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.addWidget(made)
        self.setMinimumWidth(320)

    def show_stage(self, stage: DesignStage, sections: Sequence[SideSection]) -> None:
        """Show a stage as it is now. Rows that are the same stay, and so does the place."""
        other = stage.number != self.stage.number
        self.stage = stage
        acts = ACTS[stage.number]
        self._disc.show_number(stage.number)
        self.title.setText(stage.name)
        self.badge.show_stage(stage)
        maker = stage.maker
        words = [maker.words if maker else "Not begun. Any stage may be entered by hand"]
        words.append(when_words(stage.when, datetime.now().astimezone()) if maker else "")
        self.maker.setText(", ".join(filter(None, words)))
        self.digest.setText(f"digest {digest_words(stage.digest)}" if stage.digest else "")
        self.digest.setToolTip(tip_text(stage.digest))
        self.digest.setVisible(bool(stage.digest))
        empty = stage.standing == EMPTY
        for button, said in (
            (self.act, FROM_TEXT if empty and acts.act is AGAIN else acts.act),
            (self.edit, acts.start if empty else acts.edit),
            (self.open, acts.open),
        ):
            button.setVisible(said is not None)
            if said is not None:
                button.setText(f" {said[0]}")
                button.setToolTip(tip_text(said[1]))
        self.holds.setVisible(bool(stage.own) and stage.number in (FSM, HARDWARE))
        self.read.setVisible(stage.number == CODE and stage.is_generated)
        self.hint.setText(acts.hint)
        self._dress()
        if tuple(sections) != self._sections or other:
            self._sections = tuple(sections)
            self._fill()
            if other:
                self.area.verticalScrollBar().setValue(0)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._disc.set_tokens(tokens)
        self.badge.set_tokens(tokens)
        self._dress()
        self._fill()

    def _dress(self) -> None:
        tokens, maker = self._tokens, self.stage.maker
        for button, name in (
            (self.act, "loop"), (self.edit, "pencil"), (self.open, "arrow"),
            (self.holds, "check"), (self.read, "eye"),
        ):  # fmt: skip
            button.setIcon(icon(name, tokens))
        self._by.setVisible(maker is not None)
        if maker is not None:
            self._by.setPixmap(pixmap(MAKERS[maker.kind], tokens.tx2, tokens.surf))

    def _fill(self) -> None:
        while (at := self._column.takeAt(0)) is not None:
            part = at.widget()
            if part is not None:
                part.hide()
                part.deleteLater()
        self.rows = []
        for section in self._sections:
            self._column.addWidget(_section_head(section))
            self._add_rows(section)
            self._column.addWidget(rule())
        self._column.addStretch(1)

    def _add_rows(self, section: SideSection) -> None:
        if not section.rows and not section.parts:
            empty = label(section.empty, "hint")
            empty.setContentsMargins(14, 0, 14, 10)
            self._column.addWidget(empty)
        for one in section.rows:
            plain = PlainRow(one, self._tokens)
            plain.clicked.connect(lambda _=False, one=one: self._lead(one.address, one.line))
            self._add(plain)
        for part in section.parts:
            beside = PartRow(part, self._tokens)
            beside.source_wanted.connect(
                lambda source: self.line_wanted.emit(source.file, source.line, source.page)
            )
            beside.element_wanted.connect(self.element_wanted)
            self._add(beside)

    def _add(self, made: PlainRow | PartRow) -> None:
        self.rows.append(made)
        self._column.addWidget(made)

    def _lead(self, address: str, line: tuple[str, int, int] | None) -> None:
        if line is not None:
            self.line_wanted.emit(*line)
        elif address:
            self.element_wanted.emit(address)


def _section_head(section: SideSection) -> QWidget:
    """The title of a section, and a number at its right. A sentence stands below the title."""
    made = QWidget()
    column = QVBoxLayout(made)
    column.setContentsMargins(14, 8, 14, 6)
    column.setSpacing(2)
    title = Elided(section.title)
    title.setProperty("role", "heading")
    beside = label(section.right, "small")
    if len(section.right) <= BESIDE:
        column.addLayout(row(title, beside))
    else:
        beside.setWordWrap(True)
        column.addWidget(title)
        column.addWidget(beside)
    return made


class _StageNumber(QWidget):
    """The number of the stage."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._number = tokens, 0
        self.setFixedSize(22, 22)

    def show_number(self, number: int) -> None:
        """Set the number."""
        self._number = number
        self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the disc."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_disc(painter, QPointF(11, 11), self._number, self._tokens, accent=True)
        painter.end()


class _Standing(QWidget):
    """How the stage stands, as a badge."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens, self._stage, self._font = tokens, DesignStage(FSM), text_font(12, 500)

    def show_stage(self, stage: DesignStage) -> None:
        """Set the stage."""
        self._stage = stage
        self.setFixedSize(QSize(min(300, badge_width(stage.foot, self._font)), 22))
        self.setToolTip(tip_text(stage.foot))
        self.update()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the badge."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        ink, ground = foot_colours(self._stage.standing, self._tokens)
        look = BadgeLook(FEET[self._stage.standing], ink, ground, self._stage.is_generated)
        box = self.rect().toRectF().adjusted(0.5, 0.5, -0.5, -0.5)
        look.paint(painter, box, self._stage.foot, self._font)
        painter.end()
