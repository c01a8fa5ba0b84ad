"""Parts of the accessible tree are held while Qt may ask for them, and let go once they are gone.

A part has no Qt object, so Qt never forgets it by itself: it keeps a number and a bare pointer for
each part that a reader was given. If Python freed such a part, the process would crash when Qt uses
the pointer. So each part is held here. When many have been made, those that are no longer valid are
first taken out of Qt's table (which deletes what is behind the pointer), and then dropped. A reader
that asks for one of them later is told that there is no such object.

This happens between two events, never while a part is at work: a menu that a part opens has an
event loop of its own, and Qt returns to the part when the menu is closed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar
from weakref import WeakValueDictionary

from PySide6.QtCore import QTimer
from PySide6.QtGui import QAccessible, QAccessibleInterface
from shiboken6 import isValid

Key = TypeVar("Key")
Part = TypeVar("Part", bound=QAccessibleInterface)
Children = WeakValueDictionary
"""A table for the children of a part. It does not hold them, so that they can be let go."""

LEAST = 500
"""So many parts may be held before it is looked for the first time whether some are gone."""


class HeldParts:
    """All parts that were made and not let go. Looks through them when their number has doubled."""

    def __init__(self) -> None:
        self._parts: list[QAccessibleInterface] = []
        self._limit, self._at_work, self._asked = LEAST, 0, False

    def __len__(self) -> int:
        return len(self._parts)

    def hold(self, part: QAccessibleInterface) -> None:
        """Hold a part until it is gone."""
        self._parts.append(part)
        if len(self._parts) > self._limit and not self._asked:
            self._asked = True
            QTimer.singleShot(0, self.let_go)

    @contextmanager
    def at_work(self) -> Iterator[None]:
        """While a part does something, nothing is let go, for Qt returns to the part."""
        self._at_work += 1
        try:
            yield
        finally:
            self._at_work -= 1

    def let_go(self) -> None:
        """Let those go that are no longer valid; later, if a part is at work now."""
        self._asked = False
        if self._at_work:
            return
        stay = [part for part in self._parts if part.isValid()]
        gone = {*self._parts}.difference(stay)
        self._parts, self._limit = stay, max(LEAST, 2 * len(stay))
        for part in gone:
            QAccessible.deleteAccessibleInterface(QAccessible.uniqueId(part))


HELD = HeldParts()
"""The parts of the whole program: Qt's table is one, too."""


def kept(children: Children[Key, Part], key: Key, make: Callable[[], Part]) -> Part:
    """The child at a key of a table; made anew if there is none, or if it was let go."""
    found = children.get(key)
    if found is None or not isValid(found):
        found = children[key] = make()
    return found
