"""The accessible interface of the whole program, in place of Qt's.

In Qt's interface the children of the program are its windows without popups. So a menu that was
opened by a right click or by the menu key is in no list of children, and a reader that walks the
tree never comes to it. Here such a menu is a child of the program while it is open.
"""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import QRect, Qt
from PySide6.QtGui import QAccessible, QAccessibleInterface, QGuiApplication
from PySide6.QtWidgets import QApplication, QMenu, QMenuBar, QWidget

from smsl_studio.legible import plain_text


class ProgramAccessible(QAccessibleInterface):
    """The program. Its children are its windows, then the menus that belong to no other menu."""

    def isValid(self) -> bool:
        """Whether the program still runs."""
        return QApplication.instance() is not None

    def object(self) -> Any:
        """The application."""
        return QApplication.instance()

    def window(self) -> Any:
        """None: a program has several windows."""
        return None

    def parent(self) -> Any:
        """None: the desktop is no part of the program."""
        return None

    def tops(self) -> list[QWidget]:
        """The windows in the order in which they were made, then the open menus."""
        made = {window: at for at, window in enumerate(QGuiApplication.topLevelWindows())}
        shown = [one for one in QApplication.topLevelWidgets() if one.windowHandle() in made]
        shown.sort(key=lambda one: made[one.windowHandle()])
        passing = (Qt.WindowType.Popup, Qt.WindowType.Desktop)
        return [one for one in shown if one.windowType() not in passing] + [
            one for one in shown if isinstance(one, QMenu) and one.isVisible() and is_alone(one)
        ]

    def childCount(self) -> int:
        """The number of windows and open menus."""
        return len(self.tops())

    def child(self, index: int) -> Any:
        """The window or menu with this number; None if there is none."""
        tops = self.tops()
        found = tops[index] if 0 <= index < len(tops) else None
        return QAccessible.queryAccessibleInterface(found) if found is not None else None

    def indexOfChild(self, child: QAccessibleInterface) -> int:
        """The number of a window or menu; -1 for anything else."""
        tops, found = self.tops(), child.object()
        return tops.index(found) if found in tops else -1

    def childAt(self, x: int, y: int) -> Any:
        """The upper window or menu at a point of the screen (pixels); None if there is none."""
        for top in reversed(self.tops()):
            if top.isVisible() and top.frameGeometry().contains(x, y):
                return QAccessible.queryAccessibleInterface(top)
        return None

    def focusChild(self) -> Any:
        """The window that has the keyboard."""
        active = QApplication.activeWindow()
        return QAccessible.queryAccessibleInterface(active) if active is not None else None

    def text(self, kind: QAccessible.Text) -> str:
        """The name of the program, or its path as the description."""
        if kind == QAccessible.Text.Name:
            return plain_text(QApplication.applicationName())
        return QApplication.applicationFilePath() if kind == QAccessible.Text.Description else ""

    def setText(self, kind: QAccessible.Text, text: str) -> None:
        """Ignored: the name of the program cannot be set from outside."""

    def rect(self) -> QRect:
        """Empty: the program has no place on the screen."""
        return QRect()

    def role(self) -> QAccessible.Role:
        """An application."""
        return QAccessible.Role.Application

    def state(self) -> QAccessible.State:
        """No flags."""
        return QAccessible.State()


def is_alone(menu: QMenu) -> bool:
    """Whether no menu and no menu bar leads to a menu."""
    shown_in = menu.menuAction().associatedObjects()
    return not any(isinstance(one, QMenu | QMenuBar) for one in shown_in)
