"""The YAML form: what it reads, how it refuses, and that any YAML reader reads what it writes."""

from __future__ import annotations

import json
from itertools import pairwise
from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from ruamel.yaml import YAML

from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused, ReadError
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.document.limits import MAX_DEPTH
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.yaml_form import keep_winner, parse, reconcile, recover, tidy, write
from tests.counts import share_of
from tests.smsl.texts import VALUES

LISTS = """\
SB1: [
    HEADER: [INITIAL: State000, NUM_FACTS: 3, SUB_SBS: [SB2: 1]],
    State000: [Operation000: State100],
    State100: [ Operation100A: State110, Operation100B: State111 ],
    State110: [],
    State111: {},
    State112:
]
SB2: [
    State0: [Operation0: State1],
    State1: [Operation1: State0]
]
"""
MAPS = {
    "SB1": {
        "HEADER": {"INITIAL": "State000", "NUM_FACTS": 3, "SUB_SBS": [{"SB2": 1}]},
        "State000": {"Operation000": "State100"},
        "State100": {"Operation100A": "State110", "Operation100B": "State111"},
        "State110": {},
        "State111": {},
        "State112": {},
    },
    "SB2": {"State0": {"Operation0": "State1"}, "State1": {"Operation1": "State0"}},
}


def refusal(text: str) -> ReadError:
    with pytest.raises(ReadError) as caught:
        parse(text, "f.yaml")
    return caught.value


def exact(values: object) -> str:
    return json.dumps(values)


def test_the_list_of_one_key_maps_reads_like_a_map() -> None:
    assert exact(parse(LISTS, "f.yaml").values) == exact(MAPS)


def test_a_list_may_stand_at_the_top_too() -> None:
    top = "[ SB1: [ S: [a: S] ], SB2: [] ]"
    assert parse(top, "f.yaml").values == {"SB1": {"S": {"a": "S"}}, "SB2": {}}
    block = "- SB1:\n  - S:\n    - a: S\n    - b: T\n  - T:\n"
    assert parse(block, "f.yaml").values == {"SB1": {"S": {"a": "S", "b": "T"}, "T": {}}}


@pytest.mark.parametrize(
    "name", ["on", "No", "010", "12:30", "~", "1.0", "2001-01-01", "null", "true", "0x1F", "<<"]
)
def test_a_name_is_a_text_whatever_it_looks_like(name: str) -> None:
    text = f"SB:\n  HEADER: {{INITIAL: {name}, ACTIVATING: {name}}}\n  {name}: {{{name}: {name}}}\n"
    document = parse(text, "f.yaml")
    header = {"INITIAL": name, "ACTIVATING": name}
    assert document.values == {"SB": {"HEADER": header, name: {name: name}}}
    lists = f"SB: [HEADER: [INITIAL: {name}, ACTIVATING: {name}], {name}: [{name}: {name}]]"
    assert parse(lists, "f.yaml").values == document.values
    assert parse(write(document.values), "f.yaml").values == document.values


def test_other_values_follow_the_core_schema() -> None:
    text = """\
_x: {cost: 2.5, on: on, no: No, octal: 010, eight: 0o17, hex: 0x1F, time: 12:30, yes: true,
     none: ~, also: , text: '1', day: 2001-01-01, big: 1e3, under: 1_000, tagged: !!str 5}
SB:
  HEADER: {NUM_FACTS: 3, OTHER: 2.5, WORD: on}
"""
    values = parse(text, "f.yaml").values
    assert values["_x"] == {
        **{"cost": 2.5, "on": "on", "no": "No", "octal": 10, "eight": 15, "hex": 31},
        **{"time": "12:30", "yes": True, "none": None, "also": None, "text": "1"},
        **{"day": "2001-01-01", "big": 1000.0, "under": "1_000", "tagged": "5"},
    }
    assert values["SB"]["HEADER"] == {"NUM_FACTS": 3, "OTHER": 2.5, "WORD": "on"}


@pytest.mark.parametrize("path", sorted(samples_dir().glob("*.json")), ids=lambda path: path.name)
def test_a_sample_as_lists_has_the_places_of_its_names(path: Any) -> None:
    values = read_document(path).values
    text = as_lists(values)
    document = parse(text, "f.yaml")
    assert exact(document.values) == exact(values)
    lines = text.splitlines()
    for branch in read_blueprint(document):
        for edge in branch.edges():
            place = document.place(edge.address.path)
            assert lines[place.line - 1][place.column - 1 :].startswith(f"{edge.name}: ")


def as_lists(value: Any, level: int = 0, key: str = "") -> str:
    """The values as upstream writes them."""
    if key.startswith("_") or not isinstance(value, dict) or level == 3:
        return value if isinstance(value, str) and not key else json.dumps(value)
    inner = [f"{k}: {as_lists(v, level + 1, k if k[0] == '_' else '')}" for k, v in value.items()]
    return "\n".join(inner) + "\n" if level == 0 else f"[ {', '.join(inner)} ]"


