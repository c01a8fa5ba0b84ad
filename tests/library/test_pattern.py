"""Name patterns are read by one documented rule."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.errors import PluginError
from smsl_studio.library.pattern import read_pattern
from tests.counts import share_of

DISK = {"disk": int, "peg": str}


@pytest.mark.parametrize(
    ("pattern", "types", "name", "found"),
    [
        ("Op_{disk}{peg}", DISK, "Op_1b", {"disk": "1", "peg": "b"}),
        ("Op_{disk}{peg}", DISK, "Op_12b", {"disk": "12", "peg": "b"}),
        ("Op_{disk}{peg}", DISK, "Op_123", {"disk": "12", "peg": "3"}),
        ("Op_{disk}{peg}", DISK, "Op_b1", None),
        ("Op_{disk}{peg}", DISK, "Op_1", None),
        ("Op_{disk}{peg}", DISK, "xOp_1b", None),
        ("{a}_{b}", {}, "x_y_z", {"a": "x", "b": "y_z"}),
        ("{a}{b}", {}, "xyz", {"a": "x", "b": "yz"}),
        ("at {x} m", {"x": float}, "at 0.25 m", {"x": "0.25"}),
        ("lamp {on}", {"on": bool}, "lamp true", {"on": "true"}),
        ("lamp {on}", {"on": bool}, "lamp maybe", None),
        ("{a}{on}", {"on": bool}, "xytrue", {"a": "xy", "on": "true"}),
        ("{{{a}}}", {}, "{x}", {"a": "x"}),
        ("a.c", {}, "abc", None),
        ("Op_{disk}", {"disk": int}, "Op_\u0661", None),
    ],
)
def test_a_name_is_read_by_the_rule(
    pattern: str, types: dict[str, type], name: str, found: dict[str, str] | None
) -> None:
    assert read_pattern(pattern, types).match(name) == found


@given(st.integers(0, 10**6), st.text(min_size=1).filter(lambda t: not t[0].isdecimal()))
def test_what_is_filled_in_is_read_out(disk: int, peg: str) -> None:
    pattern = read_pattern("Op_{disk}{peg}", DISK)
    assert pattern.match(pattern.fill({"disk": disk, "peg": peg})) == {
        "disk": str(disk),
        "peg": peg,
    }


@pytest.mark.parametrize("text", ["Op_{", "Op_}", "{a}{a}", "{a:d}", "{a!r}", "{0}", "{}", "{a.b}"])
def test_a_pattern_that_means_nothing_is_refused(text: str) -> None:
    with pytest.raises(PluginError, match="pattern"):
        read_pattern(text, {})


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (7, "of type int, not a text"),
        ("x" * 501, "has 501 characters"),
        ("".join(f"{{a{n}}}" for n in range(17)), "more than 16 parameters"),
    ],
)
def test_a_pattern_that_is_none_or_too_long_is_refused(text: str, words: str) -> None:
    with pytest.raises(PluginError, match=words):
        read_pattern(text, {})


KINDS = {int: "[0-9]+", float: r"[0-9]+(?:\.[0-9]+)?", bool: "true|false", str: ".+?"}
PIECES = st.lists(
    st.tuples(st.text("a1.", max_size=2), st.sampled_from(list(KINDS))), min_size=1, max_size=4
)
NAMES = st.lists(st.sampled_from(["a", "1", "23", ".", "true", "\n"]), max_size=9).map("".join)


@settings(max_examples=share_of(400))
@given(PIECES, st.text("a1.", max_size=2), NAMES)
def test_a_name_is_read_as_a_regular_expression_would(
    pieces: list[tuple[str, type]], last: str, name: str
) -> None:
    text = "".join(f"{fixed}{{p{at}}}" for at, (fixed, _) in enumerate(pieces)) + last
    regex = "".join(
        f"{re.escape(fixed)}(?P<p{at}>{KINDS[kind]})" for at, (fixed, kind) in enumerate(pieces)
    )
    pattern = read_pattern(text, {f"p{at}": kind for at, (_, kind) in enumerate(pieces)})
    found = re.compile(regex + re.escape(last), re.DOTALL).fullmatch(name)
    assert pattern.match(name) == (found.groupdict() if found else None)


@pytest.mark.parametrize("kind", list(KINDS))
@pytest.mark.parametrize("between", ["", "1"])
def test_no_pattern_makes_a_name_take_for_ever(kind: type, between: str) -> None:
    names = [f"p{at}" for at in range(16)]
    text = "".join(f"{{{name}}}{between}" for name in names) + "!"
    assert read_pattern(text, dict.fromkeys(names, kind)).match("1" * 2000) is None
