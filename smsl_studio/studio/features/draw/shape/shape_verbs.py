"""The commands that change the shape of a blueprint and keep its behaviour."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDialog, QWidget

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.beside import Beside
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.base.overlays.work_card import WorkCard
from smsl_studio.studio.document.session import Session

if TYPE_CHECKING:
    from smsl_studio.generate.shapes.identify import FoundCut, Identification
    from smsl_studio.generate.shapes.same_states import SameStates
    from smsl_studio.studio.features.draw.shape.shape_edit import ShapeEdit, ShapeRefusal

NONE = (
    "No states could be a sub-SB that saves states or facts. "
    "Select states and extract them if they belong together anyway"
)
"""The answer of *Identify* where nothing can be saved."""


class ShapeVerbs(QObject):
    """Computes a change in a second thread, shows a preview, and makes the change on request.

    An edit of the drawing in the meantime ends all of this. The preview blocks ``window``.
    """

    said = Signal(str)
    """str: a hint for the person, shown for a short time."""
    run_wanted = Signal(object, str)
    """(steps, title): show this run on the drawing."""

    def __init__(self, session: Session, canvas: Canvas, window: QWidget) -> None:
        super().__init__(window)
        self._session, self._canvas, self._window = session, canvas, window
        self._beside = Beside(self)
        self.card: WorkCard | None = None
        """The card that says that a change is being computed. The person can cancel it there."""
        self.dialog: QDialog | None = None
        """The dialog that is open now."""
        session.blueprint_changed.connect(lambda *_: self._outdated())
        session.broken_changed.connect(self._outdated)

    # Which commands are possible now.

    def can_flatten(self) -> bool:
        """Whether the blueprint has several SBs."""
        return self._session.broken is None and len(self._session.blueprint) > 1

    def can_extract(self) -> bool:
        """Whether some states of one SB are selected, but not all."""
        states = self._states()
        branch = self._session.blueprint.branches.get(self._session.branch)
        return bool(states) and branch is not None and len(states) < len(branch.table)

    def can_inline(self) -> bool:
        """Whether the shown SB is a sub-SB."""
        return self._session.branch in self._session.blueprint.bases

    def can_identify(self) -> bool:
        """Whether an SB has states from which a sub-SB could be made."""
        return any(len(branch.table) > 1 for branch in self._session.blueprint)

    # The commands.

    def flatten(self) -> None:
        """Replace all SBs by one SB."""
        from smsl_studio.studio.features.draw.shape.shape_edit import flat_edit

        self._compute("Making one State Branch of all", flat_edit)

    def extract(self) -> None:
        """Make a sub-SB of the selected states."""
        from smsl_studio.studio.features.draw.shape.shape_edit import extract_edit

        states = tuple(self._states())
        work = partial(extract_edit, branch=self._session.branch, states=states)
        self._compute("Looking whether these states can be a sub-SB", work)

    def inline(self) -> None:
        """Put the shown sub-SB back into its base."""
        from smsl_studio.studio.features.draw.shape.shape_edit import inline_edit

        sub = self._session.branch
        self._compute(f"Putting {sub} back", partial(inline_edit, sub=sub))

    def identify(self) -> None:
        """List the groups of states that could become a sub-SB."""
        from smsl_studio.studio.features.draw.shape.shape_edit import identified

        self._begin("Looking for states that could be a sub-SB", identified, self._identified)

    def merge(self, same: SameStates) -> None:
        """Merge states that behave alike into one."""
        from smsl_studio.studio.features.draw.shape.shape_edit import merge_edit

        self._compute("Merging states", partial(merge_edit, same=same))

    def stop(self) -> None:
        """End all work, because the window closes."""
        self._beside.stop()

    # Computing, showing and making a change.

    def _states(self) -> list[str]:
        chosen = self._session.selection
        return [a.state for a in chosen if a.state and not a.operation]

    def _compute(self, words: str, work: Callable[[Blueprint], ShapeEdit]) -> None:
        self._begin(words, work, self._show)

    def _begin(
        self, words: str, work: Callable[[Blueprint], Any], then: Callable[[Any], None]
    ) -> None:
        self._give_up()
        self._session.settling.emit()
        if self._session.broken is not None:
            self._session.refused.emit(self._session.broken.refusal)
            return
        canvas = self._canvas
        card = self.card = WorkCard(canvas, canvas.tokens, words)
        card.cancelled.connect(self._give_up)
        card.move((canvas.width() - card.width()) // 2, canvas.top_room() + 8)
        card.show()
        card.raise_()
        card.cancel.setFocus()
        from smsl_studio.studio.features.draw.shape.shape_edit import tried

        blueprint = self._session.blueprint
        self._beside.do(partial(tried, work, blueprint), partial(self._came, blueprint, then))

    def _came(self, before: Blueprint, then: Callable[[Any], None], came: Any) -> None:
        from smsl_studio.studio.features.draw.shape.shape_edit import ShapeRefusal

        self._close_card()
        if before is not self._session.blueprint:
            return
        if isinstance(came, ShapeRefusal):
            self._refuse(came)
        else:
            then(came)

    def _show(self, edit: ShapeEdit) -> None:
        from smsl_studio.studio.features.draw.shape.shape_preview import ShapePreview

        preview = ShapePreview(edit, self._canvas.tokens, self._window)
        preview.apply_wanted.connect(lambda: self._apply(edit))
        preview.undo_wanted.connect(self._session.history.undo)
        preview.redo_wanted.connect(self._session.history.redo)
        self._open(preview)

    def _apply(self, edit: ShapeEdit) -> None:
        dialog, self.dialog = self.dialog, None
        if dialog is not None:
            dialog.accept()
        self._session.edit(edit.words, lambda _: edit.after)

    def _identified(self, found: Identification) -> None:
        if not found.cuts:
            self.said.emit(NONE)
            return
        from smsl_studio.studio.features.draw.shape.identify_dialog import IdentifyDialog

        dialog = IdentifyDialog(found, self._canvas.tokens, self._window)
        dialog.chosen.connect(self._preview_cut)
        self._open(dialog)

    def _preview_cut(self, found: FoundCut) -> None:
        from smsl_studio.studio.features.draw.shape.shape_edit import found_edit

        self._show(found_edit(self._session.blueprint, found))

    def _refuse(self, refusal: ShapeRefusal) -> None:
        if not refusal.run:
            self._session.refused.emit(refusal.error)
            return
        from smsl_studio.studio.features.draw.shape.refused_shape import RefusedShape

        dialog = RefusedShape(refusal, self._canvas.tokens, self._window)
        title = "Run that shows why"
        dialog.run_wanted.connect(lambda: self.run_wanted.emit(refusal.steps, title))
        self._open(dialog)

    def _open(self, dialog: QDialog) -> None:
        self.dialog = dialog
        dialog.finished.connect(self._answered)
        dialog.open()

    def _answered(self) -> None:
        if self.sender() is self.dialog:
            self.dialog = None

    def _outdated(self) -> None:
        """Drop the change that is computed or shown, because it belongs to an earlier drawing."""
        self._give_up()
        dialog, self.dialog = self.dialog, None
        if dialog is not None:
            dialog.reject()
            self.said.emit("The drawing has changed, so the preview was closed")

    def _give_up(self) -> None:
        self._beside.drop()
        self._close_card()

    def _close_card(self) -> None:
        card, self.card = self.card, None
        if card is not None:
            card.close_field()
