"""The top row: logo, menus, the file name in the middle, and badges at the right."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QEvent, QObject, QRectF, QSize, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPaintEvent, QPen, QPixmap, QResizeEvent
from PySide6.QtWidgets import QHBoxLayout, QMenu, QMenuBar, QWidget

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.actions import Actions
from smsl_studio.studio.base.controls import Elided, Label, label, name_parts, row
from smsl_studio.studio.base.icons import draw, pixmap
from smsl_studio.studio.base.theme import MENU_BAR, Tokens, text_font

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
        self.badge = Badge("Uninspected", "shield", tokens)
        self.badge.setToolTip(
            "Nobody has inspected and signed this blueprint. It runs in simulation only."
        )
        self._badges: tuple[QWidget, ...] = (self.badge,)
        self._title = _Title(self)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(12, 2, 12, 1)
        layout.setSpacing(8)
        layout.addWidget(self._logo)
        layout.addSpacing(4)
        layout.addWidget(self.menus, 0, Qt.AlignmentFlag.AlignVCenter)
        layout.addStretch(1)
        layout.addWidget(self.badge)
        self._fill(actions, submenus)
        name_parts(self.menus)
        self.menus.setAccessibleName("Menus")
        self.set_tokens(tokens)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._logo.setPixmap(_logo(tokens, self.devicePixelRatioF()))
        self.badge.set_tokens(tokens)
        self._title.set_tokens(tokens)

    def add_badge(self, badge: QWidget) -> None:
        """Add a badge before the badge "Uninspected". The title does not cover it."""
        self._badges = (badge, *self._badges)
        layout = self.layout()
        assert isinstance(layout, QHBoxLayout)
        layout.insertWidget(layout.indexOf(self.badge), badge)
        badge.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Place the title again after a badge changed."""
        kind = QEvent.Type
        if event.type() in (kind.Show, kind.Hide, kind.Move, kind.Resize):
            self._place()
        return super().eventFilter(watched, event)

    def show_unsettled(self, shown: bool) -> None:
        """Show or hide the badge "Uninspected": an unfinished drawing is not to be approved yet."""
        self.badge.setVisible(shown)
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
            menu = self.menus.addMenu(name)
            menu.setToolTipsVisible(False)
            menu.aboutToShow.connect(actions.refresh)
            section = None
            for action in actions.in_menu(name):
                if section not in (None, action.section):
                    menu.addSeparator()
                section = action.section
                menu.addAction(actions[action.id])
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


class Badge(QWidget):
    """A small box with icon and words. Its dashed border means that something is not settled."""

    def __init__(self, words: str, icon: str, tokens: Tokens) -> None:
        super().__init__()
        self._words, self._icon, self._tokens = words, icon, tokens
        self._font = text_font(12, 500)
        self.setAccessibleName(plain_text(words))
        self.setFixedSize(self.sizeHint())

    def sizeHint(self) -> QSize:
        """Wide enough for the words."""
        return QSize(round(QFontMetricsF(self._font).horizontalAdvance(self._words)) + 38, 22)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint a dashed box with icon and words."""
        tokens, painter = self._tokens, QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        pen = QPen(tokens.risk, 1)
        pen.setDashPattern([3, 2])
        painter.setPen(pen)
        painter.setBrush(tokens.risks)
        painter.drawRoundedRect(QRectF(self.rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6)
        draw(painter, self._icon, QRectF(9, 4.5, 13, 13), tokens.risk, tokens.risks)
        painter.setPen(tokens.risk)
        painter.setFont(self._font)
        room = self.rect().adjusted(28, 0, 0, 0)
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter, plain_text(self._words))


def _logo(tokens: Tokens, ratio: float) -> QPixmap:
    return pixmap("logo", tokens.acc, tokens.win, 18, ratio)
