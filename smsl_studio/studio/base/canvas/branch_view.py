"""BranchView: a view of one SB, as gestures, keys and floating widgets see it.

It has the camera, the switch ``editing``, and the signals by which user requests leave the canvas.
"""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QPointF, QRect, QRectF, Signal
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.picture.levels import FULL_SIZE
from smsl_studio.studio.base.canvas.camera import STEP
from smsl_studio.studio.base.canvas.drawn_stage import DrawnStage
from smsl_studio.studio.base.canvas.frames import about, frame_of, opening_of
from smsl_studio.studio.base.canvas.sheet import Position
from smsl_studio.studio.base.theme import Tokens

TOP = 40
"""The height at the top that is kept free for the breadcrumb (pixels)."""
RIM = 8
"""The free room beside an element after the view was scrolled to it (pixels)."""


class BranchView(DrawnStage):
    """A view of one SB. Points in signals are scene points.

    ``editing`` is False in Run mode: nothing can be moved, and a click on an operation emits
    ``edge_clicked``.
    """

    selection_wanted = Signal(object)
    """tuple[Address]: select these elements."""
    add_state_wanted = Signal(QPointF)
    """Add a state at this point (double click on empty canvas)."""
    connect_wanted = Signal(object, object, QPointF)
    """(source, target or None, point): add an operation; without a target also add a state."""
    retarget_wanted = Signal(object, object)
    """(operation, new target state): the user dragged the arrowhead there."""
    source_wanted = Signal(object, object)
    """(operation, new source state): the user dragged the beginning of its line there."""
    line_wanted = Signal(object, object, bool)
    """(operation, EdgeLayout, whether this goes on with the same key): draw its line so."""
    rename_wanted = Signal(object)
    """Address: edit the name of this element in place."""
    moved = Signal(object, object)
    """(dict[str, (x, y)], dict[str, tuple[str, ...]]): the user dragged these states to these scene
    points, and these groups, by their keys, get these states."""
    nudge_wanted = Signal(float, float)
    """(dx, dy) in scene units: move the selected states (arrow keys)."""
    enter_wanted = Signal(str)
    """The name of a sub-SB: show it."""
    leave_wanted = Signal()
    """Show the base SB."""
    edge_clicked = Signal(object)
    """Address: an operation was clicked while ``editing`` is False."""
    node_clicked = Signal(object)
    """Address: a state was clicked while ``editing`` is False."""
    context_wanted = Signal(object, object)
    """(Address or None, point of the screen): open a context menu."""
    quick_add_wanted = Signal()
    """Add an operation from the selected state (Tab or /)."""
    sibling_wanted = Signal()
    """Add an operation from where the selected element is reached (Shift+Tab)."""
    pressed = Signal()
    """A mouse button went down on the canvas."""
    delete_wanted = Signal()
    """Delete the selection (Del)."""
    fact_wanted = Signal(int)
    """The digit of a fact of the selected state that was clicked."""
    verb_wanted = Signal(str)
    """The id of a window action whose key was pressed: copy, cut, paste, duplicate, find,
    set_value."""
    collapse_wanted = Signal(bool)
    """Draw operations between the same two states as one line, or each by itself."""
    hover_changed = Signal(object)
    """Address under the pointer, or None."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(tokens, parent)
        self.editing = True
        self._aim: QRectF | None = None
        self.pending = QRectF()
        """The place of a new state that is being named (scene), so nothing may float over it; empty
        if there is none."""
        self.came_by: Address | None = None
        """The operation along which a key came to the selected state; None before that."""
        self.crowded = False
        """Whether the SB has so many operations that it is or can be collapsed."""
        self.why_not: Callable[[Address, Address], str] = lambda source, target: ""
        """Called with (source, target): why there can be no such operation; empty if there can."""
        self.state_pick: Callable[[Address], bool] = lambda address: False
        """Called with a state that is clicked: whether an open card takes it."""
        self.extended: Callable[[], tuple[Address, ...]] = lambda: self.marks.selection
        """The selection that a click with Shift or Ctrl extends."""

    def say(self, text: str, at: QPointF | None = None) -> None:
        """Show a short sentence at the pointer, or at a scene point."""

    def top_room(self) -> int:
        """The height at the top that floating widgets cover (pixels)."""
        return TOP

    def zoom_to(self, zoom: float) -> None:
        """Zoom about the middle of the view; 1.0 is 100 %."""
        self.camera.keep("")
        self.camera.go(self.camera.centre, zoom)

    def zoom_in(self) -> None:
        """Zoom in one step about the middle of the view."""
        self.zoom_to(self.zoom * STEP)

    def zoom_out(self) -> None:
        """Zoom out one step about the middle of the view."""
        self.zoom_to(self.zoom / STEP)

    def fit(self, smooth: bool = True) -> None:
        """Show the whole SB, at 100 % at most."""
        sheet = self.sheet
        self.camera.keep("fit", fitted=True)
        if sheet is None or not len(sheet.at):
            self.camera.go(QPointF(0.0, 0.0), 1.0, smooth)
            return
        self._look_below_top(*frame_of(sheet, self._room), smooth)

    @property
    def shows_all(self) -> bool:
        """Whether the whole drawing is in view."""
        sheet = self.sheet
        return sheet is None or not len(sheet.at) or self._whole_view.contains(about(sheet))

    @property
    def positions(self) -> dict[str, Position]:
        """The places of the states (scene points) by name."""
        if self.sheet is None:
            return {}
        names = self.sheet.picture.names
        return {n: (x, y) for n, (x, y) in zip(names, self.sheet.at.tolist(), strict=True)}

    @property
    def outside(self) -> int:
        """The number of states whose centre is outside the view."""
        if self.sheet is None:
            return 0
        view, (x, y) = self.seen, self.sheet.at.T
        across, down = abs(x - view.center().x()), abs(y - view.center().y())
        return int(((across > view.width() / 2) | (down > view.height() / 2)).sum())

    def show_all(self) -> None:
        """Show the whole SB. The zoom stays if the SB fits into the view at it."""
        sheet = self.sheet
        if sheet is None or self.shows_all:
            return
        middle, most = frame_of(sheet, self._room)
        if most >= self.zoom:
            self.camera.keep("")
            self._look_below_top(middle, self.zoom, smooth=True)
        else:
            self.fit()

    def hold(self, before: Position, after: Position) -> None:
        """Scroll so that a state, which has moved, stays where it is on the screen."""
        way = QPointF(*after) - QPointF(*before)
        self.camera.keep("")
        self.camera.go(self.camera.centre + way, self.zoom, smooth=False)

    def look_at_opening(self) -> None:
        """Show the whole SB, or the part around the initial state if states would be too small.

        With ``editing`` off it always shows the whole, because a run highlights and names what
        matters.
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
        """Repeat the last fit after the view changed its size, unless the user zoomed or panned."""
        if self.camera.keeps == "fit":
            self.fit(smooth=False)
        elif self.camera.keeps == "opening":
            self.look_at_opening()

    @property
    def _room(self) -> tuple[float, float]:
        """The size that a picture may fill (pixels): the viewport without ``top_room``."""
        view = self.viewport()
        return float(view.width()), float(view.height() - self.top_room())

    def _look_below_top(self, middle: QPointF, zoom: float, smooth: bool) -> None:
        top = self.top_room()
        self.camera.go(middle - QPointF(0.0, top / 2 / zoom), zoom, smooth)

    def reveal(self, address: Address, smooth: bool = True) -> None:
        """Scroll until a state or operation is wholly in view, and no farther. The zoom stays."""
        rect = self.rect_of(address)
        if rect is not None:
            self.camera.finish()
            self._scroll_to(rect, self._whole_view, smooth)

    def reveal_point(self, at: QPointF, smooth: bool = True) -> None:
        """Scroll until a state at a scene point is wholly in view, no farther. The zoom stays."""
        self.camera.finish()
        if not self.clear_view.contains(at):
            across, down = FULL_SIZE
            state = QRectF(at.x() - across / 2, at.y() - down / 2, across, down)
            self._scroll_to(state, self._whole_view, smooth)

    @property
    def _whole_view(self) -> QRectF:
        """The visible part of the scene, without a rim and without the parts that float on it."""
        view = self.viewport().rect().adjusted(RIM, self.top_room(), -RIM, -RIM)
        return self.mapToScene(view).boundingRect()

    def _scroll_to(self, rect: QRectF, view: QRectF, smooth: bool) -> None:
        """Bring a part of the scene into a part of the view. What is far away gets to the
        middle."""
        across = _way(rect.left(), rect.right(), view.left(), view.right())
        down = _way(rect.top(), rect.bottom(), view.top(), view.bottom())
        far = abs(across) > view.width() / 2 or abs(down) > view.height() / 2
        landed = self.mapFromScene(rect.translated(-across, -down)).boundingRect()
        down += 0.0 if far else self.foot_room(landed) / self.zoom
        if not across and not down:
            return
        nearer = self.camera.centre + QPointF(across, down)
        self.camera.keep("")
        self._aim = rect
        self.camera.go(rect.center() if far else nearer, self.zoom, smooth)

    def rise_from_tools(self) -> None:
        """Once the view has arrived at an element: scroll if a tool at the foot now covers it."""
        aim, self._aim = self._aim, None
        if aim is not None:
            self.camera.pan(0.0, -self.foot_room(self.mapFromScene(aim).boundingRect()))

    def foot_room(self, area: QRect) -> int:
        """How far an area of the view has to rise to be clear of what floats at the foot, in
        pixels."""
        return 0

    def show_in_middle(self, address: Address, least: float) -> None:
        """Scroll a state or operation to the middle. A zoom below ``least`` rises to it."""
        rect = self.rect_of(address)
        if rect is None:
            return
        self.camera.finish()
        self.camera.keep("")
        if self.zoom < least:
            # At another level of detail the label of an operation stands elsewhere.
            self.camera.go(rect.center(), least, smooth=False)
            rect = self.rect_of(address) or rect
        self.camera.go(rect.center(), self.zoom)

    def shows_whole(self, address: Address) -> bool:
        """Whether a state or the label of an operation is wholly in view, where nothing floats
        above the drawing; during a movement, whether it will be."""
        self.camera.finish()
        rect = self.rect_of(address)
        if rect is None or not self._whole_view.contains(rect):
            return False
        return not self.is_covered(self.mapFromScene(rect).boundingRect())

    def is_covered(self, area: QRect) -> bool:
        """Whether something floats above a part of the view (pixels)."""
        return False

    def place_of(self, address: Address) -> QRect:
        """The part of the screen (global pixels) with a state, or an operation and its target.

        Empty if the element is not in this SB.
        """
        sheet, found = self.sheet, self.rect_of(address)
        if sheet is None or found is None:
            return QRect()
        edge = sheet.picture.edge(address)
        target = int(sheet.picture.target[edge]) if edge >= 0 else -1
        if target >= 0:
            found |= self.rect_of(sheet.address_of_state(target)) or found
        return self.screen_rect(found)

    def screen_rect(self, rect: QRectF) -> QRect:
        """The place of a scene rectangle on the screen (global pixels)."""
        shown = self.mapFromScene(rect).boundingRect()
        return QRect(self.viewport().mapToGlobal(shown.topLeft()), shown.size())

    @property
    def clear_view(self) -> QRectF:
        """The visible part of the scene without a margin, so that a node at its border is whole."""
        view = self.viewport().rect()
        across, down = min(70, view.width() // 3), min(64, view.height() // 3)
        return self.mapToScene(view.adjusted(across, down, -across, -down)).boundingRect()


def _way(first: float, last: float, low: float, high: float) -> float:
    """The way that a view from ``low`` to ``high`` must move to show ``first`` to ``last``.

    If they do not fit into the view, their middle gets to the middle of the view.
    """
    if last - first > high - low:
        first = last = (first + last) / 2
    return max(last - high, 0.0) + min(first - low, 0.0)
