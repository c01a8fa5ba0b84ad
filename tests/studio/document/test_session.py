"""One history for canvas, forms and text; a broken text blocks nothing but edits."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import ReadError, StudioError
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.document.broken import read_text
from smsl_studio.studio.document.session import Broken, Session

SAMPLES = Path(__file__).parents[3] / "samples"
TEXT = '{\n  "SB1": {\n    "State_0": {"Op": "State_1"},\n    "State_1": {}\n  }\n}\n'


def blueprint_of(text: str, file: str = "a.json") -> Blueprint:
    return read_blueprint(form_named("json").parse(text, file))


@pytest.fixture
def session(qapp: object) -> Session:
    return Session(blueprint_of(TEXT))


@pytest.fixture
def refused(session: Session) -> list[StudioError]:
    found: list[StudioError] = []
    session.refused.connect(found.append)
    return found


def test_a_readable_text_is_one_step_like_any_edit(session: Session) -> None:
    session.write("Type", TEXT.replace("State_1", "State_2"))
    assert list(session.blueprint["SB1"].table) == ["State_0", "State_2"]
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_3"))
    session.history.undo()
    session.history.undo()
    assert session.texts == {"a.json": TEXT}
    session.history.redo()
    assert list(session.blueprint["SB1"].table) == ["State_0", "State_2"]


def test_a_broken_text_keeps_the_last_good_blueprint(session: Session) -> None:
    good, told = session.blueprint, []
    session.blueprint_changed.connect(lambda *_: told.append("blueprint"))
    session.broken_changed.connect(lambda: told.append("broken"))
    session.write("Type", TEXT[:-4])
    assert session.blueprint is good
    assert session.broken is not None
    assert session.broken.error.place is not None
    assert session.texts == {"a.json": TEXT[:-4]}
    assert session.edited
    session.write("Type", TEXT)
    assert session.broken is None
    assert session.blueprint is good
    assert told == ["broken", "broken"]


def test_edits_are_refused_until_the_text_is_repaired_or_undone(
    session: Session, refused: list[StudioError]
) -> None:
    session.write("Type", TEXT.replace('"State_1": {}', '"State_1": {,}'))
    assert not session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_3"))
    assert "a.json" in refused[0].sentence
    assert "line 4" in refused[0].sentence
    assert "undo" in refused[0].advice
    session.history.undo()
    assert session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_3"))


def test_typed_text_becomes_a_step_before_an_edit(session: Session) -> None:
    session.settling.connect(lambda: session.write("Type", TEXT.replace("State_1", "State_2")))
    assert session.edit("Add", lambda bp: editing.add_operation(bp, "SB1", "State_2", "O",
                                                                "State_0"))  # fmt: skip
    assert session.history.count() == 2


def test_a_text_that_changes_nothing_leaves_no_step(session: Session) -> None:
    session.write("Type", TEXT)
    assert session.history.count() == 0


def test_steps_from_before_a_save_under_another_name_keep_the_new_one(session: Session) -> None:
    session.write("Type", TEXT[:-4])
    session.write("Type", TEXT)
    session.saved(blueprint_of(TEXT, "b.json"))
    session.history.undo()
    assert session.broken is not None
    assert session.broken.file == session.blueprint.file == "b.json"
    assert session.broken.error.place is not None
    assert session.broken.error.place.file == "b.json"
    assert session.texts == {"b.json": TEXT[:-4]}


def test_a_broken_file_opens_with_what_could_be_read(session: Session) -> None:
    broken = read_text(session.blueprint, "a.json", TEXT[:-4])
    assert isinstance(broken, Broken)
    session.open(session.blueprint, broken)
    assert session.broken is broken
    assert not session.edited
    session.open(session.blueprint)
    assert session.broken is None


def test_only_one_file_may_be_broken(session: Session, refused: list[StudioError]) -> None:
    session.open(session.blueprint, Broken("other.json", "{", _error("{", "other.json")))
    session.write("Type", TEXT.replace("State_1", "State_2"))
    assert "other.json" in refused[0].sentence
    assert session.history.count() == 0


def _error(text: str, file: str) -> ReadError:
    with pytest.raises(ReadError) as caught:
        form_named("json").parse(text, file)
    return caught.value


def test_a_reading_is_a_pure_function_of_a_blueprint(qapp: object) -> None:
    before = read_blueprint(read_document(SAMPLES / "hanoi.json"))
    text = before.document.text.replace("State_aaa", "State_aab", 1)
    reading = read_text(before, before.file, text)
    assert isinstance(reading, Blueprint)
    assert reading.document.text == text


def test_what_was_selected_before_a_fact_and_was_undone_is_extended_no_more(
    session: Session,
) -> None:
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", "State_2"))
    state, added = Address("SB1", "State_0"), Address("SB1", "State_2")
    session.select([state, added])
    session.select_fact("SB1", 0)
    assert list(session.extended) == [state, added]
    session.history.undo()
    assert list(session.extended) == [state]


def test_a_selected_fact_that_is_gone_is_shown_by_nobody(session: Session) -> None:
    """A form that is told of the new blueprint asks which fact is selected."""
    seen = []
    session.blueprint_changed.connect(lambda *_: seen.append(session.fact))
    told: list[tuple[Address, ...]] = []
    session.selection_changed.connect(told.append)
    session.edit("Add", lambda bp: editing.add_branch(bp, "SB2"))
    session.edit("Add", lambda bp: editing.add_state(bp, "SB2", "State_0"))
    session.select_fact("SB2", 0)
    session.edit("Rename", lambda bp: editing.rename(bp, Address("SB2"), "SB3"))
    assert (seen[-1], session.fact) == (("SB3", 0), ("SB3", 0))
    session.history.undo()
    assert (seen[-1], session.fact) == (("SB2", 0), ("SB2", 0))
    told.clear()
    session.history.undo()
    session.history.undo()
    assert (seen[-1], session.fact, told) == (None, None, [()])
    assert session.branch == "SB1"


def at(*names: str) -> tuple[Address, ...]:
    return tuple(Address("SB1", name) for name in names)


def added(session: Session, name: str) -> None:
    """A new state, which is selected as the window does it."""
    session.edit("Add", lambda bp: editing.add_state(bp, "SB1", name))
    session.select(at(name))


def deleted(session: Session, *names: str) -> None:
    session.edit("Delete", lambda bp: editing.delete(bp, at(*names)))


def test_an_undo_selects_again_what_was_selected(session: Session) -> None:
    session.select(at("State_1", "State_0"))
    deleted(session, "State_1", "State_0")
    assert session.selection == ()
    session.history.undo()
    assert session.selection == at("State_1", "State_0")
    session.history.redo()
    assert session.selection == ()


def test_undo_and_redo_walk_along_the_selections(session: Session) -> None:
    session.select(at("State_0"))
    for name in ("State_2", "State_3", "State_4"):
        added(session, name)
    walked = []
    for step in (session.history.undo,) * 3 + (session.history.redo,) * 3:
        step()
        walked.append([one.state for one in session.selection])
    assert walked == [["State_3"], ["State_2"], ["State_0"], ["State_2"], ["State_3"], ["State_4"]]


def test_a_remembered_name_is_that_of_the_stand(session: Session) -> None:
    session.select(at("State_1"))
    session.edit("Rename", lambda bp: editing.rename(bp, at("State_1")[0], "State_9"))
    deleted(session, "State_9")
    session.history.undo()
    assert session.selection == at("State_9")
    session.history.undo()
    assert session.selection == at("State_1")


def test_a_newer_choice_stays_after_an_undo(session: Session) -> None:
    session.select(at("State_1"))
    deleted(session, "State_1")
    session.select(at("State_0"))
    session.history.undo()
    assert session.selection == at("State_0"), "a state that was selected since"
    session.history.redo()
    session.select_fact("SB1", 0)
    session.history.undo()
    assert session.fact == ("SB1", 0), "a fact"
    session.select(at("State_1"))
    session.edit("Rename", lambda bp: editing.rename(bp, at("State_1")[0], "State_9"))
    session.select(())
    session.history.undo()
    assert session.selection == (), "nothing"


def test_what_is_in_another_branch_is_not_selected(session: Session) -> None:
    session.select(at("State_1"))
    deleted(session, "State_1")
    session.edit("Add", lambda bp: editing.add_branch(bp, "SB2"))
    session.show_branch("SB2")
    session.history.undo()
    session.edit("Add", lambda bp: editing.add_branch(bp, "SB2"))
    session.show_branch("SB2")
    session.edit("Add", lambda bp: editing.add_state(bp, "SB2", "State_7"))
    session.history.undo()
    assert (session.branch, session.selection) == ("SB2", ())
