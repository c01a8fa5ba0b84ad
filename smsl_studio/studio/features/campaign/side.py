"""The chosen cell of a campaign: how its runs ended, and each run by its seed."""

from __future__ import annotations

from PySide6.QtCore import (
    QModelIndex,
    QPersistentModelIndex,
    QRectF,
    QSize,
    Qt,
    QTimer,
    Signal,
)
from PySide6.QtGui import QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import (
    QListView,
    QPushButton,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.campaign_runs import RunVerdict
from smsl_studio.front.campaign_tally import (
    KINDS,
    REFUSED,
    CampaignCell,
    CampaignShare,
    kind_of,
    share_of,
)
from smsl_studio.front.recordings import Recording
from smsl_studio.studio.base.controls import Elided, label, row, rule
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.rows import ListRow, RowsView, TextInk, paint_text
from smsl_studio.studio.base.theme import RADIUS_CONTROL, Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.campaign.atlas import UNDISTURBED, names_of
from smsl_studio.studio.features.campaign.marks import ICONS, WORDS, inks, paint_share
from smsl_studio.studio.features.campaign.run_story import RunStory

TILE_WIDE, TILE_HIGH = 38, 32
TILE_ROWS = 2
"""So many rows of tiles are seen at once; the others are scrolled to."""
QUIET = 300
"""Milliseconds after which the run that is chosen is looked at."""
AGAIN = "The run of seed {} is carried out again, to show its events…"
NOTHING = "Choose a cell of the table to see its runs."
Index = QModelIndex | QPersistentModelIndex


class _Tiles(QStyledItemDelegate):
    """Paints a run as a tile: its seed, and the sign of its end."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """The size of a tile with its margin."""
        return QSize(TILE_WIDE, TILE_HIGH)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one tile."""
        told: ListRow = index.data(Qt.ItemDataRole.UserRole)
        seed, verdict = told.payload
        ink, ground = inks(kind_of(verdict), self.tokens)
        box = QRectF(option.rect).adjusted(2.5, 2.5, -2.5, -2.5)
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        painter.setPen(QPen(self.tokens.acc if chosen else ink, 2 if chosen else 1))
        painter.setBrush(ground)
        painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
        paint_text(painter, box.adjusted(5, 0, 0, -12), f"{seed}", TextInk(self.tokens.tx, 11))
        sign = QRectF(box.right() - 16, box.bottom() - 14, 10, 10)
        draw(painter, ICONS[kind_of(verdict)], sign, ink, ground)
        painter.restore()


class _Share(QWidget):
    """A share with its interval, from 0 to 100 %."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self.tokens, self.share = tokens, CampaignShare(0, 0)
        self.setFixedHeight(18)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint it."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        paint_share(painter, QRectF(self.rect()), self.share, self.tokens)
        painter.end()


class CampaignSide(QWidget):
    """The column at the right of the table."""

    finding_wanted = Signal()
    """The person wants this cell, which ended otherwise than foreseen, on the drawing."""
    replay_wanted = Signal(int)
    """int: the seed of the run that the person wants to see again."""
    story_wanted = Signal(int)
    """int: the seed of the run whose events are to be shown here."""

    def __init__(self, tokens: Tokens) -> None:
        super().__init__()
        self._tokens = tokens
        self._cell: CampaignCell | None = None
        self._shown: tuple[CampaignCell | None, int] = (None, -1)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.title, self.states = label("", "heading"), label("", "second")
        self.empty = label(NOTHING, "hint")
        self.counts = {kind: label("", "second") for kind in KINDS}
        self.between, self.after = Elided(), label("", "small")
        self._share = _Share(tokens)
        self.story = RunStory(tokens)
        self._told: tuple[CampaignCell | None, int | None] = (None, None)
        self._quiet = QTimer(self)
        self._quiet.setSingleShot(True)
        self._quiet.setInterval(QUIET)
        self._quiet.timeout.connect(self._look)
        self.runs = RowsView(tokens)
        self.runs.setItemDelegate(_Tiles(tokens, self.runs))
        self.runs.setViewMode(QListView.ViewMode.IconMode)
        self.runs.setMovement(QListView.Movement.Static)
        self.runs.setResizeMode(QListView.ResizeMode.Adjust)
        self.runs.setUniformItemSizes(True)
        self.runs.setFrameShape(QListView.Shape.NoFrame)
        self.runs.setAccessibleName("Runs by seed")
        self.replay = QPushButton("Replay")
        self.replay.setProperty("role", "primary")
        self.replay.setFixedHeight(36)
        self.replay.setToolTip(
            tip_text("Carry this very run out again with its seed and its fault, and show it")
        )
        self.foreseen = label("", "small")
        self.foreseen.setWordWrap(True)
        self.finding = QPushButton("Open as finding")
        self.finding.setToolTip(
            tip_text("Write a note at the state where the operation begins, and show it in Draw")
        )
        self.finding.clicked.connect(self.finding_wanted)
        self.after.setToolTip("So many reached the goal after something went wrong")
        self.told = label("", "small")
        self.told.setWordWrap(True)
        self.told.hide()
        self.replay.clicked.connect(self._ask)
        self.runs.activated.connect(lambda _: self._ask())
        self.runs.doubleClicked.connect(lambda _: self._ask())
        self.runs.selectionModel().currentChanged.connect(lambda *_: self._name_run())
        self._build()
        self.show_cell(None, None)

    def _build(self) -> None:
        self._whole = QWidget()
        inner = QVBoxLayout(self._whole)
        inner.setContentsMargins(0, 0, 0, 0)
        inner.setSpacing(6)
        inner.addLayout(row(self.title, None, self.states))
        inner.addLayout(row(*self.counts.values(), self.after, None, spacing=14))
        inner.addWidget(self.between)
        inner.addWidget(self._share)
        inner.addWidget(self.foreseen)
        inner.addWidget(self.finding)
        inner.addWidget(rule())
        inner.addWidget(self.runs)
        inner.addWidget(self.told)
        inner.addWidget(self.replay)
        inner.addWidget(rule())
        inner.addWidget(self.story, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(14, 12, 14, 12)
        column.addWidget(self.empty)
        column.addWidget(self._whole, 1)
        column.addStretch(0)

    @property
    def seed(self) -> int | None:
        """The seed of the chosen run, or None."""
        payload = self.runs.current_payload
        return payload[0] if payload is not None else None

    def show_cell(self, cell: CampaignCell | None, blueprint: Blueprint | None) -> None:
        """Show a cell. None shows what to do."""
        self._cell = cell
        self.empty.setVisible(cell is None)
        self._whole.setVisible(cell is not None)
        if cell is None or blueprint is None:
            return
        now = cell, cell.runs
        if now == self._shown:
            return
        self._shown = now
        name, states = names_of(cell.edge, blueprint)
        self.title.setText(f"{name}, {cell.fault.replace('_', ' ') or UNDISTURBED}")
        self.states.setText(states)
        for kind, shown in self.counts.items():
            shown.setText(f"{cell.counts[kind]:,} {WORDS[kind]}")
            shown.setVisible(kind != REFUSED or cell.counts[kind] > 0)
        share = self._share.share = share_of([cell])
        part = (
            f"Reached {100 * share.reached / share.runs:.0f} %"
            if share.runs
            else share.nothing.capitalize()
        )
        between = f", 95 % interval {100 * share.low:.0f} to {100 * share.high:.0f} %"
        self.between.setText(f"{part}{between if share.runs else ''}")
        after = f"{cell.recovered:,} recovered" if cell.recovered else ""
        self.after.setText(after)
        self.after.setVisible(bool(after))
        self._share.update()
        self.runs.show_rows([_row(one, cell.verdicts[one]) for one in sorted(cell.verdicts)])
        if self.seed is None and cell.verdicts:
            self.runs.setCurrentIndex(self.runs.rows.index(0))
        self._fit_tiles()
        self._name_run()

    def show_story(self, recording: Recording, seed: int) -> None:
        """Show the events of a run, if it is still the chosen one."""
        if self._cell is not None and seed == self.seed:
            verdict = self._cell.verdicts[seed]
            self.story.show_recording(recording, seed, WORDS[kind_of(verdict)])

    def show_foreseen(self, cell: CampaignCell | None) -> None:
        """Show how the runs were foreseen to end. If they ended otherwise, a button offers to open
        that as a finding."""
        told = cell.foreseen if cell is not None and cell.runs >= cell.seeds else None
        differs = cell is not None and cell.differs
        other = ". They ended otherwise" if differs else ""
        words = f"Foreseen: {told.end}, because {told.why}{other}." if told is not None else ""
        self.foreseen.setText(words)
        self.foreseen.setVisible(bool(words))
        self.finding.setVisible(differs)

    def say(self, words: str) -> None:
        """Say what is being done with the chosen run; empty says nothing."""
        self.told.setText(words)
        self.told.setVisible(bool(words))
        self._name_run()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = self._share.tokens = tokens
        self.story.set_tokens(tokens)
        delegate = self.runs.itemDelegate()
        assert isinstance(delegate, _Tiles)
        delegate.tokens = tokens
        self.runs.viewport().update()
        self.update()

    def _name_run(self) -> None:
        seed = self.seed
        self.replay.setText("Replay" if seed is None else f"Replay the run of seed {seed}")
        self.replay.setEnabled(seed is not None and not self.told.text())
        if (self._cell, seed) != self._told:
            self._told = self._cell, seed
            self.story.show_words(AGAIN.format(seed) if seed is not None else "")
            self._quiet.start()

    def _look(self) -> None:
        if self.seed is not None and self.isVisible():
            self.story_wanted.emit(self.seed)

    def _fit_tiles(self) -> None:
        """Give the tiles the height of their rows."""
        across = max(self.runs.viewport().width() // TILE_WIDE, 1)
        rows = -(-self.runs.rows.rowCount() // across)
        self.runs.setFixedHeight(TILE_HIGH * min(max(rows, 1), TILE_ROWS) + 2)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Make the tiles fit the new width."""
        super().resizeEvent(event)
        self._fit_tiles()

    def _ask(self) -> None:
        if self.seed is not None and self.replay.isEnabled():
            self.replay_wanted.emit(self.seed)


def _row(seed: int, verdict: RunVerdict) -> ListRow:
    kind = WORDS[kind_of(verdict)]
    after = ", after something went wrong" if verdict.recovered else ""
    why = f" ({verdict.reason})" if not verdict.reached else ""
    return ListRow(f"Seed {seed}", (seed, verdict), right=f"{kind}{after}{why}",
                   tip=f"Seed {seed}: {kind}{after}{why}. Enter replays it")  # fmt: skip
