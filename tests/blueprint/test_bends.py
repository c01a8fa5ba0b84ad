"""Bends and moved labels: kept in ``_layout``, outside the meaning, and followed by every edit."""

from __future__ import annotations

import json
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.edge_layout import MOST_BENDS, EdgeLayout
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.forms import form_named

GO, BACK, LOOP = Address("S", "A", "go"), Address("S", "B", "back"), Address("S", "A", "a/b")
BENT = EdgeLayout(((10.0, 20.0), (30.5, -40.0)), (0.25, 4.0, -12.0))


def read(values: dict[str, Any], form: str = "json") -> Blueprint:
    written = form_named(form)
    return read_blueprint(written.parse(written.write(values), f"f.{form}"))


def plain(form: str = "json") -> Blueprint:
    states = {"A": {"go": "B", "a/b": "A"}, "B": {"back": "A"}, "C": {}}
    return read({"S": states, "T": {"A": {"go": "A"}}}, form)


def bent(form: str = "json", at: Address = GO) -> Blueprint:
    after = edit.set_bends(plain(form), at, BENT.bends)
    return edit.place_label(after, at, BENT.label)


def lines(blueprint: Blueprint, branch: str = "S") -> dict[tuple[str, str], EdgeLayout]:
    return dict(blueprint[branch].notes.edges)


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
@pytest.mark.parametrize("at", [GO, LOOP])
def test_a_bent_line_is_read_back_in_every_form(form: str, at: Address) -> None:
    before, after = plain(form), bent(form, at)
    text = after.document.text
    again = read_blueprint(form_named(form).parse(text, f"f.{form}"))
    assert lines(again) == lines(after) == {(at.state, at.operation): BENT}
    assert not again["S"].notes.faults
    for other in ("json", "smsl", "yaml"):
        written = form_named(other).write(again.document.values)
        assert lines(read_blueprint(form_named(other).parse(written, "f"))) == lines(after)
    assert edit.straighten(after, "S").document.text == before.document.text
    cleared = edit.set_bends(edit.place_label(after, at, None), at, ())
    assert cleared.document.text == before.document.text


def test_it_stands_in_layout_and_in_no_digest() -> None:
    after = bent()
    assert after.document.values["S"]["_layout"] == {
        "_operations": {"A/go": {"bends": [[10, 20], [30.5, -40]], "label": [0.25, 4, -12]}}
    }
    assert digests(after) == digests(plain())
    assert after == plain()
    assert after["S"].notes.layout == {}


def test_only_its_own_lines_of_the_text_change() -> None:
    before = edit.set_layout(bent(), "S", {"A": (0.0, 0.0)})
    after = edit.set_bends(before, BACK, [(1.0, 1.0)])
    gone = set(before.document.text.splitlines()) - set(after.document.text.splitlines())
    assert len(gone) <= 1, "the comma behind the entry before"


def test_a_place_is_rounded_and_what_else_an_entry_says_stays() -> None:
    values = plain().document.values
    odd = {"A/go": {"bends": [[1, 1]], "why": "so"}, "A~1/x": 5}
    before = read({**values, "S": {**values["S"], "_layout": {"_operations": odd}}})
    after = edit.set_bends(before, GO, [(1.26, -0.04)])
    table = after.document.values["S"]["_layout"]["_operations"]
    assert table == {"A/go": {"bends": [[1.3, 0]], "why": "so"}, "A~1/x": 5}
    without = edit.set_bends(after, GO, ())
    assert without.document.values["S"]["_layout"]["_operations"]["A/go"] == {"why": "so"}


def test_several_operations_are_straightened_together() -> None:
    before = edit.set_bends(bent(), BACK, [(5.0, 5.0)])
    assert lines(edit.set_bends(before, [GO, BACK, LOOP], ())) == {
        ("A", "go"): EdgeLayout((), BENT.label)
    }


@pytest.mark.parametrize(
    ("change", "left"),
    [
        (lambda b: edit.rename(b, Address("S", "A"), "D"), ("D", "go")),
        (lambda b: edit.rename(b, Address("S", "B"), "D"), ("A", "go")),
        (lambda b: edit.rename(b, GO, "x/y"), ("A", "x/y")),
        (lambda b: edit.rename(b, GO, "x", rename_everywhere=True), ("A", "x")),
        (lambda b: edit.rename(b, Address("S"), "U"), None),
        (lambda b: edit.retarget(b, GO, "B"), ("A", "go")),
        (lambda b: edit.retarget(b, BACK, "C"), ("A", "go")),
        (lambda b: edit.reorder(b, GO, 1), ("A", "go")),
        (lambda b: edit.delete(b, [BACK]), ("A", "go")),
        (lambda b: edit.set_layout(b, "S", {"A": (1.0, 2.0)}), ("A", "go")),
    ],
)
def test_an_edit_of_its_operation_carries_the_line(change: Any, left: Any) -> None:
    after = change(bent())
    if left is None:
        assert lines(after, "U") == {("A", "go"): BENT}
    else:
        assert lines(after) == {left: BENT}


@pytest.mark.parametrize(
    "change",
    [
        lambda b: edit.delete(b, [GO]),
        lambda b: edit.delete(b, [Address("S", "A")]),
        lambda b: edit.delete(b, [Address("S", "B")]),
        lambda b: edit.retarget(b, GO, "C"),
        lambda b: edit.retarget(b, [GO, BACK], "C"),
        lambda b: edit.move_source(b, GO, "C"),
    ],
)
def test_a_line_that_has_no_way_any_more_is_forgotten(change: Any) -> None:
    after = change(bent())
    assert lines(after) == {}
    assert "_operations" not in after.document.values["S"].get("_layout", {})


