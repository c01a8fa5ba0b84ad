"""Reading and writing the native form: what it means, and that no value is lost."""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.errors import ConvertError, Place, ReadError
from smsl_studio.smsl.files import parse_bytes, read_document
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.smsl.native_form import keep_winner, parse, write
from tests.counts import share_of
from tests.smsl.native_texts import native, plain
from tests.smsl.texts import VALUES

Json = Any
EXAMPLE = Path(__file__).parents[2] / "samples" / "example.smsl"
VALUES_OF_EXAMPLE = {
    "SB1": {
        "HEADER": {"INITIAL": "State000", "NUM_FACTS": 3, "SUB_SBS": {"SB2": 1}},
        "State000": {"Operation000": "State100"},
        "State100": {"Operation100A": "State110", "Operation100B": "State111"},
        "State111": {},
    },
    "SB2": {"State0": {"Operation0": "State1"}, "State1": {"Operation1": "State0"}},
}


def read(text: str) -> Json:
    return parse(text, "f.smsl").values


def branch(*lines: str) -> Json:
    """What the lines of one branch read to."""
    return read("\n".join(["{", "# NAME: A", *lines, "}"]))["A"]


def test_the_example_reads_to_its_values() -> None:
    document = read_document(EXAMPLE)
    assert document.form == "smsl"
    assert json.dumps(document.values) == json.dumps(VALUES_OF_EXAMPLE)
    assert document.encoded() == EXAMPLE.read_bytes()


def moved_comments(text: str) -> str:
    """A comment behind every second token that is followed by white space."""
    places = [match.end() for match in re.finditer(r"(?<=[\w\]\[{},>])(?=\s)", text)]
    for place in reversed(places[::2]):
        line = text[text.rfind("\n", 0, place) + 1 : text.find("\n", place)]
        if "#" not in line and "//" not in line:
            text = f"{text[:place]} // moved {{ [ ->\n{text[place:]}"
        elif "#" in line and place + len("\n") <= len(text) and text[place] == "\n":
            text = f"{text[:place]} // moved{text[place:]}"
    return text.replace("// comment\n", "", 1)


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace(",", ""),
        lambda text: text.replace(",", ",,"),
        lambda text: text.replace(",", " , ,\n,") if "(" not in text else text.replace(",", ", ,"),
        lambda text: text.replace("]", "],").replace("{", "{,").replace("[", "[ , "),
        lambda text: text.replace("\n    S", "\n    // {\n\n    S"),
        moved_comments,
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace("\n", "\r"),
        lambda text: "\ufeff" + text.rstrip("\n"),
        lambda text: re.sub(r"(?m)^ +", "", text),
        lambda text: text.replace(": ", ":").replace("# ", "#").replace(" -> ", "->"),
        lambda text: text.replace("[", "\n[\n").replace(" -> ", "\n->\n"),
        lambda text: re.sub(r"\b(State|Operation)(\w+)", r'"\1\2"', text),
    ],
    ids=range(13),
)
def test_separators_comments_and_line_ends_change_nothing(change: Any) -> None:
    text = change(EXAMPLE.read_text("utf-8"))
    document = parse_bytes(text.encode(), "f.smsl")
    assert json.dumps(document.values) == json.dumps(VALUES_OF_EXAMPLE), text
    assert document.encoded() == text.encode()


@settings(max_examples=share_of(150), deadline=None)
@given(VALUES, st.integers(0, 10**6))
def test_any_values_are_read_from_any_layout(values: Json, seed: int) -> None:
    text = native(values, seed)
    document = parse_bytes(text.encode(), "f.smsl")
    assert document.encoded() == text.encode()
    assert json.dumps(document.values) == json.dumps(plain(values))


@settings(max_examples=share_of(100), deadline=None)
@given(VALUES)
def test_new_text_reads_to_its_values(values: Json) -> None:
    assert json.dumps(read(write(values))) == json.dumps(plain(values))


def test_the_canonical_layout_is_that_of_the_example() -> None:
    text = EXAMPLE.read_text("utf-8").removeprefix("// comment\n")
    assert write(VALUES_OF_EXAMPLE) == text.replace("State1]\n    S", "State1],\n    S")
    fields = {"_imports": ["a.json"], "A": {"S": {"_x": 1}, "_layout": {"S": [1, 2.5]}}}
    assert write(fields) == (
        '# _imports: ["a.json"]\n\n{\n    # NAME: A\n    S: [\n        # _x: 1\n    ]\n'
        '    # _layout: {"S": [1, 2.5]}\n}\n'
    )


