"""The search for lines, compared with a plain search line by line; the order of the hits."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.studio.features.draw.find.haystack import LETTERS, Haystack
from tests.counts import share_of

letters = st.text(st.sampled_from("abAB01_ İßé"), max_size=6)
lines = st.lists(st.builds(lambda name, more: f"{name}\t{more}", letters, letters), max_size=12)


def holds(line: str, word: str) -> bool:
    return word in line.lower()


@settings(max_examples=share_of(150), deadline=None)
@given(lines, st.text(st.sampled_from("ab01_ "), min_size=1, max_size=5))
def test_every_line_with_all_words_is_found(haystack: list[str], typed: str) -> None:
    words = typed.lower().split()
    found = {hit.line for hit in Haystack(haystack).find(typed, 100) if hit.tier < LETTERS}
    plain = [line.replace("İ", "?") for line in haystack]
    expected = {at for at, line in enumerate(plain) if all(holds(line, w) for w in words)}
    assert found == (expected if words else set())


def names(haystack: list[str], typed: str) -> list[str]:
    return [haystack[hit.line] for hit in Haystack(haystack).find(typed, 10)]


def test_the_nearest_stands_first() -> None:
    lines = ["xplan", "PlanLong", "replan", "x_plan", "Plan", "pl_a_n", "RePlan", "o\tplan it"]
    assert names(lines, "plan") == [
        "Plan", "PlanLong", "o\tplan it", "x_plan", "RePlan", "xplan", "replan", "pl_a_n"
    ]  # fmt: skip
    assert names(["S_0110", "State_110", "State110long", "S1x1x0"], "110") == [
        "State_110", "State110long", "S_0110", "S1x1x0"
    ]  # fmt: skip
    assert names(["ab cab", "long_a and_b"], "a b")[0] == "long_a and_b"


def test_special_characters_of_expressions_are_plain_characters() -> None:
    lines = ["a.b", "a*b", "[x]", "^-]\\", "a\nb"]
    for line in lines[:4]:
        assert names(lines, line) == [line]
    assert names(lines, "a b")[0] == "a\nb", "a name of two lines is one line"
    assert names([], "a") == []
    assert names(lines, "x" * 5000) == []


@settings(max_examples=share_of(100), deadline=None)
@given(lines, st.text(st.sampled_from("ab01_ "), max_size=4))
def test_every_line_that_holds_the_text_is_told_in_order_with_its_place(
    haystack: list[str], typed: str
) -> None:
    phrase, stack = " ".join(typed.split()), Haystack(haystack)
    plain = [line.lower().replace("i̇", "İ") for line in haystack]
    expected = [
        (at, line.find(phrase), line.find(phrase) + len(phrase))
        for at, line in enumerate(plain) if phrase and phrase in line
    ]  # fmt: skip
    assert list(stack.holding(typed)) == expected
    assert [stack.line(at) for at in range(len(stack))] == haystack