FAULTS = [
    ("", 1, 1, "the file is empty"),
    ("# only\n", 1, 1, "the file is empty"),
    ("text", 1, 1, "holds no State Branches"),
    ("[1, SB: []]", 1, 2, "has no name"),
    ("SB: [HEADER: [INITIAL], S: []]", 1, 15, "has no name"),
    ("SB:\n  S: {? [a]: b}", 2, 9, "a name is a text"),
    ("SB: [", 1, 6, "a value is missing"),
    ("SB:\n\tS: {}", 2, 1, "a tab cannot indent"),
    ("SB: !!python/object:os.system {}", 1, 5, "the tag '!!python/object:os.system' is not read"),
    ("SB: !me {}", 1, 5, "the tag '!me' is not read"),
    ("SB: *x", 1, 5, "nothing is anchored as &x"),
    ("SB: &x [S: *x]", 1, 12, "*x stands inside what it stands for"),
    ("SB: {}\n---\nSC: {}", 2, 1, "a second document begins here"),
    ("_x: .nan", 1, 5, ".nan is no number"),
    ("_x: 1e999", 1, 5, "the number is too large"),
    ("_x: " + "9" * 4001, 1, 5, "the number is too large"),
    ("_x: !!int foo", 1, 5, "no value for the tag !!int"),
    ("SB: \x01", 1, 5, "the character U+0001 cannot stand in YAML"),
    ("_x: " + "[" * 70 + "]" * 70, 1, 5 + MAX_DEPTH - 1, "nested deeper than 64 levels"),
    ("SB: a: b", 1, 6, "a ':' stands where no name can end"),
    ("SB: {S: 'x}", 1, 12, "the text ends inside quotes"),
    ("SB: @x", 1, 5, "no value can begin with this character"),
]


@pytest.mark.parametrize(("text", "line", "column", "words"), FAULTS)
def test_a_refusal_names_the_place(text: str, line: int, column: int, words: str) -> None:
    error = refusal(text)
    assert words in error.sentence
    assert error.place is not None
    assert (error.place.line, error.place.column) == (line, column)
    assert error.advice
    assert error.length >= 1
    recover(text, "f.yaml")


