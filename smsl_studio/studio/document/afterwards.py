"""Shows an edit in the forms and lists of a window.

The drawing shows an edit at once. The other parts show it once, a moment later. They show it sooner
if the person presses a key or the mouse.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer

MOMENT = 60
"""Milliseconds from an edit until forms and lists follow the drawing; 0 for at once."""

KIND = QEvent.Type
ASKING = frozenset({
    KIND.ShortcutOverride, KIND.KeyPress, KIND.KeyRelease, KIND.Shortcut, KIND.InputMethod,
    KIND.MouseButtonPress, KIND.MouseButtonRelease, KIND.MouseButtonDblClick, KIND.Wheel,
    KIND.TabletPress, KIND.TouchBegin, KIND.NativeGesture, KIND.ContextMenu, KIND.DragEnter,
    KIND.Drop, KIND.ToolTip, KIND.WhatsThis, KIND.WindowActivate, KIND.WindowDeactivate,
    KIND.Close,
})  # fmt: skip
"""The events with which a person can look at or use what is not shown yet."""


class Afterwards(QObject):
    """The parts of a window that still have to show the last edit.

    The drawing follows an edit at once. Forms, lists and the enabled actions ask ``show``: then
    each part follows once, ``MOMENT`` milliseconds after the edit. A key, a press or the wheel
    finds all parts as they should be, because they follow before it arrives anywhere. Without an
    edit just before, a part follows at once.
    """

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._wanted: dict[Callable[[], object], None] = {}
        self._changes = 0
        """How many changes of the blueprint have begun and not ended."""
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.catch_up)

    @property
    def pending(self) -> bool:
        """Whether a part still has to show the last edit."""
        return bool(self._wanted)

    def follow(self, show: Callable[[], object], *signals: Any) -> None:
        """Call ``show`` after each of these signals: at once, or a moment after an edit."""
        for signal in signals:
            signal.connect(lambda *_: self.show(show))

    def show(self, part: Callable[[], object]) -> None:
        """Call ``part`` when the edit that goes on or was just made is to be seen in all parts."""
        if self._changes or self._timer.isActive():
            # The last one that asks is called last, because it may read what the others show.
            self._wanted.pop(part, None)
            self._wanted[part] = None
        else:
            part()

    @contextmanager
    def change(self) -> Iterator[None]:
        """While the blueprint changes; parts that have to show it are called later."""
        self._changes += 1
        try:
            yield
        finally:
            self._changes -= 1
            if self._wanted and not self._changes:
                self._wait()

    def catch_up(self) -> None:
        """Let all parts show the last edit now."""
        if self._timer.isActive():
            self._timer.stop()
        application = QCoreApplication.instance()
        if application is not None:
            application.removeEventFilter(self)
        wanted, self._wanted = self._wanted, {}
        for part in wanted:
            part()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Let all parts show the last edit before somebody uses them."""
        if event.type() in ASKING:
            self.catch_up()
        return False

    def _wait(self) -> None:
        application = QCoreApplication.instance()
        if not MOMENT or application is None:
            self.catch_up()
        elif not self._timer.isActive():
            application.installEventFilter(self)
            self._timer.start(MOMENT)
