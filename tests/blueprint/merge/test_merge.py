"""The three-way merge, case by case."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest

from smsl_studio.blueprint.merge import ABSENT, Merge, merge
from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import read_bytes
from tests.blueprint.values import in_form, read

BASE: dict[str, Any] = {
    "_hazards": [{"name": "fire", "facts": {"A/0": "1"}}],
    "A": {
        "HEADER": {"INITIAL": "S0", "ACTIVATING": "S1", "NUM_STATES": 3},
        "S0": {"go": "S1", "wait": "S0"},
        "S1": {"back": "S0", "on": "S2"},
        "S2": {"back": "S1"},
        "_states": {"S2": {"title": "third"}},
        "_operations": {"S0/go": {"timeout": 8.0}},
    },
    "B": {"HEADER": {"INITIAL": "X0", "ACTIVATING": "X1"}, "X0": {"up": "X1"}, "X1": {}},
}


def changed(*changes: tuple[str, Any]) -> dict[str, Any]:
    """The base with values at paths such as ``A/S0/go``; None removes what is there."""
    values = deepcopy(BASE)
    for path, value in changes:
        *way, last = path.split("|")
        node = values
        for key in way:
            node = node.setdefault(key, {})
        if value is None:
            del node[last]
        else:
            node[last] = value
    return values


def merged(ours: dict[str, Any], theirs: dict[str, Any]) -> Merge:
    return merge(read(BASE), read(ours), read(theirs))


def told(done: Merge) -> list[tuple[str, Any, Any, Any]]:
    return [(one.address, one.base, one.ours, one.theirs) for one in done.conflicts]


def test_changes_of_both_sides_are_taken() -> None:
    done = merged(
        changed(("A|S0|go", "S2"), ("A|_states|S2|title", "last")),
        changed(("A|S2|again", "S2"), ("B|X1|down", "X0"), ("A|HEADER|INITIAL", "S1")),
    )
    assert done.conflicts == ()
    assert done.blueprint["A"].table["S0"]["go"] == "S2"
    assert done.blueprint["A"].table["S2"] == {"back": "S1", "again": "S2"}
    assert done.blueprint["A"].initial == "S1"
    assert done.blueprint["B"].table["X1"] == {"down": "X0"}
    note = done.blueprint["A"].state_note("S2")
    assert note is not None
    assert note.title == "last"


@pytest.mark.parametrize(
    ("ours", "theirs", "conflict"),
    [
        (("A|S0|go", "S0"), ("A|S0|go", "S2"), ("A/S0/go", "S1", "S0", "S2")),
        (("A|S0|go", None), ("A|S0|go", "S2"), ("A/S0/go", "S1", ABSENT, "S2")),
        (("A|S0|new", "S1"), ("A|S0|new", "S2"), ("A/S0/new", ABSENT, "S1", "S2")),
        (("A|HEADER|INITIAL", "S1"), ("A|HEADER|INITIAL", "S2"), ("A", "S0", "S1", "S2")),
        (
            ("A|_operations|S0/go|timeout", 12.0),
            ("A|_operations|S0/go|timeout", 5.0),
            ("A/S0/go", 8.0, 12.0, 5.0),
        ),
        (
            ("A|_states|S2|title", "one"),
            ("A|_states|S2|title", "two"),
            ("A/S2", "third", "one", "two"),
        ),
        (
            ("_hazards", [{"name": "fire", "facts": {"A/0": "2"}}]),
            ("_hazards", [{"name": "fire", "facts": {"A/0": "3"}}]),
            (
                "_hazards/fire",
                *({"name": "fire", "facts": {"A/0": value}} for value in "123"),
            ),
        ),
        (("B", None), ("B|X1|down", "X0"), None),
    ],
)
def test_what_both_changed_is_one_conflict_that_keeps_ours(
    ours: tuple[str, Any], theirs: tuple[str, Any], conflict: tuple[str, Any, Any, Any] | None
) -> None:
    done = merged(changed(ours), changed(theirs))
    if conflict is None:
        (_, base, mine, other) = ("B", BASE["B"], ABSENT, changed(theirs)["B"])
        conflict = ("B", base, mine, other)
    assert told(done) == [conflict]
    assert done.blueprint == read(changed(ours))


FIRE = {"name": "fire", "facts": {"A/0": "1"}}
NEVER = {"name": "p", "never": "A/0 = 1"}


@pytest.mark.parametrize(
    ("key", "base", "ours", "theirs"),
    [
        ("_hazards", None, FIRE, {"name": "fire", "facts": {"B/0": "1"}}),
        (
            "_hazards",
            FIRE,
            {"name": "fire", "facts": {"A/0": "1", "B/0": "1"}},
            {"name": "fire", "facts": {"A/0": "1", "A/1": "1"}},
        ),
        ("_properties", None, NEVER, {"name": "p", "reachable": "B/0 = 1"}),
        ("_properties", NEVER, {**NEVER, "never": "A/0 = 2"}, {"name": "p", "reachable": "B = 1"}),
        (
            "_properties",
            {"name": "p", "way_back": {"from": "A/0 = 0", "to": "A/0 = 1"}},
            {"name": "p", "way_back": {"from": "A/0 = 2", "to": "A/0 = 1"}},
            {"name": "p", "way_back": {"from": "A/0 = 0", "to": "A/0 = 2"}},
        ),
    ],
)
def test_two_sentences_are_not_mixed_into_a_third(
    key: str, base: Any, ours: Any, theirs: Any
) -> None:
    """Of two hazards with one name, a weaker one came that had the facts of both."""
    versions = [
        read({**changed(), key: [entry]} if entry else {**changed(), key: []})
        for entry in (base, ours, theirs)
    ]
    done = merge(*versions)
    name = ours["name"]
    assert told(done) == [(f"{key}/{name}", ABSENT if base is None else base, ours, theirs)]
    assert done.blueprint.document.values[key] == [ours]


def test_the_reason_of_a_property_is_merged_beside_its_sentence() -> None:
    base, mine = {**NEVER, "why": "old"}, {**NEVER, "why": "new"}
    other = {**NEVER, "why": "old", "never": "A/0 = 2"}
    versions = [read({**changed(), "_properties": [one]}) for one in (base, mine, other)]
    done = merge(*versions)
    assert done.conflicts == ()
    assert done.blueprint.document.values["_properties"] == [{**other, "why": "new"}]


def test_another_order_of_states_counts_where_it_names_the_ends() -> None:
    """Without INITIAL and ACTIVATING the first and the last state are these."""
    plain = {"A": {"S0": {"a": "S1"}, "S1": {"b": "S0"}}, "B": {"X0": {"up": "X1"}, "X1": {}}}
    turned = {**plain, "A": {"S1": {"b": "S0"}, "S0": {"a": "S1"}}}
    elsewhere = {**plain, "B": {"X0": {"up": "X1"}, "X1": {"down": "X0"}}}
    gone = {"B": plain["B"]}
    for ours, theirs in ((plain, turned), (elsewhere, turned), (turned, elsewhere)):
        done = merge(read(plain), read(ours), read(theirs))
        assert done.conflicts == ()
        assert (done.blueprint["A"].initial, done.blueprint["A"].activating) == ("S1", "S0")
    for ours, theirs in ((turned, gone), (gone, turned)):
        (conflict,) = merge(read(plain), read(ours), read(theirs)).conflicts
        assert conflict.address == "A"


def test_hazards_of_both_sides_are_kept() -> None:
    fire = BASE["_hazards"][0]
    mine, other = ({"name": name, "facts": {"A/0": "2"}} for name in ("mine", "theirs"))
    done = merged(changed(("_hazards", [fire, mine])), changed(("_hazards", [fire, other])))
    assert done.conflicts == ()
    assert {one.name for one in done.blueprint.hazards} == {"fire", "mine", "theirs"}


def without_s2() -> dict[str, Any]:
    return changed(("A|S2", None), ("A|S1|on", None), ("A|_states|S2", None))


def test_a_state_that_one_side_deleted_and_the_other_changed_is_one_conflict() -> None:
    theirs = changed(("A|S2|back", "S0"))
    done = merged(without_s2(), theirs)
    assert told(done) == [("A/S2", BASE["A"]["S2"], ABSENT, {"back": "S0"})]
    assert "S2" not in done.blueprint["A"].table
    other = merged(theirs, without_s2())
    assert told(other) == [("A/S2", BASE["A"]["S2"], {"back": "S0"}, ABSENT)]
    assert other.blueprint["A"].table["S1"]["on"] == "S2", "the way to it stays with it"
    assert other.blueprint["A"].state_note("S2") is not None


def test_an_operation_to_a_state_that_the_other_side_deleted_is_a_conflict() -> None:
    done = merged(without_s2(), changed(("A|S0|jump", "S2")))
    assert [one.address for one in done.conflicts] == ["A/S2", "A/S0/jump"]
    assert "jump" not in done.blueprint["A"].table["S0"]


def test_a_state_that_the_other_side_left_alone_is_deleted() -> None:
    done = merged(without_s2(), changed(("A|S0|wait", "S1")))
    assert done.conflicts == ()
    assert list(done.blueprint["A"].table) == ["S0", "S1"]
    assert done.blueprint["A"].header.num_states == 3


def test_the_number_of_states_is_counted_again() -> None:
    one = changed(("A|S3", {"x": "S0"}), ("A|HEADER|NUM_STATES", 4))
    other = changed(("A|S4", {"x": "S0"}), ("A|HEADER|NUM_STATES", 4))
    done = merged(one, other)
    assert done.conflicts == ()
    assert done.blueprint["A"].header.num_states == 5


def test_a_renamed_state_takes_the_changes_of_the_other_side() -> None:
    ours = changed(("A|S1", None), ("A|S0|go", "Done"), ("A|S2|back", "Done"),
                   ("A|Done", {"back": "S0", "on": "S2"}),
                   ("A|HEADER|ACTIVATING", "Done"))  # fmt: skip
    theirs = changed(("A|S1|more", "S0"), ("A|S0|also", "S1"))
    for done in (merged(ours, theirs), merged(theirs, ours)):
        assert done.conflicts == ()
        assert done.blueprint["A"].table["Done"] == {"back": "S0", "on": "S2", "more": "S0"}
        assert done.blueprint["A"].table["S0"]["also"] == "Done"
        assert done.blueprint["A"].activating == "Done"


def test_a_default_that_both_sides_shift_is_a_conflict_about_the_end() -> None:
    base = {"A": {"S0": {"go": "S1"}, "S1": {}}}
    one, other = deepcopy(base), deepcopy(base)
    one["A"]["Mine"], other["A"]["Other"] = {}, {}
    done = merge(read(base), read(one), read(other))
    assert told(done) == [("A", "S1", "Mine", "Other")]
    assert done.conflicts[0].path == ("A", "HEADER", "ACTIVATING")
    assert done.blueprint["A"].activating == "Mine"
    assert set(done.blueprint["A"].table) == {"S0", "S1", "Mine", "Other"}


def test_places_that_both_sides_moved_are_no_conflict() -> None:
    one, other = changed(("A|_layout|S0", [0, 0])), changed(("A|_layout|S0", [9, 9]))
    done = merged(one, other)
    assert (done.conflicts, done.layout_kept) == ((), ("A/S0",))
    assert done.blueprint["A"].notes.layout["S0"] == (0, 0)


def test_notes_that_both_sides_pinned_are_both_kept() -> None:
    one, other = (
        changed(("A|_notes|1", {"at": [0, 0], "text": text})) for text in ("mine", "theirs")
    )
    done = merged(one, other)
    assert done.conflicts == ()
    notes = done.blueprint["A"].drawn.notes
    assert {key: note.text for key, note in notes.items()} == {"1": "mine", "2": "theirs"}


def test_two_sub_sbs_on_one_digit_are_a_conflict() -> None:
    base = {"A": {"s0": {"go": "s1"}, "s1": {}}, "B": BASE["B"], "C": BASE["B"]}
    one, other = deepcopy(base), deepcopy(base)
    one["A"]["HEADER"], other["A"]["HEADER"] = {"SUB_SBS": {"B": 0}}, {"SUB_SBS": {"C": 0}}
    done = merge(read(base), read(one), read(other))
    assert sorted(told(done), key=str) == [("A", ABSENT, 0, ABSENT), ("A", ABSENT, ABSENT, 0)]
    assert dict(done.blueprint["A"].header.sub_sbs) == {"B": 0}


def test_what_a_former_merge_left_open_stays_open() -> None:
    first = merged(changed(("A|S0|go", "S0")), changed(("A|S0|go", "S2")))
    again = merge(read(BASE), first.blueprint, read(changed(("B|X1|down", "X0"))))
    assert again.conflicts == ()
    assert len(again.blueprint.document.values["_conflicts"]) == 1


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_every_form_holds_the_conflicts_and_ours_keeps_its_form(form: str) -> None:
    one, other = read(changed(("A|S2", None), ("A|S1|on", "S0"))), changed(("A|S2|back", "S2"))
    done = merge(read(BASE), in_form(one, form), read(other))
    text = done.blueprint.document.text.encode()
    again = read_bytes(text, f"f.{form}")
    assert done.blueprint.document.form == form
    assert again.document.values["_conflicts"][0]["path"] == ["A", "S2"]
    assert again.document.values["_conflicts"] == done.blueprint.document.values["_conflicts"]


def test_a_key_that_is_written_twice_is_refused() -> None:
    doubled = read_bytes(b'{"A": {"S": {}, "S": {}}}', "f.json")
    with pytest.raises(ReadError, match="A/S is written 2 times"):
        merge(read(BASE), read(BASE), doubled)


def test_states_renamed_in_an_sb_that_the_other_side_deleted_are_one_conflict() -> None:
    base: dict[str, Any] = {"B": {"State_0": {}}}
    mine: dict[str, Any] = {"B": {"State_Q": {}}}
    for ours, theirs in ((mine, {}), ({}, mine)):
        done = merge(read(base), read(ours), read(theirs))
        assert [one.address for one in done.conflicts] == ["B"]
        assert done.blueprint == read(ours)


def test_a_deleted_sb_and_a_new_one_with_states_of_the_same_names_are_two() -> None:
    """What theirs changed in the deleted one is a conflict, and nothing of it goes into the new."""
    new = {"X0": {"heat": "X1"}, "X1": {}}
    done = merged(changed(("B", None), ("C", new)), changed(("B|X1|down", "X0")))
    assert [one.address for one in done.conflicts] == ["B"]
    assert done.blueprint["C"].table == new
    assert "B" not in done.blueprint.branches


def test_a_renamed_sb_takes_the_changes_of_the_other_side() -> None:
    renamed = changed(("B", None), ("C", deepcopy(BASE["B"])))
    done = merged(renamed, changed(("B|X1|down", "X0")))
    assert done.conflicts == ()
    assert done.blueprint["C"].table == {"X0": {"up": "X1"}, "X1": {"down": "X0"}}
