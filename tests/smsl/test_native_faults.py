"""Faults of native texts: each has its place, and a repair if one is clear."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import recovered
from smsl_studio.smsl.native_form import parse, recover

EXAMPLE = (Path(__file__).parents[2] / "samples" / "example.smsl").read_text("utf-8")
VALUES = parse(EXAMPLE, "f").values


def faults(text: str) -> tuple[ReadError, ...]:
    with pytest.raises(ReadError) as caught:
        parse(text, "f.smsl")
    for fault in caught.value.faults:
        assert fault.place is not None
        assert fault.advice
    return caught.value.faults


def repaired(text: str) -> Document:
    """The document that is left when one quick fix after the other is taken."""
    for _ in range(20):
        try:
            return parse(text, "f.smsl")
        except ReadError as error:
            fix = next(fault.fix for fault in error.faults if fault.fix)
            text = text[: fix.start] + fix.text + text[fix.end :]
    raise AssertionError(text)


DAMAGES = [
    ("111\n    ],\n", "111\n    ,\n", 11, 34, "the state 'State100' is not closed: ] is missing"),
    ("-> State1]", "-> State1", 17, 34, "the state 'State0' is not closed: ] is missing"),
    ("    State0: [", "    State0 [", 17, 12, "'State0' is a state, and : is missing"),
    ("State0: [Op", "State0: Op", 17, 13, "[ is missing behind the state 'State0'"),
    ("State111: [ ]", "State111:", 13, 13, "the state 'State111' has no [ ]"),
    ("State111: [ ]", "State111", 13, 5, "'State111' is no state: a colon and [ ] are missing"),
    ("State111: [ ]", "State111: { ]", 13, 15, "the operations of a state stand in [ ]"),
    ("State111: [ ]", "State111: [[ ]", 13, 16, "this [ opens a second time"),
    ("State111: [ ]", "]State111: [ ]", 13, 5, "nothing is open that this ] could close"),
    ("State111: [ ]\n}", "State111: [ ]\n}}", 14, 2, "nothing is open that this } could close"),
    ("},\n{", "{", 13, 18, "the State Branch 'SB1' is not closed: } is missing"),
    ("State0]\n}\n", "State0]\n", 18, 35, "the State Branch 'SB2' is not closed"),
    ("},\n{\n", "},\n", 15, 5, "this stands in no State Branch: { is missing before it"),
    ("},\n{\n", "", 14, 5, "this State Branch has a NAME already"),
    ("-> State1]", "=> State1]", 17, 25, "-> is expected, not =>"),
    ("Operation0 -> ", "Operation0=>", 17, 24, "-> is expected, not =>"),
    ("Operation0 -> ", "Operation0: ", 17, 24, "-> is expected, not :"),
    ("Operation0 -> ", "Operation0 → ", 17, 25, "-> is expected, not →"),
    ("Operation0 -> ", "Operation0 ", 17, 25, "-> is missing behind 'Operation0'"),
    ("State0: [", '"State0: [', 17, 5, "the quotes are not closed"),
    ("[Operation0 ", '["Operation0 ', 17, 14, "the quotes are not closed"),
    ("-> State1]", '-> "State1]', 17, 28, "the quotes are not closed"),
    ("# NAME: SB2", '# NAME: "SB2', 16, 13, "the quotes are not closed"),
    ("# NAME: SB2", "# NAME SB2", 16, 5, ": is missing behind NAME"),
    ("    # NAME: SB2\n", "", 15, 1, "this State Branch has no NAME"),
]


@pytest.mark.parametrize(
    ("old", "new", "line", "column", "words"), DAMAGES, ids=range(len(DAMAGES))
)
def test_one_damage_is_one_fault_that_its_fix_repairs(
    old: str, new: str, line: int, column: int, words: str
) -> None:
    assert old in EXAMPLE
    text = EXAMPLE.replace(old, new, 1)
    (fault,) = faults(text)
    assert (fault.place and (fault.place.line, fault.place.column)) == (line, column), fault
    assert fault.sentence.startswith(words), fault
    assert repaired(text).values == VALUES
    assert list(recover(text, "f.smsl").values) == ["SB1", "SB2"]


def test_two_damages_are_two_faults_in_the_order_of_the_text() -> None:
    for first in DAMAGES[:9]:
        for second in DAMAGES[14:21]:
            text = EXAMPLE.replace(first[0], first[1], 1)
            if second[0] not in text:
                continue
            both = faults(text.replace(second[0], second[1], 1))
            words = [fault.sentence for fault in both]
            expected = [(first[2], first[4]), (second[2], second[4])]
            assert len(both) == 2, both
            ordered = (words for _, words in sorted(expected, key=lambda pair: pair[0]))
            for said, start in zip(words, ordered, strict=True):
                assert said.startswith(start) or first[2] == second[2]


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("hello world", 1, 1, "this cannot stand here: hello world"),
        ('{"A": {"S": {}}}', 1, 1, "this is JSON, not native SMSL"),
        ("{ # NAME: A\n", 1, 12, "the State Branch 'A' is not closed"),
        ("{ # NAME:\n}", 1, 5, "NAME has no value"),
        ("{ # NAME: two words\n}", 1, 11, "'two words' is no name without quotes"),
        ("{ # NAME: A }", 1, 13, "a header line ends with its line"),
        ('{ # NAME: A\n# TITLE: "a" b\n}', 2, 14, "more stands behind the value of TITLE"),
        ("{ # NAME: A\n# a plain note\n}", 2, 1, "this is no header line"),
        ("{ # NAME: A\n# SUB_SBS: (B: one)\n}", 2, 12, "SUB_SBS is no map"),
        ("{ # NAME: A\nHEADER: [ ]\n}", 2, 1, "HEADER cannot be the name of a state"),
        ("{ # NAME: A\na -> b\n}", 2, 1, "these operations stand in no state"),
        ("{ # NAME: A\nS: [-> S]\n}", 2, 5, "an operation needs a name before ->"),
        ("{ # NAME: A\nS: [a ->]\n}", 2, 5, "the operation 'a' leads to no state"),
        ("{ # NAME: A\nS: [a]\n}", 2, 5, "the operation 'a' leads to no state"),
        ("{ # NAME: A\n: [a -> S]\n}", 2, 1, "a state without a name"),
        ("{ # NAME: A\nS 1: [ ]\n}", 2, 1, "'S 1' is no name without quotes"),
        ("{ # NAME: A\nS: [a b -> S]\n}", 2, 5, "'a b' is no name without quotes"),
        ("{ # NAME: A\nS: [a -> S/T]\n}", 2, 10, "'S/T' is no name without quotes"),
        ('{ # NAME: "\\x"\n}', 1, 11, "what stands in the quotes is no text in JSON"),
        ('{ # NAME: "\\ud800"\n}', 1, 11, "what stands in the quotes is no text in JSON"),
        ("# _x: {", 1, 8, "no valid JSON: expecting property name"),
        ("# _x:", 1, 6, "a value in JSON is missing"),
        ('# _x: {"a": \n 1}', 1, 7, "the value of _x goes over several lines"),
        ("# _x: [NaN]", 1, 7, "no valid JSON: NaN is no number in JSON"),
        ("# _x: 1e999", 1, 7, "no valid JSON: the number is too large"),
        ("{ # NAME: A\n# N: 1e999\n}", 2, 6, "the number is too large"),
        ("# _x: " + "7" * 5000, 1, 7, "no valid JSON: the number is too large"),
        ('# _x: "\\ud800"', 1, 8, "half a surrogate pair is no character"),
        ("# _x: \ud800", 1, 7, "half a surrogate pair is no character"),
        ("# _x: " + "[" * 64 + "]" * 64, 1, 70, "nested deeper than 64 levels"),
        ("# _x: " + "[" * 15_000, 1, 70, "nested deeper than 64 levels"),
    ],
    ids=range(31),
)
def test_a_fault_names_its_place(text: str, line: int, column: int, words: str) -> None:
    fault = faults(text)[0]
    assert fault.place
    assert (fault.place.line, fault.place.column) == (line, column), fault
    assert fault.sentence.startswith(words), fault


def test_repairs_that_keep_what_was_meant() -> None:
    text = (
        "{ # NAME: two words\nS 1: [a b => S 1, c S 1 d -> x]\n"
        '# _x: {"a":\n 1}\n# a note\nT: [ e -> S 1\n'
    )
    document = repaired(text)
    branch = document.values["two words"]
    assert branch["_x"] == {"a": 1}
    assert branch["S 1"]["a b"] == "S 1"
    assert branch["T"] == {"e": "S 1"}


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ('\ufeff{"A": {"S": {"a": "S"}}}', "JSON"),
        ('{"A": {"S": {"a": "S"}}', "JSON"),
        ("# a note\nA:\n  S: {a: S}\n", "YAML"),
    ],
)
def test_a_text_in_another_form_is_told_as_that(text: str, form: str) -> None:
    (fault,) = faults(text)
    assert fault.sentence == f"this is {form}, not native SMSL"
    assert recovered(text, "f.smsl").values == {"A": {"S": {"a": "S"}}}


def test_operations_outside_of_a_state_are_one_fault() -> None:
    text = EXAMPLE.replace("    State100: [\n", "")
    (fault,) = faults(text)
    assert fault.sentence == "these operations stand in no state"
    assert (fault.place and fault.place.line, fault.length > 30) == (9, True)


def test_what_can_be_read_is_recovered() -> None:
    text = "# _f: 1\n{\n# NUM_FACTS: 1\nS: [a -> S, b -> ]\n)( T: [\n}\n{ # NAME: B\nU: ["
    document = recover(text, "f.smsl")
    assert document.values == {
        "_f": 1,
        "SB1": {"HEADER": {"NUM_FACTS": 1}, "S": {"a": "S"}, "T": {}},
        "B": {"U": {}},
    }
    assert parse(document.text, "f.smsl").values == document.values
    assert recover("", "f.smsl").values == {}


def test_a_quote_that_is_not_closed_is_asked_once_of_its_line() -> None:
    begun = "{\n# NAME: A\nS: [a -> S"
    lost = '"\\' * 60_000  # asked again of every quote behind it, this takes a minute
    assert [fault.place and fault.place.line for fault in faults(f"{begun}, {lost}\n")] == [3, 3]
    repaired_text = repaired(f'{begun}, b -> "S  \n}}').text
    assert repaired_text.startswith(begun)


@pytest.mark.parametrize(
    "piece", ["{", "[", "a ", '"', ":", "->", "a->b ", "# _x: {\n", ")\n", "{ # NAME: A\nB: [x\n"]
)
def test_of_very_many_faults_a_hundred_are_told(piece: str) -> None:
    text = piece * 3000
    assert 1 <= len(faults(text)) <= 100
    recover(text, "f.smsl")
