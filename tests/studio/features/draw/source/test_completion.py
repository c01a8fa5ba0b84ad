"""Completion: the names that fit, written as the form requires."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from PySide6.QtCore import Qt

from smsl_studio.studio.features.draw.source.around import around
from smsl_studio.studio.features.draw.source.completion import offers
from tests.studio.features.draw.source.conftest import CTRL, Writer, read

At = Callable[..., Writer]
TEXT = """{
    "SB1": {
        "HEADER": {"SUB_SBS": {"SB2": 0}},
        "State_0": {"Op_1": "State_1", "Op_2": "State_2"},
        "State_1": {},
        "_states": {"State_0": {"title": "Start"}}
    },
    "SB2": {"State_0": {"On": "State_1"}, "State_1": {}}
}
"""


def names(text: str, form: str = "json", library: tuple[str, ...] = ()) -> list[str]:
    """What is offered at the bar."""
    lines = text.split("\n")
    at = next(n for n, line in enumerate(lines) if "|" in line)
    column = lines[at].index("|")
    lines[at] = lines[at].replace("|", "")
    here = around(lines, at, column, form)
    return [one.name for one in offers(read(TEXT), library, here)]


@pytest.mark.parametrize(
    ("line", "wanted"),
    [
        ('"SB1": {"State_0": {"Op_1": "|"', ["State_0", "State_1"]),
        ('"SB1": {"State_0": {"Op_1": "_1|"', ["State_1"]),
        ('"SB1": {"State_0": {"|', ["Op_1", "Op_2", "grip"]),
        ('"SB1": {"HEADER": {"INITIAL": |', ["State_0", "State_1"]),
        ('"SB1": {"HEADER": {"A|', ["ACTIVATING", "INITIAL", "NUM_FACTS", "NUM_STATES"]),
        ('"SB1": {"HEADER": {"SUB_SBS": {"|', ["SB2"]),
        ('"SB1": {"|', ["State_2", "HEADER", "_facts", "_operations", "_layout", "_notes"]),
        ('"SB1": {"_states": {"|', ["State_0", "State_1"]),
        ('"SB1": {"_states": {"State_0": {"t|', ["title", "note", "facts"]),
        ('"SB1": {"_operations": {"Op|', ["Op_1", "Op_2"]),
        ('"SB1": {"_operations": {"Op_1": {"co|', ["cost", "confirm"]),
        ('"_h|', ["_hazards"]),
        ('"SB1": {"_facts": {"0": {"name": "|', []),
        ('"SB3": {"State_0": {"Op": "|', []),
    ],
)
def test_what_fits_where(line: str, wanted: list[str]) -> None:
    found = names("{" + line, library=("grip",) if line.endswith('_0": {"|') else ())
    assert set(wanted) == set(found)
    assert found[:1] == wanted[:1]


def test_native_text_offers_the_same() -> None:
    text = "{\n# NAME: SB1\n%s"
    assert names(text % "State_0: [Op_1 -> |", "smsl") == ["State_0", "State_1"]
    assert names(text % "# INITIAL: St|", "smsl") == ["State_0", "State_1"]
    assert names(text % "# SUB_SBS: (|", "smsl") == ["SB2"]
    assert "ACTIVATING" in names(text % "# A|", "smsl")


def test_a_target_is_chosen_while_one_types(at_text: At) -> None:
    writer = at_text(TEXT)
    writer.go('"Op_2": "State_2"')
    writer.type(', "New": "St')
    popup = writer.pane.popup
    writer.until(popup.isVisible)
    assert popup.names == ["State_0", "State_1"]
    writer.key(Qt.Key.Key_Down)
    writer.key(Qt.Key.Key_Return)
    assert '"Op_2": "State_2", "New": "State_1"},\n' in writer.text
    assert not popup.isVisible()
    assert writer.pane.editor.hasFocus()
    writer.pane.settle()
    assert writer.session.blueprint["SB1"].table["State_0"]["New"] == "State_1"


def test_a_name_that_is_asked_for_gets_its_quotes_and_colon(at_text: At) -> None:
    writer = at_text(TEXT)
    writer.go('"State_1": {')
    writer.key(Qt.Key.Key_Space, CTRL)
    writer.until(writer.pane.popup.isVisible)
    assert writer.pane.popup.names == ["Op_1", "Op_2"]
    writer.key(Qt.Key.Key_Tab)
    assert '"State_1": {"Op_1": }' in writer.text
    writer.key(Qt.Key.Key_Space, CTRL)
    writer.key(Qt.Key.Key_Escape)
    assert not writer.pane.popup.isVisible()


def test_a_name_that_is_complete_leaves_enter_to_the_text(at_text: At) -> None:
    writer = at_text(TEXT.replace('"State_1": {},', '"State_1": {}, "State_10": {},', 1))
    writer.go('"Op_2": "State_2"')
    writer.key(Qt.Key.Key_Return)
    writer.type(', "New": "State_1')
    writer.until(writer.pane.popup.isVisible)
    assert writer.pane.popup.names == ["State_1", "State_10"]
    writer.type('"')
    writer.until(lambda: not writer.pane.popup.isVisible())
    writer.key(Qt.Key.Key_Return)
    assert writer.text.count("\n") == TEXT.count("\n") + 2


def test_names_are_written_as_native_text_writes_them(at_text: At) -> None:
    text = '{\n    # NAME: SB1\n    "a b": [Op -> State_1]\n    State_1: []\n}\n'
    writer = at_text(text, "a.smsl")
    writer.go("State_1: [")
    writer.key(Qt.Key.Key_Space, CTRL)
    writer.key(Qt.Key.Key_Return)
    writer.key(Qt.Key.Key_Space, CTRL)
    writer.until(writer.pane.popup.isVisible)
    assert writer.pane.popup.names == ["a b", "State_1"]
    writer.key(Qt.Key.Key_Return)
    writer.pane.settle()
    assert writer.session.broken is None
    assert writer.session.blueprint["SB1"].table["State_1"] == {"Op": "a b"}


SENSED = """{
    "SB": {
        "_facts": {"0": {"sources": {"force": "N", "far-away": "mm"}, "range": {"force": [0, 9]},
                         "predicate": {"0": "force < 1 N"}}, "1": {"sources": {"count": "1"}}},
        "State_01": {"Go": "State_10"}, "State_10": {}
    }
}
"""


@pytest.mark.parametrize(
    ("entry", "wanted"),
    [
        ('"sources": {"f|', ["force", "far-away"]),
        ('"sources": {"force": "kP|', ["kPa"]),
        ('"sources": {"force": "|', ["mm", "N", "deg", "1"]),
        ('"unit": "mm|', ["mm", "mmHg"]),
        ('"range": {"f|', ["force", "far-away"]),
        ('"predicate": {"|', ["0", "1"]),
        ('"predicate": {"0": "f|', ["force < 0 N", "force > 0 N", "'far-away' < 0 mm"]),
        ('"na|', ["name"]),
        ('"name": "|', []),
    ],
)
def test_sources_units_and_conditions_of_a_fact(entry: str, wanted: list[str]) -> None:
    lines = [f'{{"SB": {{"_facts": {{"0": {{{entry}']
    column = lines[0].index("|")
    here = around([lines[0].replace("|", "")], 0, column, "json")
    found = [one.name for one in offers(read(SENSED), (), here)]
    assert set(wanted) <= set(found)
    assert bool(wanted) == bool(found)