@pytest.mark.parametrize(
    ("line", "key", "value"),
    [
        ("# INITIAL: 010", "INITIAL", "010"),
        ("# INITIAL: true", "INITIAL", "true"),
        ("#ACTIVATING:12.30 // the goal", "ACTIVATING", "12.30"),
        ('# INITIAL: "a // b"', "INITIAL", "a // b"),
        ('# INITIAL: ["odd"]', "INITIAL", ["odd"]),
        ("# NUM_FACTS: 3 // three", "NUM_FACTS", 3),
        ("# NUM_FACTS: 3,", "NUM_FACTS", 3),
        ("# NUM_FACTS: 03", "NUM_FACTS", "03"),
        ('# NUM_FACTS: "3"', "NUM_FACTS", "3"),
        ("# NUM_FACTS: three of them", "NUM_FACTS", "three of them"),
        ('# SUB_SBS: (SB2: 1, "SB 3": 2)', "SUB_SBS", {"SB2": 1, "SB 3": 2}),
        ("# SUB_SBS: (SB2: 1 SB3: -2,,) // c", "SUB_SBS", {"SB2": 1, "SB3": -2}),
        ("# SUB_SBS: ( )", "SUB_SBS", {}),
        ("# SUB_SBS: []", "SUB_SBS", []),
        ('# SUB_SBS: [{"SB2": 1}]', "SUB_SBS", [{"SB2": 1}]),
        ('# SUB_SBS: {"SB2": "x"}', "SUB_SBS", {"SB2": "x"}),
        ("# AUTHOR: Ada, Countess of L. // who", "AUTHOR", "Ada, Countess of L."),
        ("# URL: https://example.org/a", "URL", "https://example.org/a"),
        ("# RIGHTS: (c) 2026 us", "RIGHTS", "(c) 2026 us"),
        ("# EMPTY:", "EMPTY", ""),
        ("# SPEED: -2.5e3", "SPEED", -2500.0),
        ("# READY: true", "READY", True),
        ("# NOTHING: null", "NOTHING", None),
        ('# "two words": x', "two words", "x"),
        ('# HEADER._x: {"u": "http://a//b"}', "_x", {"u": "http://a//b"}),
        ('# HEADER."_x y": 2', "_x y", 2),
        ("# HEADER.NAME: other", "NAME", "other"),
        ('# "HEADER.x": 1', "HEADER.x", 1),
    ],
)
def test_header_lines(line: str, key: str, value: Json) -> None:
    found = branch(line)["HEADER"]
    assert json.dumps(found) == json.dumps({key: value})
    again = read(write({"A": {"HEADER": found}}))["A"]["HEADER"]
    assert json.dumps(again) == json.dumps(found)


def test_underscore_lines_stand_at_four_levels() -> None:
    text = (
        '# _file: ["a"]\n{\n# NAME: A\n# _sb: "// text"\nS: [\n# _state: 1 // one\na -> S\n]\n'
        "# HEADER._head: null\n}\n# _last: {}\n"
    )
    assert read(text) == {
        "_file": ["a"],
        "A": {"HEADER": {"_head": None}, "_sb": "// text", "S": {"_state": 1, "a": "S"}},
        "_last": {},
    }
    odd = read("{ # NAME: _old\nS: [a -> S]\n}\n{ # NAME: A\n_s: [x -> y]\nT: [_o -> T]\n}")
    assert odd == {"_old": {"S": {"a": "S"}}, "A": {"_s": {"x": "y"}, "T": {"_o": "T"}}}


WILD = [
    "move-star-chess-to-block-0",
    "a->b",
    "#x",
    "//",
    "a name with spaces",
    "外科手术",
    "جراحة",
    "\u202eright\u202c",
    '"quoted" \\ and \t tab',
    "{}[]:,#/()>",
    "-",
    "a-",
    "->",
    "\u2028",
    "\x85\x00",
    "x" * 10_000,
]


@pytest.mark.parametrize("name", WILD, ids=range(len(WILD)))
def test_names_in_the_wild_come_back(name: str) -> None:
    header = {"INITIAL": name, "SUB_SBS": {name: 0}, name: name}
    values = {name: {"HEADER": header, name: {name: name}, f"{name}2": {}}}
    for arrow in (" -> ", "->"):
        text = write(values).replace(" -> ", arrow)
        document = parse_bytes(text.encode(), "f.smsl")
        assert document.values == values
        assert document.encoded().decode() == text
    assert parse_json(json.dumps(values), "f").values == values


