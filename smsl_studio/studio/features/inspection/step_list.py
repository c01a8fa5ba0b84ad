"""A list of the operations out of a configuration. Refused ones show the reason."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QApplication,
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.front.views.states import short_name
from smsl_studio.inspection.explorer.onward import OnwardStep
from smsl_studio.legible import plain_text
from smsl_studio.studio.base.controls import Elided, Label, label
from smsl_studio.studio.base.focus_line import FocusLine
from smsl_studio.studio.base.icons import pixmap
from smsl_studio.studio.base.tab_order import in_order
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import capital

MOST = 100
"""At most this many permitted and this many refused operations are shown."""
HIGH = 30
NONE_REFUSED = "No operation out of these states is refused."
WHERE = 170
"""The largest width of the text that says where a step leads (pixels)."""


class StepList(QScrollArea):
    """All operations of the active states. Permitted ones are buttons.

    If the list changes while it has the keyboard focus, the focus stays in it.
    """

    step_wanted = Signal(object)
    """OnwardStep: the person wants to take this step."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._tokens = tokens
        self._blueprint: Blueprint | None = None
        self._steps: tuple[OnwardStep, ...] = ()
        self._empty = ""
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setAccessibleName("Next steps")
        FocusLine(self)

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        self._rebuild()

    def show_steps(
        self, blueprint: Blueprint, steps: Sequence[OnwardStep], empty: str = ""
    ) -> None:
        """Show other steps. If there are none, show the text ``empty``."""
        self._blueprint, self._steps, self._empty = blueprint, tuple(steps), empty
        self._rebuild()

    def buttons(self) -> Iterator[QPushButton]:
        """The buttons of the permitted operations, in order."""
        inner = self.widget()
        yield from inner.findChildren(QPushButton, "step") if inner else ()

    def refusals(self) -> Iterator[QWidget]:
        """The rows of the refused operations, in order."""
        inner = self.widget()
        yield from inner.findChildren(QFrame, "refused") if inner else ()

    def _rebuild(self) -> None:
        focus, old = QApplication.focusWidget(), self.widget()
        inside = focus is not None and old is not None and old.isAncestorOf(focus)
        if inside:
            self.setFocus()
        inner = QWidget()
        inner.setProperty("role", "panel")
        column = QVBoxLayout(inner)
        column.setContentsMargins(12, 0, 12, 8)
        column.setSpacing(3)
        permitted = [one for one in self._steps if one.permitted]
        refused = [one for one in self._steps if not one.permitted]
        for words, group, line in (
            ("Permitted next steps", permitted, self._button),
            ("Refused", refused, self._refusal),
        ):
            if group:
                column.addWidget(label(f"{words} ({len(group):,})", "small"))
            for step in group[:MOST]:
                column.addWidget(line(step))
            if len(group) > MOST:
                column.addWidget(label(f"and {len(group) - MOST:,} more", "hint"))
        if not permitted and self._empty:
            column.insertWidget(0, label(self._empty, "hint"))
        if permitted and not refused:
            column.addWidget(label(NONE_REFUSED, "hint"))
        column.addStretch(1)
        self.setWidget(inner)
        in_order(self, [*self.buttons(), *self.refusals()])
        first = next(self.buttons(), None)
        if inside and first is not None and first.isVisible():
            first.setFocus()

    def _button(self, step: OnwardStep) -> QWidget:
        button = QPushButton()
        button.setObjectName("step")
        button.setProperty("role", "step")
        button.setProperty("hazard", bool(step.hazard))
        where = f"meets the hazard {step.hazard}" if step.hazard else self._where(step)
        across = QHBoxLayout(button)
        across.setContentsMargins(8, 0, 8, 0)
        across.setSpacing(8)
        tokens = self._tokens
        sign = ("error", tokens.bad) if step.hazard else ("chevron-right", tokens.acc)
        mark = Label()
        mark.setPixmap(pixmap(*sign, tokens.surf, 14, self.devicePixelRatioF()))
        mark.setFixedWidth(16)
        name, right = Elided(step.address.operation), Elided(where)
        right.setProperty("role", "refusal" if step.hazard else "small")
        right.setSizePolicy(QSizePolicy.Policy.Maximum, QSizePolicy.Policy.Preferred)
        right.setMaximumWidth(WHERE)
        for part, stretch in ((mark, 0), (name, 1), (right, 0)):
            part.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
            across.addWidget(part, stretch)
        button.setFixedHeight(HIGH)
        button.setMinimumWidth(0)
        said = f"{step.address.operation}, {self._where(step)}"
        said += f", meets the hazard {step.hazard}" if step.hazard else ""
        button.setAccessibleName(plain_text(said))
        moves = "\n".join(f"{name} to {state}" for name, state in step.after.items())
        button.setToolTip(tip_text(f"{step.address}\n{moves}"))
        button.clicked.connect(lambda _=False: self.step_wanted.emit(step))
        return button

    def _where(self, step: OnwardStep) -> str:
        """Say in a few words where a permitted step leads."""
        assert self._blueprint is not None
        address, more = step.address, len(step.after) - 1
        words = short_name(self._blueprint[address.branch], step.target)
        if len(self._blueprint) > 1:
            words = f"{address.branch} {words}"
        return f"{words}, {more:,} more" if more > 0 else words

    def _refusal(self, step: OnwardStep) -> QWidget:
        line = _RefusedLine()
        line.setObjectName("refused")
        down = QVBoxLayout(line)
        down.setContentsMargins(8, 4, 8, 6)
        down.setSpacing(0)
        down.addWidget(label(step.address.operation, "medium"))
        reason = capital("; ".join(step.reasons))
        down.addWidget(label(reason, "hint"))
        line.setAccessibleName(plain_text(f"{step.address.operation} is refused. {reason}"))
        line.setToolTip(tip_text(f"{step.address}\n{reason}"))
        line.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        FocusLine(line)
        return line


class _RefusedLine(QFrame):
    """A refused operation. It takes the keyboard focus so that a screen reader can read it."""

    def minimumSizeHint(self) -> QSize:
        """The height of the text, and no minimum width, so that the list can be narrow."""
        return QSize(0, super().minimumSizeHint().height())
