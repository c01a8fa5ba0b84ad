"""The outline as a Qt model. Lines are made when Qt asks for them.

After an edit, the lines that did not change stay in the model. So expanded lines, the selection and
the scroll position stay, too.
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
from smsl_studio.studio.features.draw.panels.outline_lines import OutlineLine, fact_line
from smsl_studio.studio.features.draw.panels.outline_nodes import (
    Key,
    OutlineNode,
    OutlineNodes,
    has_facts,
)

Index = QModelIndex | QPersistentModelIndex
NOWHERE = QModelIndex()
FEW = 50
"""If more SBs have changed, Qt is told that everything changed."""
_TEXTS = (int(Qt.ItemDataRole.DisplayRole), int(Qt.ItemDataRole.EditRole))
_TIP, _LINE = int(Qt.ItemDataRole.ToolTipRole), int(Qt.ItemDataRole.UserRole)
_SAID = int(Qt.ItemDataRole.AccessibleTextRole)
_PLAIN = Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable
_NAMED = _PLAIN | Qt.ItemFlag.ItemIsEditable


class OutlineModel(QAbstractItemModel):
    """The SBs, their facts and sub-SBs as a tree for Qt. Names can be edited."""

    named = Signal(str, object, str)
    """(SB, digit or None, name): the person typed this name for the SB or the fact."""

    def __init__(self, blueprint: Blueprint, parent: QObject) -> None:
        super().__init__(parent)
        self.nodes = OutlineNodes(blueprint)
        self.worst: Mapping[str, str] = {}
        """The worst severity letter of each SB (see ``worst_of``)."""

    # What Qt asks.

    def index(self, row: int, column: int, /, parent: Index = NOWHERE) -> QModelIndex:
        """The index of a line below another; invalid if there is none."""
        below = self.nodes.below(self.node(parent))
        if column == 0 and 0 <= row < len(below):
            return self.createIndex(row, 0, below[row].number)
        return QModelIndex()

    def parent(self, child: Index = NOWHERE, /) -> QModelIndex:  # type: ignore[override]
        """The index of the line above; invalid for a line at the top."""
        above = self.node(child).above
        return self.index_of(above) if above is not None else QModelIndex()

    def rowCount(self, /, parent: Index = NOWHERE) -> int:
        """How many lines are below a line."""
        return len(self.nodes.below(self.node(parent)))

    def columnCount(self, /, parent: Index = NOWHERE) -> int:
        """One column."""
        return 1

    def hasChildren(self, /, parent: Index = NOWHERE) -> bool:
        """Whether lines are below this one; it does not make them."""
        return self.nodes.leads_down(self.node(parent))

    def flags(self, index: Index, /) -> Qt.ItemFlag:
        """Names can be edited, except the name of a failed import."""
        # A failed import has no SB in its key.
        return _NAMED if self.node(index).key[0] else _PLAIN

    def data(self, index: Index, /, role: int = _TEXTS[0]) -> Any:
        """The text, the words for a screen reader, the tooltip or the ``OutlineLine`` of a line."""
        if role in _TEXTS:
            return self.line(self.node(index)).text
        if role == _SAID:
            node = self.node(index)
            above = node.above if node.above is not None and node.above.above is not None else None
            return self.line(node).words(self.line(above) if above is not None else None)
        if role == _TIP:
            return tip_text(self.line(self.node(index)).tip)
        return self.line(self.node(index)) if role == _LINE else None

    def setData(self, index: Index, value: Any, /, role: int = _TEXTS[1]) -> bool:
        """Emit ``named`` for a typed name. The line changes when the blueprint has the name."""
        self.named.emit(*self.node(index).key, str(value).strip())
        return True

    # Lines and indexes.

    def node(self, index: Index) -> OutlineNode:
        """The node of an index; the invisible root for an invalid one."""
        found = self.nodes.node(index.internalId()) if index.isValid() else None
        return found if found is not None else self.nodes.root

    def index_of(self, node: OutlineNode) -> QModelIndex:
        """The index of a node."""
        return self.createIndex(node.row, 0, node.number) if node.above else QModelIndex()

    def line(self, node: OutlineNode) -> OutlineLine:
        """The content of a node."""
        return self.nodes.line(node, self.worst)

    # Another blueprint.

    def begin(self, blueprint: Blueprint) -> None:
        """Show the blueprint of another file; nothing of the old one is kept."""
        self.beginResetModel()
        self.nodes = OutlineNodes(blueprint)
        self.endResetModel()

    def show(self, blueprint: Blueprint) -> list[OutlineNode]:
        """Show the blueprint after an edit. Returns the nodes that have to be expanded.

        These are new nodes, and nodes that have children for the first time. The children of a new
        node are not made yet.
        """
        before = self.nodes.blueprint
        changed = _changed(before, blueprint)
        self.nodes.replace(blueprint)
        others = before.branches.keys() != blueprint.branches.keys()
        fresh: list[OutlineNode] = []
        for node in list(self.nodes.asked.values()):
            # The children of a removed node are removed with it.
            mine = node.above is None or others or node.key[0] in changed
            if mine and self.nodes.asked.get(node.number) is node:
                fresh += self._renew(node)
        self._tell(before, changed)
        return fresh

    def _renew(self, node: OutlineNode) -> list[OutlineNode]:
        """Make the children of a node match the blueprint.

        Returns the nodes that have to be expanded.
        """
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
        """Whether the SB of a key still exists; if not, it may have been renamed."""
        return not key[0] or key[0] in self.nodes.blueprint.branches

    def _put(self, node: OutlineNode, first: int, gone: int, come: list[OutlineNode]) -> None:
        below = self.nodes.below(node)
        below[first : first + gone] = come
        for row in range(first, len(below)):
            below[row].row = row

    def _tell(self, before: Blueprint, changed: set[str]) -> None:
        """Tell Qt which lines have another content, or have children for the first time."""
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
                if below and not _facts_are_alike(before, after, [one.key for one in below]):
                    self.dataChanged.emit(self.index_of(below[0]), self.index_of(below[-1]))


def _facts_are_alike(before: Blueprint, after: Blueprint, keys: list[Key]) -> bool:
    """Whether a few facts of an SB have the same lines, as after most edits: painting takes longer
    than this comparison.
    """
    if len(keys) > FEW or any(
        digit is None or name not in before.branches or digit >= before[name].num_facts
        for name, digit in keys
    ):
        return False
    return all(
        fact_line(before, name, digit) == fact_line(after, name, digit)
        for name, digit in keys
        if digit is not None
    )


def _leads(branch: StateBranch | None) -> object:
    """The values that decide which lines of an SB have children."""
    return None if branch is None else (has_facts(branch), branch.header.sub_sbs)


def _alike(some: list[Key], others: list[Key]) -> int:
    """The length of the common beginning of two lists."""
    count = 0
    for one, other in zip(some, others, strict=False):
        if one != other:
            break
        count += 1
    return count


def _changed(before: Blueprint, after: Blueprint) -> set[str]:
    """The SBs that an edit changed. Unchanged SBs are the same object in both blueprints."""
    return {
        name
        for name in before.branches.keys() | after.branches.keys()
        if before.branches.get(name) is not after.branches.get(name)
    }
