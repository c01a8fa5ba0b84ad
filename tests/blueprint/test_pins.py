"""Pins: kept in ``_layout``, outside the meaning, and followed by every edit and every merge."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.merge import merge
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.front.inputs import inspect
from smsl_studio.smsl.forms import form_named

STATES = {"A": {"go": "B"}, "B": {"back": "A"}, "C": {}}
LAYOUT = {"A": [12.345, 0], "B": [240, 96], "_pinned": {"A": True, "B": True}}


def read(values: dict[str, Any], form: str = "json") -> Blueprint:
    written = form_named(form)
    return read_blueprint(written.parse(written.write(values), f"f.{form}"))


def pinned(form: str = "json") -> Blueprint:
    return read({"S": {**STATES, "_layout": LAYOUT}}, form)


def pins(blueprint: Blueprint, branch: str = "S") -> set[str]:
    return set(blueprint[branch].notes.pinned)


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_a_pin_is_read_back_in_every_form(form: str) -> None:
    before = read({"S": {**STATES, "_layout": {"A": [12.345, 0]}}}, form)
    after = edit.pin(before, "S", {"A": (99.0, 99.0), "C": (7.04, -3.0)})
    assert pins(after) == {"A", "C"}
    assert after["S"].notes.layout == {"A": (12.345, 0.0), "C": (7.0, -3.0)}, "a place stays"
    for other in ("json", "smsl", "yaml"):
        text = form_named(other).write(after.document.values)
        again = read_blueprint(form_named(other).parse(text, "f"))
        assert pins(again) == {"A", "C"}
        assert not again["S"].notes.faults
    assert digests(after).meaning == digests(before).meaning
    without = edit.unpin(after, "S", ["C"])
    assert pins(without) == {"A"}
    assert "C" in without["S"].notes.layout, "its place is not forgotten"
    left = edit.unpin(without, "S").document.values["S"]["_layout"]
    assert left == {"A": [12.345, 0], "C": [7, -3]}


def test_the_text_before_comes_back_if_the_last_pin_goes() -> None:
    before = read({"S": {**STATES, "_layout": {"A": [1, 2]}}})
    after = edit.pin(before, "S", {"A": (1.0, 2.0)})
    assert edit.unpin(after, "S", ["A"]).document.text == before.document.text
    assert edit.unpin(after, "S").document.text == before.document.text


ODD: list[Any] = [False, 1, 1.0, "true", None, [0, 0], {}, [True]]


@pytest.mark.parametrize(
    ("pin_map", "path"),
    [
        ([], ("_layout", "_pinned")),
        ("A", ("_layout", "_pinned")),
        (None, ("_layout", "_pinned")),
        *(({"A": odd}, ("_layout", "_pinned", "A")) for odd in ODD),
        ({"C": True}, ("_layout", "_pinned", "C")),
        ({"": True}, ("_layout", "_pinned", "")),
        ({"x" * 9_999: True}, ("_layout", "_pinned", "x" * 9_999)),
    ],
)
def test_what_does_not_fit_is_left_out_and_reported_with_its_place(
    pin_map: Any, path: tuple[str, ...]
) -> None:
    more = {"B": True} if isinstance(pin_map, dict) else None
    written = {**pin_map, **more} if more else pin_map
    values = {"S": {**STATES, "_layout": {**LAYOUT, "_pinned": written}}}
    blueprint = read(values)
    notes = blueprint["S"].notes
    assert [where for where, _ in notes.faults] == [path]
    assert notes.pinned == ({"B"} if more else set()), "the others count"
    (found,) = [one for one in inspect(blueprint) if one.rule == "R29"]
    assert found.place is not None
    assert found.place.line > 1
    assert found.advice


def test_an_edit_of_pins_that_cannot_be_made_is_refused() -> None:
    with pytest.raises(EditRefused, match="there is no state 'D'"):
        edit.pin(pinned(), "S", {"D": (0.0, 0.0)})
    odd = read({"S": {**STATES, "_layout": {"_pinned": [1]}}})
    with pytest.raises(EditRefused, match="_pinned of S is no map") as refused:
        edit.pin(odd, "S", {"A": (0.0, 0.0)})
    assert refused.value.place is not None
    assert "_pinned" in refused.value.advice
    with pytest.raises(EditRefused, match="not on the canvas"):
        edit.pin(read({"S": STATES}), "S", {"A": (1e9, 0.0)})
    assert edit.pin(pinned(), "S", {}) == pinned()


def test_a_pin_follows_its_state() -> None:
    before = pinned()
    renamed = edit.rename(before, Address("S", "A"), "Z")
    assert pins(renamed) == {"Z", "B"}
    assert renamed["S"].notes.layout["Z"] == (12.345, 0.0)
    again = read_blueprint(form_named("json").parse(renamed.document.text, "f"))
    assert pins(again) == pins(renamed), "what was handed on is what is read"
    gone = edit.delete(before, [Address("S", "A")])
    assert gone.document.values["S"]["_layout"] == {"B": [240, 96], "_pinned": {"B": True}}
    none = edit.delete(gone, [Address("S", "B")])
    assert "_pinned" not in none.document.values["S"]["_layout"]
    moved = edit.set_layout(before, "S", {"A": (5.0, 5.0)})
    assert pins(moved) == {"A", "B"}, "a hand may move a pinned state, and the pin goes along"


def test_a_pin_that_is_left_of_a_former_state_does_not_come_to_a_new_one() -> None:
    old = {**LAYOUT, "Z": [1, 1], "_pinned": {"Z": True}}
    before = read({"S": {**STATES, "_layout": old}})
    assert pins(edit.rename(before, Address("S", "C"), "Z")) == set()


def test_copies_are_pinned_too() -> None:
    before = pinned()
    chosen = [Address("S", "A"), Address("S", "C")]
    after, made = edit.paste(before, "S", edit.excerpt(before, chosen))
    copy, other = (one.state for one in made)
    assert pins(after) == {"A", "B", copy}
    assert other not in pins(after)
    cut, text = edit.cut(before, chosen)
    assert pins(cut) == {"B"}
    back, _ = edit.paste(cut, "S", text)
    assert pins(back) == {"A", "B"}
    doubled = edit.duplicate_state(before, Address("S", "A"), "A2", (400.0, 0.0))
    assert pins(doubled) == {"A", "B", "A2"}
    whole, (made_branch,) = edit.duplicate(before, [Address("S")])
    assert pins(whole, made_branch.branch) == {"A", "B"}


def test_a_comparison_tells_pins_as_layout() -> None:
    before = pinned()
    after = edit.pin(edit.unpin(before, "S", ["A"]), "S", {"C": (0.0, 200.0)})
    found = compare(before, after)
    assert found.layout_only
    assert not found.same
    assert found.pinned == (Address("S", "A"), Address("S", "C"))
    assert found.words == "Layout only: 1 state was moved, 2 states were pinned or unpinned."
    assert found.as_json()["pinned"] == 2
    assert compare(before, edit.unpin(before, "S", ["A"])).words == (
        "Layout only: 1 state was pinned or unpinned."
    )
    assert compare(before, edit.rename(before, Address("S", "A"), "Z")).pinned == ()
    assert compare(before, edit.delete(before, [Address("S", "A")])).pinned == ()
    changed = edit.delete(after, [Address("S", "B")])
    assert "; 2 pinned or unpinned" in compare(before, changed).words


def with_layout(**layout: Any) -> dict[str, Any]:
    return {"S": {**deepcopy(STATES), "_layout": layout}}


FREE = with_layout(A=[0, 0], B=[240, 0])
MINE = with_layout(A=[0, 0], B=[240, 0], _pinned={"A": True})
THEIRS = with_layout(A=[500, 500], B=[240, 0], _pinned={"B": True})


def test_pins_of_both_sides_are_merged_state_by_state() -> None:
    for one, other in ((MINE, THEIRS), (THEIRS, MINE)):
        done = merge(read(FREE), read(one), read(other))
        assert done.conflicts == ()
        assert pins(done.blueprint) == {"A", "B"}
    gone = merge(read(MINE), read(FREE), read(MINE))
    assert pins(gone.blueprint) == set(), "a pin that one side has taken away is gone"


def test_the_place_counts_at_which_one_side_has_pinned_a_state() -> None:
    moved = with_layout(A=[500, 500], B=[240, 0])
    done = merge(read(FREE), read(MINE), read(moved))
    assert done.blueprint["S"].notes.layout["A"] == (0.0, 0.0)
    assert done.layout_kept == ("S/A",), "theirs moved it, and that is told"
    done = merge(read(FREE), read(moved), read(MINE))
    assert done.blueprint["S"].notes.layout["A"] == (0.0, 0.0)
    assert pins(done.blueprint) == {"A"}
    both = merge(read(FREE), read(MINE), read({**THEIRS, "S": {**THEIRS["S"], "_layout": {
        **THEIRS["S"]["_layout"], "_pinned": {"A": True}}}}))  # fmt: skip
    assert both.blueprint["S"].notes.layout["A"] == (500.0, 500.0), "theirs alone moved it"


def test_a_state_that_one_side_deleted_takes_its_pin_along() -> None:
    deleted = edit.delete(read(FREE), [Address("S", "A")])
    for done in (merge(read(FREE), read(MINE), deleted), merge(read(FREE), deleted, read(MINE))):
        assert done.conflicts == ()
        assert "A" not in done.blueprint["S"].table
        assert "_pinned" not in str(done.blueprint.document.values)
        assert not done.blueprint["S"].notes.faults


def test_a_renamed_state_keeps_the_pin_of_the_other_side() -> None:
    renamed = edit.rename(read(FREE), Address("S", "A"), "Z")
    done = merge(read(FREE), renamed, read(MINE))
    assert pins(done.blueprint) == {"Z"}
