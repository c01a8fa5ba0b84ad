"""The outline as a Qt model: each line is made when Qt asks for it.

A blueprint that was edited takes the place of the one before: the lines that are the same stay,
and with them what stands open, what is selected and how far the tree was scrolled.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from PySide6.QtCore import (
    QAbstractItemModel,
    QModelIndex,
    QObject,
    QPersistentModelIndex,
    Qt,
    Signal,
)

from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.draw.panels.outline_lines import OutlineLine
from smsl_studio.studio.features.draw.panels.outline_nodes import Key, OutlineNode, OutlineNodes

Index = QModelIndex | QPersistentModelIndex
NOWHERE = QModelIndex()
FEW = 50
"""Of so many SBs that were changed each line is told alone."""
_TEXTS = (int(Qt.ItemDataRole.DisplayRole), int(Qt.ItemDataRole.EditRole))
_TIP, _LINE = int(Qt.ItemDataRole.ToolTipRole), int(Qt.ItemDataRole.UserRole)
_PLAIN = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
_NAMED = _PLAIN | Qt.ItemFlag.ItemIsEditable


class OutlineModel(QAbstractItemModel):
    """The SBs, their facts and sub-SBs as a tree for Qt; a name is edited in place."""

    named = Signal(str, object, str)
    """(SB, digit or None, name): the name that the SB or its fact is to have was typed in place."""

    def __init__(self, blueprint: Blueprint, parent: QObject) -> None:
        super().__init__(parent)
        self.nodes = OutlineNodes(blueprint)
        self.worst: Mapping[str, str] = {}
        """The gravest finding of each SB (see ``worst_of``)."""

    # What Qt asks.

    def index(self, row: int, column: int, /, parent: Index = NOWHERE) -> QModelIndex:
        """The index of a line below another; an invalid one where there is none."""
        below = self.nodes.below(self.node(parent))
        if column == 0 and 0 <= row < len(below):
            return self.createIndex(row, 0, below[row].number)
        return QModelIndex()

    def parent(self, child: Index = NOWHERE, /) -> QModelIndex:  # type: ignore[override]
        """The index of the line above; an invalid one for a line at the top."""
        above = self.node(child).above
        return self.index_of(above) if above is not None else QModelIndex()

    def rowCount(self, /, parent: Index = NOWHERE) -> int:
        """How many lines stand below a line."""
        return len(self.nodes.below(self.node(parent)))

    def columnCount(self, /, parent: Index = NOWHERE) -> int:
        """One column."""
        return 1

    def hasChildren(self, /, parent: Index = NOWHERE) -> bool:
        """Whether lines stand below; answers without making them."""
        return self.nodes.leads_down(self.node(parent))

    def flags(self, index: Index, /) -> Qt.ItemFlag:
        """Names can be edited, except that of an import that failed."""
        # An import that failed stands below no SB.
        return _NAMED if self.node(index).key[0] else _PLAIN

    def data(self, index: Index, /, role: int = _TEXTS[0]) -> Any:
        """The text, the tip, or the ``OutlineLine`` itself."""
        if role in _TEXTS:
            return self.line(self.node(index)).text
        if role == _TIP:
            return tip_text(self.line(self.node(index)).tip)
        return self.line(self.node(index)) if role == _LINE else None

    def setData(self, index: Index, value: Any, /, role: int = _TEXTS[1]) -> bool:
        """A name was typed; the line says it when the blueprint does."""
        self.named.emit(*self.node(index).key, str(value).strip())
        return True

    # Lines and where they stand.

    def node(self, index: Index) -> OutlineNode:
        """The node of an index; the invisible one above all others where it is none."""
        found = self.nodes.node(index.internalId()) if index.isValid() else None
        return found if found is not None else self.nodes.root

    def index_of(self, node: OutlineNode) -> QModelIndex:
        """Where Qt finds a node."""
        return self.createIndex(node.row, 0, node.number) if node.above else QModelIndex()

    def line(self, node: OutlineNode) -> OutlineLine:
        """What a node says."""
        return self.nodes.line(node, self.worst)

    # Another blueprint.

    def begin(self, blueprint: Blueprint) -> None:
        """Show a blueprint that has nothing to do with the one before."""
        self.beginResetModel()
        self.nodes = OutlineNodes(blueprint)
        self.endResetModel()

    def show(self, blueprint: Blueprint) -> list[OutlineNode]:
        """Show a blueprint in place of the one before; the nodes that are new, or lead down now.

        Below a node that is new others are, which nobody has asked for yet.
        """
        before = self.nodes.blueprint
        changed = _changed(before, blueprint)
        self.nodes.replace(blueprint)
        others = before.branches.keys() != blueprint.branches.keys()
        fresh: list[OutlineNode] = []
        for node in list(self.nodes.asked.values()):
            # Whoever stood below what is gone is gone with it.
            mine = node.above is None or others or node.key[0] in changed
            if mine and self.nodes.asked.get(node.number) is node:
                fresh += self._renew(node)
        self._tell(before, changed)
        return fresh

    def _renew(self, node: OutlineNode) -> list[OutlineNode]:
        """Let what is to stand below a node stand there."""
        below, keys = self.nodes.below(node), self.nodes.keys(node)
        old = [one.key for one in below]
        if old == keys:
            return []
        first = _alike(old, keys)
        last = _alike(old[first:][::-1], keys[first:][::-1])
        gone, come = below[first : len(old) - last], keys[first : len(keys) - last]
        if len(gone) == len(come) and not any(self._stands(one.key) for one in gone):
            for one, key in zip(gone, come, strict=True):
                self.nodes.rename(one, key)
            return []
        index = self.index_of(node)
        if gone:
            self.beginRemoveRows(index, first, first + len(gone) - 1)
            self._put(node, first, len(gone), [])
            self.nodes.drop(gone)
            self.endRemoveRows()
        if not come:
            return []
        self.beginInsertRows(index, first, first + len(come) - 1)
        made = self.nodes.make(node, come, first)
        self._put(node, first, 0, made)
        self.endInsertRows()
        return made if old or node.above is None else [node]

    def _stands(self, key: Key) -> bool:
        """Whether the SB of a key is still there; where it is not it may have another name."""
        return not key[0] or key[0] in self.nodes.blueprint.branches

    def _put(self, node: OutlineNode, first: int, gone: int, come: list[OutlineNode]) -> None:
        below = self.nodes.below(node)
        below[first : first + gone] = come
        for row in range(first, len(below)):
            below[row].row = row

    def _tell(self, before: Blueprint, changed: set[str]) -> None:
        """Say that lines say something else now, or lead down for the first time."""
        after = self.nodes.blueprint
        if len(changed) > FEW or any(
            _leads(before.branches.get(name)) != _leads(after.branches.get(name))
            for name in changed
        ):
            self.layoutAboutToBeChanged.emit()
            self.layoutChanged.emit()
            return
        for name in changed:
            for node in self.nodes.standing((name, None)):
                index, below = self.index_of(node), node.below
                self.dataChanged.emit(index, index)
                if below:
                    self.dataChanged.emit(self.index_of(below[0]), self.index_of(below[-1]))


def _leads(branch: StateBranch | None) -> object:
    """What decides under which of an SB's lines there is something."""
    return None if branch is None else (bool(branch.table), branch.header.sub_sbs)


def _alike(some: list[Key], others: list[Key]) -> int:
    """How many keys both begin with."""
    count = 0
    for one, other in zip(some, others, strict=False):
        if one != other:
            break
        count += 1
    return count


def _changed(before: Blueprint, after: Blueprint) -> set[str]:
    """The SBs that are not the very same as before; an edit takes over what it does not touch."""
    return {
        name
        for name in before.branches.keys() | after.branches.keys()
        if before.branches.get(name) is not after.branches.get(name)
    }
