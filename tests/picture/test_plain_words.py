"""A name that is a plain word shows no chips; a name that carries facts does."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.picture.picture import Picture
from smsl_studio.smsl.files import parse_text

WORD = '{"SB1": {"Idle": {}}}'


def chips(text: str) -> list[str]:
    picture = Picture(read_blueprint(parse_text(text, "f.json")), "SB1")
    return [chip.text for chip in picture.face(0).chips]


@pytest.mark.parametrize("text", [WORD, '{"SB1": {"Idle": {"Op": "Busy"}, "Busy": {}}}'])
def test_a_plain_word_has_no_chips(text: str) -> None:
    assert chips(text) == []


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ('{"SB1": {"State_ab": {}}}', ["a", "b"]),
        ('{"SB1": {"State01": {}}}', ["0", "1"]),
        ('{"SB1": {"HEADER": {"NUM_FACTS": 4}, "Idle": {}}}', ["I", "d", "l", "e"]),
        ('{"SB1": {"a1": {}}}', ["a", "1"]),
    ],
)
def test_a_name_that_carries_facts_has_them(text: str, shown: list[str]) -> None:
    assert chips(text) == shown
