"""Controls that Qt's Fusion style lacks or draws otherwise. Their colours come from the palette."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QLocale, QPoint, QRectF, QSize, Qt
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QFontMetrics,
    QKeyEvent,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QPalette,
    QPen,
    QResizeEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import (
    QAbstractButton,
    QComboBox,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QMenu,
    QPushButton,
    QSizePolicy,
    QStyledItemDelegate,
    QWidget,
)

from smsl_studio.legible import plain_text
from smsl_studio.studio.base.icons import draw
from smsl_studio.studio.base.theme import CONTROL, RADIUS_CONTROL
from smsl_studio.studio.base.tips import tip_text

Role, Keys = QPalette.ColorRole, QKeySequence.StandardKey
LEFT, BESIDE_TEXT = 9, 31
"""Pixels left of the text of a combo box, and left and right of it together (with the chevron)."""


class Label(QLabel):
    """A label that shows a text literally: no markup, and control characters have no effect.

    With ``rich`` it shows markup instead. Texts from outside must then be escaped already.
    """

    def __init__(
        self, text: str = "", parent: QWidget | None = None, *, rich: bool = False
    ) -> None:
        super().__init__(parent)
        self._rich = rich
        self.setTextFormat(Qt.TextFormat.RichText if rich else Qt.TextFormat.PlainText)
        self.setText(text)

    def setText(self, text: str) -> None:
        """Replace the text."""
        super().setText(text if self._rich else plain_text(text))


def label(text: str, role: str, parent: QWidget | None = None) -> Label:
    """A label with a role of the style sheet (heading, second, small, hint, refusal ...)."""
    made = Label(text, parent)
    made.setProperty("role", role)
    if role in {"hint", "refusal"}:
        made.setWordWrap(True)
    return made


class Elided(Label):
    """A label of one line that leaves out the middle of a text that is too long.

    It has no minimum width.
    """

    def __init__(self, text: str = "", parent: QWidget | None = None) -> None:
        self._told = ""
        super().__init__(text, parent)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)

    def minimumSizeHint(self) -> QSize:
        """No minimum width, because the text can be shortened."""
        return QSize(0, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Update the tooltip, which has the whole text if it no longer fits."""
        super().resizeEvent(event)
        self._tell_whole()

    def setText(self, text: str) -> None:
        """Replace the text; the tooltip has the whole of it if it does not fit."""
        before = self.text()
        super().setText(text)
        if self.text() != before:
            self._tell_whole()

    def _tell_whole(self) -> None:
        """Put the whole text into the tooltip if it is cut, unless another tooltip was set."""
        whole = self.text()
        if self.toolTip() in ("", self._told):
            cut = self.sizeHint().width() > self.width()
            told = tip_text(whole if cut else "")
            self._told = told
            self.setToolTip(told)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the text; if it is too long, without its middle."""
        painter = QPainter(self)
        room = self.contentsRect()
        shown = self.fontMetrics().elidedText(
            plain_text(self.text()), Qt.TextElideMode.ElideMiddle, room.width()
        )
        painter.setPen(self.palette().color(self.foregroundRole()))
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, shown)


PARTS = {
    "qt_tableview_cornerbutton": "Select all",
    "qt_toolbar_ext_button": "More tools",
    "qt_menubar_ext_button": "More menus",
}
"""Accessible names for the buttons that Qt makes inside its own widgets."""


def name_parts(widget: QWidget) -> None:
    """Give accessible names to the parts that Qt makes inside a control and leaves without one.

    Otherwise a screen reader would say only "button" or "list".
    """
    for button in widget.findChildren(QAbstractButton):
        if not button.text() and not button.accessibleName():
            inner = isinstance(button.parent(), QLineEdit)
            button.setAccessibleName(
                plain_text("Clear" if inner else PARTS.get(button.objectName(), ""))
            )
    for menu in widget.findChildren(QMenu):
        if not menu.accessibleName():
            menu.setAccessibleName(plain_text(menu.title().replace("&", "")))


def rule(vertical: bool = False, length: int | None = None) -> QFrame:
    """A line one pixel wide that separates groups."""
    line = QFrame()
    line.setProperty("role", "rule")
    if vertical:
        line.setFixedWidth(1)
        if length:
            line.setFixedHeight(length)
    else:
        line.setFixedHeight(1)
    return line


def row(*widgets: QWidget | int | None, spacing: int = 8) -> QHBoxLayout:
    """A layout of widgets side by side; None is a stretch, a number is a gap in pixels."""
    layout = QHBoxLayout()
    layout.setContentsMargins(0, 0, 0, 0)
    layout.setSpacing(spacing)
    for widget in widgets:
        if widget is None:
            layout.addStretch(1)
        elif isinstance(widget, int):
            layout.addSpacing(widget)
        else:
            layout.addWidget(widget)
    return layout


def row_button(words: str, tip: str) -> QPushButton:
    """A low button that fits into a row. ``tip`` says what it does."""
    button = QPushButton(words)
    button.setProperty("role", "row")
    button.setToolTip(tip_text(tip))
    return button


class NameDelegate(QStyledItemDelegate):
    """Paints the entries of a list literally; the data of the entries stays unchanged."""

    def displayText(self, value: object, locale: QLocale | QLocale.Language) -> str:
        """The text of an entry."""
        return plain_text(super().displayText(value, locale))


class Combo(QComboBox):
    """A combo box in the style of the window.

    The wheel scrolls the panel around it, not its entries.

    ``accent`` highlights a choice where "none" is usual (such as a sub-SB under a fact).
    """

    def __init__(self, parent: QWidget | None = None, height: int = CONTROL) -> None:
        super().__init__(parent)
        self.accent = False
        self.setFixedHeight(height)
        self.setMinimumWidth(60)
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMaxVisibleItems(16)
        self.setItemDelegate(NameDelegate(self))
        self.view().setAccessibleName("Choices")

    def words_in(self, room: int, metrics: QFontMetrics) -> str:
        """The words of the choice that are shown in so much room (pixels)."""
        whole = plain_text(self.currentText())
        return metrics.elidedText(whole, Qt.TextElideMode.ElideMiddle, room)

    def width_of_entries(self, least: int, most: int) -> int:
        """The width that the longest entry needs (pixels), between ``least`` and ``most``."""
        metrics = self.fontMetrics()
        texts = (self.itemText(at) for at in range(self.count()))
        widest = max((metrics.horizontalAdvance(text) for text in texts), default=0)
        return max(least, min(most, widest + BESIDE_TEXT + 1))

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Ignore the wheel, so that scrolling a panel changes no choice."""
        event.ignore()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the border, the choice and the chevron."""
        palette, focus = self.palette(), self.hasFocus()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        width = 2.0 if focus else 1.0
        edge = palette.color(Role.Accent if focus or self.accent else Role.Dark)
        if not self.isEnabled():
            edge = palette.color(Role.Midlight)
        painter.setPen(QPen(edge, width))
        painter.setBrush(palette.color(Role.Base if self.isEnabled() else Role.AlternateBase))
        inset = width / 2
        box = QRectF(self.rect()).adjusted(inset, inset, -inset, -inset)
        painter.drawRoundedRect(box, RADIUS_CONTROL, RADIUS_CONTROL)
        ink = palette.color(Role.Accent if self.accent else Role.Text)
        if not self.isEnabled() or (not self.accent and self.property("pale")):
            ink = palette.color(Role.PlaceholderText)
        draw(painter, "chevron-down", QRectF(self.width() - 21, self.height() / 2 - 5.5, 12, 12),
             ink, palette.color(Role.Base))  # fmt: skip
        painter.setPen(ink)
        font = self.font()
        font.setWeight(font.Weight.Medium if self.accent else font.Weight.Normal)
        painter.setFont(font)
        room = self.rect().adjusted(LEFT, 0, LEFT - BESIDE_TEXT, 0)
        text = self.words_in(room.width(), painter.fontMetrics())
        painter.drawText(
            room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, plain_text(text)
        )


class Switch(QAbstractButton):
    """A switch, drawn as a thumb in a track. The words beside it say what it switches."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setCheckable(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setFixedSize(36, 22)

    def sizeHint(self) -> QSize:
        """The size of the track and the room around it."""
        return QSize(36, 22)

    def hitButton(self, pos: QPoint) -> bool:
        """Take a click anywhere in the rectangle."""
        return self.rect().contains(pos)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint track and thumb, and a frame while it has the keyboard focus."""
        palette = self.palette()
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        track = QRectF(2, 2, 32, 18)
        on = self.isChecked()
        painter.setPen(QPen(palette.color(Role.Accent if on else Role.Dark), 1.2))
        painter.setBrush(palette.color(Role.Accent if on else Role.Base))
        painter.drawRoundedRect(track, 9, 9)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(palette.color(Role.BrightText if on else Role.Dark))
        painter.drawEllipse(QRectF(18.5 if on else 4.5, 4.5, 13, 13))
        if self.hasFocus():
            painter.setPen(QPen(palette.color(Role.Accent), 1.5))
            painter.setBrush(QColor(0, 0, 0, 0))
            painter.drawRoundedRect(QRectF(0.75, 0.75, 34.5, 20.5), 10, 10)


class Field(QLineEdit):
    """A line edit whose text counts after Enter or when the field is left.

    Escape restores the old text. A short ``suffix`` (a unit, an explanation) stands at the right.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._settled = ""
        self._suffix = Label("", self)
        self._suffix.setProperty("role", "hint")
        self._suffix.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._suffix.hide()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    @property
    def changed(self) -> bool:
        """Whether the text differs from the value that was shown."""
        return self.text() != self._settled

    def settle(self, text: str) -> None:
        """Show a value and drop what was being typed."""
        self._settled = text
        if self.text() != text:
            self.setText(text)
            self.setCursorPosition(0)
        self.set_refused(False)

    def set_refused(self, refused: bool) -> None:
        """Mark or unmark the text as refused."""
        if bool(self.property("refused")) != refused:
            self.setProperty("refused", refused)
            self.style().unpolish(self)
            self.style().polish(self)

    def set_suffix(self, text: str) -> None:
        """Show a short text at the right, such as a unit; empty hides it."""
        before = self._suffix.text(), self._suffix.isHidden()
        self._suffix.setText(text)
        self._suffix.setVisible(bool(text))
        if before != (self._suffix.text(), self._suffix.isHidden()):
            self._suffix.adjustSize()
            self._place_suffix()

    def event(self, event: QEvent) -> bool:
        """Let Undo and Redo act on the drawing, unless something is being typed here."""
        if (
            isinstance(event, QKeyEvent)
            and event.type() is QEvent.Type.ShortcutOverride
            and (event.matches(Keys.Undo) or event.matches(Keys.Redo))
            and not self.changed
        ):
            event.ignore()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Escape restores the old text; other keys type."""
        if event.key() == Qt.Key.Key_Escape and self.changed:
            self.settle(self._settled)
            self.selectAll()
            return
        super().keyPressEvent(event)

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Select the whole text after Tab."""
        super().focusInEvent(event)
        if event.reason() in {Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason}:
            self.selectAll()

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Scroll back to the beginning of the text."""
        super().focusOutEvent(event)
        if event.reason() is not Qt.FocusReason.PopupFocusReason:
            self.setCursorPosition(0)

    def resizeEvent(self, event: object) -> None:
        """Move the suffix to the right end."""
        super().resizeEvent(event)  # type: ignore[arg-type]
        self._place_suffix()

    def _place_suffix(self) -> None:
        size = self._suffix.sizeHint()
        self._suffix.resize(size)
        self._suffix.move(self.width() - size.width() - 10, (self.height() - size.height()) // 2)
