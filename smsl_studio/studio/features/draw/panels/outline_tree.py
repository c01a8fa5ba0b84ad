"""The tree widget of the outline, and the delegate that paints its lines."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence

from PySide6.QtCore import (
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QRect,
    QRectF,
    QSize,
    Qt,
    Signal,
)
from PySide6.QtGui import QFontMetricsF, QKeyEvent, QMouseEvent, QPainter, QPen
from PySide6.QtWidgets import (
    QLineEdit,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QTreeView,
    QWidget,
)

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.legible import plain_text
from smsl_studio.picture.chip_kinds import VALUE
from smsl_studio.studio.base.chips import paint_chip
from smsl_studio.studio.base.icons import SEVERITY_ICON, draw, severity_colour
from smsl_studio.studio.base.rows import TextInk, paint_text
from smsl_studio.studio.base.theme import Tokens, mono_font
from smsl_studio.studio.features.draw.panels.outline_lines import OutlineLine
from smsl_studio.studio.features.draw.panels.outline_model import OutlineModel
from smsl_studio.studio.features.draw.panels.outline_nodes import Key, OutlineNode

ROW, INDENT = 28, 13
NAMEABLE = 40
"""Free pixels after the name of an SB that are needed to show its file name."""
FULL = 1_000
"""At most this many lines are expanded at the start."""
Index = QModelIndex | QPersistentModelIndex


class OutlineTree(QTreeView):
    """The tree of the outline. It remembers which lines a person has collapsed."""

    moved = Signal(QModelIndex)
    """QModelIndex: the current line has changed, but not by ``mark``."""
    named = Signal(str, object, str)
    """(SB, digit or None, name): the person typed this name for the SB or the fact."""

    def __init__(self, tokens: Tokens, blueprint: Blueprint, parent: QWidget) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.lines = OutlineModel(blueprint, self)
        self.lines.named.connect(self.named)
        self._closed: set[Key] = set()
        self._quiet = False
        self.setModel(self.lines)
        self.setAccessibleName("State Branches")
        self.setHeaderHidden(True)
        self.setIndentation(INDENT)
        self.setUniformRowHeights(True)
        self.setMouseTracking(True)
        self.setExpandsOnDoubleClick(False)
        self.setEditTriggers(QTreeView.EditTrigger.NoEditTriggers)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._delegate = OutlineDelegate(tokens, self)
        self.setItemDelegate(self._delegate)
        self.collapsed.connect(lambda index: self._closed.add(self.lines.node(index).key))
        self.expanded.connect(lambda index: self._closed.discard(self.lines.node(index).key))
        self._open(self.lines.nodes.top, ())

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = self._delegate.tokens = tokens
        self.viewport().update()

    def set_run(self, active: Mapping[str, str], running: str) -> None:
        """Show the active state of each SB. ``running`` is the SB in which an operation runs."""
        if (active, running) != (self._delegate.active, self._delegate.running):
            self._delegate.active, self._delegate.running = dict(active), running
            self.viewport().update()

    @property
    def active(self) -> Mapping[str, str]:
        """The active state of each SB that a run shows here."""
        return self._delegate.active

    @property
    def naming(self) -> bool:
        """Whether a name is being edited."""
        return self.state() == QTreeView.State.EditingState

    def index_of(self, branch: str, digit: int | None = None) -> QModelIndex:
        """The first line of an SB or of one of its facts; a line above it may be collapsed."""
        node = self.lines.nodes.first((branch, digit)) if branch else None
        return self.lines.index_of(node) if node is not None else QModelIndex()

    def show_marks(self, worst: Mapping[str, str]) -> None:
        """Mark every SB with its worst severity letter."""
        self.lines.worst = worst
        self.viewport().update()

    def show_blueprint(self, blueprint: Blueprint, another: bool) -> None:
        """Show a blueprint. ``another`` says that it is of another file.

        For the same file, collapsed lines stay collapsed.
        """
        self.blockSignals(True)
        if another:
            self._closed.clear()
            self.lines.begin(blueprint)
            self._open(self.lines.nodes.top, ())
        else:
            self._open(self.lines.show(blueprint), self._closed)
        self.blockSignals(False)
        self.viewport().update()

    def mark(self, index: Index) -> None:
        """Make a line the current one (or none) without emitting ``moved``."""
        self._quiet = True
        if index.isValid():
            command = QItemSelectionModel.SelectionFlag.ClearAndSelect
            self.selectionModel().setCurrentIndex(index, command)
        else:
            self.clearSelection()
        self._quiet = False

    def _open(self, nodes: Sequence[OutlineNode], closed: Container[Key]) -> None:
        """Expand lines and everything below them, from the top, up to ``FULL`` lines.

        Lines in ``closed`` stay collapsed, but lines below them are expanded.
        """
        known, room = self.lines.nodes, FULL
        if nodes:
            # One layout for all lines, not one for each expanded line.
            self.scheduleDelayedItemsLayout()
        for begun in nodes:
            room -= 1
            if room <= 0:
                return
            stack = [begun]
            while stack:
                node = stack.pop()
                below = known.below(node)
                if below and len(below) <= room:
                    room -= len(below)
                    stack += reversed(below)
                    if node.key not in closed:
                        self.expand(self.lines.index_of(node))

    def currentChanged(self, current: Index, previous: Index) -> None:
        """Emit ``moved``, unless ``mark`` changed the current line."""
        super().currentChanged(current, previous)
        if not self._quiet:
            self.moved.emit(current)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Limit what the key ``*`` expands, because it could be far too much."""
        if event.key() == Qt.Key.Key_Asterisk:
            node = self.lines.node(self.currentIndex())
            self._open([node] if node.above is not None else [], ())
            return
        super().keyPressEvent(event)

    def keyboardSearch(self, search: str, /) -> None:
        """Do nothing: letters must not move the current line, because Del acts on it.

        The palette finds SBs and facts by letters.
        """

    def drawBranches(self, painter: QPainter, rect: QRect, index: Index) -> None:
        """Paint the background left of a selected line; tree lines are not drawn."""
        if self.selectionModel().isSelected(index):
            painter.fillRect(rect, self._tokens.accs)

    def drawRow(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint the line, and a chevron if it has children."""
        super().drawRow(painter, option, index)
        if self.model().hasChildren(index):
            row = self.visualRect(index)
            name = "chevron-down" if self.isExpanded(index) else "chevron-right"
            box = QRectF(row.left() - 5, row.center().y() - 4.5, 11, 11)
            draw(painter, name, box, self._tokens.tx2, self._tokens.surf)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Expand or collapse on a click on the chevron at the left end of the line."""
        index = self.indexAt(event.position().toPoint())
        near = index.isValid() and self.model().hasChildren(index)
        if near and event.position().x() < self.visualRect(index).left() + 9:
            self.setExpanded(index, not self.isExpanded(index))
            return
        super().mousePressEvent(event)


class OutlineDelegate(QStyledItemDelegate):
    """Paints SBs, facts and failed imports, and makes the field for a new name."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens
        self.active: Mapping[str, str] = {}
        self.running = ""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """All lines have the same height."""
        return QSize(10, ROW)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Paint one line."""
        line: OutlineLine = index.data(Qt.ItemDataRole.UserRole)
        rect = QRectF(option.rect)
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        painter.save()
        if chosen:
            painter.fillRect(rect, self.tokens.accs)
        if line.digit is None:
            self._branch(painter, rect, line, chosen)
        else:
            self._fact(painter, rect, line)
        if chosen and option.state & QStyle.StateFlag.State_HasFocus:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.setPen(QPen(self.tokens.acc, 2))
            painter.drawRect(rect.adjusted(1, 1, -1, -1))
        painter.restore()

    def _branch(self, painter: QPainter, rect: QRectF, line: OutlineLine, chosen: bool) -> None:
        tokens = self.tokens
        mid = rect.center().y()
        badge = QRectF(rect.right() - 31, mid - 10, 20, 20)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if not line.fault:
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(tokens.sunk)
            painter.drawRoundedRect(badge, 4, 4)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            paint_text(
                painter, badge.adjusted(6.5, 0, 0, 0), line.right, TextInk(tokens.tx2, 11, 500)
            )
        # A failed import has no level; its severity icon is drawn there.
        right = badge.right() - 1 if line.fault else badge.left() - 6
        if line.severity:
            box = QRectF(right - 15, mid - 7, 14, 14)
            colour = severity_colour(line.severity, tokens)
            draw(painter, SEVERITY_ICON[line.severity], box, colour, tokens.surf)
            right -= 21
        if line.branch in self.active:
            right = self._active(painter, rect, right, line.branch)
        box = QRectF(rect.left() + 14, mid - 7.5, 15, 15)
        icon = "file" if line.fault else "layers"
        draw(painter, icon, box, tokens.acc if chosen else tokens.tx2, tokens.surf)
        room = QRectF(rect.left() + 38, rect.top(), right - rect.left() - 38, rect.height())
        if line.fault:
            used = paint_text(painter, room, line.text, TextInk(tokens.tx2))
        else:
            used = paint_text(painter, room, line.text, TextInk(tokens.tx, 13, 600))
        behind = line.right if line.fault else line.home
        if behind and room.width() - used > NAMEABLE:
            paint_text(painter, room.adjusted(used + 8, 0, 0, 0), behind, TextInk(tokens.tx2, 12))

    def _active(self, painter: QPainter, rect: QRectF, right: float, branch: str) -> float:
        """Paint the active state of an SB as a chip. Returns the x where the name has to end."""
        tokens, live = self.tokens, branch == self.running
        font = mono_font(11, 500)
        metrics = QFontMetricsF(font)
        room = max(rect.width() / 2 - 30, 20.0)
        words = metrics.elidedText(
            plain_text(self.active[branch]), Qt.TextElideMode.ElideLeft, room
        )
        wide = metrics.horizontalAdvance(words) + 10
        chip = QRectF(right - wide, rect.center().y() - 9, wide, 18)
        painter.setPen(QPen(tokens.acc if live else tokens.accl, 1))
        painter.setBrush(tokens.acc if live else tokens.accs)
        painter.drawRoundedRect(chip, 4, 4)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(tokens.onacc if live else tokens.acc)
        painter.setFont(font)
        painter.drawText(chip, Qt.AlignmentFlag.AlignCenter, plain_text(words))
        return chip.left() - 6

    def _fact(self, painter: QPainter, rect: QRectF, line: OutlineLine) -> None:
        tokens = self.tokens
        chip = QRectF(rect.left() + 15, rect.center().y() - 9, 18, 18)
        paint_chip(painter, chip, str(line.digit), VALUE, tokens, sub=line.sub)
        right = rect.right() - 12
        if line.right:
            room = rect.adjusted(rect.width() / 2, 0, -12, 0)
            right -= paint_text(
                painter, room, line.right, TextInk(tokens.tx2, 12, mono=True), right=True
            )
        room = QRectF(rect.left() + 41, rect.top(), right - rect.left() - 47, rect.height())
        paint_text(painter, room, line.text, TextInk(tokens.tx))

    def updateEditorGeometry(
        self, editor: QWidget, option: QStyleOptionViewItem, index: Index
    ) -> None:
        """Put the field over the name, right of the icon."""
        rect: QRect = option.rect
        left = 33 if line_of(index).digit is None else 36
        editor.setGeometry(rect.adjusted(left, 0, -4, 0))

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: Index) -> QWidget:
        """A flat field whose accessible name says what is being named."""
        editor = QLineEdit(parent)
        editor.setProperty("role", "flat")
        line = line_of(index)
        what = "the State Branch" if line.digit is None else f"{line.text}, digit {line.digit}"
        editor.setAccessibleName(plain_text(f"Name of {what}"))
        editor.setStyleSheet("background: palette(base);")
        return editor


def line_of(index: Index) -> OutlineLine:
    """The line at an index."""
    found: OutlineLine = index.data(Qt.ItemDataRole.UserRole)
    return found
