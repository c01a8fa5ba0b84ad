"""What the node of a state shows: its title, as many words as fit, and not all of many facts."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.graph.layout import place_states
from smsl_studio.picture.chip_words import CHIP, CHIP_TEXT, GAP, ROOM
from smsl_studio.picture.figure import WIDEST, Figure
from smsl_studio.picture.picture import MOST_CHIPS, Picture
from smsl_studio.picture.svg import as_svg, draw_blueprint, one_below_another
from smsl_studio.picture.words import mono_width
from smsl_studio.smsl.json_form import parse_json
from tests.bombs.table import BY_NAME
from tests.bombs.test_work import read, steps


def test_a_node_has_no_more_chips_than_it_has_room_for() -> None:
    picture = Picture(read(BY_NAME["long_states"], "json", 100_000), "B")
    face = picture.face(0)
    assert len(face.chips) == MOST_CHIPS >= WIDEST / (CHIP + GAP)
    assert face.short.startswith("0" * (MOST_CHIPS // 2) + "…")
    assert face.short.endswith(picture.names[0][-MOST_CHIPS // 2 :])


def test_a_face_takes_the_same_work_however_many_facts_there_are() -> None:
    def work(size: int) -> int:
        picture = Picture(read(BY_NAME["known_subs"], "json", size), "A")
        picture.face(0)  # what is known of the SB is worked out once
        return steps(lambda: picture.face(1))

    assert work(40_000) <= 2 * work(2_000)


def facts_of(meanings: list[tuple[str, str]], title: str = "") -> Blueprint:
    """An SB with one fact for each pair of words, in two states."""
    count = len(meanings)
    first, last = f"State_{'0' * count}", f"State_{'1' * count}"
    values = {
        "A": {
            "HEADER": {"INITIAL": first, "ACTIVATING": last, "NUM_FACTS": count},
            "_facts": {
                str(at): {"name": f"Fact{at}", "values": {"0": zero, "1": one}}
                for at, (zero, one) in enumerate(meanings)
            },
            "_states": {last: {"title": title}} if title else {},
            first: {"Op_a": last},
            last: {"Op_b": first},
        }
    }
    return read_blueprint(parse_json(json.dumps(values), "test.json"))


def words_of(meanings: list[tuple[str, str]], state: int) -> list[str]:
    picture = Picture(facts_of(meanings), "A", words=True)
    return [chip.text for chip in picture.face(state).chips]


FOUR = [("not planned", "planned"), ("not yet", "all"), ("not planned", "planned"), ("no", "yes")]


def test_of_four_facts_those_have_words_that_fit_and_the_others_digits() -> None:
    assert words_of(FOUR, 0) == ["not plann…", "0", "0", "no"]
    assert words_of(FOUR, 1) == ["planned", "1", "1", "yes"]
    assert words_of([("off", "on")] * 3, 1) == ["on", "on", "on"]


@given(
    st.lists(
        st.tuples(st.text("abc ", max_size=12), st.text("abc ", max_size=12)),
        min_size=1,
        max_size=9,
    )
)
def test_words_never_push_a_fact_off_a_node(meanings: list[tuple[str, str]]) -> None:
    texts = [words_of(meanings, state) for state in (0, 1)]
    digits = [mono_width(value, CHIP_TEXT) for value in "01"]
    for one in texts:
        assert len(one) == len(meanings)
        wide = [max(18.0, mono_width(text, CHIP_TEXT) + 8.0) for text in one]
        if any(text not in ("0", "1") for text in one):
            assert sum(wide) + GAP * (len(wide) - 1) <= ROOM + 1e-6
    for zero, one in zip(*texts, strict=True):
        assert (zero == "0") == (one == "1") or "" in (zero, one), "in all states or in none"
    assert max(digits) <= 18.0


@pytest.mark.parametrize("title", ["Ready", "Registered and checked twice by two other people"])
def test_a_title_stands_in_the_node_and_nothing_moves(title: str) -> None:
    with_title, without = facts_of(FOUR, title), facts_of(FOUR)
    drawn = as_svg(one_below_another(draw_blueprint(with_title, ["A"])), "a")
    plain = as_svg(one_below_another(draw_blueprint(without, ["A"])), "a")
    begin, end = title[:4], title[-4:]
    shown = [part for part in drawn.split(">") if part.startswith(begin) and "</text" in part]
    assert len(shown) == 1
    assert shown[0].removesuffix("</text").endswith(end)
    assert begin not in plain

    there, before = (
        Figure(Picture(read, "A"), place_states(read["A"])).at for read in (with_title, without)
    )
    assert (there - there[0] == before - before[0]).all()


def test_a_compact_node_keeps_a_name_that_does_not_show_its_facts() -> None:
    """Three copies of a state all read 0 1 0, and no name was left on the drawing."""
    given_facts = {
        "Ready": {"facts": ["0", "1"]},
        "Moving": {"facts": ["1", "1"]},
        "State_00": {"facts": ["0", "0"]},
    }
    values = {"A": {**{name: {} for name in given_facts}, "_states": given_facts}}
    picture = Picture(read_blueprint(parse_json(json.dumps(values), "test.json")), "A")
    assert [picture.face(at).short for at in range(3)] == ["Ready", "Moving", "0 0"]
