"""Counts and sentences, as the panels show them."""

from __future__ import annotations

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.errors import Place
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.studio.base.words import brief, capital, counted, first_lines, tally, worst

HERE = Address("SB1", "State0")


def finding(severity: Severity, address: Address = HERE) -> Finding:
    return Finding("R00", severity, address, Place("a.json", 1, 1), "is wrong")


@pytest.mark.parametrize(
    ("number", "words"), [(0, "0 states"), (1, "1 state"), (6561, "6,561 states")]
)
def test_counts(number: int, words: str) -> None:
    assert counted(number, "state") == words


def test_a_tally_leaves_out_what_there_is_none_of() -> None:
    found = [finding(Severity.NOTE), finding(Severity.NOTE), finding(Severity.ERROR)]
    assert tally(found) == "1 error, 2 notes"
    assert tally([]) == ""


def test_the_gravest_letter_of_an_address_wins_and_notes_are_no_mark() -> None:
    found = [finding(Severity.WARNING), finding(Severity.ERROR), finding(Severity.WARNING)]
    assert worst(found) == {HERE: "E"}
    assert worst([finding(Severity.NOTE)]) == {}


@pytest.mark.parametrize(
    ("said", "sentence"),
    [
        ("that is so", "That is so."),
        ("Did you?", "Did you?"),
        ("", ""),
        ("plain.json is in no git repository", "plain.json is in no git repository."),
        ("stop.", "Stop."),
    ],
)
def test_sentences(said: str, sentence: str) -> None:
    assert capital(said) == sentence


def test_a_name_that_is_too_long_leaves_the_words_around_it_in_sight() -> None:
    assert brief("Copied State_aaa as a picture.") == "Copied State_aaa as a picture."
    path = "/home/stein/procedures/registration/2026/outer.json was saved"
    assert brief(path) == path
    said = brief(f"Copied State_{'x' * 9_994}_end as a picture.")
    assert said == f"Copied State_{'x' * 34}…{'x' * 16}_end as a picture."
    assert len(brief("word " * 2_000)) == 600


def test_of_many_lines_the_first_are_said_and_how_many_more_there_are() -> None:
    assert first_lines(["a", "b"], 2, 2) == "a\nb"
    assert first_lines(["a", "b"], 2, 12_347) == "a\nb\nand 12,345 more"
    assert first_lines([], 2, 0) == ""
