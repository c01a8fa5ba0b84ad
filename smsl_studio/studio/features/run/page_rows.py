"""The row of Run in the mode bar: that of the page which is shown, if it has one of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtWidgets import QHBoxLayout, QWidget


class PageRows(QWidget):
    """The row of the run itself, and rows of further pages, each made when it is first shown."""

    def __init__(self, home: QWidget, make: Mapping[str, Callable[[], QWidget]]) -> None:
        super().__init__()
        self._home, self._make = home, make
        self._rows: dict[str, QWidget] = {}
        self._across = QHBoxLayout(self)
        self._across.setContentsMargins(0, 0, 0, 0)
        self._across.addWidget(home)
        # It was hidden as long as it stood nowhere.
        home.show()

    def show_page(self, name: str) -> None:
        """Show the row of a page."""
        if name in self._make and name not in self._rows:
            self._rows[name] = self._make[name]()
            self._across.addWidget(self._rows[name])
        shown = self._rows.get(name, self._home)
        for one in (self._home, *self._rows.values()):
            one.setVisible(one is shown)
