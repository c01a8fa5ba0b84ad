"""Actions: one table of all that a user can ask the window to do.

Menus, mode bar, command palette, the list of shortcuts and the tests read it. A new action is one
row in the table of its feature.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid

from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.key_menu import show_key
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text


def always() -> bool:
    """True: the condition of an action that is always enabled."""
    return True


@dataclass(frozen=True)
class Action:
    """One row of the table: something that a user can ask for.

    ``keys`` are shortcuts; menus and tooltips show the first one. ``scope`` is ``window``, or
    ``canvas`` for keys that the canvas itself answers while it has the focus (single letters, Del,
    Enter). ``section`` groups the actions of a menu; a line separates the sections. ``pointer``
    names the kinds of elements (state, operation) whose menu at the pointer ends with the action.
    """

    id: str
    words: str
    call: Callable[[], object]
    menu: str = ""
    icon: str = ""
    keys: tuple[str, ...] = ()
    enabled: Callable[[], bool] = always
    checked: Callable[[], bool] | None = None
    scope: str = "window"
    section: int = 0
    short: str = ""
    """The label in the mode bar, if ``words`` are too long for it."""
    tip: str = ""
    pointer: tuple[str, ...] = ()
    inner: str = ""
    """The words of the submenu in which the row stands; a menu shows it where its first row is."""

    also: str = ""
    """Other words for the same, by which the palette finds the row too."""
    once: bool = False
    """Whether a key that is held counts once, because the action lets something move."""

    @property
    def hint(self) -> str:
        """The text of the tooltip: ``tip`` or else the words, and the first shortcut."""
        said = self.tip or self.words.rstrip("….")
        return f"{said} ({key_words(self.keys[0])})" if self.keys else said


def _now(function: Callable[[], object]) -> None:
    function()


def key_words(keys: str) -> str:
    """A shortcut as this platform writes it, such as Ctrl+S."""
    return QKeySequence(keys).toString(QKeySequence.SequenceFormat.NativeText)


class Actions(QObject):
    """The table as Qt actions. ``refresh`` updates which are enabled and checked.

    ``before`` is called ahead of each action. It takes over what is still being typed, because a
    key or a button of the mode bar does not move the focus out of the field.
    """

    def __init__(
        self,
        table: Iterable[Action],
        window: QWidget,
        tokens: Tokens,
        before: Callable[[], object] = always,
        keys: Mapping[str, tuple[str, ...]] = MappingProxyType({}),
    ) -> None:
        """``keys`` are those that a person has chosen, by the id of their action."""
        super().__init__(window)
        self._before = before
        self.shipped: dict[str, Action] = {action.id: action for action in table}
        """The table with the keys that the program comes with."""
        self.table: dict[str, Action] = dict(self.shipped)
        for name in keys.keys() & self.table.keys():
            if self.table[name].scope == "window":
                self.table[name] = replace(self.table[name], keys=keys[name])
        self._made: dict[str, QAction] = {}
        self.later: Callable[[Callable[[], object]], object] = _now
        """Calls a function now, or a moment later if the window shows an edit then."""
        for action in self.table.values():
            made = QAction(action.words, window)
            made.setObjectName(action.id)
            made.setCheckable(action.checked is not None)
            made.setAutoRepeat(not action.once)
            made.setIconVisibleInMenu(action.checked is None)
            if action.scope == "window":
                made.setShortcuts([QKeySequence(key) for key in action.keys])
            elif action.keys:
                # The canvas answers these keys itself, so the menu only shows them.
                show_key(made, action.keys[0])
            made.setIconText(f" {action.short or action.words.rstrip('…')}")
            made.setToolTip(tip_text(action.hint))
            made.setStatusTip(tip_text(action.tip))
            made.triggered.connect(self._caller(action))
            self._made[action.id] = made
        self.set_tokens(tokens)
        self.refresh()
        # Last, because the window would be told of each change of an action that it has.
        window.addActions([self._made[one.id] for one in self if one.scope == "window"])

    def __getitem__(self, name: str) -> QAction:
        return self._made[name]

    def __iter__(self) -> Iterator[Action]:
        return iter(self.table.values())

    def set_keys(self, name: str, keys: tuple[str, ...]) -> None:
        """Let other keys do an action of the window, at once."""
        action = self.table[name] = replace(self.table[name], keys=keys)
        made = self._made[name]
        made.setShortcuts([QKeySequence(key) for key in keys])
        made.setToolTip(tip_text(action.hint))

    def set_tokens(self, tokens: Tokens) -> None:
        """Paint the icons of all actions in the colours of another theme."""
        for action in self:
            if action.icon:
                self._made[action.id].setIcon(icon(action.icon, tokens))

    def refresh(self) -> None:
        """Update whether each action is enabled and checked."""
        for action in self:
            made = self._made[action.id]
            made.setEnabled(action.enabled())
            if action.checked is not None:
                made.setChecked(action.checked())

    def in_menu(self, menu: str) -> list[Action]:
        """The actions of a menu, by section, in the order of the table."""
        return sorted((a for a in self if a.menu == menu), key=lambda a: a.section)

    def _caller(self, action: Action) -> Callable[[], None]:
        def call() -> None:
            """Do the action if it is enabled now, then refresh the table."""
            self._before()
            if action.enabled():
                action.call()
            # The action may have closed the window.
            if isValid(self):
                self.later(self.refresh)

        return call
