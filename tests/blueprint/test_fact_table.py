"""Facts go through a table of text and back; a paste fills and adds them."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.editing.fact_table import LONGEST, table_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.forms import form_named
from tests.counts import share_of

STATES: dict[str, Any] = {"State_00": {"go": "State_11"}, "State_11": {}}
WORDS = st.text(min_size=1, max_size=9).map(str.strip)
SOME = WORDS.filter(bool)
NOTES = st.fixed_dictionaries(
    {},
    optional={
        "name": SOME,
        "values": st.dictionaries(st.sampled_from(["0", "1", "b;", 'c"']), SOME, min_size=1),
        "on": st.sampled_from(["0", "1"]),
        "failure": st.lists(SOME, min_size=1, max_size=3),
        "critical": st.just(True),
        "sensors": st.lists(SOME, min_size=1, max_size=3),
        "max_age": st.sampled_from([0.25, 3.0]),
        "unit": SOME,
    },
)


def read(values: Any, form: str = "json") -> Blueprint:
    doors = form_named(form)
    return read_blueprint(doors.parse(doors.write(values), f"f.{form}"))


@settings(max_examples=share_of(150), deadline=None)
@given(st.sampled_from(["json", "smsl", "yaml"]), NOTES, NOTES)
def test_all_facts_go_through_a_table_and_back(
    form: str, first: dict[str, Any], second: dict[str, Any]
) -> None:
    notes = {key: note for key, note in (("0", first), ("1", second)) if note}
    noted = read({"A": {**STATES, "_facts": notes} if notes else STATES}, form)
    again = edit.fill_facts(read({"A": STATES}, form), "A", table_of(noted["A"]))
    assert again == noted
    back = read_blueprint(form_named(form).parse(again.document.text, f"f.{form}"))
    assert back == noted


def test_a_paste_fills_facts_and_adds_those_that_are_missing() -> None:
    before = read({"A": {**STATES, "_facts": {"0": {"unit": "mm"}}}})
    text = "Name\tMeaning\tSensor\nClamp\t0 = open; 1 = fixed\tforce, switch\n\t\t\nTool\t\t\n"
    after = edit.fill_facts(before, "A", text)
    assert list(after["A"].table) == ["State_00", "State_11"]
    assert after["A"].fields["_facts"] == {
        "0": {"unit": "mm", "name": "Clamp", "values": {"0": "open", "1": "fixed"},
              "sensors": ["force", "switch"]},
        "1": {"name": "Tool"},
    }  # fmt: skip
    more = edit.fill_facts(after, "A", "2\tDrape\t\t\t\tyes\t\t2 s\tkPa")
    assert list(more["A"].table) == ["State_000", "State_110"]
    drape = {"name": "Drape", "critical": True, "max_age": 2.0, "unit": "kPa"}
    assert more["A"].fields["_facts"]["2"] == drape
    first = edit.fill_facts(read({"A": {}}), "A", "Clamp\nTool")
    assert first["A"].header.num_facts == 2


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (" \n", "no table to paste"),
        ("x" * (LONGEST + 1), "too long"),
        ("name\tcritical\nClamp\tperhaps", "does not say whether"),
        ("name\tage\nClamp\tsoon", "no number of seconds"),
        ("digit\tname\nfirst\tClamp", "no digit of a fact"),
        ("9999\tClamp", "A has 2 facts"),
    ],
)
def test_what_is_no_table_of_facts_is_refused(text: str, why: str) -> None:
    with pytest.raises(EditRefused, match=why):
        edit.fill_facts(read({"A": STATES}), "A", text)
