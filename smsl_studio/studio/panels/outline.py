"""Outline: the State Branches by level, their facts as chips, sub-SBs below their fact."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import (
    QItemSelectionModel,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
    QRect,
    QRectF,
    QSize,
    Qt,
)
from PySide6.QtGui import QAction, QKeySequence, QMouseEvent, QPainter
from PySide6.QtWidgets import (
    QLineEdit,
    QMenu,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolButton,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.inspection.finding import Finding
from smsl_studio.studio.chips import VALUE, paint_chip
from smsl_studio.studio.icons import SEVERITY_ICON, draw, icon, severity_colour
from smsl_studio.studio.panels.frame import Heading, Panel
from smsl_studio.studio.rows import Ink, paint_text
from smsl_studio.studio.session import Session
from smsl_studio.studio.theme import Tokens

ROW, INDENT = 28, 13
Index = QModelIndex | QPersistentModelIndex


@dataclass(frozen=True)
class Line:
    """One line of the tree: an SB (``digit`` is None) or one of its facts."""

    branch: str
    digit: int | None
    text: str
    right: str
    sub: bool = False
    severity: str = ""


class Outline(Panel):
    """The tree of SBs. A click shows an SB; F2, the menu and the buttons add, rename, delete."""

    def __init__(self, session: Session, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__("Outline", parent)
        self._session, self._tokens = session, tokens
        self._findings: tuple[Finding, ...] = ()
        self._heading = Heading("Outline", "Level")
        self.column.addWidget(self._heading)
        self.add_button = QToolButton(self._heading)
        self.add_button.setProperty("role", "small")
        self.add_button.setFixedSize(24, 24)
        self.add_button.setToolTip("Add a State Branch")
        self.add_button.setAccessibleName("Add a State Branch")
        self.add_button.clicked.connect(self.add_branch)
        layout = self._heading.layout()
        assert layout is not None
        layout.removeWidget(self._heading.right)
        layout.addWidget(self.add_button)
        layout.addWidget(self._heading.right)
        self.tree = _Tree(tokens, self)
        self.column.addWidget(self.tree, 1)
        self.tree.itemClicked.connect(self._clicked)
        self.tree.itemActivated.connect(self._clicked)
        self.tree.itemChanged.connect(self._renamed)
        self.tree.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.tree.customContextMenuRequested.connect(self._menu)
        for key, call in (("F2", self.rename_branch), ("Del", self.delete_branch)):
            action = QAction(self.tree)
            action.setShortcut(QKeySequence(key))
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
            action.triggered.connect(call)
            self.tree.addAction(action)
        session.blueprint_changed.connect(lambda *_: self._show())
        session.branch_changed.connect(lambda *_: self._mark())
        self.set_tokens(tokens)
        self._show()

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self.add_button.setIcon(icon("plus", tokens, 14))
        self.tree.set_tokens(tokens)

    def set_findings(self, findings: Sequence[Finding]) -> None:
        """Mark every SB with the gravest of its findings."""
        self._findings = tuple(findings)
        self._show()

    # The verbs of the tree, on the SB that is shown.

    def add_branch(self) -> None:
        """Add an empty SB and start naming it."""
        name = fresh_branch_name(self._session.blueprint)
        if self._session.edit(f"Add State Branch {name}", lambda bp: editing.add_branch(bp, name)):
            self._session.show_branch(name)
            self.rename_branch()

    def rename_branch(self) -> None:
        """Edit the name of the current SB in place."""
        item = self._item(self._current_branch())
        if item is not None:
            self.tree.setFocus()
            self.tree.setCurrentItem(item)
            self.tree.editItem(item)

    def delete_branch(self) -> None:
        name = self._current_branch()
        if name:
            self._session.edit(
                f"Delete State Branch {name}", lambda bp: editing.delete(bp, [Address(name)])
            )

    def _current_branch(self) -> str:
        item = self.tree.currentItem()
        line = _line(item) if item is not None else None
        return line.branch if line is not None else self._session.branch

    def _clicked(self, item: QTreeWidgetItem) -> None:
        line = _line(item)
        self._session.show_branch(line.branch)
        self._session.select(())
        self._mark()

    def _renamed(self, item: QTreeWidgetItem) -> None:
        old, new = _line(item).branch, item.text(0)
        if new == old or _line(item).digit is not None:
            return
        done = self._session.edit(
            f"Rename {old} to {new}", lambda bp: editing.rename(bp, Address(old), new)
        )
        if not done:
            self._show()

    def _menu(self, at: QPoint) -> None:
        item = self.tree.itemAt(at)
        if item is not None:
            self.tree.setCurrentItem(item)
        menu = QMenu(self)
        menu.addAction(icon("plus", self._tokens), "Add State Branch", self.add_branch)
        if self._current_branch():
            name = self._current_branch()
            menu.addAction(icon("pencil", self._tokens), f"Rename {name}\tF2", self.rename_branch)
            menu.addAction(icon("trash", self._tokens), f"Delete {name}\tDel", self.delete_branch)
        menu.exec(self.tree.viewport().mapToGlobal(at))

    def _show(self) -> None:
        self.tree.blockSignals(True)
        closed = {_line(item) for item in _items(self.tree) if not item.isExpanded()}
        closed_keys = {(line.branch, line.digit) for line in closed}
        self.tree.clear()
        worst = _worst(self._findings)
        blueprint = self._session.blueprint
        for name in _tops(blueprint):
            self._add(self.tree.invisibleRootItem(), blueprint, name, worst)
        for item in _items(self.tree):
            line = _line(item)
            item.setExpanded((line.branch, line.digit) not in closed_keys or not item.childCount())
        self.tree.blockSignals(False)
        self._mark()

    def _add(
        self,
        above: QTreeWidgetItem,
        blueprint: Blueprint,
        name: str,
        worst: Mapping[str, str],
        path: tuple[str, ...] = (),
    ) -> None:
        branch = blueprint.branches.get(name)
        if branch is None or name in path:
            return
        line = Line(name, None, name, str(len(path)), severity=worst.get(name, ""))
        item = _new_item(above, line)
        item.setFlags(item.flags() | Qt.ItemFlag.ItemIsEditable)
        for digit in _digits(branch):
            sub = branch.subs.get(digit)
            values = branch.alphabet[digit] if digit < len(branch.alphabet) else ()
            right = "" if set(values) <= {"0", "1"} else " ".join(values)
            text = branch.fact_name(digit)
            fact = _new_item(item, Line(name, digit, text, right, sub is not None))
            if sub is not None:
                self._add(fact, blueprint, sub, worst, (*path, name))

    def _mark(self) -> None:
        """Put the current row on the SB that is shown."""
        item = self._item(self._session.branch)
        self.tree.setCurrentItem(
            item, 0, QItemSelectionModel.SelectionFlag.ClearAndSelect
        ) if item else self.tree.clearSelection()

    def _item(self, branch: str) -> QTreeWidgetItem | None:
        for item in _items(self.tree):
            if _line(item).branch == branch and _line(item).digit is None:
                return item
        return None


class _Tree(QTreeWidget):
    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self.setAccessibleName("State Branches")
        self.setHeaderHidden(True)
        self.setIndentation(INDENT)
        self.setUniformRowHeights(True)
        self.setMouseTracking(True)
        self.setExpandsOnDoubleClick(False)
        self.setEditTriggers(QTreeWidget.EditTrigger.NoEditTriggers)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._delegate = _Delegate(tokens, self)
        self.setItemDelegate(self._delegate)

    def set_tokens(self, tokens: Tokens) -> None:
        self._tokens = self._delegate.tokens = tokens
        self.viewport().update()

    def drawBranches(self, painter: QPainter, rect: QRect, index: Index) -> None:
        if self.selectionModel().isSelected(index):
            painter.fillRect(rect, self._tokens.accs)

    def drawRow(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        super().drawRow(painter, option, index)
        if self.model().hasChildren(index):
            row = self.visualRect(index)
            name = "chevron-down" if self.isExpanded(index) else "chevron-right"
            box = QRectF(row.left() - 5, row.center().y() - 4.5, 11, 11)
            draw(painter, name, box, self._tokens.tx2, self._tokens.surf)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """A click on the chevron opens and closes; it stands where the branch's own row begins."""
        index = self.indexAt(event.position().toPoint())
        near = index.isValid() and self.model().hasChildren(index)
        if near and event.position().x() < self.visualRect(index).left() + 9:
            self.setExpanded(index, not self.isExpanded(index))
            return
        super().mousePressEvent(event)


