"""The verbs of drawing that need no pointer; menus, keys and buttons call them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from PySide6.QtCore import QPointF

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing.digits import count_of
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.graph.arrangement import BEST, DISTANCE, LAYERS
from smsl_studio.picture.marks import Marks
from smsl_studio.picture.picture import Picture
from smsl_studio.studio.base.actions import Action
from smsl_studio.studio.base.canvas.note_room import notes_in_room
from smsl_studio.studio.base.canvas.sheet import Sheet
from smsl_studio.studio.document.fact_changes import addition
from smsl_studio.studio.document.session import Session
from smsl_studio.studio.features.draw.canvas.editor import CanvasEditor
from smsl_studio.studio.features.draw.canvas.free_places import free_place
from smsl_studio.studio.features.draw.canvas.tidy_work import LARGE, Tidied, TidyBeside, TidyWork
from smsl_studio.studio.features.draw.canvas.value_menu import ValueMenu
from smsl_studio.studio.features.draw.canvas.ways import WaysBetween

TIDY = "The drawing is tidy already."


class DrawVerbs:
    """Verbs on the SB that is shown and on the selection. ``can_…`` and ``has_…`` enable them."""

    def __init__(self, session: Session, editor: CanvasEditor) -> None:
        self._session, self._editor, self.canvas = session, editor, editor.canvas
        self.ways = WaysBetween(session, self.canvas)
        self.values = ValueMenu(session, self.canvas)
        self.beside = TidyBeside(self.canvas)
        self.add_fact: Callable[[], object] = lambda: None
        """Asks in the panel of facts whether to add one."""
        self._tidied: tuple[object, ...] = (None,)
        """Blueprint, SB, states and kind of the last tidying. The same states laid out once more
        could stand elsewhere, because they stand around the middle of their former places."""

    # What can be done now.

    def has_branch(self) -> bool:
        """Whether the SB that is shown exists."""
        return self._session.branch in self._session.blueprint.branches

    def has_states(self) -> bool:
        """Whether the SB that is shown has states."""
        return self.has_branch() and bool(self._branch.table)

    def has_selection(self) -> bool:
        """Whether states, operations, a note or a group are selected."""
        return bool(self._session.selection) or self.canvas.drawn.chosen is not None

    def can_rename(self) -> bool:
        """Whether exactly one element is selected."""
        return len(self._session.selection) == 1 or self.canvas.drawn.chosen is not None

    def can_add_operation(self) -> bool:
        """Whether one or two states are selected."""
        return bool(self._states()) and len(self._states()) <= 2

    def can_enter(self) -> bool:
        """Whether a fact of the SB that is shown has a sub-SB."""
        if not self.has_branch():
            return False
        branches = self._session.blueprint.branches
        return not branches.keys().isdisjoint(self._branch.subs.values())

    def can_leave(self) -> bool:
        """Whether the SB that is shown is a sub-SB."""
        return self._session.branch in self._session.blueprint.bases

    # The verbs.

    def add_state(self) -> None:
        """Ask for the name of a new state, at a free place near the selected state."""
        self.canvas.setFocus()
        chosen = [a.state for a in self._states() if a.branch == self._session.branch]
        self._editor.add_state_at(QPointF(*free_place(self.canvas, chosen[-1] if chosen else "")))

    def add_branch(self) -> None:
        """Add an SB and show it."""
        name = fresh_branch_name(self._session.blueprint)
        if self._edit(f"Add State Branch {name}", lambda bp: editing.add_branch(bp, name)):
            self._session.show_branch(name)

    def add_operation(self) -> None:
        """Ask for an operation from the selected state, or from the first of two to the second."""
        self.canvas.setFocus()
        self._editor.quick_add.go_on()

    def connect(self) -> None:
        """Connect two selected states; otherwise let the user click a source and a target."""
        if len(self._session.selection) == len(self._states()) == 2:
            self.add_operation()
        else:
            self.canvas.hand.begin_connect()

    def attach(self, digit: int, sub: str | None) -> None:
        """Make an SB expand a fact of the SB that is shown. With ``sub`` None, the SB is new."""
        base = self._session.branch
        name = sub or fresh_branch_name(self._session.blueprint)

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the sub-SB attached; a new sub-SB is added first."""
            if sub is None:
                blueprint = editing.add_branch(blueprint, name)
            return editing.attach_sub(blueprint, base, digit, name)

        self._edit(f"Attach {name} to digit {digit} of {base}", change)

    def attach_new_fact(self, sub: str | None) -> None:
        """Add a fact to the SB that is shown and make an SB expand it, as one step.

        States with words for names keep them, and each has the value beside its name.
        """
        base, branch = self._session.branch, self._branch
        name, digit = sub or fresh_branch_name(self._session.blueprint), count_of(branch)
        added = addition(branch, "")

        def change(blueprint: Blueprint) -> Blueprint:
            """The blueprint with the new fact, and the sub-SB attached to it."""
            blueprint = added.change(blueprint)
            if sub is None:
                blueprint = editing.add_branch(blueprint, name)
            return editing.attach_sub(blueprint, base, digit, name)

        self._edit(f"Add a fact to {base} and attach {name} to it", change)

    def rename(self) -> None:
        """Edit the name of the selected element on the canvas."""
        drawn = self.canvas.drawn.chosen
        if drawn is not None:
            self.canvas.drawn_edit_wanted.emit(drawn)
        elif self.can_rename():
            self.canvas.setFocus()
            self._editor.rename(self._session.selection[0])

    def delete(self) -> None:
        """Delete the selection."""
        self.canvas.delete_wanted.emit()

    def select_all(self) -> None:
        """Select all states of the SB that is shown."""
        self._session.select(Address(self._branch.name, name) for name in self._branch.table)

    def tidy(self, kind: str = BEST) -> None:
        """Compute the layout of the SB anew, as one step. Bends and moved labels go, and notes
        leave states, labels, titles and other notes free.

        If two or more states are selected, only these move. Otherwise all states move, and the
        drawing looks like the one before. Pinned states stay where they are. The zoom stays,
        unless the whole drawing was in view and does not fit any more. If nothing would change,
        only a sentence says so. A large SB is laid out beside the window. ``kind`` is one of the
        layouts of ``graph.arrangement``.
        """
        # What is still being typed is taken over first, because the drawing must have it.
        self._session.settling.emit()
        branch = self._branch
        own = frozenset(a.state for a in self._states() if a.branch == branch.name)
        chosen = own if 1 < len(own) < len(branch.table) else None
        blueprint, *asked = self._tidied
        if blueprint is self._session.blueprint and asked == [branch.name, chosen, kind]:
            self.canvas.say(TIDY)
            return
        if branch.notes.pinned.issuperset(branch.table if chosen is None else chosen):
            which = "Every state" if chosen is None else "Each selected state"
            self.canvas.say(f"{which} is pinned, so none moves. Unpin some first (Shift+K).")
            return
        shown = self.canvas.positions
        work = TidyWork(self._session.blueprint, branch.name, shown, chosen, kind)
        if len(branch.table) > LARGE:
            self.beside.begin(work, self._take_tidy)
        else:
            self._take_tidy(work, work.do())

    def _take_tidy(self, work: TidyWork, found: Tidied) -> None:
        """Make a step of a tidy drawing, and show it."""
        name, canvas = work.branch, self.canvas
        self._session.settling.emit()
        if self._session.blueprint is not work.blueprint or self._session.branch != name:
            canvas.say("The drawing was changed meanwhile, so it is not tidied. Tidy again.")
            return
        notes = self._notes_in_room(found.straight, found.places)
        if found.same and not notes:
            canvas.say(TIDY)
            return
        after = editing.put_notes(found.placed, name, notes) if notes else found.placed
        view, whole = canvas.camera.stand, canvas.shows_all
        middle = self._state_in_middle() if not whole else ""
        if not self._edit(f"Tidy {name}", lambda _: after):
            return
        self._tidied = (self._session.blueprint, name, work.chosen, work.kind)
        if work.chosen is None:
            if middle:
                canvas.hold(work.shown[middle], found.places[middle])
            else:
                canvas.show_all()
            self._editor.views.keep(view)
        canvas.glide_from(work.shown)

    def _state_in_middle(self) -> str:
        """The state nearest to the middle of the view, a selected one first."""
        seen, places = self.canvas.seen, self.canvas.positions
        chosen = [a.state for a in self._states() if seen.contains(QPointF(*places[a.state]))]
        middle = seen.center()
        ways = {n: (QPointF(*places[n]) - middle).manhattanLength() for n in chosen or places}
        return min(ways, key=lambda name: ways[name])

    def tidy_in_layers(self) -> None:
        """Tidy, with the states in columns from left to right."""
        self.tidy(LAYERS)

    def tidy_by_distance(self) -> None:
        """Tidy. Two states stand near each other if few operations lead from one to the other."""
        self.tidy(DISTANCE)

    def _notes_in_room(
        self, blueprint: Blueprint, places: Mapping[str, tuple[float, float]]
    ) -> dict[str, dict[str, object]]:
        """The notes that have to move if the states go to these places, with their new places."""
        branch = blueprint[self._session.branch]
        if not branch.drawn.notes:
            return {}
        picture = Picture(blueprint, branch.name, words=self.canvas.words)
        sheet = Sheet(picture, places, self.canvas.ink, Marks())
        return {key: {"at": at} for key, at in notes_in_room(sheet).items()}

    def enter(self) -> None:
        """Show the sub-SB of the first fact that has one."""
        branches = self._session.blueprint.branches
        subs = [sub for _, sub in sorted(self._branch.subs.items()) if sub in branches]
        if subs:
            self._editor.way_back.show(subs[0])

    def leave(self) -> None:
        """Show the base SB."""
        self._editor.way_back.leave()

    @property
    def _branch(self) -> StateBranch:
        return self._session.blueprint[self._session.branch]

    def _states(self) -> tuple[Address, ...]:
        return tuple(a for a in self._session.selection if a.state and not a.operation)

    def _edit(self, words: str, change: Callable[[Blueprint], Blueprint]) -> bool:
        return self._session.edit(words, change)