def test_a_file_may_not_ask_for_too_much(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("smsl_studio.smsl.document.limits.MAX_VALUES", 50)
    error = refusal("SB: {S: {a: S}}\n_x: [" + "a," * 50 + "]\nSC: {}\n")
    assert "names and values stand in one file" in error.sentence
    assert recover("SB: {}\n_x: [" + "a," * 50 + "]", "f.yaml").values["SB"] == {}
    monkeypatch.setattr("smsl_studio.smsl.yaml_form.reader.MAX_CHARACTERS", 50)
    text = "SB: {}\n" * 10
    assert "larger than" in refusal(text).sentence
    empty = recover(text, "f.yaml")
    assert (empty.values, empty.place(("SB",)).line) == ({}, 1)


def test_several_faults_are_told_at_once_and_the_rest_is_recovered() -> None:
    text = """\
SB1: {S: !odd {a: S}, _x: .inf}
SB2: [S: [a: ]
SB3: {S: [b, c: S]}
SB4: {S: "x}
"""
    error = refusal(text)
    told = [(fault.place.line, fault.place.column) for fault in error.faults if fault.place]
    assert told == [(1, 10), (1, 27), (3, 1), (3, 11), (5, 1)]
    values = recover(text, "f.yaml").values
    assert values["SB1"] == {"S": {"a": "S"}, "_x": None}
    assert values["SB3"] == {"S": {"c": "S"}}
    fix = error.faults[0].fix
    assert fix is not None
    assert text[fix.start : fix.end] == "!odd "


@pytest.mark.parametrize("edge", ["go:S", "go -> S", "go->S", "go = S"])
def test_a_name_that_only_lacks_its_colon_is_repaired(edge: str) -> None:
    text = f"SB: [S: [stay: S, {edge}]]"
    (fault,) = refusal(text).faults
    fix = fault.fix
    assert fix is not None
    mended = text[: fix.start] + fix.text + text[fix.end :]
    assert parse(mended, "f.yaml").values == {"SB": {"S": {"stay": "S", "go": "S"}}}


def test_aliases_stand_for_values_but_not_for_the_world() -> None:
    shared = "SB1: &a {S: {x: S}}\nSB2: *a\n_x: &n 010\n_y: {n: *n}\nSB3: {S: {x: *n}}\n"
    document = parse(shared, "f.yaml")
    assert document.values["SB2"] == {"S": {"x": "S"}}
    assert (document.values["_y"], document.values["SB3"]) == ({"n": 10}, {"S": {"x": "010"}})
    assert document.place(("SB2", "S", "x")).line == 1
    names = "abcdefgh"
    lines = ["_a: &a [lol, lol, lol, lol, lol, lol, lol, lol, lol]"]
    for one, following in pairwise(names):
        lines.append(f"_{following}: &{following} [{', '.join([f'*{one}'] * 9)}]")
    error = refusal("\n".join(lines))
    assert len(error.faults) == 1
    assert error.sentence == "the aliases of this file stand for too much"


def test_an_alias_does_not_nest_deeper_than_a_text_may() -> None:
    deep = "_a: &a " + "[" * 40 + "]" * 40 + "\n"
    assert parse(deep + "_b: " + "[" * 22 + "*a" + "]" * 22, "f.yaml").values["_b"]
    error = refusal(deep + "_b: " + "[" * 24 + "*a" + "]" * 24)
    assert error.sentence == "nested deeper than 64 levels"
    assert error.place is not None
    assert (error.place.line, error.place.column) == (2, 29)


def test_places_are_told_apart_from_what_stands_before_the_content() -> None:
    document = parse("\ufeff# c\n\nSB: {}", "f.yaml")
    assert (document.place(()).line, document.place(()).column) == (3, 1)
    assert recover("\ufeff \n ", "f.yaml").place(()).line == 2


def test_a_doubled_key_opens_and_one_of_them_can_be_kept() -> None:
    text = "SB: [ S: [a: S, b: S, a: T], T: [] ]\n"
    document = parse(text, "f.yaml")
    assert document.values == {"SB": {"S": {"a": "T", "b": "S"}, "T": {}}}
    ((path, places),) = document.duplicates()
    assert (path, [place.column for place in places]) == (("SB", "S", "a"), [11, 23])
    kept = keep_winner(document, path)
    assert kept.text == "SB: [ S: [a: T, b: S], T: [] ]\n"
    assert not kept.doubled
    with pytest.raises(EditRefused, match="written 2 times"):
        reconcile(document, {**document.values, "SC": {}})
    block = parse("SB:\n  S: {a: S}\n  # c\n  T: {}\n  S:\n    b: T\n", "f.yaml")
    assert keep_winner(block, ("SB", "S")).text == "SB:\n  S:\n    b: T\n  # c\n  T: {}\n"
    mixed = parse("SB: [ {S: {}, T: {}}, {T: {a: S}, S: {b: T}} ]", "f.yaml")
    for path, _ in mixed.duplicates():
        assert keep_winner(mixed, path).values == mixed.values


def test_what_is_doubled_in_a_way_nobody_can_join_is_left_to_the_person() -> None:
    text = "SB:\n  S: &x {a: S}\n  T: *x\n  S: {b: T}\n"
    for before in ("", "SC: &x {Q: {}}\n"):
        document = parse(before + text, "f.yaml")
        with pytest.raises(EditRefused, match="written in ways"):
            keep_winner(document, ("SB", "S"))
    with pytest.raises(KeyError):
        keep_winner(document, ("SB", "Q"))


COMMENTED = """\
# head
SB1: [  # of SB1
    HEADER: [INITIAL: State0], # of the header
    # above State0
    State0: [go: State1, # of go
        stay: State0
        # foot of State0
    ],
    State1: [], _x: [1, # one
      2]
    # foot of SB1
]
# end
"""


def test_comments_survive_an_edit_of_what_they_stand_beside() -> None:
    document = parse(COMMENTED, "f.yaml")
    values: Any = json.loads(json.dumps(document.values))
    values["SB1"] = {("State9" if k == "State0" else k): v for k, v in values["SB1"].items()}
    values["SB1"]["State9"]["go"] = "State9"
    edited = reconcile(document, values)
    assert exact(parse(edited.text, "f.yaml").values) == exact(values)
    assert (
        edited.text
        == """\
# head
SB1:  # of SB1
  HEADER:  # of the header
    INITIAL: State0
  # above State0
  State9:
    go: State9  # of go
    stay: State0
    # foot of State0
  State1: {}
  _x:
    - 1  # one
    - 2
  # foot of SB1
# end
"""
    )
    values = json.loads(json.dumps(values))
    del values["SB1"]["State9"]
    assert "above State0" not in reconcile(edited, values).text
    assert "# foot of SB1" in reconcile(edited, values).text


@pytest.mark.parametrize(
    ("written", "tidied"),
    [
        ("SB:\n  T:\n  # end\nSC:", "SB:\n  T: {}\n  # end\nSC: {}\n"),
        ("SB: [ S: [],\n  T:\n  # end\n]\nSC:", "SB:\n  S: {}\n  T: {}\n  # end\nSC: {}\n"),
        (
            "_h:\n  # one\n  - a: 1\n    # two\n    b: 2\n  # end\n",
            "_h:\n  # one\n  - a: 1\n    # two\n    b: 2\n  # end\n",
        ),
        ("_h: | # said\n  text\nSB: {} # of SB\n", '_h: "text\\n"  # said\nSB: {}  # of SB\n'),
        ("# a\n{} # b\n# c\n", "{}\n# a\n# b\n# c\n"),
        (
            "_x: [ # x\n  # over\n  [], # one\n  [ # two\n  # in\n ], {} # three\n ]\n",
            "_x:  # x\n  # over\n  - []  # one\n  - []  # two\n    # in\n  - {}  # three\n",
        ),
        ("SB: { # one\n S: {a: S} } # two\n", "SB:  # one  # two\n  S:\n    a: S\n"),
        ("'a#b': {\"#\": '#'}\n# c", '"a#b":\n  "#": "#"\n# c\n'),
    ],
)
def test_a_comment_stays_with_what_it_speaks_of(written: str, tidied: str) -> None:
    assert tidy(parse(written, "f.yaml")).text == tidied


def test_tidying_twice_is_tidying_once() -> None:
    once = tidy(parse("\ufeff" + COMMENTED.replace("\n", "\r\n"), "f.yaml"))
    assert tidy(parse(once.text, "f.yaml")).text == once.text
    assert once.text.startswith("\ufeff# head\r\nSB1:  # of SB1\r\n")
    assert exact(parse(once.text, "f.yaml").values) == exact(parse(COMMENTED, "f.yaml").values)
    same = parse("SB:\n  S: {}\n", "f.yaml")
    assert tidy(same) is same


@settings(max_examples=share_of(150))
@given(VALUES)
def test_what_is_written_reads_back_in_any_yaml(values: dict[str, Any]) -> None:
    text = write(values)
    assert exact(parse(text, "f.yaml").values) == exact(values)
    if "!!" in text or "INITIAL:\n" in text:
        return
    new = YAML(typ="safe", pure=True).load(text)
    old = yaml.safe_load(text)
    assert exact(new) == exact(values) == exact(old)


def test_a_deep_value_grows_with_its_parts_and_not_with_their_depth() -> None:
    deep: Any = {"x y": [1.5, "null", {}, []], "k" * 2000: None}
    for step in range(50):
        deep = [deep, "a: b"] if step % 2 else {"a": deep, "#": [step]}
    once, often = (write({"_x": [deep] * count}) for count in (1, 40))
    assert len(once) < 5_000
    assert len(often) < 40 * len(once)
    assert parse(often, "f.yaml").values == {"_x": [deep] * 40}
    assert YAML(typ="safe").load(once) == {"_x": [deep]}


def test_a_comment_in_the_depth_keeps_its_place() -> None:
    lines = [f"{'  ' * step}a:" for step in range(20)]
    text = "_x:\n" + "\n".join(f"  {line}" for line in lines) + f" 1  # deep\n{'  ' * 20}# last\n"
    document = parse(text, "f.yaml")
    said = form_named("yaml").comments_in(document)
    assert len(said) == 2
    assert [line.strip() for line in write(document.values, said).splitlines()] == [
        line.strip() for line in text.splitlines()
    ]


def test_a_reader_of_yaml_1_1_sees_what_was_meant() -> None:
    values = {"_x": {"y": "n", "Y": "=", "big": 1e22, "small": 1e-7, "t": "12:30:00", "d": 1.0}}
    text = write(values)
    assert exact(yaml.safe_load(text)) == exact(values)
    assert '"y": "n"' in text, "some readers take these for true and false"
    assert '"Y": "="' in text


@pytest.mark.parametrize(
    "value", [5, 2.5, True, None, [], [{"a": 1}], "", "~", "null", {"a": {"b": 1}}, 1e-7, 1e22]
)
def test_what_is_no_name_or_map_has_a_spelling_too(value: Any) -> None:
    for values in (
        {"SB": {"S": {"op": value}}},
        {"SB": {"S": value}},
        {"SB": {"HEADER": value}},
        {"SB": value},
        {"SB": {"HEADER": {"INITIAL": value, "ACTIVATING": value, "OTHER": value}}},
        {"_x": [value, {"y": value}]},
    ):
        if value == {"a": {"b": 1}} and values == {"SB": value}:
            continue  # a state whose operation leads to a number
        assert exact(parse(write(values), "f.yaml").values) == exact(values)


@settings(max_examples=share_of(100))
@given(VALUES, VALUES)
def test_an_edited_text_reads_to_the_edited_values(old: Any, new: Any) -> None:
    document = parse("# head\n" + write(old) + "# end\n", "f.yaml")
    edited = reconcile(document, new)
    assert exact(edited.values) == exact(new)
    assert exact(parse(edited.text, "f.yaml").values) == exact(new)
    assert reconcile(document, old) is document
