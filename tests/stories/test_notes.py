"""Notes: put on a state or on the canvas, edited in place, moved, copied, found, and undone."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import QApplication, QMenu, QPushButton

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.annotations import LONGEST, DrawnNote
from smsl_studio.blueprint.digests import digests
from smsl_studio.studio.base.canvas.drawn_sheet import DrawnKey
from smsl_studio.studio.features.draw.canvas.context_menu import context_menu
from smsl_studio.studio.features.draw.drawn.note_field import TOO_LONG, NoteBox, NoteField
from smsl_studio.studio.features.draw.find.drawing_index import FACTS_TOO
from smsl_studio.studio.running.persons import Person as Worker
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person

Key, Ctrl, Shift = Qt.Key, Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FILE, SB = SAMPLES / "hfsm.json", "SB1"
WORDS = "The drape sensor drifts when warm"


@pytest.fixture
def person(sit: Sit) -> Person:
    made = sit(FILE)
    made.window.features.draw.notes.today = lambda: "2026-11-12"
    made.window.features.draw.notes.author = lambda: "R. Stein"
    return made


def notes(person: Person) -> dict[str, DrawnNote]:
    return dict(person.blueprint[SB].drawn.notes)


def state_note(person: Person) -> str:
    note = person.blueprint[SB].state_note("State000")
    return note.note if note is not None else ""


def chosen(person: Person) -> DrawnKey | None:
    return person.window.canvas.drawn.chosen


def box(person: Person) -> NoteBox:
    """The field that is open, with the keys in it."""
    field = person.window.features.draw.notes.field
    assert isinstance(field, NoteField)
    person.until(field.field.hasFocus)
    return field.field


def keep(person: Person, words: str) -> None:
    """Type a note into the open field, and keep it."""
    box(person)
    person.type(words)
    person.press(Key.Key_Return, [Ctrl])


def add(person: Person, state: str = "", words: str = WORDS) -> str:
    """Add a note by keys; returns its key."""
    before = notes(person)
    if state:
        person.select(f"{SB}/{state}")
    else:
        person.window.session.select(())
    person.window.canvas.setFocus()
    person.press(Key.Key_M, [Ctrl, Shift])
    keep(person, words)
    (key,) = notes(person).keys() - before.keys()
    return key


def place(person: Person, key: str) -> QPoint:
    """The middle of a note, in pixels of the canvas."""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    rect = sheet.drawn.rect(DrawnKey("note", key))
    assert rect is not None
    return person.on_canvas(rect.center())


def undo_all(person: Person) -> str:
    while person.window.session.history.canUndo():
        person.ctrl(Key.Key_Z)
    return person.blueprint.document.text


def test_a_note_is_put_on_the_selected_state_by_keys_alone(person: Person) -> None:
    before = digests(person.blueprint)
    key = add(person, "State100")
    note = notes(person)[key]
    assert (note.text, note.author, note.date) == (WORDS, "R. Stein", "2026-11-12")
    assert note.state == "State100"
    assert chosen(person) == DrawnKey("note", key)
    assert person.steps() == ["Add a note"]
    assert digests(person.blueprint) == before
    assert person.window.canvas.hasFocus()
    assert undo_all(person) == FILE.read_text()
    assert chosen(person) is None


def test_a_free_note_lies_where_nothing_is_and_in_view(person: Person) -> None:
    one, two = add(person), add(person)
    assert notes(person)[one].state == ""
    sheet = person.window.canvas.sheet
    assert sheet is not None
    rects = [sheet.drawn.rect(DrawnKey("note", key)) for key in (one, two)]
    first, second = (rect for rect in rects if rect is not None)
    assert not first.intersects(second)
    seen = person.window.canvas.seen
    assert seen.contains(first)
    assert seen.contains(second)
    sides = first.left(), first.top(), first.right(), first.bottom()
    assert not sheet.states_in(*sides)


def test_a_note_moves_with_its_state_and_alone(person: Person) -> None:
    key = add(person, "State000")
    before = place(person, key)
    state = person.place(f"{SB}/State000")
    person.drag(state, state + QPoint(0, 48))
    assert person.steps()[-1] == "Move State000"
    moved_by = person.place(f"{SB}/State000") - state
    assert moved_by.x() == 0
    assert abs(moved_by.y() - 48) <= 8, "a drag ends at a guide if one is near"
    assert place(person, key) - before == moved_by
    at = notes(person)[key].at
    person.drag(place(person, key), place(person, key) + QPoint(24, 40))
    assert person.steps()[-1] == "Move a note"
    moved = notes(person)[key]
    assert (moved.at[0] - at[0], moved.at[1] - at[1]) == (24.0, 40.0)
    assert moved.state == "State000"
    person.ctrl(Key.Key_Z)
    assert notes(person)[key].at == at


def test_escape_keeps_what_was_typed_and_shift_escape_drops_it(person: Person) -> None:
    person.press(Key.Key_M, [Ctrl, Shift])
    box(person)
    person.type("Ask the clinic")
    person.press(Key.Key_Escape)
    (key,) = notes(person)
    assert notes(person)[key].text == "Ask the clinic"
    assert person.steps() == ["Add a note"]
    assert chosen(person) == DrawnKey("note", key)
    person.press(Key.Key_F2)
    box(person)
    person.type("Something else")
    person.press(Key.Key_Escape, [Shift])
    assert notes(person)[key].text == "Ask the clinic"
    assert person.window.features.draw.notes.field is None
    person.press(Key.Key_F2)
    box(person)
    person.type("Twice the work")
    person.press(Key.Key_Escape)
    assert notes(person)[key].text == "Twice the work"
    person.ctrl(Key.Key_Z)
    assert notes(person)[key].text == "Ask the clinic"


def test_escape_in_an_empty_note_makes_none(person: Person) -> None:
    person.press(Key.Key_M, [Ctrl, Shift])
    box(person)
    person.press(Key.Key_Escape)
    assert not notes(person)
    assert person.window.features.draw.notes.field is None


def test_escape_in_the_note_of_a_state_keeps_it_too(person: Person) -> None:
    person.select(f"{SB}/State000")
    field = person.window.properties.state.note
    person.click(field)
    person.type("Ask the clinic")
    person.press(Key.Key_Escape)
    assert state_note(person) == "Ask the clinic"
    person.type(" twice")
    person.press(Key.Key_Escape, [Shift])
    assert field.toPlainText() == "Ask the clinic"


def test_it_is_edited_in_place_and_without_words_it_goes(person: Person) -> None:
    key = add(person)
    person.double_click_canvas(place(person, key))
    assert box(person).toPlainText() == WORDS
    keep(person, "Ask the clinic")
    assert notes(person)[key].text == "Ask the clinic"
    assert person.steps()[-1] == "Edit a note"
    person.press(Key.Key_F2)
    person.press(Key.Key_Escape)
    assert person.steps()[-1] == "Edit a note"
    person.press(Key.Key_Return)
    box(person).selectAll()
    person.press(Key.Key_Delete)
    person.press(Key.Key_Return, [Ctrl])
    assert not notes(person)
    assert person.steps()[-1] == "Delete a note"


def test_enter_begins_a_line_and_a_click_elsewhere_keeps_the_words(person: Person) -> None:
    person.press(Key.Key_M, [Ctrl, Shift])
    box(person)
    person.type("one")
    person.press(Key.Key_Return)
    person.type("two")
    person.click_canvas(QPoint(30, 500))
    assert [note.text for note in notes(person).values()] == ["one\ntwo"]
    person.press(Key.Key_M, [Ctrl, Shift])
    box(person)
    person.press(Key.Key_Return, [Ctrl])
    assert len(notes(person)) == 1


def test_arrows_move_it_as_one_step_and_del_deletes_it(person: Person) -> None:
    key = add(person)
    at, steps = notes(person)[key].at, len(person.steps())
    for _ in range(3):
        person.press(Key.Key_Right)
    person.press(Key.Key_Down, [Shift])
    assert notes(person)[key].at == (at[0] + 24.0, at[1] + 1.0)
    assert len(person.steps()) == steps + 1
    person.press(Key.Key_Delete)
    assert not notes(person)
    assert chosen(person) is None
    person.ctrl(Key.Key_Z)
    assert notes(person)[key].at == (at[0] + 24.0, at[1] + 1.0)


def test_it_is_selected_instead_of_states(person: Person) -> None:
    key = add(person)
    person.select(f"{SB}/State111")
    assert chosen(person) is None
    person.click_canvas(place(person, key))
    assert chosen(person) == DrawnKey("note", key)
    assert not person.selected()
    person.press(Key.Key_Escape)
    assert chosen(person) is None
    person.press(Key.Key_M, [Ctrl, Qt.KeyboardModifier.AltModifier])
    assert chosen(person) == DrawnKey("note", key)
    person.ctrl(Key.Key_A)
    assert chosen(person) is None
    assert len(person.selected()) == 4


def test_it_is_copied_cut_pasted_and_duplicated(person: Person) -> None:
    key = add(person)
    person.ctrl(Key.Key_C)
    assert QGuiApplication.clipboard().text() == WORDS
    person.ctrl(Key.Key_V)
    assert [note.text for note in notes(person).values()] == [WORDS] * 2
    assert {note.author for note in notes(person).values()} == {"R. Stein"}
    person.ctrl(Key.Key_D)
    assert len(notes(person)) == 3
    person.ctrl(Key.Key_X)
    assert len(notes(person)) == 2
    assert person.steps() == ["Add a note", "Copy a note", "Copy a note", "Delete a note"]
    assert key in notes(person)


def test_copied_states_bring_their_notes(person: Person) -> None:
    add(person, "State100")
    person.select(f"{SB}/State100", f"{SB}/State110")
    person.ctrl(Key.Key_D)
    assert len(notes(person)) == 2
    assert len({note.state for note in notes(person).values()}) == 2


@pytest.mark.parametrize("raw", [b"", b"5", b"{", b'{"text": 5}', b"x" * 300_000])
def test_what_is_no_note_on_the_clipboard_adds_none(person: Person, raw: bytes) -> None:
    data = QMimeData()
    data.setData("application/x-smsl-note", raw)
    QGuiApplication.clipboard().setMimeData(data)
    person.ctrl(Key.Key_V)
    assert all(note.text == "" for note in notes(person).values())


def test_properties_say_what_hangs_on_a_state(person: Person) -> None:
    person.select(f"{SB}/State110")
    section = person.window.properties.state.notes
    assert section.words.text() == "None"
    person.click(section.button)
    keep(person, WORDS)
    (key,) = notes(person)
    assert notes(person)[key].state == "State110"
    person.select(f"{SB}/State110")
    assert section.words.text() == WORDS
    assert section.button.text() == "Show note"
    person.click(section.button)
    assert chosen(person) == DrawnKey("note", key)


def rows(menu: QMenu) -> list[str]:
    return [one.text().partition("\t")[0] for one in menu.actions() if one.text()]


def row(menu: QMenu, words: str) -> QAction:
    return next(one for one in menu.actions() if one.text().partition("\t")[0] == words)


def test_the_menus_at_the_pointer_offer_it(person: Person) -> None:
    window = person.window
    draw = window.features.draw
    shown = window.session, window.editor, window.actions_table, draw.clipping
    menu = context_menu(*shown, None)
    assert "Add a note here" in rows(menu)
    menu.close()
    person.select(f"{SB}/State100")
    menu = context_menu(*shown, window.session.selection[0])
    row(menu, "Add note").trigger()
    menu.close()
    keep(person, WORDS)
    (key,) = notes(person)
    assert notes(person)[key].state == "State100"
    window.canvas.drawn_menu_wanted.emit(DrawnKey("note", key), QPoint(5, 5))
    menu = next(one for one in window.findChildren(QMenu) if one.isVisible())
    assert rows(menu)[:1] == ["Edit the note"]
    assert "Free the note" in rows(menu)
    assert "Hang on the nearest state" not in rows(menu)
    row(menu, "Free the note").trigger()
    menu.close()
    assert notes(person)[key].state == ""
    before = place(person, key)
    window.actions_table["hang_note"].trigger()
    assert notes(person)[key].state
    assert place(person, key) == before


def test_a_note_is_added_where_the_menu_was_opened(person: Person) -> None:
    person.window.canvas.note_wanted.emit(QPointF(101.0, -83.0))
    keep(person, WORDS)
    (note,) = notes(person).values()
    assert note.at == (104.0, -80.0)


def test_the_find_bar_finds_it_in_any_branch(person: Person) -> None:
    key = add(person)
    person.window.session.show_branch("SB2")
    bar = person.window.features.draw.search.bar
    person.ctrl(Key.Key_F)
    person.until(bar.field.hasFocus)
    bar.scope.setCurrentIndex(FACTS_TOO)
    bar.field.selectAll()
    person.type("drifts when")
    search = person.window.features.draw.search
    person.until(lambda: not search.due)
    person.press(Key.Key_Return)
    person.until(lambda: not search.due)
    assert len(search.hits) == 1
    assert search.hits[0].kind == "Note"
    assert person.window.session.branch == SB
    assert chosen(person) == DrawnKey("note", key)
    assert person.window.canvas.seen.contains(person.window.canvas.mapToScene(place(person, key)))


def test_a_text_that_is_too_long_is_refused_with_a_sentence(person: Person) -> None:
    person.press(Key.Key_M, [Ctrl, Shift])
    field = box(person)
    QApplication.clipboard().setText("x" * (LONGEST + 1))
    field.paste()
    assert field.toPlainText() == ""
    opened = person.window.features.draw.notes.field
    assert opened is not None
    assert opened.error.text() == TOO_LONG
    QApplication.clipboard().setText("y" * 6_000)
    field.paste()
    field.paste()
    assert opened.error.text() == TOO_LONG
    assert field.toPlainText() == "y" * 6_000, "what was written stays, and can be kept"
    QApplication.clipboard().setText("z" * 4_000)
    field.paste()
    person.type("!")
    assert opened.error.text() == TOO_LONG
    person.press(Key.Key_Return)
    assert opened.error.text() == TOO_LONG
    person.press(Key.Key_Return, [Ctrl])
    assert [note.text for note in notes(person).values()] == ["y" * 6_000 + "z" * 4_000]


def test_the_author_is_the_person_of_this_window_or_the_user(sit: Sit) -> None:
    person = sit(FILE)
    persons = person.windows.persons
    write = person.window.features.draw.notes.author
    assert write() != "a person"
    persons.put(Worker("Dr. Lee", "surgeon"))
    assert write() == "Dr. Lee"


def test_another_branch_and_another_file_drop_field_and_selection(person: Person) -> None:
    add(person)
    person.press(Key.Key_F2)
    box(person)
    person.window.session.show_branch("SB2")
    assert person.window.features.draw.notes.field is None
    assert chosen(person) is None


def test_a_screen_reader_is_told(person: Person) -> None:
    key = add(person, "State100")
    assert "Note: The drape" in person.window.canvas.accessibleDescription()
    assert "on State100" in person.window.canvas.accessibleDescription()
    person.select(f"{SB}/State100")
    assert "Note" not in person.window.canvas.accessibleDescription()
    assert key in notes(person)


def test_ten_thousand_notes_and_two_hundred_groups_open(sit: Sit, tmp_path: Path) -> None:
    values = json.loads(FILE.read_text())
    many = {str(i): {"text": "long " * 2_000 if i % 100 == 0 else "short", "at": [i, -i]}
            for i in range(10_000)}  # fmt: skip
    states = [name for name in values[SB] if name not in ("HEADER",)]
    groups = {str(i): {"title": "t" * 10_000, "states": states[i % 4 : i % 4 + 1]}
              for i in range(200)}  # fmt: skip
    values[SB] |= {"_notes": many, "_layout": {"_groups": groups}}
    path = tmp_path / "many.json"
    path.write_text(json.dumps(values))
    person = sit(path)
    assert len(notes(person)) == 10_000
    assert len(person.blueprint[SB].drawn.groups) == 4
    person.window.canvas.fit()
    person.window.canvas.grab()
    person.window.canvas.setFocus()
    person.press(Key.Key_M, [Ctrl, Shift])
    keep(person, WORDS)
    assert len(notes(person)) == 10_001


# Properties


def test_properties_show_the_selected_note_and_change_it(person: Person) -> None:
    key = add(person, "State110")
    form = person.window.properties.drawn
    person.until(form.isVisible)
    assert form.text.field.toPlainText() == WORDS
    assert (form.author.field.text(), form.date.text()) == ("R. Stein", "2026-11-12")
    assert form.on.text() == "State110"
    person.write(form.author.field, "A. Maier")
    assert notes(person)[key].author == "A. Maier"
    assert chosen(person) == DrawnKey("note", key)
    person.click(form.text.field)
    form.text.field.selectAll()
    person.type("Ask the clinic")
    person.click(form.author.field)
    assert notes(person)[key].text == "Ask the clinic"
    person.click(form.text.field)
    form.text.field.selectAll()
    person.press(Key.Key_Backspace)
    person.click(form.author.field)
    assert notes(person)[key].text == "Ask the clinic", "a note keeps its words"
    assert "needs words" in form.text.refusal.text()
    person.select("SB1/State000")
    assert not form.isVisible()
    assert person.window.properties.state.isVisible()


def test_a_free_note_says_so_and_hangs_on_a_state_from_properties(person: Person) -> None:
    key = add(person)
    form = person.window.properties.drawn
    person.until(form.isVisible)
    assert form.on.text() == "None, it is free"
    (hang,) = (one for one in form.findChildren(QPushButton) if one.text() == "Hang")
    person.click(hang)
    assert notes(person)[key].state
    assert form.on.text() == notes(person)[key].state


def test_a_very_long_text_pasted_in_properties_is_refused_at_once(person: Person) -> None:
    key = add(person, "State110")
    form = person.window.properties.drawn
    person.until(form.isVisible)
    person.click(form.text.field)
    QGuiApplication.clipboard().setText("x\n" * 5_000_000)
    person.ctrl(Key.Key_V)
    assert form.text.field.toPlainText() == WORDS
    assert f"{LONGEST:,} characters" in form.text.refusal.text()
    assert notes(person)[key].text == WORDS


def test_a_new_note_covers_no_state_and_no_other_note(sit: Sit) -> None:
    person = sit(SAMPLES / "hanoi.json")
    canvas, verbs = person.window.canvas, person.window.features.draw.notes
    (branch, *_) = person.blueprint
    for state in list(branch.table)[:10]:
        verbs.add_note(state=state)
        keep(person, "Short.")
    sheet = canvas.sheet
    assert sheet is not None
    rects = [sheet.drawn.rect(DrawnKey("note", key)) for key in sheet.drawn.parts.note_keys]
    nodes = [canvas.rect_of(Address(branch.name, state)) for state in branch.table]
    assert len(rects) == 10
    for at, rect in enumerate(rects):
        assert rect is not None
        others = [one for one in (*rects[:at], *nodes) if one is not None]
        assert not [one for one in others if one.intersects(rect)]
