"""BranchView: what shows one SB, as its gestures, keys and floating widgets know it.

It knows where it looks, what may be done in it, and by which signals it tells what somebody wants.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF, QRectF, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.studio.base.canvas.camera import STEP
from smsl_studio.studio.base.canvas.frames import frame_of, opening_of
from smsl_studio.studio.base.canvas.stage import Stage
from smsl_studio.studio.base.theme import Tokens

TOP = 40
"""The height that belongs to the breadcrumb."""


class BranchView(Stage):
    """Looks at a part of one SB. Positions in signals are scene points.

    ``editing`` is False in Run mode: nothing moves, and a click on an operation asks for it
    (``edge_clicked``).
    """

    selection_wanted = Signal(object)
    """tuple[Address]: what shall be selected."""
    add_state_wanted = Signal(QPointF)
    """A state is wanted at this point (double click on empty canvas)."""
    connect_wanted = Signal(object, object, QPointF)
    """(source, target or None, point): an operation is wanted; without target, a state too."""
    retarget_wanted = Signal(object, object)
    """(operation, new target state): the arrowhead was dragged there."""
    rename_wanted = Signal(object)
    """Address whose name shall be edited in place."""
    moved = Signal(object)
    """dict[str, (x, y)]: states that were dragged and let go."""
    enter_wanted = Signal(str)
    """A sub-SB shall be shown."""
    leave_wanted = Signal()
    """The base SB shall be shown."""
    edge_clicked = Signal(object)
    """Address of an operation that was clicked while not editing."""
    node_clicked = Signal(object)
    """Address of a state that was clicked while not editing."""
    context_wanted = Signal(object, object)
    """(Address or None, global point): a context menu is wanted."""
    quick_add_wanted = Signal()
    """Tab or /: an operation shall be added from the selected state."""
    pressed = Signal()
    """A mouse button went down on the canvas."""
    delete_wanted = Signal()
    """Del: the selection shall go."""
    fact_wanted = Signal(int)
    """A fact of a selected state was clicked: its digit."""
    verb_wanted = Signal(str)
    """A key asks for an action of the window by its id: copy, cut, paste, duplicate, find."""
    hover_changed = Signal(object)
    """Address under the pointer, or None."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(tokens, parent)
        self.editing = True
        self.why_not: Callable[[Address, Address], str] = lambda source, target: ""
        """Why an operation from a state to another is impossible; the empty text if it is not."""
        self.extended: Callable[[], tuple[Address, ...]] = lambda: self.marks.selection
        """What a click with Shift or Ctrl adds to."""

    def say(self, text: str, at: QPointF | None = None) -> None:
        """Say a short sentence at the pointer, or at a scene point."""

    def top_room(self) -> int:
        """The height at the top that belongs to what stands over the picture."""
        return TOP

    def zoom_to(self, zoom: float) -> None:
        """Zoom about the middle: 1.0 is 100 %."""
        self.camera.keep("")
        self.camera.go(self.camera.centre, zoom)

    def zoom_in(self) -> None:
        """Zoom in one step about the middle."""
        self.zoom_to(self.zoom * STEP)

    def zoom_out(self) -> None:
        """Zoom out one step about the middle."""
        self.zoom_to(self.zoom / STEP)

    def fit(self, smooth: bool = True) -> None:
        """Show everything, at 100 % at most."""
        sheet = self.sheet
        self.camera.keep("fit", fitted=True)
        if sheet is None or not len(sheet.at):
            self.camera.go(QPointF(0.0, 0.0), 1.0, smooth)
            return
        self._look_below_top(*frame_of(sheet, self._room), smooth)

    def look_at_opening(self) -> None:
        """Show everything; where states could not be told apart then, what is about the initial.

        While nobody draws everything is shown all the same: what runs is lit and named.
        """
        sheet = self.sheet
        if sheet is None or not len(sheet.at):
            self.fit(smooth=False)
            self.camera.keep("opening", fitted=True)
            return
        whole = frame_of(sheet, self._room)
        first = opening_of(sheet, self._room, whole[1]) if self.editing else None
        self.camera.keep("opening", fitted=first is None)
        self._look_below_top(*(first or whole), smooth=False)

    def look_again(self) -> None:
        """There is more room or less: look at what was looked at, if nobody zoomed or panned."""
        if self.camera.keeps == "fit":
            self.fit(smooth=False)
        elif self.camera.keeps == "opening":
            self.look_at_opening()

    @property
    def _room(self) -> tuple[float, float]:
        """The pixels a picture may fill: all but the top, which belongs to the breadcrumb."""
        view = self.viewport()
        return float(view.width()), float(view.height() - self.top_room())

    def _look_below_top(self, middle: QPointF, zoom: float, smooth: bool) -> None:
        top = self.top_room()
        self.camera.go(middle - QPointF(0.0, top / 2 / zoom), zoom, smooth)

    def reveal(self, address: Address, smooth: bool = True) -> None:
        """Bring a state or operation into view, without zooming, where it is not in view yet."""
        rect = self.rect_of(address)
        if rect is not None:
            self.reveal_point(rect.center(), smooth)

    def reveal_point(self, at: QPointF, smooth: bool = True) -> None:
        """Scroll until a scene point is in view, where it is not; it is in the middle then."""
        self.camera.finish()
        if not self.clear_view.contains(at):
            self.camera.keep("")
            self.camera.go(at, self.zoom, smooth)

    @property
    def clear_view(self) -> QRectF:
        """The part of the scene in view in which a node is whole, and below the breadcrumb."""
        view = self.viewport().rect()
        across, down = min(70, view.width() // 3), min(64, view.height() // 3)
        return self.mapToScene(view.adjusted(across, down, -across, -down)).boundingRect()
