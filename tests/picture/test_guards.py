"""Guards in a picture: which operations require facts of other SBs, in words and as a mark."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.editing import set_note
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.colours import LIGHT
from smsl_studio.picture.figure import Figure
from smsl_studio.picture.guards import MEANING, guarded_edges, guards_of, needs_words
from smsl_studio.picture.labels import meet
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.svg import draw_blueprint
from tests.stories.person import sample

MOVE = Address("ROBOT", "State10", "MoveToTarget")


@pytest.fixture(scope="module")
def rooms() -> Blueprint:
    return sample("three-roots.json")


def _requires(blueprint: Blueprint, key: str, requires: dict[str, str]) -> Blueprint:
    return set_note(blueprint, "ROBOT", "_operations", key, {"requires": requires})


def test_an_edge_names_the_facts_it_needs(rooms: Blueprint) -> None:
    guards = guards_of(rooms, rooms["ROBOT"], MOVE.state, MOVE.operation)
    assert [(guard.branch, guard.digit, guard.value) for guard in guards] == [
        ("REGISTRATION", 2, "1"), ("TOOLPLAN", 0, "1"), ("TOOLPLAN", 1, "1"),
    ]  # fmt: skip
    assert needs_words(guards) == (
        "needs Registered of REGISTRATION to be 1, Entry chosen of TOOLPLAN to be 1, "
        "Target chosen of TOOLPLAN to be 1"
    )
    assert needs_words(()) == ""


def test_what_a_value_means_is_said_and_what_is_no_fact_too(rooms: Blueprint) -> None:
    named = set_note(rooms, "TOOLPLAN", "_facts", "0", {"name": "Entry", "values": {"1": "chosen"}})
    odd = _requires(named, "SwitchOn", {"TOOLPLAN/0": "1", "TOOLPLAN/7": "1", "x": "1"})
    guards = guards_of(odd, odd["ROBOT"], "State00", "SwitchOn")
    assert [guard.words for guard in guards] == [
        "Entry of TOOLPLAN to be 1 (chosen)", "TOOLPLAN/7, which is no fact", "x, which is no fact",
    ]  # fmt: skip
    assert [guard.digit for guard in guards] == [0, -1, -1]


def test_guarded_edges_are_found_by_name_and_by_edge(rooms: Blueprint) -> None:
    assert list(guarded_edges(rooms["ROBOT"])) == [MOVE]
    assert list(guarded_edges(rooms["TOOLPLAN"])) == []
    own = _requires(rooms, "State11/Retract", {"TOOLPLAN/0": "1"})
    assert set(guarded_edges(own["ROBOT"])) == {MOVE, Address("ROBOT", "State11", "Retract")}


def test_the_mark_has_room_in_its_label_and_covers_no_other(rooms: Blueprint) -> None:
    picture = Picture(rooms, "ROBOT")
    figure = Figure(picture, place_states(rooms["ROBOT"]))
    edge = picture.edge(MOVE)
    plain = Picture(_requires(rooms, "MoveToTarget", {}), "ROBOT")
    bare = Figure(plain, place_states(rooms["ROBOT"]))
    assert figure.label_size(edge)[0] > bare.label_size(edge)[0]
    places = [figure.geometry.label(e) for e in range(len(picture.operations))]
    for at, one in enumerate(places):
        assert one is not None
        assert not any(other and meet(one, other) for other in places[:at])


def test_the_svg_says_what_is_needed_and_explains_the_mark(rooms: Blueprint) -> None:
    svg = draw_blueprint(rooms, ["ROBOT"], LIGHT)[0].svg
    assert "needs Registered of REGISTRATION to be 1" in svg
    assert svg.count(MEANING) == 1
