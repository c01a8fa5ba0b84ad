"""The compact form of a state: derived from its name, never from facts that a word does not say."""

from __future__ import annotations

import json
from string import ascii_letters, digits

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.figure import compact_width
from smsl_studio.picture.levels import COMPACT_MAX
from smsl_studio.picture.name_room import STEPS, with_room
from smsl_studio.picture.picture import Picture
from smsl_studio.picture.prefix import SEPARATORS, left_out
from smsl_studio.picture.svg import as_svg, draw_blueprint, one_below_another
from smsl_studio.smsl.json_form import parse_json
from tests.picture.test_svg import words_of

WORDS = st.text(ascii_letters, min_size=1, max_size=9)
STATES = st.one_of(
    WORDS,
    st.text(digits, min_size=3, max_size=3).map("State_{}".format),
    st.text(digits, min_size=3, max_size=3).map("Drill_{}".format),
    st.tuples(WORDS, WORDS).map("_".join),
    st.tuples(WORDS, WORDS).map(" ".join),
)


def machine(states: list[str], given_facts: bool, names: bool = False) -> Blueprint:
    """A ring of states, whose facts are numbers in ``_states`` or stand in their names."""
    table: dict[str, object] = {"HEADER": {} if given_facts else {"NUM_FACTS": 3}}
    for at, state in enumerate(states):
        table[state] = {f"go{at}": states[(at + 1) % len(states)]}
    if given_facts:
        table["_states"] = {s: {"facts": list(f"{at:03b}")} for at, s in enumerate(states)}
    if names:
        table["_facts"] = {"0": {"name": "Power", "values": {"0": "off", "1": "on"}}}
    return read_blueprint(parse_json(json.dumps({"S": table}), "test.json"))


@given(st.lists(STATES, min_size=2, max_size=6, unique=True), st.booleans())
def test_a_short_form_says_nothing_that_the_name_does_not_say(
    states: list[str], given_facts: bool
) -> None:
    picture = Picture(machine(states, given_facts), "S")
    for at, name in enumerate(picture.names):
        short = picture.face(at).short
        assert name.endswith((short, short.replace(" ", "")))
        if given_facts and not any(map(str.isdigit, name)):
            assert short == name


def test_words_stay_and_names_that_carry_facts_are_short() -> None:
    named = Picture(machine(["Idle", "Homing", "Ready"], given_facts=True), "S")
    assert [named.face(at).short for at in range(3)] == ["Idle", "Homing", "Ready"]
    assert named.first_shortened == -1
    said = Picture(machine(["State_000", "State_001", "Fault"], given_facts=True), "S")
    assert [said.face(at).short for at in range(3)] == ["0 0 0", "0 0 1", "Fault"]
    carried = Picture(machine(["State_000", "State_110"], given_facts=False), "S")
    assert [carried.face(at).short for at in range(2)] == ["000", "110"]


def test_a_word_that_is_read_by_letters_is_not_cut() -> None:
    picture = Picture(machine(["Patient ready", "State_01a", "State_11b"], given_facts=False), "S")
    assert picture.face(0).short == "Patient ready"


@given(st.lists(st.text("ab_-", min_size=1, max_size=6), max_size=40, unique=True))
def test_what_labels_leave_out_is_there_and_keeps_them_different(names: list[str]) -> None:
    prefix = left_out(names)
    assert not prefix or prefix[-1] in SEPARATORS
    cut = [name.removeprefix(prefix) for name in names]
    assert all(cut)
    assert len(set(cut)) == len(names)
    lacking = [name for name in names if not name.startswith(prefix)]
    assert len(lacking) * 10 <= len(names)
    ends = [at for at, char in enumerate(names[0], 1) if char in SEPARATORS] if names else []
    everywhere = [
        names[0][:end] for end in ends
        if all(name.startswith(names[0][:end]) and name != names[0][:end] for name in names)
    ]  # fmt: skip
    if everywhere and len(names) > 1:
        assert prefix == everywhere[-1]


def test_one_odd_name_leaves_the_labels_of_the_others_short() -> None:
    usual = [f"Op_{at}" for at in range(20)]
    assert left_out([*usual, "Extra"]) == "Op_"
    assert left_out([*usual, "Extra", "Aside", "Zoom"]) == ""
    assert left_out([*usual, "7"]) == "", "Op_7 and 7 would look the same"


@pytest.mark.parametrize("named", [True, False])
def test_a_file_says_what_the_facts_mean(named: bool) -> None:
    blueprint = machine(["Idle", "Homing", "Ready"], given_facts=True, names=named)
    shown = words_of(as_svg(one_below_another(draw_blueprint(blueprint, ["S"])), "t"))
    said = "Facts from left to right: Power (0 off, 1 on); Fact 2; Fact 3"
    assert (said in shown) == named


@given(st.integers(2, 12), st.integers(120, 240), st.integers(12, 30))
def test_names_have_room_when_a_drawing_is_small(count: int, pitch: int, letters: int) -> None:
    names = [f"{chr(97 + at)}" * letters for at in range(count)]
    picture = Picture(machine(names, given_facts=True), "S")
    at = np.array([(pitch * place, 0.0) for place in range(count)], dtype=np.float64)
    faces = [picture.face(place) for place in range(count)]
    wished = np.array([compact_width(face) for face in faces])
    found = with_room(at, np.full(count, 160.0), np.minimum(wished, COMPACT_MAX), faces)
    half = 0.5 * pitch
    assert (found + 8.0 <= max(half, STEPS[-1] + 8.0) + 1e-6).all()
    assert (found >= min(STEPS[-1], wished.min())).all()


def test_names_that_carry_facts_keep_their_width() -> None:
    picture = Picture(machine(["State_000", "State_110"], given_facts=False), "S")
    faces = [picture.face(0), picture.face(1)]
    wished = np.array([120.0, 120.0])
    at = np.array([(0.0, 0.0), (130.0, 0.0)])
    assert with_room(at, wished, wished, faces).tolist() == [120.0, 120.0]