def selection_actions(drawing: DrawVerbs, drawn: Callable[[], bool]) -> tuple[Action, ...]:
    """The rows of the Edit menu about the selection. ``drawn`` tells whether Draw mode is shown.

    A new edit is a method above and its row here.
    """
    return (
        Action("rename", "Rename", drawing.rename, "Edit", "pencil", ("F2",),
               lambda: drawn() and drawing.can_rename(), scope="canvas", section=1,
               tip="Edit the name in place"),
        Action("delete", "Delete", drawing.delete, "Edit", "trash", ("Del",),
               lambda: drawn() and drawing.has_selection(), scope="canvas", section=1,
               pointer=("state", "operation")),
        Action("select_all", "Select all states", drawing.select_all, "Edit", "", ("Ctrl+A",),
               lambda: drawn() and drawing.has_states(), scope="canvas", section=1),
        Action("set_value", "Change a fact…", drawing.values.open_facts, "Edit", "", ("D",),
               lambda: drawn() and drawing.values.can_open(), scope="canvas", section=1,
               tip="Give a fact of the selected states another value; the names follow",
               pointer=("state",)),
        Action("show_ways", "Show ways between", drawing.ways.show, "Edit", "",
               enabled=lambda: drawn() and drawing.ways.can_show(), section=1,
               tip="Light the cheapest ways between two selected states, there and back",
               pointer=("state",)),
    )  # fmt: skip
