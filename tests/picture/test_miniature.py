"""The miniature of a blueprint: places and pairs of states, fitted into a box."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.miniature import MOST_STATES, Miniature, miniature_of
from smsl_studio.smsl.files import Content, document_of, read_document
from smsl_studio.smsl.inputs import NOTHING

SAMPLES = Path(__file__).parents[2] / "samples"


def drawn(text: str) -> Miniature | None:
    return miniature_of(read_blueprint(document_of(Content(text.encode(), NOTHING), "a.json")))


def test_states_and_lines_are_those_of_the_largest_branch() -> None:
    found = miniature_of(read_blueprint(read_document(SAMPLES / "registration-people.json")))
    assert found is not None
    assert len(found.places) == 8
    assert found.activating == 7


def test_a_line_is_drawn_once_and_not_to_itself_or_to_nothing() -> None:
    found = drawn('{"S": {"A0": {"a": "A1", "b": "A0", "c": "A9"}, "A1": {"d": "A0", "e": "A0"}}}')
    assert found is not None
    assert found.lines.tolist() == [[0, 1]]


def test_the_places_fit_into_the_box_and_keep_their_proportions() -> None:
    found = miniature_of(read_blueprint(read_document(SAMPLES / "hanoi.json")))
    assert found is not None
    at = found.within(60, 40)
    assert at.min() >= 0
    assert (at.max(axis=0) <= (60, 40)).all()
    wide, tall = np.ptp(found.places, axis=0)
    assert np.isclose(np.ptp(at, axis=0)[0] / np.ptp(at, axis=0)[1], wide / tall)


def test_one_state_stands_in_the_middle() -> None:
    found = drawn('{"S": {"A0": {}}}')
    assert found is not None
    assert found.within(60, 40).tolist() == [[30, 20]]


def test_nothing_and_far_too_much_have_none() -> None:
    assert drawn("{}") is None
    assert drawn('{"S": {"HEADER": {}}}') is None
    states = ", ".join(f'"A{at}": {{}}' for at in range(MOST_STATES + 1))
    assert drawn(f'{{"S": {{{states}}}}}') is None
