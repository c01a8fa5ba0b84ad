"""Conflict markers of git: the versions between them, and markers that do not belong together."""

from __future__ import annotations

import pytest

from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import read_bytes
from smsl_studio.smsl.document.conflict_markers import is_marked, unmarked

PLAIN = "a\n<<<<<<< HEAD\nmine\n=======\nother\n>>>>>>> branch\nz\n"
DIFF3 = "a\n<<<<<<< HEAD\nmine\n||||||| 4f2a\nold\n=======\nother\n>>>>>>> branch\nz\n"


def test_both_versions_are_put_together_again() -> None:
    marked = unmarked(PLAIN, "f.json")
    assert (marked.ours, marked.theirs) == ("a\nmine\nz\n", "a\nother\nz\n")
    assert (marked.base, marked.lines) == (None, (2,))


def test_the_style_diff3_tells_the_base() -> None:
    assert unmarked(DIFF3, "f.json").base == "a\nold\nz\n"
    assert unmarked(DIFF3 + PLAIN, "f.json").base is None
    assert unmarked(PLAIN + DIFF3, "f.json").base is None
    assert unmarked(DIFF3.replace("\n", "\r\n"), "f.json").base == "a\r\nold\r\nz\r\n"


def test_a_line_of_equal_signs_outside_a_conflict_is_text() -> None:
    assert unmarked("=======\n" + PLAIN, "f").ours.startswith("=======\n")
    assert not is_marked("x = '<<<<<<< no'\n  <<<<<<< no\n<<<<<<<< eight\n")


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("<<<<<<< a\nmine\n", 1, "has no end"),
        ("<<<<<<< a\nmine\n=======\nother\n", 1, "has no end"),
        ("<<<<<<< a\n<<<<<<< b\n=======\n>>>>>>> a\n", 2, "stands inside another conflict"),
        ("<<<<<<< a\n=======\n<<<<<<< b\n>>>>>>> a\n", 3, "stands inside another conflict"),
        ("<<<<<<< a\n>>>>>>> b\n", 2, "stands at a wrong place"),
        ("<<<<<<< a\n=======\n=======\n>>>>>>> b\n", 3, "stands at a wrong place"),
        ("<<<<<<< a\n=======\n|||||||\n>>>>>>> b\n", 3, "stands at a wrong place"),
        (">>>>>>> b\n<<<<<<< a\n", 1, "has no beginning"),
    ],
)
def test_markers_that_do_not_belong_together_are_told_with_their_line(
    text: str, line: int, words: str
) -> None:
    with pytest.raises(ReadError, match=words) as told:
        unmarked(text, "f.json")
    assert told.value.place is not None
    assert told.value.place.line == line
    with pytest.raises(ReadError, match=words):
        read_bytes(text.encode(), "f.json")


@pytest.mark.parametrize("name", ["f.json", "f.smsl", "f.yaml"])
def test_a_marked_file_is_told_in_one_sentence_with_line_and_advice(name: str) -> None:
    with pytest.raises(ReadError) as told:
        read_bytes(f"{{\n{DIFF3}{PLAIN}}}".encode(), name)
    error = told.value
    assert (
        error.sentence == "the conflict markers of a merge by lines stand in the file, in 2 places"
    )
    assert error.place is not None
    assert error.place.line == 3
    assert "page Merge" in error.advice
    assert len(error.faults) == 1


def test_a_million_lines_take_one_walk() -> None:
    text = "<<<<<<< a\n=======\n>>>>>>> b\n" * 100_000
    assert len(unmarked(text, "f").lines) == 100_000
