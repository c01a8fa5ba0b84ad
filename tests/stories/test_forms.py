"""Annotations edited in forms: facts, states, operations, hazards, files."""

from __future__ import annotations

import json
from pathlib import Path

from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtGui import QTextDocumentFragment
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit

from smsl_studio.studio.base.lines.fact_rows import FactRows
from smsl_studio.studio.features.draw.panels.kept import KeptValues
from tests.stories.at_outline import click_line
from tests.stories.conftest import Sit
from tests.stories.person import LEFT, SAMPLES, Person

Key = Qt.Key
HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"
REGISTRATION = SAMPLES / "registration.json"


def lines_of(kept: KeptValues) -> list[str]:
    """What a person reads there; where a line may break nothing is seen."""
    shown = QTextDocumentFragment.fromHtml(kept.words.text()).toPlainText()
    return shown.replace("\u200b", "").splitlines()


def written(folder: Path, values: object, name: str = "file.json") -> Path:
    path = folder / name
    path.write_text(json.dumps(values, indent=4))
    return path


def clear(person: Person, field: QLineEdit) -> None:
    """Take a text out of a field."""
    person.click(field)
    field.selectAll()
    QTest.keyClick(field, Key.Key_Delete)
    QTest.keyClick(field, Key.Key_Return)


# Facts


def test_a_fact_is_described_in_its_form(sit: Sit) -> None:
    person = sit(REGISTRATION)
    click_line(person.window.outline.tree, "Fact 2")
    form = person.window.properties.fact
    assert form.isVisible()
    person.write(form.name, "Landmarks digitised")
    person.write(form.values.rows["1"].meaning, "all of them")
    person.click(form.values.rows["0"].failure)
    person.click(form.values.rows["0"].on)
    person.click(form.line("critical").field)
    person.write(form.line("sensors").field, 'tracker, "left, near", camera')  # type: ignore[arg-type]
    person.choose(form.line("aggregation").field, "At least k of them")  # type: ignore[arg-type]
    person.write(form.line("k").field, "2")  # type: ignore[arg-type]
    person.write(form.line("max_age").field, "0,5")  # type: ignore[arg-type]
    note = person.blueprint["REGISTRATION"].fields["_facts"]["1"]
    assert note == {
        "name": "Landmarks digitised", "values": {"1": "all of them"}, "failure": ["0"],
        "on": "0", "critical": True, "sensors": ["tracker", "left, near", "camera"],
        "aggregation": "k_of_n", "k": 2, "max_age": 0.5,
    }  # fmt: skip
    assert "Set max. age of digit 1 of REGISTRATION to 0.5 s" in person.steps()
    for _ in range(len(person.steps())):
        person.window.session.history.undo()
    assert person.blueprint.document.text == REGISTRATION.read_text()


