"""The text of one state, as it is written, and in another form."""

from __future__ import annotations

from dataclasses import replace

from smsl_studio.front.views.state_text import MOST, StateTexts
from smsl_studio.smsl.files import parse_text
from tests.front.views.statuses import sample, written

SAMPLE = sample("registration.json")
BRANCH, STATE = "REGISTRATION", "State_0010"


def test_the_lines_are_those_of_the_file_and_know_their_operations() -> None:
    texts = StateTexts(SAMPLE)
    assert texts.forms(BRANCH) == ("smsl", "json")
    found = texts.lines(BRANCH, STATE, "json")
    whole = SAMPLE.document.text.splitlines()
    assert [line.text for line in found.lines] == [whole[one.number - 1] for one in found.lines]
    assert '"State_0010": {' in found.lines[0].text
    assert [one.operation for one in found.lines if one.operation] == [*SAMPLE[BRANCH].table[STATE]]
    first = found.lines[0].number
    assert found.words == f"lines {first} to {first + 5} of {len(whole)}"


def test_another_form_is_written_once_and_has_the_same_operations() -> None:
    texts = StateTexts(SAMPLE)
    found = texts.lines(BRANCH, STATE, "smsl")
    assert found.lines[0].text == "    State_0010: ["
    assert found.lines[1].text == "        Op_ClearToolPose -> State_0000,"
    assert [one.operation for one in found.lines if one.operation] == [*SAMPLE[BRANCH].table[STATE]]
    assert texts.lines(BRANCH, "State_0", "smsl").words == "The text has no such state"


def test_of_a_large_state_a_part_is_shown_and_what_cannot_be_written_says_why() -> None:
    row = ", ".join(f'"Op_{n}": "State_b"' for n in range(2 * MOST)).replace(", ", ",\n")
    drawn = written(f'{{"SB": {{"State_a": {{\n{row}\n}}, "State_b": {{}}}}}}')
    found = StateTexts(drawn).lines("SB", "State_a", "json")
    assert (len(found.lines), found.count) == (MOST, 2 * MOST + 2)
    odd = parse_text('{"SB": {"State_a": {"Go": {"to": 1}}, "State_b": {}}}', "odd.json")
    refused = StateTexts(replace(drawn, document=odd)).lines("SB", "State_a", "smsl")
    assert not refused.lines
    assert refused.words.startswith("It cannot be written as SMSL: SB/State_a/Go cannot be")
