"""MoreChoices: the button of a narrow transport, whose menu has the choices without room."""

from __future__ import annotations

from PySide6.QtGui import QAction, QIntValidator
from PySide6.QtWidgets import QAbstractButton, QComboBox, QMenu, QToolButton, QWidget, QWidgetAction

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Field, label, row

MOST = 300
"""The largest number of entries that the menu lists for one choice. A wide window lists all."""


class MoreChoices(QToolButton):
    """A button with the menu of these choices, the seed, and a switch.

    The menu is filled when it opens. An entry that is chosen there is chosen in the row, too.
    """

    def __init__(self, seed: Field, by_hand: QAbstractButton, *choices: QComboBox) -> None:
        super().__init__()
        self._seed, self._by_hand, self._choices = seed, by_hand, choices
        self.setText("Choices")
        self.setProperty("role", "tool")
        self.setFixedHeight(32)
        self.setToolTip("World, start, goal, seed and speed of the run")
        self.setAccessibleName("Choices of the run")
        self.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self)
        menu.aboutToShow.connect(self._fill)
        self.setMenu(menu)

    def set_brief(self, brief: bool) -> None:
        """Show three dots in place of the word, where there is little room."""
        self.setText("…" if brief else "Choices")

    def _fill(self) -> None:
        menu = self.menu()
        menu.clear()
        for combo in self._choices:
            self._list(menu, combo)
        menu.addAction(self._seed_action(menu))
        by_hand = menu.addAction(self._by_hand.text())
        by_hand.setCheckable(True)
        by_hand.setChecked(self._by_hand.isChecked())
        by_hand.triggered.connect(self._by_hand.setChecked)

    def _list(self, menu: QMenu, combo: QComboBox) -> None:
        """A menu with the entries of a choice; its title has the present one."""
        words = plain_text(f"{combo.accessibleName()}: {combo.currentText()}")
        inner = menu.addMenu(words.replace("&", "&&"))
        inner.setEnabled(combo.isEnabled() and combo.count() > 0)
        for at in range(min(combo.count(), MOST)):
            entry = QAction(plain_text(combo.itemText(at)).replace("&", "&&"), inner)
            entry.setCheckable(True)
            entry.setChecked(at == combo.currentIndex())
            entry.triggered.connect(lambda _, at=at, combo=combo: combo.setCurrentIndex(at))
            inner.addAction(entry)

    def _seed_action(self, menu: QMenu) -> QWidgetAction:
        """The seed as a field in the menu."""
        field, holder = Field(), QWidget()
        field.setFixedWidth(72)
        field.setValidator(QIntValidator(0, 999_999, field))
        field.settle(self._seed.text())
        field.setAccessibleName("Seed")
        field.setEnabled(self._seed.isEnabled())
        field.textChanged.connect(lambda text: self._seed.settle(text or "0"))
        line = row(label("Seed", "small"), field, None, spacing=8)
        line.setContentsMargins(12, 4, 12, 4)
        holder.setLayout(line)
        action = QWidgetAction(menu)
        action.setDefaultWidget(holder)
        return action