class _Delegate(QStyledItemDelegate):
    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.tokens = tokens

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        return QSize(10, ROW)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        line: Line = index.data(Qt.ItemDataRole.UserRole)
        rect = QRectF(option.rect)
        chosen = bool(option.state & QStyle.StateFlag.State_Selected)
        painter.save()
        if chosen:
            painter.fillRect(rect, self.tokens.accs)
        if line.digit is None:
            self._branch(painter, rect, line, chosen)
        else:
            self._fact(painter, rect, line)
        painter.restore()

    def _branch(self, painter: QPainter, rect: QRectF, line: Line, chosen: bool) -> None:
        tokens = self.tokens
        mid = rect.center().y()
        badge = QRectF(rect.right() - 31, mid - 10, 20, 20)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(tokens.sunk)
        painter.drawRoundedRect(badge, 4, 4)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        paint_text(painter, badge.adjusted(6.5, 0, 0, 0), line.right, Ink(tokens.tx2, 11, 500))
        right = badge.left() - 6
        if line.severity:
            box = QRectF(right - 15, mid - 7, 14, 14)
            colour = severity_colour(line.severity, tokens)
            draw(painter, SEVERITY_ICON[line.severity], box, colour, tokens.surf)
            right -= 21
        box = QRectF(rect.left() + 14, mid - 7.5, 15, 15)
        draw(painter, "layers", box, tokens.acc if chosen else tokens.tx2, tokens.surf)
        room = QRectF(rect.left() + 38, rect.top(), right - rect.left() - 38, rect.height())
        paint_text(painter, room, line.text, Ink(tokens.tx, 13, 600))

    def _fact(self, painter: QPainter, rect: QRectF, line: Line) -> None:
        tokens = self.tokens
        chip = QRectF(rect.left() + 15, rect.center().y() - 9, 18, 18)
        paint_chip(painter, chip, str(line.digit), VALUE, tokens, sub=line.sub)
        right = rect.right() - 12
        if line.right:
            room = rect.adjusted(rect.width() / 2, 0, -12, 0)
            right -= paint_text(
                painter, room, line.right, Ink(tokens.tx2, 12, mono=True), right=True
            )
        room = QRectF(rect.left() + 41, rect.top(), right - rect.left() - 47, rect.height())
        paint_text(painter, room, line.text, Ink(tokens.tx))

    def updateEditorGeometry(
        self, editor: QWidget, option: QStyleOptionViewItem, index: Index
    ) -> None:
        rect: QRect = option.rect
        editor.setGeometry(rect.adjusted(33, 0, -4, 0))

    def createEditor(self, parent: QWidget, option: QStyleOptionViewItem, index: Index) -> QWidget:
        editor = QLineEdit(parent)
        editor.setProperty("role", "flat")
        editor.setAccessibleName("Name of the State Branch")
        editor.setStyleSheet("background: palette(base);")
        return editor


