"""Large or odd blueprints do not block the window: thousands of edges, typing errors in a
header."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QPointF

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import change_notes
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.base.canvas import lit_labels
from smsl_studio.studio.features.draw.panels import note_form
from tests.stories.conftest import Sit
from tests.stories.person import SAMPLES, Person, address

HANOI, HFSM = SAMPLES / "hanoi.json", SAMPLES / "hfsm.json"


def written(folder: Path, values: object) -> Path:
    path = folder / "odd.json"
    path.write_text(json.dumps(values, indent=4))
    return path


@pytest.mark.parametrize(
    "branch",
    [{"HEADER": {"NUM_FACTS": 10**12}}, {"S" + "01" * 500: {}, "S" + "10" * 500: {}}],
    ids=["a slip in NUM_FACTS", "long names"],
)
def test_thousands_of_facts_have_few_rows(sit: Sit, tmp_path: Path, branch: object) -> None:
    person = sit(written(tmp_path, {"SB1": branch}))
    header = person.window.properties.header
    assert len(header.facts) == 64
    assert "The first 64 of 1,0" in header.sentence.text()
    person.window.editor.add_state_at(QPointF(0, 300))
    assert person.window.editor.field is not None


def test_values_of_the_wrong_kind_are_shown_as_left_out(sit: Sit, tmp_path: Path) -> None:
    header = {"INITIAL": 5, "ACTIVATING": [], "NUM_FACTS": "x", "SUB_SBS": 7}
    branch = {"HEADER": header, "_states": 5, "_layout": 3, "State0": {"Op": "State0"}}
    person = sit(written(tmp_path, {"SB1": branch}))
    form = person.window.properties.header
    assert form.initial.currentText() == "Default (State0)"
    person.select("SB1/State0")
    person.write(person.window.properties.state.title, "Home")
    assert "is no map" in person.window.properties.state.line("title").refusal.text()
    person.choose(form.initial, "State0")
    assert person.blueprint["SB1"].header.initial == "State0"


def test_a_note_that_many_edges_share_is_written_once(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    person = sit(HANOI)
    written: list[object] = []

    def count(blueprint: Blueprint, table: str, changes: dict[object, object]) -> Blueprint:
        written.extend(changes)
        return change_notes(blueprint, table, changes)  # type: ignore[arg-type]

    monkeypatch.setattr(note_form, "change_notes", count)
    person.window.docks.show_tab("Library")
    person.click_row(person.window.library.list, "Op_1b")
    assert len(person.selected()) > 10
    form = person.window.properties.operation
    person.choose(form.risk, "High")
    assert written == [("SB1", "Op_1b")]
    assert person.blueprint["SB1"].operation_note("State_aaa", "Op_1b").risk == "high"
    edges = len(person.selected())
    person.choose(form.where, "These edges only")
    person.choose(form.risk, "Low")
    assert len(written) == 1 + edges
    assert person.steps() == [
        "Set risk of Op_1b to High", f"Set risk of {edges} operations to Low"
    ], "one step each, and one edit"  # fmt: skip


def test_where_very_many_operations_are_lit_only_what_says_more_is_named(
    sit: Sit, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(lit_labels, "MOST", 20)
    person = sit(HANOI)
    person.until_inspected()
    canvas = person.window.canvas
    assert len(canvas.lit_layer.shown()) == 2, "the two errors"
    person.window.session.select(_operations(person))
    assert len(canvas.lit_layer.shown()) == 2


def _operations(person: Person) -> list[Address]:
    (branch,) = person.blueprint
    return [
        Address(branch.name, state, operation)
        for state in branch.table
        for operation in branch.table[state]
    ]


def test_what_the_library_selects_is_shown(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.session.show_branch("SB1")
    only = next(
        name
        for operations in person.blueprint["SB2"].table.values()
        for name in operations
        if not any(name in there for there in person.blueprint["SB1"].table.values())
    )
    person.window.docks.show_tab("Library")
    person.click_row(person.window.library.list, only)
    assert person.window.session.branch == "SB2"
    assert person.selected()


def test_a_whole_sb_is_never_selected_by_a_jump(sit: Sit) -> None:
    person = sit(HFSM)
    person.window.session.jump(address("SB2"))
    assert person.window.session.branch == "SB2"
    assert person.selected() == []