def test_a_default_is_not_written(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.window.going.show_fact("REGISTRATION", 0)
    form = person.window.properties.fact
    person.click(form.line("critical").field)
    person.click(form.line("critical").field)
    person.write(form.name, "Planned")
    clear(person, form.name)
    assert person.blueprint.document.text == REGISTRATION.read_text()


def test_a_fact_that_a_sub_sb_expands_has_no_sensor_of_its_own(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State110")
    chips = person.window.properties.state.chips
    person.window.repaint()
    QTest.mouseClick(chips, LEFT, pos=chips.place_of(1).center().toPoint())
    person.choose_in_menu("What Fact 2 means…")
    form = person.window.properties.fact
    assert form.isVisible()
    assert not person.window.properties.state.isVisible()
    assert "exactly while SB2 stands in its activating state, State1" in form.expanded.text()
    assert not form.line("sensors").isVisible()
    person.click(form.close_button)
    assert person.window.properties.state.isVisible(), "what is selected counts again"
    person.window.going.show_fact("SB1", 1)
    person.click(form.enter)
    assert person.window.session.branch == "SB2"


def test_a_fact_of_a_selected_state_is_clicked_on_the_canvas(sit: Sit) -> None:
    person = sit(HFSM)
    canvas = person.window.canvas
    assert canvas.sheet is not None
    canvas.zoom_to(1.0)
    state = canvas.sheet.picture.index["State110"]
    x, y = canvas.positions["State110"]
    spots = [(x + dx, y + dy) for dx in range(-50, 51, 4) for dy in range(-24, 26, 4)]
    facts = {canvas.hand.hover.fact_at(state, QPointF(*spot)): spot for spot in spots}
    at = person.on_canvas(facts[2])
    person.click_canvas(at)
    assert person.window.properties.state.isVisible(), "the first click selects"
    person.click_canvas(at)
    person.choose_in_menu("What Fact 3 means…")
    form = person.window.properties.fact
    assert form.isVisible()
    assert form.who() == "digit 2 of SB1"


def test_a_value_of_a_wrong_kind_is_reported_and_kept(sit: Sit, tmp_path: Path) -> None:
    odd = {"0": {"name": 7, "max_age": "soon", "colour": "red"}}
    states = {"State0": {"_seen": "often"}, "State1": {}}
    notes = {"_facts": odd, "_states": {"State0": "words"}}
    person = sit(written(tmp_path, {"SB1": {**notes, **states}}))
    person.select("SB1/State0")
    assert lines_of(person.window.properties.state.kept) == ["_seen: often"]
    assert "Not understood, and kept" in person.window.properties.state.odd.text()
    person.window.going.show_fact("SB1", 0)
    form = person.window.properties.fact
    assert "does not fit" in form.line("max_age").refusal.text()
    assert "colour" in form.odd.text()
    person.write(form.line("unit").field, "mm")  # type: ignore[arg-type]
    assert person.blueprint["SB1"].fields["_facts"]["0"] == {**odd["0"], "unit": "mm"}
    person.write(form.line("max_age").field, "-1")  # type: ignore[arg-type]
    assert "too small. Write a number above 0" in form.line("max_age").refusal.text()
    person.write(form.line("max_age").field, "2")  # type: ignore[arg-type]
    assert person.blueprint["SB1"].fields["_facts"]["0"]["max_age"] == 2
    assert form.line("max_age").refusal.text() == ""


def test_while_the_text_is_broken_a_form_says_so_at_its_field(sit: Sit) -> None:
    person = sit(HFSM)
    session = person.window.session
    person.select("SB1/State110")
    session.write("Type", "{ broken")
    person.window.docks.show_tab("Properties")
    form = person.window.properties.state
    person.write(form.title, "Half way")
    assert "cannot be read" in form.line("title").refusal.text()
    assert not person.window.toast.words
    session.history.undo()
    person.write(form.title, "Half way")
    assert person.steps()[-1] == "Set title of State110 to “Half way”"


# States


def test_several_states_are_marked_and_noted_together(sit: Sit) -> None:
    person = sit(HFSM)
    person.select("SB1/State000", "SB1/State100")
    form = person.window.properties.state
    person.click(form.safe)
    person.click(form.note)
    person.type("Rest here")
    person.ctrl(Key.Key_Return)
    expected = {"safe": True, "note": "Rest here"}
    assert person.blueprint["SB1"].fields["_states"] == {"State000": expected, "State100": expected}
    assert person.steps() == [
        "Set safe state of 2 states to yes", "Set description of 2 states to “Rest here”"
    ]  # fmt: skip
    person.select("SB1/State000")
    person.write(form.title, "Start")
    person.select("SB1/State000", "SB1/State100")
    assert form.title.placeholderText() == "Various"
    assert form.note.toPlainText() == "Rest here"


def test_names_that_carry_no_facts_are_given_theirs(sit: Sit, tmp_path: Path) -> None:
    person = sit(written(tmp_path, {"SB1": {"Ready": {"Go": "Done now"}, "Done now": {}}}))
    for state, values in (("Ready", "0, 1"), ("Done now", "1, 1")):
        person.window.session.jump(person.blueprint.resolve(f"SB1/{state}"))
        person.write(person.window.properties.state.values, values)
    assert person.blueprint["SB1"].facts("Done now") == ("1", "1")
    assert person.blueprint["SB1"].num_facts == 2


# Operations


def test_an_edge_has_values_of_its_own_beside_those_of_its_name(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.session.jump(person.blueprint.resolve("SB1/State_aaa/Op_1b"))
    form = person.window.properties.operation
    person.write(form.cost, "2.5")
    person.choose(form.actor, "Robot")
    person.choose(form.where, "This edge only")
    assert form.cost.text() == ""
    assert form.cost.placeholderText() == "2.5 (all Op_1b)"
    assert form.actor.currentText() == "Robot (all Op_1b)"
    person.write(form.cost, "4")
    assert form.line("cost").hint.text() == "This edge only; all Op_1b: 2.5."
    assert person.blueprint["SB1"].cost("State_aaa", "Op_1b") == 4
    assert person.blueprint["SB1"].cost("State_aac", "Op_1b") == 2.5
    person.write(form.cost, "2.5")
    assert "State_aaa/Op_1b" not in person.blueprint["SB1"].fields["_operations"], "the same"
    assert person.steps() == [
        "Set cost of Op_1b to 2.5", "Set who acts of Op_1b to Robot",
        "Set cost of State_aaa/Op_1b to 4", "Set cost of State_aaa/Op_1b to 2.5",
    ]  # fmt: skip


def require(person: Person, rows: FactRows, fact: str, value: str) -> None:
    person.click(rows.add)
    row = rows.rows[-1]
    person.write(row.fact, fact)
    person.write(row.value, value)


def test_an_operation_requires_facts_of_any_sb(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.session.jump(person.blueprint.resolve("SB1/State100/Operation100B"))
    rows = person.window.properties.operation.requires.facts
    person.window.properties.ensureWidgetVisible(rows)
    require(person, rows, "SB2/7", "1")
    assert "SB2 has no digit 7. Its digits go from 0 to 0" in rows.refusal.text()
    require(person, rows, "SB9/0", "1")
    assert "no State Branch “SB9”" in rows.refusal.text()
    require(person, rows, "SB2/0", "1")
    require(person, rows, "SB1/0", "1")
    note = person.blueprint["SB1"].operation_note("State100", "Operation100B")
    assert note.requires == {"SB2/0": "1", "SB1/0": "1"}
    person.click(rows.rows[0].gone)
    note = person.blueprint["SB1"].operation_note("State100", "Operation100B")
    assert note.requires == {"SB1/0": "1"}
    person.click(rows.rows[0].gone)
    assert person.blueprint["SB1"].fields.get("_operations") is None


def test_a_fact_is_completed_by_any_part_of_its_name(sit: Sit) -> None:
    person = sit(SAMPLES / "registration-digitization.json")
    blueprint = person.blueprint
    person.window.session.jump(next(blueprint["REGISTRATION"].edges()).address)
    rows = person.window.properties.operation.requires.facts
    person.window.properties.ensureWidgetVisible(rows)
    person.click(rows.add)
    field = rows.rows[-1].fact
    person.click(field)
    person.type("digitiz")
    completer = field.completer()
    popup = completer.popup()
    assert popup is not None
    person.until(popup.isVisible)
    found = [completer.completionModel().index(at, 0).data() for at in range(2)]
    assert all("digitiz" in text.casefold() for text in found if text)
    QTest.keyClick(popup, Key.Key_Down)
    QTest.keyClick(popup, Key.Key_Return)
    person.come_back()
    assert field.text().partition("/")[0] in blueprint.branches


def test_an_operation_is_bound_to_a_library_function(sit: Sit) -> None:
    person = sit(HANOI)
    person.window.session.jump(person.blueprint.resolve("SB1/State_aaa/Op_1b"))
    form = person.window.properties.operation
    line = form.binding
    person.window.properties.ensureWidgetVisible(line)
    assert line.field.currentText() == "By its name: hanoi.move_disk"
    person.choose(line.field, "hanoi.move_disk")
    assert line.arguments["disk"].field.text() == "1", "what the name says is where one starts"
    person.window.properties.ensureWidgetVisible(line.arguments["disk"])
    person.write(line.arguments["disk"].field, "big")
    assert "Write a whole number" in line.arguments["disk"].refusal.text()
    person.write(line.arguments["disk"].field, "2")
    assert person.blueprint["SB1"].fields["_operations"]["Op_1b"]["binding"] == {
        "function": "hanoi.move_disk", "arguments": {"disk": 2, "peg": "b"}
    }  # fmt: skip
    clear(person, line.arguments["peg"].field)
    assert "'peg' is missing" in line.hint.text()
    person.choose(line.field, "By its name: hanoi.move_disk")
    assert person.blueprint.document.text == HANOI.read_text()


def test_a_binding_by_name_is_told_only_where_a_plugin_knows_the_procedure(
    sit: Sit, tmp_path: Path
) -> None:
    states = {
        "HEADER": {"INITIAL": "S0", "ACTIVATING": "S2"},
        "S0": {"Op_2mount": "S1", "Op_Wash": "S0"},
        "S1": {"Op_Seal": "S2", "Op_Open": "S0"},
        "S2": {"Op_Stop": "S0"},
    }
    person = sit(written(tmp_path, {"A": states}))
    person.until(lambda: person.window.properties.operation.binding.field.count() > 1)
    person.window.session.jump(person.blueprint.resolve("A/S0/Op_2mount"))
    line = person.window.properties.operation.binding
    assert "hanoi.move_disk" in [line.field.itemText(at) for at in range(line.field.count())]
    assert line.field.currentText() == "Not bound"


# Header, hazards, file


def test_hazards_and_properties_are_counted_and_lead_to_their_page(
    sit: Sit, tmp_path: Path
) -> None:
    odd, good = {"name": 5}, {"name": "Both", "facts": {"SB1/0": "1", "SB2/0": "1"}}
    person = sit(written(tmp_path, {"_hazards": [odd, good], **json.loads(HFSM.read_text())}))
    properties, page = person.window.properties, person.window.features.inspection.panel
    line = properties.claims
    properties.ensureWidgetVisible(line)
    assert line.said.text() == "2 hazards."
    person.until(lambda: person.window.inspector.proof is not None)
    person.click(line.open)
    assert page.isVisible()
    assert page.table.hasFocus()
    assert page.table.claims.rowCount() == 1

    person.click(page.add)
    person.write(page.form.name, "Again both")
    person.write(page.form.first, "SB1/0 = 1 and SB2/0 = 1")
    assert [hazard.name for hazard in person.blueprint.hazards] == ["Both", "Again both"]
    assert person.blueprint.fields["_hazards"][0] == odd, "what is no hazard is kept"
    assert line.said.text() == "3 hazards."


def test_without_hazards_the_line_leads_to_the_empty_page(sit: Sit) -> None:
    person = sit(HFSM)
    properties, page = person.window.properties, person.window.features.inspection.panel
    properties.ensureWidgetVisible(properties.claims)
    assert properties.claims.said.text().startswith("None.")
    person.click(properties.claims.open)
    assert page.add_empty.hasFocus()


def test_a_file_is_imported_and_left_again(sit: Sit, tmp_path: Path) -> None:
    values = json.loads(HFSM.read_text())
    (tmp_path / "parts").mkdir()
    sub = written(tmp_path, {"SB2": values.pop("SB2")}, "parts/sub.json")
    main = written(tmp_path, {**values, "_author": "Ada"})
    person = sit(main)
    form = person.window.properties.file
    assert lines_of(form.kept)[-1] == "_author: Ada"
    person.window.properties.ensureWidgetVisible(form.add)
    form.ask_file = lambda folder: tmp_path / "none.json"
    person.click(form.add)
    assert "cannot be read" in form.refusal.text()
    form.ask_file = lambda folder: sub
    person.click(form.add)
    assert person.blueprint.fields["_imports"] == ["parts/sub.json"]
    assert list(person.blueprint.branches) == ["SB1", "SB2"]
    assert person.steps() == ["Import parts/sub.json"]
    person.window.session.show_branch("SB2")
    assert person.window.properties.header.home.text() == "In sub.json. Edits go there."
    person.window.session.show_branch("SB1")
    person.window.properties.ensureWidgetVisible(form.rows[0][0])
    person.click(form.rows[0][2])
    assert list(person.blueprint.branches) == ["SB1"]


def test_unknown_fields_are_shown_as_they_are_written_however_long(
    sit: Sit, tmp_path: Path
) -> None:
    words = "Registration in which a <b>wrist</b> & arm"
    person = sit(written(tmp_path, {"_use": words, "_n": "a\u202eb", "SB1": {"State0": {}}}))
    kept = person.window.properties.file.kept
    assert lines_of(kept) == [f"_use: {words}", r"_n: a\u202eb"]
    assert kept.words.minimumSizeHint().width() < kept.words.fontMetrics().averageCharWidth() * 40


def test_header_keys_nobody_knows_are_shown_and_kept(sit: Sit, tmp_path: Path) -> None:
    header = {"version": 2, "_by": "hand", "NUM_STATES": 9}
    person = sit(written(tmp_path, {"SB1": {"HEADER": header, "_x": [1], "State0": {}}}))
    form = person.window.properties.header
    assert lines_of(form.kept) == ["version: 2", "_by: hand", "_x: [1]"]
    assert form.num_states.text() == "9"
    person.write(form.num_states, "3")
    assert "SB1 has 1 states" in form.states_line.refusal.text()
    person.write(form.num_states, "1")
    assert person.blueprint["SB1"].header.num_states == 1
    clear(person, form.num_states)
    assert person.blueprint.document.values["SB1"]["HEADER"] == {"version": 2, "_by": "hand"}


def test_no_form_is_wider_than_its_panel(sit: Sit) -> None:
    person = sit(HANOI, size=(1280, 800))
    properties = person.window.properties
    inner = properties.widget()
    assert inner is not None
    for address in ("SB1/State_aaa", "SB1/State_aaa/Op_1b"):
        person.window.session.jump(person.blueprint.resolve(address))
        assert inner.minimumSizeHint().width() <= properties.viewport().width()
    person.window.going.show_fact("SB1", 0)
    assert inner.minimumSizeHint().width() <= properties.viewport().width() <= 304
    person.click_canvas(QPoint(20, 300))
    assert not properties.fact.isVisible(), "what is chosen next takes its place"


# What people are asked


def test_what_people_are_asked_is_said_in_the_form_of_an_operation(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.select("REGISTRATION/State_1100/Op_Register")
    form = person.window.properties.operation
    assert not form.line("question").isVisible()
    person.choose(form.actor, "Human")
    assert form.line("question").isVisible()
    person.write(form.asking.question, "Fix the head in the clamp")
    person.write(form.asking.roles, "surgeon, surgeon, Anybody")
    person.write(form.asking.within, "90")
    person.write(form.asking.escalation, "lead surgeon")
    person.write(form.confirm, "anybody, anybody")
    note = person.blueprint["REGISTRATION"].operation_note("State_1100", "Op_Register")
    assert (note.question, note.roles) == ("Fix the head in the clamp", ("surgeon", "surgeon", ""))
    assert (note.answer_within, note.escalates_to) == (90, "lead surgeon")
    assert note.confirm == ("", "")
    assert form.confirm.text() == "anybody, anybody"
    for _ in range(6):
        person.window.session.history.undo()
    assert person.blueprint["REGISTRATION"].operation_note("State_1100", "Op_Register").roles == ()


def test_a_fact_that_no_sensor_reads_can_be_a_persons(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.window.going.show_fact("REGISTRATION", 1)
    form = person.window.properties.fact
    assert not form.line("question").isVisible()
    person.choose(form.line("aggregation").field, "A person says it")  # type: ignore[arg-type]
    person.write(form.asking.question, "Are all landmarks digitised?")
    person.write(form.asking.roles, "surgeon")
    note = person.blueprint["REGISTRATION"].fact_note(1)
    assert note is not None
    assert (note.aggregation, note.question, note.roles) == (
        "human", "Are all landmarks digitised?", ("surgeon",),
    )  # fmt: skip


def test_what_a_pause_and_a_cancel_do_is_said_in_the_form(sit: Sit) -> None:
    person = sit(REGISTRATION)
    person.select("REGISTRATION/State_1100/Op_Register")
    form = person.window.properties.operation
    person.click(form.resumes)
    person.write(form.touches, "2, 0, 2")
    note = person.blueprint["REGISTRATION"].operation_note("State_1100", "Op_Register")
    assert (note.resumes, note.touches) == (True, (0, 2))
    person.write(form.touches, "first")
    assert form.line("touches").refusal.text() == (
        "“first” is no digit. Write whole numbers, counted from 0."
    )
    assert person.blueprint["REGISTRATION"].operation_note("State_1100", "Op_Register") == note
