"""Which files can be opened and what they mean, also where the reference reader is wrong."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint, salvage
from smsl_studio.blueprint.writing import values_of
from smsl_studio.errors import AddressError, Place, ReadError
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json

SAMPLES = Path(__file__).parents[2] / "samples"


def read(values: Any) -> Blueprint:
    text = values if isinstance(values, str) else json.dumps(values, indent=1)
    return read_blueprint(parse_json(text, "f.json"))


def refusal(text: str) -> ReadError:
    with pytest.raises(ReadError) as caught:
        read(text)
    assert caught.value.advice
    return caught.value


def test_the_third_appendix_means_what_the_paper_says() -> None:
    blueprint = read_blueprint(read_document(SAMPLES / "hfsm.json"))
    base, sub = blueprint["SB1"], blueprint["SB2"]
    assert (base.initial, base.activating, base.num_facts) == ("State000", "State111", 3)
    assert (sub.initial, sub.activating, sub.num_facts) == ("State0", "State1", 1)
    assert base.subs == {1: "SB2"}
    assert blueprint.roots == ("SB1",)
    assert blueprint.bases == {"SB2": (("SB1", 1),)}
    assert base.states["State100"].facts == ("1", "0", "0")
    assert base.operation("State100", "Operation100A").target == "State110"
    assert (blueprint.state_count, blueprint.operation_count) == (6, 7)
    assert set(blueprint.fields) == {"_comments", "_comment_note"}


def test_names_that_start_with_an_underscore_are_skipped_at_every_level() -> None:
    blueprint = read(
        {
            "_file": 1,
            "A": {
                "_sb": [],
                "HEADER": {"_header": {}, "SUB_SBS": {"_sub": "no digit", "B": 0}, "INITIAL": "S0"},
                "S0": {"_comment": "no edge", "o": "S1"},
                "S1": {},
            },
            "B": {"HEADER": {"SUB_SBS": [{"_sub": "x"}]}},
        }
    )
    assert list(blueprint["A"].table) == ["S0", "S1"]
    assert blueprint["A"].table["S0"] == {"o": "S1"}
    assert blueprint["A"].state_fields == {"S0": {"_comment": "no edge"}}
    assert blueprint["A"].header.fields == {"_header": {}}
    assert blueprint["A"].header.sub_sbs == (("B", 0),)
    assert blueprint["B"].header.sub_sbs == ()
    assert set(blueprint["A"].fields) == {"_sb"}


@pytest.mark.parametrize(
    ("written", "subs"),
    [
        ("[]", ()),
        ("{}", ()),
        ("null", ()),
        ('{"B": 1}', (("B", 1),)),
        ('[{"B": 1}, {"C": 0}]', (("B", 1), ("C", 0))),
        ('[{"B": 1, "C": 0}]', (("B", 1), ("C", 0))),
        ('[{"B": 1}, {"B": 0}]', (("B", 1), ("B", 0))),
        ('{"B": 17}', (("B", 17),)),
    ],
)
def test_sub_sbs_may_be_a_map_a_list_or_absent(
    written: str, subs: tuple[tuple[str, int], ...]
) -> None:
    assert read(f'{{"A": {{"HEADER": {{"SUB_SBS": {written}}}}}}}')["A"].header.sub_sbs == subs


@pytest.mark.parametrize(
    ("text", "column", "words"),
    [
        ('{"version": 1}', 2, "'version' is a number, not a State Branch"),
        ('{"A": null}', 2, "'A' is null, not a State Branch"),
        ('{"": {}}', 2, "a State Branch has no name"),
        ('{"A": {"": {}}}', 8, "a state has no name"),
        ('{"A": {"HEADER": []}}', 8, "'HEADER' is a list, not a HEADER"),
        ('{"A": {"S": "T"}}', 8, "'S' is a text, not a state"),
        ('{"A": {"S": {"o": 1}}}', 14, "the target of 'o' is a number"),
        ('{"A": {"S": {"o": null}}}', 14, "the target of 'o' is null"),
        ('{"A": {"S": {"": "S"}}}', 14, "an operation has no name"),
    ],
)
def test_what_cannot_be_a_blueprint_is_refused_at_its_key(
    text: str, column: int, words: str
) -> None:
    error = refusal(text)
    assert error.place == Place("f.json", 1, column)
    assert words in error.sentence


@pytest.mark.parametrize(
    ("text", "column", "element"),
    [
        ('{"%s": {}}', 2, "a State Branch"),
        ('{"A": {"%s": {}}}', 8, "a state"),
        ('{"A": {"S": {"%s": "S"}}}', 14, "an operation"),
        ('{"A": {"S": {"_": 1, "%s": "S"}}}', 22, "an operation"),
    ],
)
def test_a_name_may_have_ten_thousand_characters(text: str, column: int, element: str) -> None:
    assert read(text % ("ü" * 10_000))
    error = refusal(text % ("ü" * 10_001))
    assert error.sentence == f"the name of {element} has 10,001 characters"
    assert error.place == Place("f.json", 1, column)
    salvaged = salvage(parse_json(text % ("ü" * 10_001), "f.json"))
    assert "ü" not in str(values_of(salvaged))


def test_all_wrong_kinds_are_told_at_once_in_the_order_of_the_text() -> None:
    text = """{"version": 1,
 "A": {"header": {"NUM_FACTS": 3}, "S": {"o": 7, "p": [], "_q": 1}, "T": []},
 "B": {"HEADER": "x", "U": {"o": "U"}}}"""
    faults = refusal(text).faults
    found = [(f.place.line, f.place.column, f.length) for f in faults if f.place]
    assert found == [(1, 2, 9), (2, 19, 11), (2, 42, 3), (2, 50, 3), (2, 69, 3), (3, 8, 8)]
    assert "Did you mean HEADER?" in faults[1].advice
    fixes = [fault.fix for fault in faults]
    assert [fix.text if fix else None for fix in fixes] == [
        '"_version"',
        '"HEADER"',
        '"7"',
        None,
        '"_T"',
        None,
    ]
    assert all(
        text[fix.start : fix.end] in ('"version"', '"header"', "7", '"T"') for fix in fixes if fix
    )


def test_what_can_be_read_beside_wrong_kinds_is_a_blueprint() -> None:
    text = """{"version": 1, "_note": "n", "": {}, "C": 1,
 "A": {"S": {"o": 7, "p": "T", "": "S", "_q": 1}, "T": [], "": {}, "W": {}},
 "B": {"HEADER": "x", "U": {"o": "U"}}}"""
    blueprint = salvage(parse_json(text, "f.json"))
    assert {branch.name: branch.table for branch in blueprint} == {
        "A": {"S": {"p": "T"}, "W": {}},
        "B": {"U": {"o": "U"}},
    }
    assert blueprint["A"].state_fields == {"S": {"_q": 1}}
    assert not blueprint["B"].header.present
    assert blueprint.fields == {"_note": "n"}
    whole = SAMPLES / "hfsm.json"
    assert salvage(read_document(whole)) == read_blueprint(read_document(whole))


@pytest.mark.parametrize(
    ("header", "odd"),
    [
        ('{"INITIAL": 5}', {"INITIAL": 5}),
        ('{"ACTIVATING": ""}', {"ACTIVATING": ""}),
        ('{"NUM_FACTS": "3"}', {"NUM_FACTS": "3"}),
        ('{"NUM_FACTS": true}', {"NUM_FACTS": True}),
        ('{"NUM_STATES": 1.5}', {"NUM_STATES": 1.5}),
        ('{"SUB_SBS": "B"}', {"SUB_SBS": "B"}),
        ('{"SUB_SBS": ["B", {"C": 0}]}', {}),
        ('{"SUB_SBS": {"B": "x", "C": 0}}', {}),
        ('{"SUB_SBS": [{"B": 1.0}]}', {}),
    ],
)
def test_a_header_value_of_the_wrong_kind_opens_counts_as_left_out_and_is_kept(
    header: str, odd: dict[str, object]
) -> None:
    blueprint = read(f'{{"A": {{"HEADER": {header}, "S0": {{}}}}, "B": {{}}, "C": {{}}}}')
    found = blueprint["A"].header
    assert dict(found.odd) == odd
    assert (found.initial, found.activating, found.num_facts) == (None, None, None)
    assert found.sub_sbs == ((("C", 0),) if '"C": 0' in header else ())
    assert values_of(blueprint)["A"]["HEADER"] == json.loads(header)


@pytest.mark.parametrize(
    "text",
    [
        '{"A": {"S": {"o": "Nowhere"}}}',
        '{"A": {"HEADER": {"INITIAL": "X", "ACTIVATING": "Y"}, "S": {}}}',
        '{"A": {"HEADER": {"NUM_FACTS": 7}, "S1": {}}}',
        '{"A": {"HEADER": {"NUM_FACTS": -7}, "S1": {}}}',
        '{"A": {"HEADER": {"SUB_SBS": {"B": 17, "C": 17}}, "S0": {}}, "B": {}, "C": {}}',
        '{"A": {"HEADER": {"SUB_SBS": {"A": 0}}, "S0": {}}}',
        '{"A": {"HEADER": {"SUB_SBS": {"gone": 0}}, "S0": {}}}',
        '{"A": {}, "A": {"S": {}, "S": {}}}',
        "\ufeff{}",
        '{"A": {}}',
        '{"A": {"S": {}}}',
    ],
)
def test_what_can_be_read_opens_and_answers(text: str) -> None:
    blueprint = read(text)
    for branch in blueprint:
        assert isinstance(branch.initial, str)
        assert isinstance(branch.activating, str)
        assert len(branch.alphabet) in (0, branch.num_facts)
        assert all(len(branch.facts(state)) == branch.num_facts for state in branch.table)
        for digit in (*branch.subs, -1, 99):
            assert branch.on_value(digit)
            assert not branch.is_on("S0", 99)
    assert blueprint == read(text)


def test_a_third_level_is_not_lost() -> None:
    header = {"A": {"SUB_SBS": {"B": 0}}, "B": {"SUB_SBS": {"C": 0}}, "C": {}}
    blueprint = read({name: {"HEADER": h, "S0": {}, "S1": {}} for name, h in header.items()})
    assert list(blueprint.branches) == ["A", "B", "C"]
    assert blueprint.roots == ("A",)


def test_a_sub_sb_in_two_bases_is_one() -> None:
    base = {"HEADER": {"SUB_SBS": {"C": 0}}, "S0": {}, "S1": {}}
    blueprint = read({"A": base, "B": base, "C": {"S0": {}, "S1": {}}})
    assert blueprint.roots == ("A", "B")
    assert blueprint.bases["C"] == (("A", 0), ("B", 0))


def test_of_a_key_written_twice_the_last_value_stands_in_the_first_place() -> None:
    blueprint = read('{"A": {"S": {"o": "T"}, "T": {}, "S": {"p": "T"}}}')
    assert blueprint["A"].table == {"S": {"p": "T"}, "T": {}}
    assert (blueprint["A"].initial, blueprint["A"].activating) == ("S", "T")


def test_names_may_be_any_text() -> None:
    odd = ['a/b~"c\\', "move-star-chess-to-block-0", "\u0000\n", "🦾", "0", "null", " ", "HEADER "]
    blueprint = read({name: {other: dict.fromkeys(odd, name) for other in odd} for name in odd})
    for branch in blueprint:
        for operation in branch.edges():
            assert blueprint.resolve(str(operation.address)) == operation.address
            place = blueprint.place(operation.address)
            assert place.line > 1


def test_an_address_that_leads_nowhere_says_what_is_near() -> None:
    blueprint = read_blueprint(read_document(SAMPLES / "hanoi.json"))
    assert str(blueprint.resolve("State_cbb/Op_1c")) == "SB1/State_cbb/Op_1c"
    for text, near in [
        ("SB2", "SB1"),
        ("SB1/State_ccd", "State_cc"),
        ("SB1/State_aaa/Op_1d", "Op"),
    ]:
        with pytest.raises(AddressError) as caught:
            blueprint.resolve(text)
        assert near in caught.value.advice
    for text in ("", "SB1/", "SB1/State_aaa/Op_1b/more"):
        with pytest.raises(AddressError):
            blueprint.resolve(text)


TWO: dict[str, Any] = {"A": {"S0": {"o": "S1"}, "S1": {}}, "B": {"T0": {}}}


def test_layout_comments_and_form_are_outside_the_meaning() -> None:
    plain = read(TWO)
    noted = {"_note": 1, **TWO, "A": {"_layout": {"S0": [1, 2]}, "_c": 0, **TWO["A"]}}
    noted["B"] = {"HEADER": {"_c": 1, "ODD": 1, "NUM_STATES": 1}, "T0": {"_c": "x"}}
    assert read(noted) == plain
    assert read(json.dumps(TWO)) == plain


def test_defaults_that_are_written_out_change_nothing() -> None:
    header = {"INITIAL": "S0", "ACTIVATING": "S1", "NUM_FACTS": 1, "SUB_SBS": []}
    assert read({**TWO, "A": {"HEADER": header, **TWO["A"]}}) != read(TWO)
    inferred: dict[str, Any] = {"A": {"State0": {}, "State1": {}}}
    header = {"INITIAL": "State0", "ACTIVATING": "State1", "NUM_FACTS": 1}
    assert read({"A": {"HEADER": header, **inferred["A"]}}) == read(inferred)


def test_the_order_of_sbs_counts_that_of_states_only_through_the_defaults() -> None:
    assert read(dict(reversed(TWO.items()))) != read(TWO)
    three = {"S0": {"o": "S1", "p": "S0"}, "S1": {}, "S2": {}}
    swapped = {"S0": {"p": "S0", "o": "S1"}, "S2": {}, "S1": {}}
    assert read({"A": three}) != read({"A": swapped}), "another ACTIVATING"
    header = {"HEADER": {"ACTIVATING": "S2"}}
    assert read({"A": {**header, **three}}) == read({"A": {**header, **swapped}})


@pytest.mark.parametrize(
    "change",
    [
        {"A": {"S0": {"o": "S0"}, "S1": {}}},
        {"A": {"S0": {"q": "S1"}, "S1": {}}},
        {"A": {"S0": {"o": "S1"}, "S1": {}, "_facts": {"0": {"on": "S0"}}}},
        {"A": {"S0": {"o": "S1"}, "S1": {}, "_operations": {"o": {"cost": 2}}}},
        {"A": {"HEADER": {"SUB_SBS": {"B": 0}}, "S0": {"o": "S1"}, "S1": {}}},
        {"A": {"HEADER": {"INITIAL": "S1"}, "S0": {"o": "S1"}, "S1": {}}},
        {"A": {"HEADER": {"ACTIVATING": "S0"}, "S0": {"o": "S1"}, "S1": {}}},
        {"_hazards": [{"name": "h", "facts": {"A/0": "1"}}]},
        {"_imports": ["other.json"]},
    ],
)
def test_what_counts_makes_a_difference(change: dict[str, Any]) -> None:
    assert read({**TWO, **change}) != read(TWO)
