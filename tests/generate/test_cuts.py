"""States that become a sub-SB and go back: the behaviour stays, and a refusal shows a run."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from smsl_studio.errors import AddressError, EditRefused, PlanningError, UsageError
from smsl_studio.front.inputs import read
from smsl_studio.front.shapes import diff_behaviour, extract, flatten, identify, inline
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.inspection.inspect import inspect
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.generate.cut_cases import blueprint, cut_case, planted
from tests.generate.judged_cut import judged_cut
from tests.stories.person import SAMPLES


@pytest.mark.parametrize("number", range(share_of(100)))
def test_a_random_cut_behaves_as_before(number: int) -> None:
    case = cut_case(number)
    if case is None:
        return
    judged = judged_cut(case)
    assert judged.wrong == ""
    assert judged.end == "inlined" or not case.sound


def test_digitization_is_found_in_the_flat_registration() -> None:
    found = identify(flatten(read(SAMPLES / "registration-digitization.json")))
    best = found.cuts[0]
    assert best.cut.chosen.states == ("State100+State0",)
    assert best.fact_names == (
        "REGISTRATION.Landmarks digitized", "DIGITIZATION.All landmarks digitized",
    )  # fmt: skip
    assert {edge.name for edge in best.cut.exits} == {
        "DIGITIZATION.ConfirmAllDigitized",
        "DIGITIZATION.DigitizeAllLandmarks",
        "REGISTRATION.LandmarksDigitized",
    }
    assert (best.states_saved, best.facts_saved) == (0, 1)
    assert best.after.roots == ("REGISTRATION",)
    assert not [one for one in inspect(best.after) if one.severity.name == "ERROR"]


def test_a_flat_hanoi_has_no_part() -> None:
    assert identify(read(SAMPLES / "hanoi-corrected.json")) == ((), "")
    assert identify(flatten(read(SAMPLES / "hanoi-2.json"))) == ((), "")


def test_a_planted_procedure_is_found_and_saves_states() -> None:
    cases = [planted(Random(seed)) for seed in range(40)]
    saved = []
    for case in cases:
        if case.sound and len(case.states) > 2:
            found = {one.cut.chosen.states: one for one in identify(case.origin).cuts}
            saved.append(found[case.states].states_saved == len(case.states) - 1)
    assert saved
    assert all(saved)


VALUES: dict[str, Any] = {
    "_hazards": [{"name": "h", "facts": {"P/1": "1", "P/2": "0"}}],
    "_properties": [{"name": "n", "never": "P/0 = 1 and P/3 = 1"}],
    "P": {
        "HEADER": {"INITIAL": "State0000", "ACTIVATING": "State0111"},
        "_operations": {
            "next": {"title": "Go on", "requires": {"P/0": "1", "Q/0": "0"}},
            "State1001/end": {"cost": 3},
        },
        "_layout": {
            "State1000": [0, 0],
            "State1001": [90, 0],
            "State0000": [0, 90],
            "_pinned": {"State1001": True, "State0000": True},
        },
        "State0000": {"plan": "State1000"},
        "State1000": {"next": "State1001"},
        "State1001": {"end": "State1011", "wait": "State1001"},
        "State1011": {"use": "State0111"},
        "State0111": {},
    },
    "Q": {
        "HEADER": {"INITIAL": "State0", "ACTIVATING": "State1"},
        "_operations": {"go": {"requires": {"P/2": "1"}}},
        "State0": {"go": "State1"},
        "State1": {},
    },
}


def test_what_names_facts_follows() -> None:
    """Digits 2 and 3 go: 3 differs inside, 2 changes when they are left."""
    after = extract(blueprint(VALUES), "P", ["State1000", "State1001"], "SUB")
    base, sub = after["P"], after["SUB"]
    assert list(sub.table) == ["State00", "State01", "State11"]
    assert list(base.table) == ["State000", "State100", "State101", "State011"]
    assert (sub.initial, sub.activating) == ("State00", "State11")
    assert base.subs == {2: "SUB"}
    assert dict(base.table["State100"]) == {"end": "State101"}
    assert after.hazards[0].facts == {"P/1": "1", "SUB/0": "0"}
    assert after.document.values["_properties"][0]["never"] == "P/0 = 1 and SUB/1 = 1"
    assert after["Q"].operation_note("State0", "go").requires == {"SUB/0": "1"}
    assert sub.operation_note("State00", "next").requires == {"P/0": "1", "Q/0": "0"}
    assert sub.operation_note("State00", "next").title == "Go on"
    assert sub.operation_note("State01", "wait").requires == {"P/0": "1"}
    assert sub.operation_note("State01", "end").cost == 3
    end = base.operation_note("State100", "end")
    assert (end.requires, end.cost, end.subs) == ({"SUB/1": "1"}, 3, "drive")
    assert dict(sub.notes.layout) == {"State00": (0, 0), "State01": (90, 0)}
    assert sub.notes.pinned == {"State01"}
    assert base.notes.pinned == {"State000"}
    assert base.notes.layout["State000"] == (0, 90)
    back = inline(extract(blueprint(without_q()), "P", ["State1000", "State1001"], "SUB"), "SUB")
    assert back.hazards[0].facts == {"P/1": "1", "P/3": "0"}


PEOPLE: dict[str, Any] = {
    "_levels": {"P/next": "human", "P/State1001/end": "shared", "P/State1011/again": "human",
                "P/2": "shared", "P/use": "human"},
    "P": {
        "HEADER": VALUES["P"]["HEADER"],
        "_operations": {
            "State1001/end": {"binding": {"function": "x"}}, "wait": {"confirm": ["s"]},
        },
        "State0000": {"plan": "State1000"},
        "State1000": {"next": "State1001"},
        "State1001": {"end": "State1011", "wait": "State1001"},
        "State1011": {"use": "State0111", "again": "State1000"},
        "State0111": {},
    },
}  # fmt: skip


def test_who_carries_out_an_operation_stays_so_where_it_goes() -> None:
    after = extract(blueprint(PEOPLE), "P", ["State1000", "State1001"], "SUB")
    assert after.document.values["_levels"] == {
        "SUB/next": "human",
        "P/next": "human",
        "SUB/State01/end": "shared",
        "P/State100/end": "shared",
        "SUB/State11/again": "human",
        "P/State101/again": "human",
        "SUB/0": "shared",
        "P/use": "human",
    }
    assert after["SUB"].operation_note("State01", "wait").confirm == ("s",)


def test_a_function_runs_once_in_the_sub_sb_and_not_once_more_in_its_base() -> None:
    after = extract(blueprint(PEOPLE), "P", ["State1000", "State1001"], "SUB")
    assert after["SUB"].operation_note("State01", "end").binding is not None
    assert after["P"].operation_note("State100", "end").binding is None


def test_other_people_in_two_chosen_states_are_not_made_one() -> None:
    values = {
        **PEOPLE,
        "P": {**PEOPLE["P"], "State1000": {"next": "State1001", "end": "State1011"}},
    }
    with pytest.raises(CutRefused, match="end has other annotations or levels in State1000"):
        extract(blueprint(values), "P", ["State1000", "State1001"], "SUB")


def test_nothing_is_put_back_that_would_leave_people_out() -> None:
    """``P/State100/end`` moves SUB; in one SB it would be one operation of its own."""
    cut = extract(blueprint(PEOPLE), "P", ["State1000", "State1001"], "SUB")
    with pytest.raises(EditRefused, match="people carry out or confirm SUB/State00/next"):
        inline(cut, "SUB")
    asked = {**without_q(), "P": {**without_q()["P"], "_operations": {"next": {"confirm": ["s"]}}}}
    with pytest.raises(EditRefused, match="people carry out or confirm"):
        inline(extract(blueprint(asked), "P", ["State1000", "State1001"], "SUB"), "SUB")


def test_notes_of_single_operations_go_back_too() -> None:
    values = {"A": {"HEADER": {"SUB_SBS": {"S": 0}}, "State0": {"up": "State1", "rest": "State0"},
                    "_operations": {"State0/rest": {"title": "Rest", "confirm": ["s"]}},
                    "State1": {}},
              "S": {"State0": {"go": "State1"}, "State1": {}}}  # fmt: skip
    one = inline(blueprint(values), "S")["A"]
    note = one.operation_note("State0+State0", "A.rest")
    assert (note.title, note.confirm) == ("Rest", ("s",))


def without_q() -> dict[str, Any]:
    return {"_hazards": VALUES["_hazards"], "P": {**VALUES["P"], "_operations": {}}}


@pytest.mark.parametrize(
    ("states", "words", "run"),
    [
        (["State1000", "State0111"], "ACTIVATING", ()),
        (["State1000", "State1011"], "entered at State1000 and at State1011",
         ("plan", "next", "end")),
        (["State1000", "State1001"], "those of State1000 again", ("plan", "next", "drop")),
    ],
)  # fmt: skip
def test_a_refusal_says_why(states: list[str], words: str, run: tuple[str, ...]) -> None:
    values: dict[str, Any] = {
        "P": {key: value for key, value in VALUES["P"].items() if key != "_operations"}
    }
    if run[-1:] == ("drop",):
        values["P"]["State1001"] = {"end": "State1011", "drop": "State0000"}
    with pytest.raises(CutRefused, match=words) as refused:
        extract(blueprint(values), "P", states, "SUB")
    assert refused.value.run == run


def test_a_property_that_names_a_chosen_state_refuses() -> None:
    values: dict[str, Any] = {**VALUES, "_properties": [{"name": "n", "never": "P in State1001"}]}
    with pytest.raises(CutRefused, match="the property 'n' names State1001"):
        extract(blueprint(values), "P", ["State1000", "State1001"], "SUB")


def test_wrong_names_are_told() -> None:
    origin = blueprint(VALUES)
    with pytest.raises(AddressError, match="no state 'State9'"):
        extract(origin, "P", ["State9"], "SUB")
    with pytest.raises(UsageError):
        extract(origin, "P", [], "SUB")
    with pytest.raises(EditRefused, match="already"):
        extract(origin, "P", ["State1000", "State1001"], "Q")
    with pytest.raises(PlanningError):
        extract(origin, "P", ["State1000", "State1001"], "SUB", limit=2)
    with pytest.raises(EditRefused, match="no base"):
        inline(origin, "Q")


def test_the_other_sub_sbs_of_both_stay() -> None:
    levels = read(SAMPLES / "three-levels.json")
    for sub in levels.bases:
        after = inline(levels, sub)
        assert len(after.branches) == 2
        assert len(after.bases) == 1
    header = {"SUB_SBS": {"S": 0}}
    one: dict[str, Any] = {"HEADER": header, "State0": {"up": "State1"}, "State1": {}}
    below = {"State0": {"go": "State1"}, "State1": {"back": "State0"}}
    with pytest.raises(EditRefused, match="the base A and the base B"):
        inline(blueprint({"A": one, "B": one, "S": below}), "S")


def test_what_would_behave_otherwise_is_not_put_back() -> None:
    """The way of B to ACTIVATING needs its own sub-SB on, and an edge of one SB shows no way."""
    with pytest.raises(CutRefused, match=r"after 2 operations the result has A\.o4") as refused:
        inline(blueprint(blueprint_values(578)), "B")
    assert refused.value.run == ("A.o0", "A.o4")


def test_a_cut_that_saves_nothing_is_not_listed() -> None:
    table = {"State00": {"plan": "State10"}, "State10": {"end": "State11", "both": "State01"}}
    values: dict[str, Any] = {
        "P": {"HEADER": {"ACTIVATING": "State01"}, **table, "State11": {}, "State01": {}}
    }
    assert len(extract(blueprint(values), "P", ["State10"], "SUB").branches) == 2
    assert identify(blueprint(values)) == ((), "")


def test_a_bound_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("smsl_studio.generate.shapes.identify.MOST_LOOKED", 20)
    found = identify(flatten(read(SAMPLES / "registration-digitization.json")))
    assert found.bound == "20 states looked at, over all sets of states"
    assert found.as_json()["bound"] == found.bound


def test_inline_of_two_sbs_is_flatten() -> None:
    origin = read(SAMPLES / "registration-digitization.json")
    assert diff_behaviour(inline(origin, "DIGITIZATION"), flatten(origin)).equal
