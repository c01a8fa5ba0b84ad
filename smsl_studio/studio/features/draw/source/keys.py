"""The keys of the source pane while its text has the keyboard focus."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from smsl_studio.studio.features.draw.source.manners import Manners
from smsl_studio.studio.features.draw.source.pointer import TextPointer
from smsl_studio.studio.features.draw.source.popup import Popup
from smsl_studio.studio.features.draw.source.quick_fixes import QuickFixes
from smsl_studio.studio.features.draw.source.source_text import SourceText

_NONE, _CTRL = Qt.KeyboardModifier.NoModifier, Qt.KeyboardModifier.ControlModifier
_SHIFT, _ALT = Qt.KeyboardModifier.ShiftModifier, Qt.KeyboardModifier.AltModifier
_OPEN = (Qt.Key.Key_BracketLeft, Qt.Key.Key_BraceLeft)
_SHUT = (Qt.Key.Key_BracketRight, Qt.Key.Key_BraceRight)
Combination = tuple[int, Qt.KeyboardModifier]

SOURCE_KEYS = (
    ("Complete a name", "Ctrl+Space"),
    ("Find, next, previous, replace", "Ctrl+F, F3, Shift+F3, Ctrl+H"),
    ("Go to what a name stands for", "F12 or Ctrl and click"),
    ("The quick fixes of this line", "Ctrl+."),
    ("Fold, unfold", "Ctrl+Shift+[, Ctrl+Shift+]"),
    ("Fold every State Branch, unfold everything", "Ctrl+Alt+[, Ctrl+Alt+]"),
    ("Indent, unindent", "Tab, Shift+Tab"),
    ("Leave the text", "Esc and then Tab"),
    ("Duplicate a line, move it", "Ctrl+D, Alt+Up, Alt+Down"),
    ("Comment lines, where the form has comments", "Ctrl+/"),
    ("Larger, smaller", "Ctrl and mouse wheel"),
)
"""The rows for the dialog of shortcuts."""


class PaneKeys:
    """Passes each key first to the list of names, then to the pane, then to ``Manners``."""

    def __init__(
        self, text: SourceText, popup: Popup, pointing: TextPointer, repairing: QuickFixes
    ) -> None:
        self._popup, self._manners = popup, Manners(text.editor)
        self._text, self._leaving = text, False
        key, bar = Qt.Key, text.find_bar
        self._keys: dict[Combination, Callable[[], object]] = {
            (key.Key_Z, _CTRL): text.undo,
            (key.Key_Z, _CTRL | _SHIFT): text.redo,
            (key.Key_Y, _CTRL): text.redo,
            (key.Key_Space, _CTRL): popup.ask,
            (key.Key_F, _CTRL): lambda: bar.open_bar(False),
            (key.Key_H, _CTRL): lambda: bar.open_bar(True),
            (key.Key_F3, _NONE): lambda: bar.step(1),
            (key.Key_F3, _SHIFT): lambda: bar.step(-1),
            (key.Key_F12, _NONE): pointing.jump,
            (key.Key_Period, _CTRL): repairing.offer,
        }
        for here, everywhere, keys in (
            (text.folding.fold, text.folding.fold_all, _OPEN),
            (text.folding.unfold, text.folding.unfold_all, _SHUT),
        ):
            for one in keys:
                self._keys[one, _CTRL | _SHIFT] = here
                self._keys[one, _CTRL | _ALT] = everywhere

    def takes(self, event: QKeyEvent) -> bool:
        """See ``key_owner.Keys``."""
        held = event.modifiers()
        popup = not self._popup.isHidden() and event.key() == Qt.Key.Key_Escape
        bar = not self._text.find_bar.isHidden() and event.key() == Qt.Key.Key_Escape
        known = (event.key(), held) in self._keys or self._manners.takes(event)
        return popup or bar or known

    def answer(self, event: QKeyEvent) -> bool:
        """See ``key_owner.Keys``."""
        if self._popup.answer(event):
            return True
        call = self._keys.get((event.key(), event.modifiers()))
        if call is not None:
            call()
            return True
        if event.key() == Qt.Key.Key_Escape:
            self._leaving = self._text.find_bar.isHidden()
            if not self._leaving:
                self._text.find_bar.close_bar()
            return True
        tab = event.key() in (Qt.Key.Key_Tab, Qt.Key.Key_Backtab)
        if tab and (self._leaving or self._text.editor.isReadOnly()):
            self._leaving = False
            self._text.leave(event.key() == Qt.Key.Key_Tab)
            return True
        self._leaving = False
        answered = self._manners.answer(event)
        if answered and event.text():
            self._popup.typed(event)
        return answered

    def typed(self, event: QKeyEvent) -> None:
        """See ``key_owner.Keys``."""
        self._popup.typed(event)
