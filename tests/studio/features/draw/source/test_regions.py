"""The regions that can be folded, found by indentation."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.studio.features.draw.source import regions

SAMPLES = Path(__file__).parents[5] / "samples"
HANOI = (SAMPLES / "hanoi.json").read_text("utf-8").splitlines(keepends=True)
NATIVE = """{
    # NAME: SB1

    State_0: [
        Op -> State_1

    ],
    State_1: [ ]
},
{
    # NAME: SB2
    State_0: [Op -> State_0]
}
""".splitlines(keepends=True)


def at(name: str) -> int:
    return next(n for n, line in enumerate(HANOI) if f'"{name}": {{' in line)


def test_a_state_hides_its_operations_and_the_bracket_that_closes_it() -> None:
    first = at("State_bab")
    assert regions.region(HANOI, first) == (first + 1, first + 4)
    assert HANOI[first + 4].strip() == "},"


def test_what_opens_nothing_cannot_be_folded() -> None:
    first = at("State_bab")
    assert regions.region(HANOI, first + 1) is None
    assert not regions.opens(HANOI, len(HANOI) - 1)
    assert regions.region(["a: [\n", "  b\n"], 0) is None


def test_the_nearest_line_that_holds_a_line() -> None:
    first = at("State_bab")
    assert regions.enclosing(HANOI, first + 2) == first
    assert regions.enclosing(HANOI, first) == first
    assert regions.enclosing(NATIVE, 2) == 0
    assert regions.enclosing(["a\n"], 0) is None


def test_the_sbs_of_a_file() -> None:
    assert regions.outermost(NATIVE, "smsl") == [0, 9]
    assert [HANOI[one].strip() for one in regions.outermost(HANOI, "json")] == ['"SB1": {']


def test_what_is_folded_is_named() -> None:
    first, last = at("State_bab"), at("State_bbc") - 1
    assert regions.names_in(HANOI, first, last, "json") == ("State_bab", "State_aab")
    assert regions.names_in(NATIVE, 0, 8, "smsl") == ("SB1", "SB1")
    assert regions.names_in(NATIVE, 3, 6, "smsl") == ("State_0", "State_0")
