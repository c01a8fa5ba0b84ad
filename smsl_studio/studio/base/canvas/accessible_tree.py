"""The accessible interfaces of a canvas: the view, its states, and the operations of each state.

Graphics items have no accessible interface of their own. States are children of the canvas by
number, then groups and notes. Operations are children of the state they leave, in the order of the
file. States outside the view are included, so that the zoom does not change what is read out.

No class here overrides ``interface_cast``: PySide 6.11 crashes on any override. The parts derive
from Qt's interface of a widget instead (``accessible_leaf``), which has actions.
"""

from __future__ import annotations

from functools import partial
from typing import Any
from weakref import ref

from PySide6.QtCore import QRect
from PySide6.QtGui import QAccessible, QAccessibleInterface
from PySide6.QtWidgets import QApplication, QMenu, QMenuBar, QWidget
from shiboken6 import isValid

from smsl_studio.blueprint.address import Address
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.canvas.accessible import state_words, words_for
from smsl_studio.studio.base.canvas.accessible_acts import operation_acts, state_acts
from smsl_studio.studio.base.canvas.accessible_drawn import DrawnAccessible
from smsl_studio.studio.base.canvas.accessible_held import Children, kept
from smsl_studio.studio.base.canvas.accessible_leaf import (
    ALL,
    Acts,
    LeafAccessible,
    PartAccessible,
    Relation,
)
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.canvas.element_details import operation_details, state_details
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.base.overlays.card import PassingCard

TO, FROM = QAccessible.RelationFlag.FlowsTo, QAccessible.RelationFlag.FlowsFrom
"""Qt names a relation by what the other part is: the target of an operation flows from it."""


