"""The facts of a run as tiles, for worlds that have nothing to draw."""

from __future__ import annotations

from PySide6.QtCore import QAbstractListModel, QModelIndex, QObject, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QListView, QWidget

from smsl_studio.front.views.fact_tiles import FactTile
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.running.tile_painter import Index, TilePainter

LIGHT = 1200
"""Milliseconds for which a tile is lit after its value has changed."""
WIDE, HIGH, LOW = 176, 88, 64
"""The least width of a tile, its height, and its height if there are many (pixels)."""


class TilesModel(QAbstractListModel):
    """The tiles as a Qt model."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.tiles: tuple[FactTile, ...] = ()

    def show(self, tiles: tuple[FactTile, ...]) -> tuple[FactTile, ...]:
        """Show other tiles; returns those whose values have changed since the last call."""
        before, self.tiles = self.tiles, tiles
        if [one.key for one in before] != [one.key for one in tiles]:
            self.beginResetModel()
            self.endResetModel()
            return ()
        changed = []
        for at, (old, new) in enumerate(zip(before, tiles, strict=True)):
            if old != new:
                self.dataChanged.emit(self.index(at), self.index(at))
            if old.value != new.value:
                changed.append(new)
        return tuple(changed)

    def rowCount(self, parent: Index = QModelIndex()) -> int:  # noqa: B008
        """The number of tiles; a tile has no children."""
        return 0 if parent.isValid() else len(self.tiles)

    def data(self, index: Index, role: int = Qt.ItemDataRole.DisplayRole) -> object:
        """The tile in words, or the ``FactTile`` itself."""
        tile = self.tiles[index.row()]
        if role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.AccessibleTextRole):
            return plain_text(tile.said)
        if role == Qt.ItemDataRole.ToolTipRole:
            return tip_text(tile.said)
        return tile if role == Qt.ItemDataRole.UserRole else None


class TilesView(QListView):
    """A grid of tiles that fills its width. Arrow keys go from tile to tile."""

    chosen = Signal(object)
    """FactKey: the person clicked on the tile of this fact, or pressed Enter on it."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.tiles = TilesModel(self)
        self.setModel(self.tiles)
        self.painter = TilePainter(tokens, self)
        self.setItemDelegate(self.painter)
        self.setFlow(QListView.Flow.LeftToRight)
        self.setWrapping(True)
        self.setUniformItemSizes(True)
        self.setResizeMode(QListView.ResizeMode.Adjust)
        self.setFrameShape(QListView.Shape.NoFrame)
        self.setSelectionMode(QListView.SelectionMode.NoSelection)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollMode(QListView.ScrollMode.ScrollPerPixel)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setTabKeyNavigation(False)
        self.viewport().setAutoFillBackground(False)
        self.setAccessibleName("Facts as tiles")
        self.clicked.connect(lambda index: self.chosen.emit(self.tiles.tiles[index.row()].key))
        self.activated.connect(lambda index: self.chosen.emit(self.tiles.tiles[index.row()].key))
        self._dark = QTimer(self)
        self._dark.setSingleShot(True)
        self._dark.setInterval(LIGHT)
        self._dark.timeout.connect(lambda: self._light(frozenset()))

    @property
    def lit(self) -> frozenset[tuple[str, int]]:
        """The facts whose tiles are lit, because their values have just changed."""
        return self.painter.lit

    def show_tiles(self, tiles: tuple[FactTile, ...]) -> None:
        """Show these tiles. A tile whose value has changed is lit for a short time."""
        if tiles == self.tiles.tiles:
            return
        count = len(self.tiles.tiles)
        changed = self.tiles.show(tiles)
        if len(tiles) != count:
            self._light(frozenset())
            self._arrange()
        if changed:
            self._light(frozenset(tile.key for tile in changed))
            self._dark.start()
        self._reveal(tuple(tile for tile in tiles if tile.target) or changed)

    def show_chosen(self, keys: frozenset[tuple[str, int]]) -> None:
        """Frame the tiles of these facts."""
        if keys != self.painter.chosen:
            self.painter.chosen = keys
            self.viewport().update()

    def show_share(self, share: float) -> None:
        """Show how far the tokens of moving facts have got, from 0 to 1."""
        if share != self.painter.share:
            self.painter.share = share
            for at, tile in enumerate(self.tiles.tiles):
                if tile.target:
                    self.update(self.tiles.index(at))

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.painter.tokens = tokens
        self.viewport().update()

    def keyboardSearch(self, search: str, /) -> None:
        """Letters choose no tile, because they may be keys of the window."""

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Arrange the tiles in the new size."""
        super().resizeEvent(event)
        self._arrange()

    def _light(self, keys: frozenset[tuple[str, int]]) -> None:
        if keys != self.painter.lit:
            self.painter.lit = keys
            self.viewport().update()

    def _arrange(self) -> None:
        """Give the tiles the width of whole columns; if not all are in view they are low."""
        count = len(self.tiles.tiles)
        bar = self.verticalScrollBar()
        # Qt leaves room for a scroll bar, whether it is shown or not.
        wide = self.width() - bar.sizeHint().width() - 1
        high = self.viewport().height()
        columns = max(min(wide // WIDE, count or 1), 1)
        rows = -(-count // columns)
        size = QSize(min(wide // columns, 2 * WIDE), HIGH if rows * HIGH <= high else LOW)
        if size != self.gridSize():
            self.painter.size = size
            self.setGridSize(size)

    def _reveal(self, moving: tuple[FactTile, ...]) -> None:
        """Scroll to a tile that moves, unless one of them is in view."""
        keys = {tile.key for tile in moving}
        rows = [at for at, tile in enumerate(self.tiles.tiles) if tile.key in keys]
        rects = [self.visualRect(self.tiles.index(at)) for at in rows]
        if rects and not any(self.viewport().rect().contains(rect.center()) for rect in rects):
            self.scrollTo(self.tiles.index(rows[0]))
