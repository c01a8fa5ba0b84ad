"""CanvasCollapse: decides whether a canvas draws bundles of operations as one line."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QObject

from smsl_studio.picture.crowded import is_crowded, may_be_crowded
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.shared_collapse import SharedCollapse
from smsl_studio.studio.base.canvas.sheet import Position, Sheet


class CanvasCollapse(QObject):
    """Decides whether a canvas draws all operations between two states as one line.

    The person's choice for the file decides. Without a choice, an SB is collapsed if there is no
    space for the names. A canvas without a ``SharedCollapse`` draws every operation by itself.
    """

    def __init__(self, canvas: BranchView, draw_again: Callable[[], None]) -> None:
        super().__init__(canvas)
        self._canvas, self._draw_again = canvas, draw_again
        self._shared: SharedCollapse | None = None
        self._name = ""
        self._judged: str | None = None
        self.on = False
        """Whether all operations between the same two states are drawn as one line now."""
        canvas.collapse_wanted.connect(self._choose)

    def join(self, shared: SharedCollapse, name: str = "") -> None:
        """Share the choices of the other canvases, from the next drawing on.

        The choice is kept under ``name``. Without a name it is kept under the file of the shown
        blueprint.
        """
        self._shared, self._judged, self._name = shared, None, name
        shared.chosen.connect(self._chosen)

    def forget(self) -> None:
        """Forget the decision, because the canvas shows another file next."""
        self._judged = None

    def knows(self, branch: str) -> bool:
        """Whether it has been decided for the SB of this name."""
        return self._judged == branch

    def judge(self, picture: Picture, positions: Mapping[str, Position]) -> None:
        """Decide whether an SB is drawn collapsed, when the canvas opens it."""
        canvas, shared, branch = self._canvas, self._shared, picture.branch
        self._judged = branch.name
        if shared is None:
            self.on = canvas.crowded = False
            return
        crowded = shared.crowded(branch)
        if crowded is None:
            crowded = may_be_crowded(picture) and is_crowded(
                Sheet(picture, positions, canvas.ink, Marks()).geometry
            )
            shared.learn(branch, crowded)
        wish = shared.wish(self._name or picture.blueprint.file)
        self.on = crowded if wish is None else wish
        canvas.crowded = crowded or self.on

    def turn(self, on: bool) -> None:
        """Draw the operations between two states as one line, or each by itself."""
        if on != self.on:
            self.on, self._canvas.crowded = on, True
            self._draw_again()

    @property
    def _file(self) -> str:
        """The name under which the choice for the shown SB is kept."""
        sheet = self._canvas.sheet
        return self._name or (sheet.picture.blueprint.file if sheet is not None else "")

    def _choose(self, on: bool) -> None:
        if self._shared is not None:
            self._shared.choose(self._file, on)

    def _chosen(self, file: str, on: bool) -> None:
        if file == self._file:
            self.turn(on)