class CanvasAccessible(QAccessibleInterface):
    """The canvas: a graphic whose children are the states of the SB that is shown.

    It holds the canvas by a weak reference, because PySide never frees an interface that it has
    handed to Qt. Otherwise no closed canvas would be freed.
    """

    def __init__(self, canvas: Canvas) -> None:
        super().__init__()
        self._held = ref(canvas)
        self._children: Children[int, StateAccessible] = Children()
        self._drawn: Children[DrawnKey, DrawnAccessible] = Children()

    @property
    def canvas(self) -> Canvas:
        """The canvas. Qt asks only while ``isValid`` is true."""
        canvas = self._held()
        assert canvas is not None
        return canvas

    def isValid(self) -> bool:
        """Whether the canvas still exists."""
        canvas = self._held()
        return canvas is not None and isValid(canvas)

    @property
    def sheet(self) -> Sheet | None:
        """The sheet that the canvas shows; None if the canvas is gone."""
        return self.canvas.sheet if self.isValid() else None

    def object(self) -> Any:
        """The canvas; None once it is gone."""
        return self.canvas if self.isValid() else None

    def window(self) -> Any:
        """The window that the canvas lies in."""
        return self.canvas.window().windowHandle()

    def parent(self) -> Any:
        """The interface of the widget that holds the canvas; None without one."""
        parent = self.canvas.parentWidget()
        return QAccessible.queryAccessibleInterface(parent) if parent is not None else None

    def childCount(self) -> int:
        """The number of states, groups and notes in the SB that is shown, of the form that is open
        over it, and of its open menu."""
        return self._drawn_count + len(self._above)

    @property
    def _drawn_count(self) -> int:
        sheet = self.sheet
        return self.states + len(sheet.drawn.listed()) if sheet is not None else 0

    @property
    def _above(self) -> list[QWidget]:
        """What lies open over the drawing and follows it in the tree: a form, and then a menu."""
        if not self.isValid():
            return []
        found: list[QWidget] = [
            one for one in self.canvas.children() if isinstance(one, PassingCard) and one.is_open
        ]
        menu = self.menu
        return [*found, menu] if menu is not None else found

    @property
    def menu(self) -> QMenu | None:
        """The menu that a right click or the menu key has opened over the window; None without one.

        Qt leaves popups out of the tree. Readers that walk it would not come to the menu.
        """
        found = QApplication.activePopupWidget()
        above = found.parentWidget() if isinstance(found, QMenu) else None
        if not isinstance(found, QMenu) or above is None or not self.canvas.isVisible():
            return None
        shown_in = found.menuAction().associatedObjects()
        inside = any(isinstance(one, QMenu | QMenuBar) for one in shown_in)
        return found if not inside and above.window() is self.canvas.window() else None

    @property
    def states(self) -> int:
        """The number of states in the SB that is shown."""
        sheet = self.sheet
        return len(sheet.picture) if sheet is not None else 0

    def child(self, index: int) -> Any:
        """The state with this number, or the group, note, form or menu after the states; None if
        there is none."""
        if not 0 <= index < self.childCount():
            return None
        sheet = self.sheet
        above = index - self._drawn_count
        if above >= 0:
            return QAccessible.queryAccessibleInterface(self._above[above])
        if sheet is not None and index >= self.states:
            key = sheet.drawn.listed()[index - self.states]
            return kept(self._drawn, key, partial(DrawnAccessible, self, self._held, key))
        return kept(self._children, index, partial(StateAccessible, self, index))

    def operation(self, edge: int) -> OperationAccessible | None:
        """The operation with this number in the picture; None if there is none."""
        sheet = self.sheet
        if sheet is None or not 0 <= edge < len(sheet.picture.operations):
            return None
        state = int(sheet.picture.source[edge])
        found: StateAccessible = self.child(state)
        operation: OperationAccessible | None = found.child(edge - int(sheet.picture.first[state]))
        return operation

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """The number of a state, group, note, form or menu; -1 for anything else."""
        sheet = self.sheet
        if isinstance(child, DrawnAccessible) and sheet is not None:
            keys = sheet.drawn.listed()
            return self.states + keys.index(child.key) if child.key in keys else -1
        if isinstance(child, StateAccessible):
            return child.index
        above = [id(one) for one in self._above]
        thing = id(child.object())
        return self._drawn_count + above.index(thing) if thing in above else -1

    def childAt(self, x: int, y: int) -> Any:
        """The state, note or title at a point of the screen (pixels); None if there is none."""
        sheet = self.sheet
        if sheet is None:
            return None
        at = self.canvas.mapToScene(self.canvas.viewport().mapFromGlobal(QRect(x, y, 1, 1)
                                                                           .topLeft()))  # fmt: skip
        drawn = self.canvas.drawn_at(at)
        if drawn is not None:
            return self.child(self.states + sheet.drawn.listed().index(drawn))
        return self.child(sheet.state_at(at.x(), at.y()))

    def focusChild(self) -> Any:
        """The state or operation that was selected last, or the selected note or group."""
        sheet = self.sheet
        chosen = self.canvas.drawn.chosen
        if sheet is None:
            return None
        if chosen in sheet.drawn.listed():
            return self.child(self.states + sheet.drawn.listed().index(chosen))
        for address in reversed(self.canvas.marks.selection):
            state, edge = sheet.picture.node(address), sheet.picture.edge(address)
            if state >= 0 or edge >= 0:
                return self.child(state) if state >= 0 else self.operation(edge)
        return None

    def text(self, kind: QAccessible.Text) -> str:
        """The name or the description of the canvas; empty for other kinds of text."""
        if kind == QAccessible.Text.Name:
            return self.canvas.accessibleName()
        if kind == QAccessible.Text.Description:
            return self.canvas.accessibleDescription()
        return ""

    def setText(self, kind: QAccessible.Text, text: str) -> None:
        """Ignored: names follow the blueprint and cannot be set from outside."""

    def rect(self) -> QRect:
        """The rectangle of the canvas on the screen (pixels)."""
        canvas = self.canvas
        return QRect(canvas.mapToGlobal(canvas.rect().topLeft()), canvas.size())

    def role(self) -> QAccessible.Role:
        """A graphic."""
        return QAccessible.Role.Graphic

    def state(self) -> QAccessible.State:
        """Whether the canvas has the keyboard focus and is visible."""
        found = QAccessible.State()
        found.focusable = True
        # One thing has the focus: the element that was selected last, if there is one.
        sheet, chosen = self.canvas.sheet, self.canvas.marks.selection[-1:]
        inside = sheet is not None and any(
            sheet.picture.node(one) >= 0 or sheet.picture.edge(one) >= 0 for one in chosen
        )
        found.focused = self.canvas.hasFocus() and not inside
        found.invisible = not self.canvas.isVisible()
        return found


