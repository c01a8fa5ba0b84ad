"""Canvas: the view of one SB. It paints it and handles gestures; it never edits a blueprint.

User requests leave it as signals, and ``CanvasEditor`` turns them into edits of a session.
``show_branch`` and ``set_marks`` set what it shows.
"""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, QRectF, Qt, QTimer
from PySide6.QtGui import (
    QAccessible,
    QAccessibleEvent,
    QContextMenuEvent,
    QFocusEvent,
    QHelpEvent,
    QKeyEvent,
    QMouseEvent,
    QNativeGestureEvent,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QWidget

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.legible import plain_text
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.canvas.accessible import words_for
from smsl_studio.studio.base.canvas.branch_view import BranchView
from smsl_studio.studio.base.canvas.canvas_collapse import CanvasCollapse
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.base.canvas.gesture_layer import DrawnOperation
from smsl_studio.studio.base.canvas.handles import pending_ends
from smsl_studio.studio.base.canvas.overlays import Overlays
from smsl_studio.studio.base.canvas.sheet import Position, Sheet
from smsl_studio.studio.base.canvas.tools import Hand
from smsl_studio.studio.base.canvas.touch import Pinch, turn
from smsl_studio.studio.base.theme import Tokens


class Canvas(BranchView):
    """The picture of one SB, with zoom, pan, selection and the gestures that edit."""

    def __init__(self, tokens: Tokens, parent: QWidget | None = None) -> None:
        super().__init__(tokens, parent)
        self.overlays = Overlays(self, tokens, lambda: self.hand.busy)
        self.hand = Hand(self, self.overlays)
        self._pinch = Pinch(self.camera)
        self._words = self._quiet = False
        self.collapse = CanvasCollapse(self, self._draw_again)
        self.overlays.pad.operation_wanted.connect(self.hand.begin_connect)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMouseTracking(True)
        self.viewport().setMouseTracking(True)
        self.setAccessibleName("Canvas")
        self.camera.arrived.connect(self.overlays.fitted)
        self.camera.arrived.connect(self.rise_from_tools)
        self.zoom_changed.connect(self.overlays.show_zoom)
        self.view_moved.connect(self.overlays.view_moved)
        self.picture_changed.connect(self.overlays.picture_changed)
        self.states_dragged.connect(self.overlays.map.update)
        self.set_tokens(tokens)

    # What is shown

    def show_branch(
        self,
        blueprint: Blueprint,
        branch: str,
        positions: Mapping[str, Position] | None = None,
        keep_view: bool = False,
    ) -> None:
        """Show an SB. Without ``positions`` the states stand where the layout puts them.

        ``keep_view`` keeps zoom and place, for the same SB after an edit. Otherwise the SB is shown
        as it opens.
        """
        self.hand.reset()
        sheet: Sheet | None = None
        if branch in blueprint.branches:
            picture = Picture(blueprint, branch, words=self._words)
            if positions is None:
                positions = place_states(picture.branch)
            former = self.sheet if self.sheet and self.sheet.is_of(branch) else None
            if not (keep_view and self.collapse.knows(branch)):
                self.collapse.judge(picture, positions)
            shown = picture.collapse() if self.collapsed else picture
            sheet = Sheet(shown, positions, self.ink, self.marks, former)
            sheet.looks.quiet = picture.mixed if self._quiet else frozenset()
        self.show_sheet(sheet)
        if not keep_view:
            self.look_at_opening()
        self.overlays.show_branch(blueprint, branch)
        self.hand.show_grip()
        self.hand.look_again()
        self._describe()

    @property
    def collapsed(self) -> bool:
        """Whether operations between the same two states are drawn as one line."""
        return self.collapse.on

    @property
    def quiet(self) -> bool:
        """Whether operations that change several facts at once, or load a sub-SB, are dimmed."""
        return self._quiet

    def set_quiet(self, on: bool) -> None:
        """Dim operations that change several facts at once or load a sub-SB, or show all alike."""
        self._quiet = on
        if self.sheet is not None:
            self.sheet.looks.quiet = self.sheet.picture.mixed if on else frozenset()
            self.overlays.show_dense()
            self.update_edges(self.sheet.picture.mixed)

    @property
    def words(self) -> bool:
        """Whether chips show what values mean, in place of the values."""
        return self._words

    def set_words(self, on: bool) -> None:
        """Show meanings on the chips, or the values as they are written."""
        if on != self._words:
            self._words = on
            self._draw_again()

    def _draw_again(self) -> None:
        """Draw the same SB again, because the way to draw it has changed."""
        sheet = self.sheet
        if sheet is not None:
            name, places = sheet.picture.branch.name, self.positions
            self.show_branch(sheet.picture.blueprint, name, places, keep_view=True)

    def look_at_opening(self) -> None:
        """Show the whole SB, or the part around the initial state if states would be too small.

        Before the first picture this waits until the size of the canvas is settled.
        """
        if self.settled:
            super().look_at_opening()
        else:
            self.camera.keep("opening")

    def show_places(
        self, blueprint: Blueprint, branch: str, positions: Mapping[str, Position]
    ) -> None:
        """Move states to other places (scene points) after a move or its undo, and nothing else."""
        sheet = self.sheet
        if sheet is None or branch != sheet.picture.branch.name:
            self.show_branch(blueprint, branch, positions, keep_view=True)
            return
        self.overlays.forget()
        sheet.picture.blueprint = blueprint
        sheet.picture.branch = blueprint[branch]
        self.stand(positions)
        # After a save under another name the breadcrumb shows the new file.
        self.overlays.breadcrumb.show_branch(blueprint, branch)
        self.hand.show_grip()

    def set_tokens(self, tokens: Tokens) -> None:
        """Use the colours of another theme."""
        super().set_tokens(tokens)
        self.overlays.set_tokens(tokens)

    def set_marks(self, marks: Marks) -> None:
        """Show other marks; only what looks different now is painted again."""
        labelled = self.marks.dimmed
        super().set_marks(marks)
        if self.sheet is not None:
            if labelled != marks.dimmed:
                self.look_again()
            self.overlays.show_marks(marks)
            self.hand.show_grip()
            self._describe()

    def choose_drawn(self, chosen: DrawnKey | None) -> None:
        """Show a note or a group as selected, and tell assistive tools; None for none."""
        super().choose_drawn(chosen)
        self._describe()

    def show_banner(self, text: str) -> None:
        """Show a sentence across the top, such as "The drawing has moved on"; empty hides it."""
        self.overlays.show_banner(text)

    def show_pending(
        self, source: Address | None, target: Address | None = None, at: QPointF | None = None
    ) -> None:
        """Show an operation while it is being named: a dashed line to a state, or to a point.

        Without ``source`` it disappears.
        """
        rect = self.rect_of(source) if source is not None else None
        if source is None or rect is None or at is None or source == target:
            self.gestures.put("drawn", None)
            self._spare(QRectF())
            return
        assert self.sheet is not None
        goal = self.rect_of(target) if target is not None else None
        start, end = pending_ends(self.sheet, self.sheet.picture.node(source), at, goal)
        self.gestures.put("drawn", DrawnOperation(start, end, ghost=target is None))
        new = QRectF(end.x() - 54.0, end.y() - 27.0, 108.0, 54.0)
        self._spare(new if target is None else QRectF())

    def _spare(self, new: QRectF) -> None:
        """Let nothing float over the place of a new state (scene); an empty one is over."""
        if new != self.pending:
            self.pending = new
            self.overlays.spare(self.mapFromScene(new).boundingRect())

    def say(self, text: str, at: QPointF | None = None) -> None:
        """Show a short sentence at the pointer, or at a scene point."""
        self.overlays.say(text, self.mapFromScene(at) if at is not None else None)

    def is_covered(self, area: QRect) -> bool:
        """Whether something floats above a part of the view (pixels)."""
        return self.overlays.floats_in(area)

    def top_room(self) -> int:
        """The height at the top that the breadcrumb or a banner covers (pixels)."""
        return self.overlays.top_room()

    def foot_room(self, area: QRect) -> int:
        """How far an area has to rise to be clear of the tools at the foot (pixels)."""
        return self.overlays.foot_room(area)

    def _describe(self) -> None:
        """Tell assistive tools which SB is shown and what is selected."""
        sheet = self.sheet
        if sheet is None or not len(sheet.picture):
            self.setAccessibleDescription("Empty. Enter or a double click adds the first state.")
            return
        drawn = self.drawn.chosen
        if drawn is not None and drawn in sheet.drawn.listed():
            self.setAccessibleDescription(plain_text(f"{sheet.drawn.words(drawn)}, selected"))
            self._tell_focus()
            return
        words = f"{sheet.picture.branch.name}, {len(sheet.picture)} states"
        chosen = [a for a in self.marks.selection if a.branch == sheet.picture.branch.name]
        if len(chosen) == 1:
            words = self.describe(chosen[0])
        elif chosen:
            words += f", {len(chosen)} selected"
        self.setAccessibleDescription(plain_text(words))
        if chosen:
            self._tell_focus()

    def _tell_focus(self) -> None:
        """Tell assistive tools that what is chosen has the focus, if the canvas has it."""
        if QAccessible.isActive() and self.hasFocus():
            chosen = QAccessible.queryAccessibleInterface(self).focusChild()
            if chosen is not None:
                event = QAccessibleEvent(chosen, QAccessible.Event.Focus)
                QAccessible.updateAccessibility(event)

    def describe(self, address: Address) -> str:
        """The words for a state or operation, such as "State_1100, active, 7 operations out"."""
        return words_for(self, address)

    # Qt's events

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Place the floating widgets again and repeat the last fit."""
        super().resizeEvent(event)
        if self.settled:
            self._fit_in()

    def _fit_in(self) -> None:
        self.cover()
        self.overlays.place()
        self.settled = True
        if self.camera.keeps:
            self.look_again()
        else:
            self.refresh_pool()

    def _fit_first(self) -> None:
        """Show the SB as it opens, now that the layouts of the window have their sizes."""
        if not self.settled:
            self._fit_in()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the SB, or only the ground if the size of the window is not settled yet.

        Nothing is moved while Qt paints a window. A canvas that is not on the screen is painted
        into an image. No event loop settles its size, so this does.
        """
        if not self.settled and not self.isVisible():
            self._fit_first()
        if self.settled:
            super().paintEvent(event)

    def showEvent(self, event: QShowEvent) -> None:
        """Place the floating widgets and fit again, because the size is known only now."""
        super().showEvent(event)
        if self.settled:
            self.overlays.place()
            self.look_again()
        else:
            QTimer.singleShot(0, self, self._fit_first)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom at the pointer, or scroll; ``touch`` tells which."""
        turn(self.camera, event)
        event.accept()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Hand the press to ``Hand``, which begins a gesture."""
        self.hand.press(event)

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Hand the move to ``Hand``: it continues the gesture, or updates what is hovered."""
        self.hand.move(event)

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Hand the release to ``Hand``, which ends the gesture."""
        self.hand.release(event)

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Hand the double click to ``Hand``."""
        self.hand.double_click(event)

    def leaveEvent(self, event: object) -> None:
        """End the hover, because the pointer is outside now."""
        super().leaveEvent(event)  # type: ignore[arg-type]
        self.hand.left()

    def viewportEvent(self, event: QEvent) -> bool:
        """Show the tooltip of the state or operation under the pointer, and zoom by a pinch.

        The viewport has its text, because a graphics view would ask only its items. The tooltip of
        a state is shown below the state.
        """
        if isinstance(event, QNativeGestureEvent) and self._pinch.take(event):
            return True
        if not isinstance(event, QHelpEvent) or event.type() != QEvent.Type.ToolTip:
            return super().viewportEvent(event)
        below = self.hand.hover.foot()
        if below is None:
            return False
        at = QPoint(event.globalPos().x(), self.viewport().mapToGlobal(below).y())
        return self.viewport().event(QHelpEvent(event.type(), event.pos(), at))

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Emit ``context_wanted`` or ``drawn_menu_wanted`` to open a menu.

        The mouse opens the menu of the element under the pointer. The menu key opens the menu of
        the selected element.
        """
        by_key = event.reason() is QContextMenuEvent.Reason.Keyboard
        at = self.mapToScene(event.pos())
        drawn = self.drawn_at(at) if self.editing else None
        if by_key and self.editing:
            drawn = self.drawn.chosen
        chosen = self.marks.selection[-1:] if by_key and drawn is None else ()
        for address in chosen:
            self.reveal(address, smooth=False)
            self.context_wanted.emit(address, self.place_of(address).center())
            event.accept()
            return
        if drawn is not None:
            self.drawn_wanted.emit(drawn)
            self.drawn_menu_wanted.emit(drawn, event.globalPos())
            event.accept()
            return
        self.context_wanted.emit(self.address_at(at), event.globalPos())
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Hand the key to ``Hand``; a key it does not use goes on to the window."""
        if not self.hand.key_press(event):
            event.ignore()

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Hand the key to ``Hand``; a key it does not use goes on to the window."""
        if not self.hand.key_release(event):
            event.ignore()

    def focusInEvent(self, event: QFocusEvent) -> None:
        """Show the outline that marks the keyboard focus."""
        super().focusInEvent(event)
        self.overlays.ring.show_focus(True)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Hide the outline, and treat Space as released."""
        super().focusOutEvent(event)
        self.overlays.ring.show_focus(False)
        self.hand.lost_focus()

    def focusNextPrevChild(self, forward: bool) -> bool:
        """With a selected state Tab adds an operation; otherwise it moves the focus as usual."""
        if self.editing and any(a.state for a in self.marks.selection):
            return False
        return super().focusNextPrevChild(forward)
