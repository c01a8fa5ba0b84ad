"""Tidy computes the layout anew, and makes no step if nothing would change."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRectF, Qt

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.arrangement import DISTANCE, LAYERS
from smsl_studio.graph.tidied import tidied
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE = SAMPLES / "registration.json"
SB = "REGISTRATION"


def tidy(person: Person) -> None:
    person.press(Key.Key_T, [Ctrl, Shift])


def bend(blueprint: Blueprint, lines: list[tuple[str, str]]) -> Blueprint:
    addresses = [Address(SB, state, operation) for state, operation in lines]
    return editing.set_bends(blueprint, addresses, [(40.0, 40.0)])


def move(person: Person, count: int) -> None:
    """Drag the first states somewhere else, one after the other."""
    for at, name in enumerate(list(person.blueprint[SB].table)[:count]):
        place = person.place(f"{SB}/{name}")
        person.drag(place, place + QPoint(60 + 30 * at, 150))


@pytest.mark.parametrize("moved", [1, 3])
def test_what_was_moved_is_laid_out_anew_again_and_again(sit: Sit, moved: int) -> None:
    person = sit(FILE)
    fresh = person.window.canvas.positions
    for done in range(2):
        move(person, moved)
        assert person.window.canvas.positions != fresh
        steps = len(person.steps())
        tidy(person)
        assert person.window.canvas.positions == fresh, f"time {done + 1}"
        assert person.steps()[steps:] == [f"Tidy {SB}"]


def test_no_step_is_made_where_every_state_stands_there_already(sit: Sit) -> None:
    person = sit(FILE)
    tidy(person)
    assert person.steps() == []
    assert not person.window.session.edited
    assert person.window.canvas.overlays.word.text == "The drawing is tidy already."
    move(person, 1)
    tidy(person)
    before = person.steps()
    tidy(person)
    assert person.steps() == before


def test_a_second_tidy_moves_no_state_that_stands_alone(sit: Sit) -> None:
    person = sit(FILE)
    person.press(Key.Key_N, [Ctrl, Shift])
    person.press(Key.Key_Return)
    assert len(person.blueprint[SB].table) == len(person.window.canvas.positions) == 9
    person.window.session.select(())
    tidy(person)
    steps, places = person.steps(), dict(person.window.canvas.positions)
    assert steps[-1] == f"Tidy {SB}"
    tidy(person)
    assert person.steps() == steps
    assert person.window.canvas.positions == places


def test_a_second_tidy_of_the_same_states_is_no_step(sit: Sit) -> None:
    person = sit(FILE)
    move(person, 3)
    names = list(person.blueprint[SB].table)
    person.window.session.select(Address(SB, name) for name in names[:3])
    tidy(person)
    steps, places = person.steps(), dict(person.window.canvas.positions)
    assert steps[-1] == f"Tidy {SB}"
    tidy(person)
    assert person.steps() == steps
    assert person.window.canvas.overlays.word.text == "The drawing is tidy already."
    person.window.session.select(Address(SB, name) for name in names[1:5])
    tidy(person)
    assert person.window.canvas.positions != places, "other states are tidied as ever"


def covered(person: Person) -> list[str]:
    """The notes that cover a state, a name, a title of a group, or another note."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    drawn, half, found = sheet.drawn, sheet.halves(), []
    things = [
        *np.hstack([sheet.at - half, sheet.at + half]).tolist(),
        *(r for e in range(len(sheet.picture.operations)) if (r := sheet.geometry.label(e))),
        *(rect_of(drawn.title_rect(key)) for key in drawn.listed() if key.kind == "group"),
    ]
    for key in drawn.listed():
        if key.kind == "note":
            left, top, right, bottom = rect = rect_of(drawn.rect(key))
            meets = [t[0] < right and t[2] > left and t[1] < bottom and t[3] > top for t in things]
            found += [key.key] if any(meets) else []
            things.append(rect)
    return found


def rect_of(rect: QRectF | None) -> tuple[float, float, float, float]:
    assert rect is not None
    return rect.left(), rect.top(), rect.right(), rect.bottom()


def test_notes_lie_on_nothing_after_tidy(sit: Sit) -> None:
    person = sit(FILE)
    session, names = person.window.session, list(person.blueprint[SB].table)
    places = person.window.canvas.positions
    notes = {
        str(number): {"text": f"About {name}", "at": places[name]}
        for number, name in enumerate(names[:4], 1)
    }
    hung = {"text": "On it", "at": (70.0, -20.0), "state": names[0]}
    alone = {"text": "Far away", "at": (9_000.0, 9_000.0)}
    group = {"1": {"title": "First", "states": names[:2]}}
    words = {**notes, "5": hung, "6": {**hung, "text": "Too"}, "7": alone}
    with_notes = editing.put_notes(person.blueprint, SB, words)
    session.edit("Notes", lambda _: editing.put_groups(with_notes, SB, group))
    text = person.blueprint.document.text
    assert covered(person)
    tidy(person)
    assert covered(person) == []
    person.window.canvas.zoom_to(0.5)
    assert covered(person) == []
    kept = person.blueprint[SB].drawn.notes
    assert kept["7"].at == (9_000.0, 9_000.0)
    assert kept["5"].state == names[0]
    assert person.steps() == ["Notes", f"Tidy {SB}"]
    tidy(person)
    assert person.steps() == ["Notes", f"Tidy {SB}"]
    person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == text


def test_of_selected_states_only_they_move_and_only_their_bends_go(sit: Sit) -> None:
    person = sit(FILE)
    table = person.blueprint[SB].table
    names = list(table)
    chosen, far = names[:2], names[2:]
    lines = [
        (a, o)
        for group in (chosen, far)
        for a in group
        for o, b in table[a].items()
        if b in group and b != a
    ]
    person.window.session.edit("Bend", lambda bp: bend(bp, lines))
    move(person, 2)
    before = dict(person.window.canvas.positions)
    person.window.session.select(Address(SB, name) for name in chosen)
    tidy(person)
    after = person.window.canvas.positions
    assert {n for n in names if after[n] != before[n]} == set(chosen)
    bent = person.blueprint[SB].notes.edges
    assert bent
    assert {a for a, _ in bent} <= set(far)
    assert person.steps()[-1] == f"Tidy {SB}"


def test_the_kind_of_layout_is_chosen_in_the_menu(sit: Sit) -> None:
    person = sit(FILE)
    branch = person.blueprint[SB]
    for action, kind in (("tidy_layers", LAYERS), ("tidy_distance", DISTANCE)):
        shown = dict(person.window.canvas.positions)
        person.window.actions_table[action].trigger()
        assert person.window.canvas.positions == tidied(branch, shown, kind=kind)
        assert person.steps()[-1] == f"Tidy {SB}"