def test_a_key_written_twice_opens_and_all_places_are_found() -> None:
    text = (
        "{ # NAME: A\n# INITIAL: S\n# INITIAL: T\nS: [a -> S]\nT: [a -> S, a -> T]\nS: []\n"
        '# _x: {"k": 1, "k": 2}\n# SUB_SBS: (B: 1, B: 0)\n}\n{ # NAME: B\n}\n{ # NAME: B\nU: []\n}'
    )
    document = parse(text, "f.smsl")
    assert document.values == {
        "A": {
            "HEADER": {"INITIAL": "T", "SUB_SBS": {"B": 0}},
            "S": {},
            "T": {"a": "T"},
            "_x": {"k": 2},
        },
        "B": {"U": {}},
    }
    found = {"/".join(path): [at.line for at in places] for path, places in document.duplicates()}
    assert found == {
        "A/HEADER/INITIAL": [2, 3],
        "A/HEADER/SUB_SBS/B": [8, 8],
        "A/S": [4, 6],
        "A/T/a": [5, 5],
        "A/_x/k": [7, 7],
        "B": [10, 12],
    }
    for path, _ in document.duplicates():
        document = keep_winner(document, path)
    assert document.duplicates() == ()
    assert document.text == (
        "{ # NAME: A\n# INITIAL: T\nS: []\nT: [a -> T]\n"
        '# _x: {"k": 2}\n# SUB_SBS: (B: 0)\n}\n{ # NAME: B\nU: []\n}'
    )
    with pytest.raises(KeyError):
        keep_winner(document, ("A", "gone"))


@pytest.mark.parametrize(
    ("inside", "path"),
    [
        ("S: [a -> S, a -> S]", "A/S/a"),
        ("S: [a -> S # _x: 1\na -> S]", "A/S/a"),
        ("S: [a -> S # _x: 1\n# _x: 1\n]", "A/S/_x"),
        ('S: [# _x: {"k": [{"d": 1, "d": 1}]}\n]', "A/S/_x/k/0/d"),
        ("S: [] S: []", "A/S"),
        ("# _x: 1\n# _x: 1\n", "A/_x"),
        ("# X: 1\n# HEADER.X: 1\n", "A/HEADER/X"),
        ("# SUB_SBS: (B: 1, B: 1)\n", "A/HEADER/SUB_SBS/B"),
        ("} { # NAME: A\n", "A"),
        ("}\n# _f: 1\n# _f: 1\n{ # NAME: B\n", "_f"),
    ],
)
def test_each_kind_of_key_may_be_doubled(inside: str, path: str) -> None:
    document = parse(f"{{ # NAME: A\n{inside} }}", "f.smsl")
    ((found, places),) = document.duplicates()
    assert ("/".join(found), len(places)) == (path, 2)
    assert keep_winner(document, found).duplicates() == ()
    assert keep_winner(document, found).values == document.values


def test_places() -> None:
    document = read_document(EXAMPLE)
    file = str(EXAMPLE)
    assert document.place(()) == Place(file, 1, 1)
    assert document.place(("SB1",)) == Place(file, 3, 13)
    assert document.place(("SB1", "HEADER")) == Place(file, 4, 5)
    assert document.place(("SB1", "HEADER", "SUB_SBS", "SB2")) == Place(file, 6, 17)
    assert document.place(("SB1", "State100", "Operation100B")) == Place(file, 11, 9)
    assert document.place(("SB2", "HEADER", "INITIAL")) == Place(file, 16, 13)
    with pytest.raises(KeyError):
        document.members(("SB1", "State100", "Operation100B"))
    deep = parse('\ufeff# _x: [{"a": [5]}]', "f")
    assert deep.place(("_x", "0", "a", "0")) == Place("f", 1, 15)


@pytest.mark.parametrize(
    ("values", "path"),
    [
        ({"A": {"HEADER": {"INITIAL": 5}}}, "A/HEADER/INITIAL"),
        ({"A": {"HEADER": {"ACTIVATING": None}}}, "A/HEADER/ACTIVATING"),
        ({"A": {"S/T": 5}}, "A/S~1T"),
        ({"A": {"S": {"o": 5}}}, "A/S/o"),
        ({"A": []}, "A"),
        ({"A": {"HEADER": 1}}, "A/HEADER"),
    ],
)
def test_what_has_no_spelling_is_named(values: Json, path: str) -> None:
    with pytest.raises(ConvertError, match=f"^{re.escape(path)} cannot be written") as caught:
        write(values)
    assert caught.value.advice


def damaged(text: str, chance: random.Random) -> str:
    """The text with one to three small damages."""
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(len(text) + 1)
        piece = chance.choice([*'{}[]:,#"/>-()\\\0\n\r', "->", "//", "# NAME: X\n", "# _x: {", ""])
        text = text[:at] + piece + text[at + chance.choice([0, 0, 1, 9, 80]) :]
    return text


def test_a_damaged_text_opens_or_is_refused_with_places() -> None:
    chance = random.Random(7)
    refused = 0
    for seed in range(share_of(400, least=200)):
        source = EXAMPLE.read_text("utf-8") if seed % 2 else native(VALUES_OF_EXAMPLE, seed)
        text = damaged(source, chance)
        try:
            parse(text, "f.smsl")
        except ReadError as error:
            refused += 1
            for fault in error.faults:
                assert fault.place is not None
                assert fault.place.line <= len(re.findall("\r\n?|\n", text)) + 1
                assert fault.advice
    assert refused > 100