def _new_item(above: QTreeWidgetItem, line: Line) -> QTreeWidgetItem:
    item = QTreeWidgetItem(above, [line.text])
    item.setData(0, Qt.ItemDataRole.UserRole, line)
    item.setToolTip(0, _tip(line))
    return item


def _tip(line: Line) -> str:
    if line.digit is None:
        return f"State Branch {line.text}, level {line.right}"
    values = f", values {line.right}" if line.right else ""
    return f"Fact {line.digit} of {line.branch}: {line.text}{values}"


def _line(item: QTreeWidgetItem) -> Line:
    found: Line = item.data(0, Qt.ItemDataRole.UserRole)
    return found


def _items(tree: QTreeWidget) -> Iterator[QTreeWidgetItem]:
    open_items = [tree.topLevelItem(i) for i in range(tree.topLevelItemCount())]
    while open_items:
        item = open_items.pop(0)
        if item is not None:
            yield item
            open_items = [item.child(i) for i in range(item.childCount())] + open_items


def _digits(branch: StateBranch) -> range:
    return range(branch.num_facts if branch.table else 0)


def _tops(blueprint: Blueprint) -> tuple[str, ...]:
    """The roots, and what only a cycle or an unknown base names, so that nothing is hidden."""
    shown = set(blueprint.roots)
    for name in blueprint.roots:
        stack = [name]
        while stack:
            branch = blueprint.branches.get(stack.pop())
            for sub in branch.subs.values() if branch else ():
                if sub not in shown:
                    shown.add(sub)
                    stack.append(sub)
    rest = [name for name in blueprint.branches if name not in shown]
    return (*blueprint.roots, *rest)


def _worst(findings: Sequence[Finding]) -> dict[str, str]:
    """The gravest mark of every SB: errors before warnings; notes are no mark in a tree."""
    found: dict[str, str] = {}
    for finding in findings:
        letter = finding.severity.value
        if letter == "E" or (letter == "W" and found.get(finding.address.branch) != "E"):
            found[finding.address.branch] = letter
    return found
