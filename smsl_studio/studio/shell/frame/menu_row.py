"""The top row: logo, menus, the file name in the middle, and badges at the right."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QPixmap, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QMenu, QMenuBar, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.controls import Elided, Label, label, name_parts, row
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.theme import MENU_BAR, Tokens

MENUS = ("File", "Edit", "View", "Blueprint", "Run", "Help")
Fill = Callable[[QMenu], None]


class MenuRow(QWidget):
    """The top row.

    Its menus come from the table of actions; ``submenus`` are filled each time they open.
    """

    def __init__(
        self, actions: Actions, tokens: Tokens, submenus: Mapping[str, tuple[str, Fill]]
    ) -> None:
        super().__init__()
        self.setObjectName("menu_row")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setFixedHeight(MENU_BAR)
        self._logo = Label()
        self.menus = QMenuBar()
        self.menus.setNativeMenuBar(False)
        self._badges: tuple[QWidget, ...] = ()
        self._title = _Title(self)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(12, 2, 12, 1)
        layout.setSpacing(8)
        layout.addWidget(self._logo)
        layout.addSpacing(4)
        layout.addWidget(self.menus, 0, Qt.AlignmentFlag.AlignVCenter)
        layout.addStretch(1)
        self._fill(actions, submenus)
        name_parts(self.menus)
        self.menus.setAccessibleName("Menus")
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._logo.setPixmap(_logo(tokens, self.devicePixelRatioF()))
        self._title.set_tokens(tokens)

    def add_badge(self, badge: QWidget) -> None:
        """Add a badge to the left of the others.

        The first badge, that of trust, stays at the right end. The title does not cover badges.
        """
        layout = self.layout()
        assert isinstance(layout, QHBoxLayout)
        at = layout.indexOf(self._badges[0]) if self._badges else layout.count()
        self._badges = (badge, *self._badges)
        layout.insertWidget(at, badge)
        badge.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Place the title again after a badge changed."""
        kind = QEvent.Type
        if event.type() in (kind.Show, kind.Hide, kind.Move, kind.Resize):
            self._place()
        return super().eventFilter(watched, event)

    def show_unsettled(self, shown: bool) -> None:
        """Show or hide the badge of trust.

        It is hidden for an unfinished drawing, which nobody can approve yet.
        """
        if self._badges:
            self._badges[-1].setVisible(shown)
        self._place()

    def show_title(self, name: str, edited: str) -> None:
        """Show the file name, and words about unsaved changes (empty if there are none)."""
        self._title.show_name(name, edited)
        self._place()

    @property
    def title(self) -> str:
        """The shown file name with the words about unsaved changes."""
        return self._title.words

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the title for the new width."""
        super().resizeEvent(event)
        self._place()

    def _place(self) -> None:
        """Put the title into the middle of the window, but not over menus or badges."""
        size = self._title.sizeHint()
        left = self.menus.geometry().right() + 16
        shown = [badge for badge in self._badges if not badge.isHidden()]
        right = min((badge.geometry().left() for badge in shown), default=self.width()) - 16
        wide = min(size.width(), max(0, right - left))
        at = max(left, min((self.width() - wide) // 2, right - wide))
        self._title.setGeometry(at, 1, wide, self.height() - 1)

    def _fill(self, actions: Actions, submenus: Mapping[str, tuple[str, Fill]]) -> None:
        for name in MENUS:
            # Alt and the first letter open it.
            menu = self.menus.addMenu(f"&{name}")
            menu.setToolTipsVisible(False)
            menu.aboutToShow.connect(actions.refresh)
            section, below = None, dict[str, QMenu]()
            for action in actions.in_menu(name):
                if section not in (None, action.section):
                    menu.addSeparator()
                section = action.section
                if action.inner and action.inner not in below:
                    below[action.inner] = menu.addMenu(action.inner)
                below.get(action.inner, menu).addAction(actions[action.id])
                if action.id in submenus:
                    words, fill = submenus[action.id]
                    inner = menu.addMenu(words)
                    inner.aboutToShow.connect(lambda inner=inner, fill=fill: fill(inner))


class _Title(QWidget):
    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._name = Elided()
        self._name.setProperty("role", "heading")
        self._dot = Label()
        self._edited = label("", "second")
        self.setLayout(row(self._name, self._dot, self._edited, spacing=6))
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    @property
    def words(self) -> str:
        """The name and the words about unsaved changes."""
        return self._name.text() + (
            f" {self._edited.text()}" if not self._edited.isHidden() else ""
        )

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._dot.setPixmap(pixmap("dot", tokens.acc, tokens.win, 16, self.devicePixelRatioF()))

    def show_name(self, name: str, edited: str) -> None:
        """Show a name, and words about unsaved changes (empty if there are none)."""
        self._name.setText(name)
        self._edited.setText(edited)
        self._dot.setVisible(bool(edited))
        self._edited.setVisible(bool(edited))
        self.setAccessibleName(plain_text(f"{name}, {edited}" if edited else name))


def _logo(tokens: Tokens, ratio: float) -> QPixmap:
    return pixmap("logo", tokens.acc, tokens.win, 18, ratio)
