"""What the index of a drawing finds, in which order, and the filter by fact values."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.features.draw.find import hits as hits_module
from smsl_studio.studio.features.draw.find.drawing_index import ELEMENTS, DrawingIndex
from smsl_studio.studio.features.draw.find.hits import Hits
from smsl_studio.studio.features.draw.find.value_filter import (
    Condition,
    conditions,
    filtered,
    why_nothing,
)

TEXT = """{
 "A": {"HEADER": {}, "_facts": {"0": {"name": "Lid", "values": {"1": "shut"}}},
  "_operations": {"go": {"title": "Walk"}, "State01/go": {"title": "Run"}},
  "State00": {"go": "State01", "stay": "State00"}, "State01": {"go": "State11"}, "State11": {}},
 "B": {"HEADER": {}, "State0": {"go": "State1"}, "State1": {}}
}"""


@pytest.fixture
def blueprint() -> Blueprint:
    return read_blueprint(parse_json(TEXT, "two.json"))


def index_of(blueprint: Blueprint) -> DrawingIndex:
    index = DrawingIndex()
    index.show(blueprint)
    return index


def places(hits: Hits) -> list[str]:
    return [str(hits[at].there) for at in range(len(hits))]


def test_hits_stand_in_the_order_of_the_drawing(blueprint: Blueprint) -> None:
    hits = index_of(blueprint).find("go", ELEMENTS)
    assert places(hits) == ["A/State00/go", "A/State01/go", "B/State0/go"]
    assert [hits.place(hits[at].there) for at in range(3)] == [0, 1, 2]
    assert (hits.first_in("A"), hits.first_in("B"), hits.first_in("C")) == (0, 2, None)
    assert [hits.branch(at) for at in range(3)] == ["A", "A", "B"]
    assert hits.place(Address("B", "State1")) is None


def test_the_title_of_one_edge_wins_over_that_of_its_name(blueprint: Blueprint) -> None:
    index = index_of(blueprint)
    (walk,) = [index.find("walk", ELEMENTS)[0]]
    assert (str(walk.there), walk.field, walk.text) == ("A/State00/go", "title", "Walk")
    assert places(index.find("run", ELEMENTS)) == ["A/State01/go"]


def test_an_edit_changes_what_is_found(blueprint: Blueprint) -> None:
    index = index_of(blueprint)
    index.show(editing.rename(blueprint, Address("A", "State00", "stay"), "wait"))
    assert not len(index.find("stay", ELEMENTS))
    assert places(index.find("wait", ELEMENTS)) == ["A/State00/wait"]


def test_only_so_many_hits_are_counted(
    blueprint: Blueprint, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hits_module, "MOST", 4)
    hits = index_of(blueprint).find("State", ELEMENTS)
    assert (len(hits), hits.more) == (4, True)
    monkeypatch.setattr(hits_module, "MOST", 5)
    hits = index_of(blueprint).find("State", ELEMENTS)
    assert (len(hits), hits.more) == (5, False)


@pytest.mark.parametrize(
    ("typed", "found"),
    [
        ("lid = 1", ["A/State11"]),
        ("LID = shut", ["A/State11"]),
        ("lid != 1", ["A/State00", "A/State01"]),
        ("0 = 0, fact 2 = 1", ["A/State01"]),
        ("fact 1 = 1", ["B/State1"]),
        ("li = 0", ["A/State00", "A/State01"]),
    ],
)
def test_states_are_found_by_fact_and_value(
    blueprint: Blueprint, typed: str, found: list[str]
) -> None:
    assert places(Hits.of_states(filtered(blueprint, conditions(typed)))) == found


@pytest.mark.parametrize(
    "typed", ["lid", "lid =", "= 1", "a = b = c", "lid = 1,", "x" * 300 + "=1"]
)
def test_another_text_is_no_filter(typed: str) -> None:
    assert conditions(typed) == ()


def test_a_filter_without_hits_says_why(blueprint: Blueprint) -> None:
    def why(typed: str) -> str:
        return why_nothing(blueprint, "A", conditions(typed))

    assert conditions("lid = 7") == (Condition("lid", "7"),)
    assert why("lid = 7") == "Lid is never “7”. Its values: 0, 1"
    assert why("door = 1") == "No fact is called “door”. Facts here: Lid, Fact 2"
    assert why("lid = 1, fact 2 = 0") == "No state meets this"
