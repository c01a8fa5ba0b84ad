"""The index of the help: groups, their pages, and the sections of each page."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QTreeWidget, QTreeWidgetItem

from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.theme import text_font
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.features.help.pages import GROUPS, HelpPlace, page

PLACE = Qt.ItemDataRole.UserRole


class HelpIndex(QTreeWidget):
    """A tree; the page that is shown stands open, and its section is chosen."""

    wanted = Signal(object)
    """HelpPlace: the person chose a page or a section."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("help_index")
        self.setAccessibleName("Index")
        FocusLine(self)
        self.setHeaderHidden(True)
        self.setIndentation(16)
        self.setUniformRowHeights(True)
        self._items: dict[HelpPlace, QTreeWidgetItem] = {}
        for title, files in GROUPS:
            group = self._item(title, self.invisibleRootItem(), None)
            group.setFont(0, text_font(13, 600))
            for file in files:
                self._add(file, group)
            group.setExpanded(True)
        self.itemClicked.connect(self._choose)
        self.itemActivated.connect(self._choose)

    def show_place(self, place: HelpPlace) -> None:
        """Choose the entry of a place, or of its page if its section has none."""
        item = self._items.get(HelpPlace(place.page, place.anchor))
        item = item or self._items.get(HelpPlace(place.page))
        if item is not None:
            self.setCurrentItem(item)
            (item if place.anchor == "" else item.parent() or item).setExpanded(True)

    def _add(self, file: str, group: QTreeWidgetItem) -> None:
        found = page(file)
        if found is None:
            return
        short = found.title.split(":")[0]
        of_page = self._item(short, group, HelpPlace(file))
        of_page.setToolTip(0, tip_text(found.title))
        for section in found.sections:
            if section.level == 2:
                self._item(section.title, of_page, HelpPlace(file, section.anchor))

    def _item(self, text: str, above: QTreeWidgetItem, place: HelpPlace | None) -> QTreeWidgetItem:
        made = QTreeWidgetItem(above, [text])
        made.setToolTip(0, tip_text(text))
        made.setData(0, PLACE, place)
        if place is not None:
            self._items[place] = made
        return made

    def _choose(self, item: QTreeWidgetItem) -> None:
        place = item.data(0, PLACE)
        if place is not None:
            self.wanted.emit(place)
        else:
            item.setExpanded(not item.isExpanded())
