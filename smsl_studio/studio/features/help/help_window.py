"""The window of the help: index and search at the left, a page at the right."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QObject, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QGuiApplication, QKeyEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QDialog,
    QFrame,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QSplitter,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.studio.base.controls import Elided, label, name_parts, row
from smsl_studio.studio.base.icons import icon
from smsl_studio.studio.base.panels import keyed_tool, panel
from smsl_studio.studio.base.screens import open_at, place_over
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.features.help.index import HelpIndex
from smsl_studio.studio.features.help.page_view import PageView
from smsl_studio.studio.features.help.pages import HelpPlace, page
from smsl_studio.studio.features.help.search import MOST, HelpHit, find

SIZE, LEFT = (1120, 760), 276
"""The first size of the window, and the width of the index (pixels)."""
BACK, ON = "Alt+Left", "Alt+Right"


class HelpWindow(QDialog):
    """A window of its own over ``parent``, so that both can be used. Esc closes it."""

    def __init__(self, tokens: Tokens, parent: QWidget) -> None:
        super().__init__(parent)
        self.setWindowFlags(Qt.WindowType.Window)
        self.setWindowTitle("Help")
        self._build(tokens)
        self.set_tokens(tokens)
        self._show_hits("")
        open_at(self, *SIZE)
        place_over(self, parent.window())

    def _build(self, tokens: Tokens) -> None:
        self.page = PageView(tokens)
        self.page.moved.connect(self._moved)
        self.page.outside.connect(self.tell_outside)
        self.back = keyed_tool(self, "Back", BACK, self.page.backward)
        self.on = keyed_tool(self, "Forward", ON, self.page.forward)
        for tool in (self.back, self.on):
            tool.setProperty("role", "small")
            tool.setFixedSize(32, 32)
        self._title = Elided()
        self._title.setProperty("role", "heading")
        self.field = QLineEdit()
        self.field.setPlaceholderText("Search all pages")
        self.field.setAccessibleName("Search all pages")
        self.field.setClearButtonEnabled(True)
        self.field.setFixedWidth(LEFT - 24)
        self.field.textChanged.connect(self._show_hits)
        self.field.installEventFilter(self)
        name_parts(self.field)
        QShortcut(QKeySequence("Ctrl+F"), self, activated=self._enter_field)  # type: ignore[call-overload]
        self.index = HelpIndex()
        self.index.wanted.connect(self._choose)
        self.hits = QListWidget()
        self.hits.setProperty("role", "list")
        self.hits.setAccessibleName("Sections that were found")
        self.hits.setWordWrap(True)
        self.hits.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.hits.itemActivated.connect(self._choose_hit)
        self.hits.itemClicked.connect(self._choose_hit)
        self.count = label("", "hint")
        self.count.setContentsMargins(12, 4, 12, 8)
        found = panel(self.count, self.hits)
        self.left = QStackedWidget()
        self.left.addWidget(self.index)
        self.left.addWidget(found)
        top = row(self.field, self.back, self.on, self._title)
        top.setContentsMargins(12, 8, 12, 8)
        body = QSplitter(Qt.Orientation.Horizontal)
        body.setHandleWidth(1)
        body.addWidget(self.left)
        body.addWidget(panel(self._outside_bar(), self.page))
        body.setStretchFactor(1, 1)
        body.setSizes([LEFT, SIZE[0] - LEFT])
        body.setChildrenCollapsible(False)
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        whole.addLayout(top)
        whole.addWidget(body, 1)

    def _outside_bar(self) -> QFrame:
        """A bar about a link that leads out of the help. Only its buttons open anything."""
        self.bar = QFrame()
        self.bar.setProperty("role", "bar")
        self._outside = Elided()
        self.opens, self.copies = QPushButton("Open outside"), QPushButton("Copy")
        closes = QPushButton("Close")
        self.opens.clicked.connect(self._open_outside)
        self.copies.clicked.connect(lambda: QGuiApplication.clipboard().setText(self._address))
        closes.clicked.connect(self.bar.hide)
        for button in (self.opens, self.copies, closes):
            button.setProperty("role", "row")
            button.setAutoDefault(False)
        line = row(self._outside, self.opens, self.copies, closes)
        line.setContentsMargins(16, 6, 12, 6)
        self.bar.setLayout(line)
        self.bar.hide()
        return self.bar

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self.back.setIcon(icon("chevron-left", tokens))
        self.on.setIcon(icon("chevron-right", tokens))
        self.page.set_tokens(tokens)

    # What is shown.

    def show_place(self, place: HelpPlace) -> None:
        """Show a place in front of all, with the keys in the page."""
        self.field.clear()
        self.show()
        self.page.show_place(place)
        self.raise_()
        self.activateWindow()
        self.page.setFocus()

    def tell_outside(self, address: str) -> None:
        """Tell where a link leads that leaves the help, and offer to open it."""
        self._address = address
        self._outside.setText(f"Outside the help: {address}")
        self.bar.show()
        self.opens.setFocus()

    def _open_outside(self) -> None:
        self.bar.hide()
        QDesktopServices.openUrl(QUrl.fromUserInput(self._address))

    def _moved(self) -> None:
        place = self.page.place
        found = page(place.page) if place is not None else None
        if place is None or found is None:
            return
        self.bar.hide()
        self._title.setText(found.title)
        self.back.setEnabled(self.page.has_before)
        self.on.setEnabled(self.page.has_next)
        self.index.show_place(place)

    def _choose(self, place: HelpPlace) -> None:
        self.page.show_place(place)

    # Search.

    def _enter_field(self) -> None:
        self.field.setFocus()
        self.field.selectAll()

    def _show_hits(self, typed: str) -> None:
        found = find(typed)
        self.hits.clear()
        for hit in found:
            said = f"{hit.section.title}\n{hit.page_title}\n{hit.words}"
            item = QListWidgetItem(said.replace(f"{hit.page_title}\n", "", 1)
                                   if hit.section.level == 1 else said)  # fmt: skip
            item.setData(Qt.ItemDataRole.UserRole, hit)
            self.hits.addItem(item)
        many = (
            f"the first {MOST} sections" if len(found) == MOST else counted(len(found), "section")
        )
        self.count.setText(many if found else f"No page has “{typed.strip()}”.")
        self.left.setCurrentIndex(1 if typed.strip() else 0)

    def _choose_hit(self, item: QListWidgetItem) -> None:
        hit: HelpHit = item.data(Qt.ItemDataRole.UserRole)
        place = HelpPlace(hit.section.page, hit.section.anchor)
        self.page.show_place(place, self.field.text())

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """In the field: Enter opens the best hit, Down goes to the list, Esc clears the text."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            key = Qt.Key(event.key())
            if key in (Qt.Key.Key_Return, Qt.Key.Key_Enter, Qt.Key.Key_Down):
                if self.hits.count():
                    self.hits.setCurrentRow(max(0, self.hits.currentRow()))
                    if key == Qt.Key.Key_Down:
                        self.hits.setFocus()
                    else:
                        self._choose_hit(self.hits.currentItem())
                return True
            if key == Qt.Key.Key_Escape and self.field.text():
                self.field.clear()
                return True
        return super().eventFilter(watched, event)