def test_a_new_operation_does_not_get_the_line_of_a_former_one() -> None:
    values = plain().document.values
    old = {"A/new": {"bends": [[9, 9]]}, "D/go": {"bends": [[8, 8]]}}
    before = read({**values, "S": {**values["S"], "_layout": {"_operations": old}}})
    assert ("A", "new") not in lines(edit.add_operation(before, "S", "A", "new", "B"))
    assert ("A", "new") not in lines(edit.rename(before, GO, "new"))
    assert ("D", "go") not in lines(edit.rename(before, Address("S", "A"), "D"))


def test_facts_that_change_their_order_carry_the_lines() -> None:
    values = {"S": {"State_01": {"go": "State_10"}, "State_10": {"back": "State_01"}}}
    before = edit.set_bends(read(values), Address("S", "State_01", "go"), [(1.0, 1.0)])
    before = edit.set_bends(before, Address("S", "State_10", "back"), [(2.0, 2.0)])
    after = edit.move_fact(before, "S", 0, 1)
    assert lines(after) == {
        ("State_10", "go"): EdgeLayout(((1.0, 1.0),)),
        ("State_01", "back"): EdgeLayout(((2.0, 2.0),)),
    }


def test_bends_go_along_if_both_states_move_alike() -> None:
    former = {"A": (0.0, 0.0), "B": (100.0, 0.0), "C": (0.0, 100.0)}
    by = {name: (x + 8.0, y - 16.0) for name, (x, y) in former.items()}
    after = edit.set_layout(bent(), "S", {"A": by["A"], "B": by["B"]}, former)
    assert lines(after)["A", "go"] == BENT.moved(8.0, -16.0)
    for places in ({"A": by["A"]}, {"A": by["A"], "C": by["C"]}, {**by, "B": (0.0, 0.0)}):
        assert lines(edit.set_layout(bent(), "S", places, former))["A", "go"] == BENT


def test_a_copy_has_its_own_line_beside_it() -> None:
    placed = edit.set_layout(bent(), "S", {"A": (0.0, 0.0), "B": (100.0, 0.0)})
    after, made = edit.duplicate(placed, [Address("S", "A"), Address("S", "B")], (32.0, 64.0))
    assert lines(after) == {
        ("A", "go"): BENT,
        (made[0].state, "go"): BENT.moved(32.0, 64.0),
    }
    text = edit.excerpt(placed, [Address("S", "A"), Address("S", "B")])
    pasted, _ = edit.paste(read({"Z": {}}), "Z", text, (50.0, 100.0))
    assert list(lines(pasted, "Z").values()) == [BENT.moved(0.0, 100.0)]
    alone, made = edit.duplicate(placed, [GO])
    assert lines(alone) == {("A", "go"): BENT}, "a copy between the same states lies beside it"
    half, made = edit.duplicate(placed, [Address("S", "A")])
    assert lines(half) == {("A", "go"): BENT}


def test_the_loop_of_a_copied_state_goes_where_the_copy_is_put() -> None:
    placed = edit.set_layout(bent(at=LOOP), "S", {"A": (0.0, 0.0)})
    after = edit.duplicate_state(placed, Address("S", "A"), "D", (100.0, 200.0))
    assert lines(after)["D", "a/b"] == BENT.moved(100.0, 200.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda b: edit.set_bends(b, GO, [(0.0, 0.0)] * (MOST_BENDS + 1)), "at most 40 bends"),
        (lambda b: edit.set_bends(b, GO, [(1e8, 0.0)]), "not on the canvas"),
        (lambda b: edit.set_bends(b, GO, [(float("nan"), 0.0)]), "not on the canvas"),
        (lambda b: edit.set_bends(b, Address("S", "A"), [(1.0, 1.0)]), "is no operation"),
        (lambda b: edit.set_bends(b, Address("S", "A", "gone"), [(1.0, 1.0)]), "gone"),
        (lambda b: edit.place_label(b, GO, (1.5, 0.0, 0.0)), "too far from the line"),
        (lambda b: edit.place_label(b, GO, (0.5, 0.0, 2001.0)), "too far from the line"),
        (lambda b: edit.place_label(b, GO, (float("nan"), 0.0, 0.0)), "too far from the line"),
        (lambda b: edit.straighten(b, "X"), "X"),
    ],
)
def test_what_is_no_line_is_refused(change: Any, words: str) -> None:
    with pytest.raises(EditRefused, match=words):
        change(bent())


@pytest.mark.parametrize("layout", [5, {"_operations": []}])
def test_a_layout_that_is_no_map_takes_no_line(layout: Any) -> None:
    values = plain().document.values
    before = read({**values, "S": {**values["S"], "_layout": layout}})
    with pytest.raises(EditRefused, match="no map"):
        edit.set_bends(before, GO, [(1.0, 1.0)])
    assert edit.set_bends(before, GO, ()) is before
    assert edit.straighten(before, "S")["S"].notes.edges == {}
    assert json.dumps(edit.rename(before, GO, "x").document.values["S"]["_layout"])


def test_known_notes_are_handed_on_with_new_bends() -> None:
    before = edit.set_layout(bent(), "S", {"A": (1.0, 2.0), "B": (3.0, 4.0)})
    assert before["S"].notes.layout
    after = edit.set_bends(before, GO, [(7.0, 7.0)])
    again = read_blueprint(after.document)
    assert after["S"].notes == again["S"].notes
    assert edit.straighten(after, "S")["S"].notes.edges == {}