class StateAccessible(PartAccessible):
    """One state, read as "State_1100, active, 7 operations out"."""

    def __init__(self, parent: CanvasAccessible, index: int) -> None:
        super().__init__(parent, parent.canvas)
        self._parent, self.index = parent, index
        self._children: Children[Address, OperationAccessible] = Children()

    @property
    def canvas(self) -> Canvas:
        """The canvas that shows it."""
        return self._parent.canvas

    def isValid(self) -> bool:
        """Whether the canvas still shows a state with this number."""
        return self._parent.isValid() and self.index < self._parent.states

    @property
    def operations(self) -> tuple[Address, ...]:
        """The operations that leave the state, in the order of the file."""
        sheet = self._parent.sheet
        if sheet is None or not self.isValid():
            return ()
        branch, state = sheet.picture.branch, sheet.picture.names[self.index]
        return tuple(Address(branch.name, state, name) for name in branch.table[state])

    def has(self, operation: Address) -> bool:
        """Whether an operation leaves the state."""
        sheet = self._parent.sheet
        if sheet is None or not self.isValid():
            return False
        here = sheet.address_of_state(self.index)
        table = sheet.picture.branch.table
        return operation.parent == here and operation.operation in table[here.state]

    def childCount(self) -> int:
        """The number of operations that leave the state."""
        return len(self.operations)

    def child(self, index: int) -> Any:
        """The operation with this number, in the order of the file; None if there is none."""
        operations = self.operations
        if not 0 <= index < len(operations):
            return None
        address = operations[index]
        return kept(self._children, address, partial(OperationAccessible, self, address))

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """The number of an operation that leaves the state; -1 for anything else."""
        operations = self.operations
        if not isinstance(child, OperationAccessible) or child.address not in operations:
            return -1
        return operations.index(child.address)

    def childAt(self, x: int, y: int) -> Any:
        """None: operations cannot be found by a point."""
        return None

    def text(self, kind: QAccessible.Text) -> str:
        """The name of the state as it is read out; empty for other kinds of text."""
        sheet = self._parent.sheet
        if sheet is None or not self.isValid():
            return ""
        if kind == QAccessible.Text.Description:
            return plain_text(state_details(sheet.picture.branch, sheet.picture.names[self.index]))
        return state_words(self.canvas, self.index) if kind == QAccessible.Text.Name else ""

    def acts(self) -> Acts:
        """What can be done with the state now."""
        sheet = self._parent.sheet
        if sheet is None or not self.isValid():
            return {}
        return state_acts(self.canvas, sheet.address_of_state(self.index))

    def relations(self, match: QAccessible.RelationFlag = ALL) -> list[Relation]:
        """The operations that lead to the state: it flows from them."""
        sheet = self._parent.sheet
        if sheet is None or not self.isValid() or not match & TO:
            return []
        into = (sheet.picture.target == self.index).nonzero()[0]
        return [(found, TO) for edge in into if (found := self._parent.operation(int(edge)))]

    def rect(self) -> QRect:
        """The rectangle of the node on the screen (pixels); empty if the state is gone."""
        sheet = self._parent.sheet
        if sheet is None or not self.isValid():
            return QRect()
        return _on_screen(self.canvas, sheet.address_of_state(self.index))

    def role(self) -> QAccessible.Role:
        """An item of a list."""
        return QAccessible.Role.ListItem

    def state(self) -> QAccessible.State:
        """Whether the state is selected, and whether its canvas is shown."""
        found = QAccessible.State()
        found.selectable = True
        sheet = self._parent.sheet
        if sheet is not None and self.isValid():
            found.invisible = not self.canvas.isVisible()
            found.selected = sheet.looks.node(self.index).selected
            _focus(found, self.canvas, sheet.address_of_state(self.index))
        return found


class OperationAccessible(LeafAccessible):
    """One operation, read as "Op_1b, State_aaa to State_baa"."""

    def __init__(self, parent: StateAccessible, address: Address) -> None:
        super().__init__(parent, parent.canvas)
        self._state, self.address = parent, address

    @property
    def canvas(self) -> Canvas:
        """The canvas that shows it."""
        return self._state.canvas

    def isValid(self) -> bool:
        """Whether the operation still leaves its state."""
        return self._state.has(self.address)

    def text(self, kind: QAccessible.Text) -> str:
        """The name of the operation as it is read out; empty for other kinds of text."""
        sheet = self.canvas.sheet if self.isValid() else None
        if sheet is None:
            return ""
        if kind == QAccessible.Text.Description:
            edge = sheet.picture.edge(self.address)
            return plain_text(operation_details(sheet.picture, edge))
        return words_for(self.canvas, self.address) if kind == QAccessible.Text.Name else ""

    def acts(self) -> Acts:
        """What can be done with the operation now."""
        return operation_acts(self.canvas, self.address) if self.isValid() else {}

    def relations(self, match: QAccessible.RelationFlag = ALL) -> list[Relation]:
        """The state that the operation leads to: it flows to it."""
        sheet = self.canvas.sheet if self.isValid() else None
        if sheet is None or not match & FROM:
            return []
        target = int(sheet.picture.target[sheet.picture.edge(self.address)])
        return [(self._state.parent().child(target), FROM)] if target >= 0 else []

    def rect(self) -> QRect:
        """The rectangle of the label on the screen (pixels); empty if the operation is gone."""
        return _on_screen(self.canvas, self.address) if self.isValid() else QRect()

    def role(self) -> QAccessible.Role:
        """An item of a list."""
        return QAccessible.Role.ListItem

    def state(self) -> QAccessible.State:
        """Whether the operation is selected, and whether its canvas is shown."""
        found = QAccessible.State()
        found.selectable = True
        sheet = self.canvas.sheet if self.isValid() else None
        if sheet is not None:
            found.invisible = not self.canvas.isVisible()
            found.selected = sheet.looks.edge(sheet.picture.edge(self.address)).selected
            _focus(found, self.canvas, self.address)
        return found


def _focus(found: QAccessible.State, canvas: Canvas, address: Address) -> None:
    """The element that was selected last has the keyboard focus of the canvas."""
    found.focusable = True
    found.focused = canvas.hasFocus() and canvas.marks.selection[-1:] == (address,)


def _on_screen(canvas: Canvas, address: Address) -> QRect:
    """The rectangle of a state's node or an operation's label on the screen; empty for neither."""
    rect = canvas.rect_of(address)
    return canvas.screen_rect(rect) if rect is not None else QRect()
