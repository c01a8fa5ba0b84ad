"""A person pins states: Tidy leaves them, and everything says that they are pinned."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAccessible

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.studio.base.canvas.accessible_tree import CanvasAccessible
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE, SB = SAMPLES / "registration.json", "REGISTRATION"
FIRST, SECOND = "State_0000", "State_1000"


def tidy(person: Person) -> None:
    person.press(Key.Key_T, [Ctrl, Shift])


def drag(person: Person, state: str, by: QPoint) -> None:
    place = person.place(f"{SB}/{state}")
    person.drag(place, place + by)


def pins(person: Person) -> set[str]:
    return set(person.blueprint[SB].notes.pinned)


def said(person: Person) -> str:
    return person.window.canvas.overlays.word.text


def test_a_pinned_state_stays_and_the_others_go_around_it(sit: Sit, tmp_path: Path) -> None:
    person = sit(FILE)
    drag(person, FIRST, QPoint(40, 90))
    assert pins(person) == set(), "a state that was placed by hand is not pinned by that"
    person.window.session.select([person.blueprint.resolve(f"{SB}/{FIRST}")])
    person.press(Key.Key_K)
    assert person.steps()[-1] == f"Pin {FIRST}"
    assert pins(person) == {FIRST}
    written = dict(person.blueprint.document.values[SB]["_layout"])
    person.window.session.select(())
    tidy(person)
    assert person.steps()[-1] == f"Tidy {SB}"
    after = person.blueprint.document.values[SB]["_layout"]
    assert after[FIRST] == written[FIRST]
    assert {n for n in written if after[n] != written[n]}, "others had to make room"
    at = person.window.canvas.positions
    others = [place for name, place in at.items() if name != FIRST]
    assert not any(abs(x - at[FIRST][0]) < 108 and abs(y - at[FIRST][1]) < 54 for x, y in others), (
        "none covers it"
    )
    steps = person.steps()
    tidy(person)
    assert person.steps() == steps
    assert said(person) == "The drawing is tidy already."
    saved = tmp_path / "saved.json"
    saved.write_text(person.blueprint.document.text, "utf-8")
    again = read_blueprint(read_document(saved))
    assert again[SB].notes.pinned == {FIRST}
    assert dict(again[SB].notes.layout) == at
    for _ in range(3):
        person.ctrl(Key.Key_Z)
    assert person.blueprint.document.text == FILE.read_text("utf-8")


def test_the_place_of_a_pinned_state_keeps_its_last_digit(sit: Sit, tmp_path: Path) -> None:
    """Places are written in tenths. What a file says more exactly stays so if it is pinned."""
    layout = {"A": [12.345, 0], "B": [12.345, 4], "_pinned": {"A": True}}
    states = {"A": {"go": "B"}, "B": {"on": "C"}, "C": {"back": "A"}}
    path = tmp_path / "exact.json"
    path.write_text(json.dumps({"SB": {**states, "_layout": layout}}), "utf-8")
    person = sit(path)
    person.window.canvas.setFocus()
    tidy(person)
    assert person.steps() == ["Tidy SB"]
    written = person.blueprint.document.values["SB"]["_layout"]
    assert written["A"] == [12.345, 0]
    assert written["B"] != [12.345, 4]


def test_keys_menus_and_properties_pin_and_unpin(sit: Sit) -> None:
    person = sit(FILE)
    window, line = person.window, person.window.properties.state.notes.place
    table = window.actions_table
    person.select(f"{SB}/{FIRST}")
    assert (line.words.text(), line.button.text()) == ("Level 1, row 1", "Pin")
    person.click(line.button)
    assert pins(person) == {FIRST}
    assert (line.words.text(), line.button.text()) == ("Level 1, row 1", "Unpin")
    assert line.words.accessibleName() == "Place: Level 1, row 1, pinned"
    assert not table["pin"].isEnabled()
    person.click(line.button)
    assert pins(person) == set()
    at = person.blueprint.resolve(f"{SB}/{SECOND}")
    menu = context_menu(window.session, window.editor, table, window.clipping, at)
    row = {action.text().partition("\t")[0]: action for action in menu.actions()}
    assert not row["Unpin"].isEnabled()
    row["Pin"].trigger()
    menu.deleteLater()
    assert pins(person) == {SECOND}
    window.canvas.setFocus()
    person.select(f"{SB}/{FIRST}", f"{SB}/{SECOND}")
    person.press(Key.Key_K)
    assert person.steps()[-1] == f"Pin {FIRST}", "the other one was pinned"
    person.press(Key.Key_K, [Shift])
    assert person.steps()[-1] == "Unpin 2 states"
    assert pins(person) == set()
    assert not table["unpin_all"].isEnabled()
    person.ctrl(Key.Key_Z)
    assert pins(person) == {FIRST, SECOND}
    table["unpin_all"].trigger()
    assert pins(person) == set()
    assert person.steps()[-1] == f"Unpin all of {SB}"
    window.session.select(())
    window.canvas.setFocus()
    steps = person.steps()
    person.press(Key.Key_K)
    assert person.steps() == steps
    assert said(person).startswith("Select one or more states first.")


def test_if_all_are_pinned_tidy_says_so(sit: Sit) -> None:
    person = sit(FILE)
    window = person.window
    window.canvas.setFocus()
    person.ctrl(Key.Key_A)
    person.press(Key.Key_K)
    steps = person.steps()
    window.session.select(())
    tidy(person)
    assert person.steps() == steps
    assert said(person).startswith("Every state is pinned")
    person.select(f"{SB}/{FIRST}", f"{SB}/{SECOND}")
    tidy(person)
    assert person.steps() == steps
    assert said(person).startswith("Each selected state is pinned")


def test_a_pinned_state_is_said_to_be_pinned_and_a_hand_may_move_it(sit: Sit) -> None:
    person = sit(FILE)
    window = person.window
    person.select(f"{SB}/{FIRST}")
    person.press(Key.Key_K)
    tree = CanvasAccessible(window.canvas)
    numbers = {tree.child(i).text(QAccessible.Text.Description) for i in range(tree.childCount())}
    told = [words for words in numbers if "Pinned." in words]
    assert len(told) == 1
    before = window.canvas.positions[FIRST]
    drag(person, FIRST, QPoint(0, 120))
    assert window.canvas.positions[FIRST] != before
    assert pins(person) == {FIRST}, "the pin goes along"


def test_bends_between_pinned_states_stay(sit: Sit) -> None:
    person = sit(FILE)
    table = person.blueprint[SB].table
    source = FIRST
    operation, target = next((o, t) for o, t in table[source].items() if t != source)
    other = next(n for n in table if n not in (source, target) and table[n])
    loose = next(o for o in table[other] if table[other][o] != other)
    edges = [person.blueprint.resolve(f"{SB}/{source}/{operation}"),
             person.blueprint.resolve(f"{SB}/{other}/{loose}")]  # fmt: skip
    person.window.session.edit("Bend", lambda b: editing.set_bends(b, edges, [(33.0, 44.0)]))
    person.select(f"{SB}/{source}", f"{SB}/{target}")
    person.press(Key.Key_K)
    person.window.session.select(())
    tidy(person)
    assert set(person.blueprint[SB].notes.edges) == {(source, operation)}


def test_a_pinned_state_has_a_mark(sit: Sit) -> None:
    person = sit(FILE)
    canvas = person.window.canvas
    window = person.window
    window.session.select([person.blueprint.resolve(f"{SB}/{SECOND}")])
    canvas.setFocus()

    def corner() -> list[int]:
        """The pixels around the upper left corner of the state."""
        rect = canvas.rect_of(window.session.selection[0])
        assert rect is not None
        at = canvas.mapFromScene(rect).boundingRect().topLeft()
        image = canvas.viewport().grab().toImage()
        return [image.pixel(at.x() + x, at.y() + y) for x in range(-4, 5) for y in range(-4, 5)]

    plain = corner()
    person.press(Key.Key_K)
    marked = corner()
    assert sum(a != b for a, b in zip(plain, marked, strict=True)) > 20
    person.press(Key.Key_K, [Shift])
    assert corner() == plain
