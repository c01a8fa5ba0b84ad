"""Name patterns are read in one documented way."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.errors import PluginError
from smsl_studio.library.pattern import read_pattern

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
