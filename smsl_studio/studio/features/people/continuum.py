"""The panel "Human and automation": the levels of operations, facts, inspection, supervision."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QPushButton, QVBoxLayout, QWidget

from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.controls import label
from smsl_studio.studio.base.theme import Tokens
from smsl_studio.studio.base.tips import tip_text
from smsl_studio.studio.base.words import counted
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.people.continuum_view import ContinuumView, continuum_view
from smsl_studio.studio.features.people.scale import Ends, ScaleRow, WholeRow
from smsl_studio.studio.running.next_levels import NextLevels
from smsl_studio.studio.running.run_session import RunSession

RECORDED = "Levels were set before the run and are part of its record."
UNSET = "Where nobody is named as acting, it counts as automatic."
DECLARED = "Levels of the blueprint. They can be set before a run."


class Continuum(QWidget):
    """Shows the levels of the present run, or else those of the next one.

    The levels of a run cannot be changed. The button is then disabled, and the note says why.
    """

    edit_wanted = Signal()

    def __init__(
        self, session: Session, run: RunSession, levels: NextLevels, tokens: Tokens
    ) -> None:
        super().__init__()
        self._session, self._run, self._levels = session, run, levels
        self._tokens = tokens
        self._shown: Blueprint | None = None
        self._state: tuple[dict[str, str], bool] = {}, False
        self.view: ContinuumView | None = None
        self.setAccessibleName("Human and automation")
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.edit = QPushButton("Edit levels…")
        self.edit.setProperty("role", "row")
        self.edit.clicked.connect(self.edit_wanted)
        self.rows: list[ScaleRow] = []
        self._ends, self.whole = Ends(tokens), WholeRow(tokens)
        self.note = label("", "hint")
        self.note.setContentsMargins(12, 0, 12, 8)
        head = QWidget()
        head.setFixedHeight(36)
        across = QHBoxLayout(head)
        across.setContentsMargins(12, 0, 12, 0)
        across.addWidget(label("Human and automation", "heading"))
        across.addStretch(1)
        across.addWidget(self.edit)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(0)
        for part in (head, self._ends, self.whole, self.note):
            self._column.addWidget(part)
        self._column.addStretch(1)
        session.blueprint_changed.connect(lambda *_: self.refresh())
        run.exists_changed.connect(lambda _: self.refresh())
        run.changed.connect(self.refresh)
        levels.changed.connect(self.refresh)
        self.refresh()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        self._tokens = tokens
        for part in (self._ends, self.whole, *self.rows):
            part.set_tokens(tokens)

    def refresh(self) -> None:
        """Show the present levels.

        Nothing is computed without a change or while the panel is hidden.
        """
        blueprint, levels = self._now()
        kept = self._kept
        state = (levels, kept)
        if not self.isVisible() or (blueprint is self._shown and state == self._state):
            return
        self._shown, self._state = blueprint, state
        self._show(continuum_view(blueprint, Levels(blueprint, levels)))
        self.edit.setEnabled(not kept)
        self.edit.setToolTip(
            tip_text("A run keeps the levels it began with" if kept
            else "Who does, senses, inspects and supervises in the next run")
        )  # fmt: skip
        here = counted(len(levels), "level")
        said = f"{here} set for the next run; the others as declared." if levels else DECLARED
        self.note.setText(f"{RECORDED if kept else said} {UNSET}")

    def showEvent(self, event: object) -> None:
        """Show the present levels."""
        super().showEvent(event)  # type: ignore[arg-type]
        self.refresh()

    @property
    def _kept(self) -> bool:
        """Whether the panel shows the levels of a run, which cannot be changed."""
        return self._run.exists or self._run.is_another(self._session.blueprint)

    def _now(self) -> tuple[Blueprint, dict[str, str]]:
        run = self._run
        if self._kept and run.blueprint is not None and run.choice is not None:
            return run.blueprint, dict(run.choice.levels)
        return self._session.blueprint, dict(self._levels.set)

    def _show(self, view: ContinuumView) -> None:
        self.view = view
        if not self.rows:
            self.rows = [ScaleRow(row, self._tokens) for row in view.rows]
            for at, row in enumerate(self.rows):
                self._column.insertWidget(2 + at, row)
        for row, shown in zip(self.rows, view.rows, strict=True):
            row.show_view(shown)
        self.whole.show_whole(view.position, view.words)
