"""After an edit only what looks different is painted, and the screen looks as if all of it were."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import pytest
from PySide6.QtCore import QPoint, QPointF, QRectF
from pytestqt.qtbot import QtBot

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import rename, set_header, set_layout
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import StudioError
from smsl_studio.generate.rules import hanoi
from smsl_studio.graph.layout import place_states
from tests.picture.test_former import edited
from tests.stories.at_canvas import Drawer, sample
from tests.studio.base.canvas.test_canvas import alike, on_screen, painted_anew


def headed(blueprint: Blueprint, branch: str, dice: random.Random) -> Blueprint:
    """The blueprint with another initial or activating state."""
    state = dice.choice(list(blueprint[branch].table))
    return set_header(blueprint, branch, dice.choice(["INITIAL", "ACTIVATING"]), state)


def some_edit(person: Drawer, dice: random.Random) -> None:
    """Edit what is shown, chosen by dice, as one step of the history."""
    session, canvas = person.session, person.canvas

    def change(blueprint: Blueprint) -> Blueprint:
        try:
            if dice.random() < 0.3:
                return headed(blueprint, session.branch, dice)
            return edited(blueprint, session.branch, dice, dict(canvas.positions))
        except StudioError:
            return blueprint

    session.edit("Some edit", change)


def some_drag(person: Drawer, dice: random.Random) -> None:
    """Drag a state that is in view."""
    canvas = person.canvas
    seen = [n for n, at in canvas.positions.items() if canvas.clear_view.contains(QPointF(*at))]
    if seen:
        start = person.place(dice.choice(seen))
        person.drag(start, start + QPoint(dice.randint(-90, 90), dice.randint(-90, 90)))


def some_selection(person: Drawer, dice: random.Random) -> None:
    """Select a state or an operation, or nothing."""
    session = person.session
    table = session.blueprint[session.branch].table
    state = dice.choice(list(table))
    some = [(), (Address(session.branch, state),)]
    some += [(Address(session.branch, state, operation),) for operation in table[state]]
    session.select(dice.choice(some))


@pytest.mark.parametrize("name", ["hanoi-corrected.json", "hfsm.json"])
@pytest.mark.parametrize("seed", range(3))
def test_any_edit_leaves_nothing_stale_on_the_screen(qtbot: QtBot, name: str, seed: int) -> None:
    after_any_steps(Drawer(qtbot, sample(name)), random.Random(seed), 14)


@pytest.mark.parametrize("seed", range(2))
def test_an_edit_in_a_large_drawing_leaves_nothing_stale_in_view(qtbot: QtBot, seed: int) -> None:
    after_any_steps(Drawer(qtbot, hanoi(6)), random.Random(seed), 10)


def after_any_steps(person: Drawer, dice: random.Random, steps: int) -> None:
    """Do some steps, and look after each whether the screen is as if all of it were painted."""
    camera, history = person.canvas.camera, person.session.history
    for step in range(steps):
        what = dice.choice(["edit", "edit", "edit", "drag", "select", "undo", "redo", "zoom"])
        if what == "edit":
            some_edit(person, dice)
        elif what == "drag":
            some_drag(person, dice)
        elif what == "select":
            some_selection(person, dice)
        elif what == "zoom":
            camera.go(QPointF(400, 300), dice.choice([0.37, 0.5, 0.8, 1.0]), smooth=False)
        else:
            getattr(history, what)()
        seen = on_screen(person)
        assert alike(painted_anew(person), seen), (step, what, history.undoText())


def renamed(blueprint: Blueprint, state: str) -> Blueprint:
    """The blueprint with another name for the first operation of a state."""
    operation = next(iter(blueprint["SB1"].table[state]))
    return rename(blueprint, Address("SB1", state, operation), "Op_9z")


def moved(blueprint: Blueprint, state: str) -> Blueprint:
    """The blueprint in which a state stands a little lower."""
    x, y = blueprint["SB1"].notes.layout[state]
    return set_layout(blueprint, "SB1", {state: (x + 24.0, y + 16.0)})


def in_the_middle(person: Drawer) -> str:
    """The state that is the nearest to the middle of the view."""
    middle, places = person.canvas.seen.center(), person.canvas.positions
    return min(places, key=lambda name: math.dist(places[name], (middle.x(), middle.y())))


@pytest.mark.parametrize("disks", [4, 6])
@pytest.mark.parametrize("change", [renamed, moved])
def test_an_edit_paints_only_what_looks_different(
    qtbot: QtBot,
    monkeypatch: pytest.MonkeyPatch,
    change: Callable[[Blueprint, str], Blueprint],
    disks: int,
) -> None:
    first = hanoi(disks)
    person = Drawer(qtbot, set_layout(first, "SB1", place_states(first["SB1"])))
    canvas, session = person.canvas, person.session
    on_screen(person)
    state = in_the_middle(person)
    # The names in a large drawing find their places anew at the first edit.
    session.edit("First edit", lambda blueprint: moved(blueprint, state))
    on_screen(person)
    painted: list[QRectF] = []
    monkeypatch.setattr(canvas.ground, "paint", lambda *given: painted.append(given[1]))
    session.edit("Some edit", lambda blueprint: change(blueprint, state))
    on_screen(person)
    assert painted
    seen = canvas.seen
    assert all(area.width() < seen.width() / 2 for area in painted)


def test_a_drag_that_ends_paints_only_where_it_was(
    qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = Drawer(qtbot, hanoi(4))
    canvas = person.canvas
    on_screen(person)
    start = person.place(in_the_middle(person))
    painted: list[QRectF] = []
    monkeypatch.setattr(canvas.ground, "paint", lambda *given: painted.append(given[1]))
    person.drag(start, start + QPoint(30, 20))
    on_screen(person)
    assert painted
    seen = canvas.seen
    assert all(area.width() < seen.width() / 2 for area in painted)


def test_the_lit_name_of_an_operation_is_new_after_each_rename(qtbot: QtBot) -> None:
    person = Drawer(qtbot, sample("hfsm.json"))
    session = person.session
    state, operations = next(iter(session.blueprint["SB1"].table.items()))
    session.select((Address("SB1", state),))
    name = next(iter(operations))
    for new in ("Op_x", "Op_yy", "Op_zzz"):
        address = Address("SB1", state, name)
        session.edit("Rename", lambda bp, at=address, to=new: rename(bp, at, to))  # type: ignore[misc]
        on_screen(person)
        texts = {label.text.text for label in person.canvas.lit_layer.shown().values()}
        assert person.sheet.picture.label(person.sheet.picture.numbered(state, new)) in texts
        name = new
