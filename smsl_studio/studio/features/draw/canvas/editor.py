"""CanvasEditor connects one canvas to a session: gestures become edits, edits are drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import compress
from operator import is_not

from PySide6.QtCore import QObject, QPointF, QRectF, Signal

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_state_name
from smsl_studio.errors import StudioError
from smsl_studio.studio.base.canvas.canvas import Canvas
from smsl_studio.studio.document.rename_loss import RenameWarning
from smsl_studio.studio.document.rename_scopes import rename_scopes
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.bend_verbs import Bends
from smsl_studio.studio.features.draw.canvas.clear_place import clear_place
from smsl_studio.studio.features.draw.canvas.connect_card import ConnectCard
from smsl_studio.studio.features.draw.canvas.copy_card import CopyCard
from smsl_studio.studio.features.draw.canvas.free_places import on_grid, place_near
from smsl_studio.studio.features.draw.canvas.name_field import NameField
from smsl_studio.studio.features.draw.canvas.new_operation import NewOperation
from smsl_studio.studio.features.draw.canvas.nudge import Nudge
from smsl_studio.studio.features.draw.canvas.quick_add import QuickAdd
from smsl_studio.studio.features.draw.canvas.rename_field import RenameField
from smsl_studio.studio.features.draw.canvas.step_told import StepTold
from smsl_studio.studio.features.draw.canvas.step_views import StepViews
from smsl_studio.studio.features.draw.canvas.way_back import WayBack

Position = tuple[float, float]
Field = NameField | ConnectCard | CopyCard


class CanvasEditor(QObject):
    """Shows the SB of the session on a canvas, and turns the signals of the canvas into edits.

    It follows the session by itself; only ``set_findings`` has to be called. ``field`` is the name
    field or card that is open, or None.
    """

    field_opened = Signal()
    """A field or card has opened, in its place."""

    def __init__(self, session: Session, canvas: Canvas) -> None:
        super().__init__(canvas)
        self.session, self.canvas = session, canvas
        self.field: Field | None = None
        self.warning = RenameWarning()
        self._refusals: list[StudioError] = []
        self.new_operation = NewOperation(session, canvas, self.edit, self.open_card)
        self.quick_add = QuickAdd(session, canvas, self.new_operation.ask)
        session.blueprint_changed.connect(self._blueprint_changed)
        session.branch_changed.connect(self._show)
        session.selection_changed.connect(self._selection_changed)
        session.refused.connect(self._refused)
        canvas.selection_wanted.connect(session.select)
        canvas.add_state_wanted.connect(self.add_state_at)
        canvas.connect_wanted.connect(self.new_operation.ask)
        canvas.retarget_wanted.connect(self.retarget)
        canvas.source_wanted.connect(self.move_source)
        canvas.rename_wanted.connect(self.rename)
        canvas.moved.connect(self.move)
        canvas.delete_wanted.connect(self.delete_selected)
        canvas.quick_add_wanted.connect(self.quick_add.go_on)
        canvas.sibling_wanted.connect(self.quick_add.sibling)
        canvas.pressed.connect(self._leave_card)
        self.way_back, self.views = WayBack(session, canvas), StepViews(session, canvas)
        self.step_told = StepTold(session, canvas, self.views)
        self.nudge, self.bends = Nudge(session, canvas), Bends(session, canvas)
        canvas.state_pick = self._pick
        canvas.extended = lambda: session.extended
        self._show(session.branch)

    # The session changed

    def set_findings(self, findings: Mapping[Address, str]) -> None:
        """Mark elements on the canvas: the worst severity letter (E, W, I) by address."""
        if findings != self.canvas.marks.findings:
            self.canvas.set_marks(replace(self.canvas.marks, findings=findings))

    def _blueprint_changed(self, before: Blueprint, after: Blueprint) -> None:
        self._close_field()
        branch = self.session.branch
        if self.canvas.sheet is not None:
            shown = self.canvas.sheet.picture.branch.name
            if shown != branch:
                if shown not in after.branches and len(before) == len(after):
                    self.session.places.rename_branch(shown, branch)
                    self._show_again(branch)
                return
        self._show_again(branch)

    def _show_again(self, branch: str) -> None:
        """Draw the same SB after an edit; zoom and scroll position stay."""
        blueprint = self.session.blueprint
        if branch not in blueprint.branches:
            self.canvas.show_branch(blueprint, branch)
            return
        shown, sheet = blueprint[branch], self.canvas.sheet
        places = self.session.places.of(shown)
        if sheet is not None and _same_picture(sheet.picture.branch, shown):
            self.canvas.show_places(blueprint, branch, places)
        else:
            empty = sheet is None
            self.canvas.show_branch(blueprint, branch, places, keep_view=not empty)

    def _show(self, branch: str) -> None:
        self._close_field()
        blueprint, sheet = self.session.blueprint, self.canvas.sheet
        picture = sheet.picture if sheet is not None else None
        drawn = (picture.blueprint, picture.branch.name) if picture is not None else None
        if drawn is not None and drawn[0] is blueprint and drawn[1] == branch:
            self.canvas.look_at_opening()  # another file was opened, and is drawn already
        elif branch in blueprint.branches:
            self.canvas.show_branch(blueprint, branch, self.session.places.of(blueprint[branch]))
        else:
            self.canvas.show_branch(blueprint, branch)

    def _selection_changed(self, selection: tuple[Address, ...]) -> None:
        self.canvas.set_marks(replace(self.canvas.marks, selection=selection))

    def _refused(self, error: StudioError) -> None:
        self._refusals.append(error)

    # Signals of the canvas

    def add_state_at(self, at: QPointF) -> None:
        """Ask for the name of a new state at a scene point; Enter adds it there."""
        branch = self.session.branch
        if branch not in self.session.blueprint.branches:
            self._first_branch_and_state(at)
            return
        place = on_grid(at)
        self.canvas.reveal_point(QPointF(*place), smooth=False)
        suggested = fresh_state_name(self._branch)

        def commit(name: str) -> str:
            """Add the state and select it. Returns why that was refused, or the empty text."""
            words = f"Add {name}"
            done = self.edit(words, lambda bp: editing.add_state(bp, branch, name, place))
            if not done:
                self.session.select((Address(branch, name),))
            return done

        self._name_new(suggested, commit, QPointF(*place))

    def _first_branch_and_state(self, at: QPointF) -> None:
        """Ask for the first state of a file without SBs; the SB is added with it, as one step."""
        place = on_grid(at)

        def commit(name: str) -> str:
            """Add the SB with its state and show it.

            Returns why that was refused, or the empty text.
            """

            def change(blueprint: Blueprint) -> Blueprint:
                """The blueprint with the SB and its first state."""
                return editing.add_state(editing.add_branch(blueprint, "SB1"), "SB1", name, place)

            camera = self.canvas.camera
            seen = camera.centre, camera.zoom
            reason = self.edit(f"Add {name}", change)
            if not reason:
                self.session.show_branch("SB1")
                # Showing a new SB fits it into the view; undo that, to keep the state under the
                # pointer.
                camera.keep("")
                camera.go(*seen, smooth=False)
                self.session.select((Address("SB1", name),))
            return reason

        self._name_new("State0", commit, QPointF(*place))

    def rename(self, address: Address) -> None:
        """Edit the name of a state or operation on the canvas, which scrolls to it."""
        self.canvas.reveal(address, smooth=False)
        rect = self.canvas.rect_of(address)
        if rect is None or not self._stands(address):
            return
        old = address.path[-1]
        scopes = rename_scopes(self.session.blueprint, (address,))

        def commit(new: str, chosen: Sequence[Address] = (address,)) -> str:
            """Rename the element, or all chosen operations. The selection follows.

            Returns why that was refused, or the empty text.
            """
            words = f"Rename {old} to {new}"
            if address.operation:
                lost = self.warning.once(self.session.blueprint, chosen, new)
                if lost:
                    return lost
            if len(chosen) == 1:
                return self.edit(words, lambda bp: editing.rename(bp, address, new))
            words += f" in {len(chosen):,} places"
            return self.edit(words, lambda bp: editing.rename_operations(bp, chosen, new))

        hint = "Operation" if address.operation else "State"
        width = max(rect.width() * self.canvas.zoom, 96.0)
        place = self._field_place(rect.center(), width, rect)
        if len(scopes) > 1:
            field = RenameField(self.canvas, self.canvas.tokens, old, scopes, commit)
            self.open_card(field, place[0], centred=True)
        else:
            self._name(old, hint, commit, place)

    def retarget(self, operation: Address, target: Address) -> None:
        """Make an operation lead to another state."""
        words = f"Let {operation.operation} lead to {target.state}"
        reason = self.edit(words, lambda bp: editing.retarget(bp, operation, target.state))
        if reason:
            self.canvas.say(reason)

    def move_source(self, operation: Address, source: Address) -> None:
        """Make an operation start from another state; it stays selected."""
        words = f"Let {operation.operation} start from {source.state}"
        reason = self.edit(words, lambda bp: editing.move_source(bp, operation, source.state))
        if reason:
            self.canvas.say(reason)
        else:
            self.session.select((replace(operation, state=source.state),))

    def move(
        self, places: Mapping[str, Position], groups: Mapping[str, Sequence[str]] | None = None
    ) -> None:
        """Store the new places of dragged states (scene units) as one step of the history.

        ``groups`` has the new states of each group that gained or lost some by the drag.
        """
        branch, moved = self.session.branch, self.session.places.moved
        what = next(iter(places)) if len(places) == 1 else f"{len(places)} states"
        members = {key: {"states": states} for key, states in (groups or {}).items()}

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the states at their new places."""
            after = moved(blueprint, branch, places)
            return editing.put_groups(after, branch, members) if members else after

        reason = self.edit(f"Move {what}", change)
        if reason:
            self._show_again(branch)
            self.canvas.say(reason)

    def delete_selected(self) -> None:
        """Delete the selection; operations that lead to a deleted state are deleted too."""
        selection = self.session.selection
        if not selection:
            return
        what = selection[0].path[-1] if len(selection) == 1 else f"{len(selection)} elements"
        reason = self.edit(f"Delete {what}", lambda bp: editing.delete(bp, selection))
        if reason:
            self.canvas.say(reason)

    # For other verbs of drawing

    def edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> str:
        """Edit the session. Returns why that was refused, or the empty text."""
        self._refusals.clear()
        if self.session.edit(words, change):
            return ""
        error = self._refusals[-1] if self._refusals else None
        return _sentence(error) if error is not None else "That cannot be done here."

    def open_card(self, field: Field, at: QPointF, centred: bool = False) -> None:
        """Open a field or card near a point of the view, in place of the one that is open."""
        if self.field is not None:
            previous, self.field = self.field, None
            previous.close_field()
        self.field = field
        field.closed.connect(self._field_closed)
        field.adjustSize()
        point = at.toPoint()
        if centred:
            point.setX(point.x() - field.width() // 2)
            point.setY(point.y() - 18)
        if not isinstance(field, NameField):
            point = clear_place(self.canvas, field, point)
        place_near(field, self.canvas, point)
        field.show()
        field.raise_()
        self.canvas.overlays.empty.hide()
        field.take_focus()
        self.field_opened.emit()

    # Inside

    @property
    def _branch(self) -> StateBranch:
        return self.session.blueprint[self.session.branch]

    def _stands(self, address: Address) -> bool:
        try:
            self.session.blueprint.resolve(address)
        except StudioError:
            return False
        return True

    def _name_new(self, text: str, commit: Callable[[str], str], at: QPointF) -> None:
        """Ask for the name of a new state at a scene point. Tab then adds the next state."""
        field = self._name(text, "State", commit, self._field_place(at, 108.0))
        field.go_on_with(self.quick_add.go_on)

    def _name(
        self, text: str, hint: str, commit: Callable[[str], str], place: tuple[QPointF, int]
    ) -> NameField:
        field = NameField(self.canvas, self.canvas.tokens, text, hint, commit)
        at, width = place
        field.setMinimumWidth(width)
        self.open_card(field, at, centred=True)
        return field

    def _field_closed(self) -> None:
        self.canvas.show_pending(None)
        if self.field is not None:
            self.field = None
            self.canvas.overlays.show_empty()

    def _pick(self, state: Address) -> bool:
        """Give a clicked state to the open card; whether it takes it."""
        return isinstance(self.field, ConnectCard) and self.field.pick_target(state.state)

    def _leave_card(self) -> None:
        """Close the card after a press elsewhere, if nothing was typed in it."""
        if isinstance(self.field, ConnectCard | CopyCard) and self.field.untouched:
            self._close_field()

    def _close_field(self) -> None:
        """Close the open field."""
        self.canvas.show_pending(None)
        if self.field is not None:
            field, self.field = self.field, None
            field.close_field()

    def _field_place(
        self, centre: QPointF, width: float, rect: QRectF | None = None
    ) -> tuple[QPointF, int]:
        """Centre (view pixels) and width (pixels) of a name field that covers the name itself."""
        at = QPointF(self.canvas.mapFromScene(centre))
        full = rect is not None and rect.height() * self.canvas.zoom > 40.0
        if full:
            at.setY(at.y() - 11.0)
        return at, int(min(max(width + 12.0, 110.0), 300.0))


def _sentence(error: StudioError) -> str:
    first = error.sentence[:1].upper() + error.sentence[1:]
    first = first if first.endswith(".") else first + "."
    return f"{first} {error.advice}".strip()


def _same_picture(before: StateBranch, after: StateBranch) -> bool:
    """Whether two SBs are equal except for the places of their states and lines."""
    if before.name != after.name or before.header != after.header:
        return False
    if before.notes.pinned != after.notes.pinned:
        return False
    if list(before.table) != list(after.table):
        return False
    # An edit takes over the very operations of the states that it leaves alone.
    rows = before.table.values(), after.table.values()
    others = compress(zip(*rows, strict=True), map(is_not, *rows))
    if any(list(one.items()) != list(other.items()) for one, other in others):
        return False

    def rest(branch: StateBranch) -> dict[str, object]:
        """The fields of an SB without what is only drawn."""
        return {k: v for k, v in branch.fields.items() if k not in ("_layout", "_notes")}

    return rest(before) == rest(after)
