"""One blueprint has the same values, meaning and digests in all three written forms."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import ConvertError, EditRefused
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.conversion import convert
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.forms import form_named
from smsl_studio.smsl.json_form import parse_json, write_json
from smsl_studio.smsl.splice import reconcile
from tests.blueprint.test_any_edits import random_edit
from tests.counts import share_of
from tests.smsl.texts import NOTES

FORMS = ("json", "smsl", "yaml")
SAMPLES = sorted(path for path in samples_dir().iterdir() if path.suffix in (".json", ".smsl"))
Json = dict[str, Any]


def to(document: Document, form: str) -> Document:
    return convert(document, form, f"x.{form}").document


def must_mean_the_same(one: Document, other: Document) -> None:
    before, after = read_blueprint(one), read_blueprint(other)
    assert before == after
    assert digests(before) == digests(after)


def in_order(values: Json) -> Any:
    """The values with the order of their names, and ``_`` fields in any order.

    A HEADER that says nothing is as good as none: the native form has no word for it.
    """
    said = [(k, v) for k, v in values.items() if k != "HEADER" or v]
    named = [(k, v) for k, v in said if not k.startswith("_")]
    inner = [(k, in_order(v) if isinstance(v, dict) and k != "HEADER" else v) for k, v in named]
    return inner, {k: v for k, v in values.items() if k.startswith("_")}


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_a_sample_goes_through_all_forms_and_back(path: Path) -> None:
    document = read_document(path)
    there = to(to(to(document, "smsl"), "yaml"), "json")
    must_mean_the_same(document, there)
    assert in_order(dict(there.values)) == in_order(dict(document.values))
    native = to(there, "smsl")
    assert native.text == to(to(native, "json"), "smsl").text, "converting settles"


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.name)
def test_a_sample_in_its_own_form_keeps_its_bytes(path: Path) -> None:
    document = read_document(path)
    for form in FORMS:
        once = to(document, form)
        assert to(once, form).text == once.text
        assert form_named(form).parse(once.text, "x").text == once.text
    assert to(document, document.form).encoded() == path.read_bytes()


WILD = [
    "move-star-chess-to-block-0",
    "a->b",
    "->",
    "-",
    "-a",
    "#x",
    "a #x",
    "two words",
    " a space ",
    "状态",
    "حالة",
    "a\u202eb",
    "🧠",
    '"quoted"',
    "it's",
    "back\\slash",
    "line\nline",
    "tab\there",
    "a:b",
    "a: b",
    "a:",
    "//x",
    "a//b",
    "a/b~c",
    "[x]",
    "{x}",
    "(x)",
    "a,b",
    "on",
    "No",
    "010",
    "12:30",
    "1.0",
    "~",
    "null",
    "2001-01-01",
    "&a",
    "*a",
    "!a",
    "|",
    ">",
    "%a",
    "@a",
    "`a`",
    "?",
    "? a",
    "- a",
    "---",
    "...",
    "<<",
    "=",
    "{",
    "a\x85b",
    "a\u2028b",
    "a\x00b",
    "\ufeffa",
    "a\u00a0b",
    "e\u0301",
    "HEADER.x",
    "NAME",
    "INITIAL",
    "x" * 10_000,
    "状" * 10_000,
]


def named(name: str) -> Json:
    """A blueprint in which everything that has a name has this one."""
    return {
        name: {
            "HEADER": {"INITIAL": name, "ACTIVATING": name, "SUB_SBS": {"SB2": 0}},
            name: {name: name, "other": name},
            "State1": {name: "State1"},
            "_operations": {"other": {"title": name}},
        },
        "SB2": {name: {}, "_facts": {"0": {"name": name}}},
    }


@pytest.mark.parametrize("name", WILD, ids=lambda name: ascii(name[:12]))
def test_names_in_the_wild_go_through_every_form(name: str) -> None:
    document = parse_json(write_json(named(name)), "x.json")
    for order in (FORMS, ("yaml", "smsl", "json")):
        there = document
        for form in order:
            there = to(there, form)
            must_mean_the_same(document, there)
        assert in_order(dict(to(there, "json").values)) == in_order(dict(document.values))


@pytest.mark.parametrize("name", WILD[:20], ids=lambda name: ascii(name[:12]))
def test_a_name_in_the_wild_has_its_place_in_every_form(name: str) -> None:
    document = parse_json(write_json(named(name)), "x.json")
    for form in FORMS:
        there = to(document, form)
        for path in ((name,), (name, name), (name, name, name), ("SB2", name)):
            member = there.member(path)
            assert member.key == name
            line = there.place(path).line
            assert there.text[: member.key_start].count("\n") + 1 == line


NAMES = st.one_of(
    st.sampled_from(["State0", "State1", "a->b", "on", "#x", "//", "a b", "é", "0"]),
    st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=5),
).filter(lambda name: not name.startswith("_") and name != "HEADER")
FIELDS = st.dictionaries(st.sampled_from(["_c", "_layout", "_ x", "_é"]), NOTES, max_size=2)
NUMBERS = st.integers(-(10**20), 10**20) | st.floats(allow_nan=False, allow_infinity=False)
STATES = st.builds(lambda a, b: {**a, **b}, FIELDS, st.dictionaries(NAMES, NAMES, max_size=3))
HEADERS = st.builds(
    lambda known, fields: {**known, **fields},
    st.fixed_dictionaries(
        {"NUM_FACTS": st.integers(1, 3)},
        optional={
            "INITIAL": NAMES,
            "ACTIVATING": NAMES,
            "SUB_SBS": st.dictionaries(NAMES, st.integers(0, 9), max_size=2)
            | st.lists(st.dictionaries(NAMES, st.integers(0, 3), min_size=1, max_size=1)),
            "OTHER": NOTES | NUMBERS | NAMES,
            "other key": NAMES,
        },
    ),
    FIELDS,
)
BRANCHES = st.builds(
    lambda fields, header, states: {**fields, "HEADER": header, **states},
    FIELDS,
    HEADERS,
    st.dictionaries(NAMES, STATES, max_size=3),
)
FILES = st.builds(lambda a, b: {**a, **b}, FIELDS, st.dictionaries(NAMES, BRANCHES, max_size=3))


@settings(max_examples=share_of(120))
@given(FILES, st.permutations(FORMS))
def test_any_blueprint_goes_through_every_form(values: Json, order: list[str]) -> None:
    document = parse_json(write_json(values), "x.json")
    there = document
    for form in order:
        there = to(there, form)
        assert form_named(form).write(there.values) == there.text
    must_mean_the_same(document, there)
    assert in_order(dict(to(there, "json").values)) == in_order(values)


@settings(max_examples=share_of(60))
@given(FILES, FILES, st.sampled_from(FORMS))
def test_an_edit_reads_the_same_in_every_form(old: Json, new: Json, form: str) -> None:
    document = to(parse_json(write_json(old), "x.json"), form)
    wanted = parse_json(write_json(new), "x.json")
    edited = reconcile(document, new)
    must_mean_the_same(wanted, edited)
    must_mean_the_same(wanted, form_named(form).parse(edited.text, "x"))


def test_lists_of_one_key_maps_have_the_digests_of_the_maps() -> None:
    document = read_document(samples_dir() / "hfsm.json")
    lists = [
        f"{name}: {_as_list(one)}"
        for name, one in document.values.items()
        if not name.startswith("_")
    ]
    listed = form_named("yaml").parse("\n".join(lists), "x.yaml")
    assert digests(read_blueprint(listed)) == digests(read_blueprint(document))


def _as_list(value: Any) -> str:
    if not isinstance(value, dict):
        return str(value)
    return f"[{', '.join(f'{name}: {_as_list(inner)}' for name, inner in value.items())}]"


COMMENTED = """\
// the file
{
    // the name
    # NAME: SB1
    # INITIAL: State0  // the header
    // a state
    State0: [  // its line
        go -> State1,  // an edge
        // a field
        # _note: "// no comment"
        stay -> State0
        // the end of a state
    ],
    State1: [ ]
    // the end of an SB
}
// the end
"""


def test_comments_go_along_between_the_forms_that_have_them() -> None:
    document = form_named("smsl").parse(COMMENTED, "x.smsl")
    yaml = to(document, "yaml")
    back = to(yaml, "smsl")
    words = sorted(line.partition("//")[2].strip() for line in COMMENTED.splitlines())
    for text, mark in ((yaml.text, "# "), (back.text, "// ")):
        for said in filter(None, words):
            assert said == 'no comment"' or f"{mark}{said}\n" in text
    assert to(to(back, "yaml"), "smsl").text == back.text
    noted = form_named("yaml").parse("SB: # name\n  _n: 1  # field\n  S: {}  # state\n", "x.yaml")
    assert to(noted, "smsl").text == (
        "// name\n{\n    # NAME: SB\n    // field\n    # _n: 1\n\n    S: [ ]  // state\n}\n"
    )
    left = convert(document, "json", "x.json")
    assert left.comments_left == COMMENTED.count("//") - 1
    assert convert(left.document, "yaml", "x.yaml").comments_left == 0


@pytest.mark.parametrize("form", ["smsl", "yaml"])
@pytest.mark.parametrize("name", ["hfsm", "registration-digitization"])
def test_a_history_of_edits_means_the_same_in_every_form(name: str, form: str) -> None:
    document = read_document(samples_dir() / f"{name}.json")
    ours, theirs = read_blueprint(to(document, form)), read_blueprint(document)
    done = 0
    for seed in range(60):
        try:
            theirs = random_edit(random.Random(seed), theirs)
        except EditRefused:
            with pytest.raises(EditRefused):
                random_edit(random.Random(seed), ours)
            continue
        ours = random_edit(random.Random(seed), ours)
        assert ours == theirs, seed
        again = form_named(form).parse(ours.document.text, "x")
        assert again.values == ours.document.values
        done += 1
    assert done > 15


@settings(max_examples=share_of(60))
@given(FILES, st.integers(0, 10**6), st.sampled_from(("smsl", "yaml")))
def test_comments_anywhere_survive_tidying_and_converting(
    values: Json, seed: int, form: str
) -> None:
    text, words = commented(to(parse_json(write_json(values), "x.json"), form).text, form, seed)
    document = form_named(form).parse(text, "x")
    other = "yaml" if form == "smsl" else "smsl"
    for after in (form_named(form).tidy(document), to(document, other)):
        assert [word for word in words if word not in after.text] == []
        assert form_named(after.form).parse(after.text, "x").values == after.values
        must_mean_the_same(document, after)


def commented(text: str, form: str, seed: int) -> tuple[str, list[str]]:
    """A text with comments on lines of their own and behind others, and the word of each."""
    chance, mark = random.Random(seed), "//" if form == "smsl" else "#"
    lines: list[str] = []
    words: list[str] = []
    for written in text.split("\n"):
        line = written
        if chance.random() < 0.3:
            words.append(f"word{len(words)}.")
            lines.append(f"{' ' * chance.choice((0, 2, 4, 6, 8))}{mark} {words[-1]}")
        if chance.random() < 0.2 and line.strip():
            words.append(f"word{len(words)}.")
            line = f"{line} {mark} {words[-1]}"
        lines.append(line)
    return "\n".join(lines), words


@pytest.mark.parametrize(
    "char", ["\u2028", "\u2029", "\x85", "\x01", "\x0c", "\x7f", "\ufeff", "\uffff"]
)
def test_a_comment_puts_nothing_into_yaml_but_words(char: str) -> None:
    said = f" one {char}Other: {{State_0: {{}}}}"
    text = f"//{said}\n{{\n    # NAME: SB //{said}\n    State_0: [ ] //{said}\n}}\n//{said}\n"
    document = form_named("smsl").parse(text, "f.smsl")
    there = to(document, "yaml")
    assert there.values == document.values
    assert there.text.count("Other: {State_0") == 4
    assert form_named("yaml").tidy(there).text == there.text


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_lines_are_counted_by_whichever_line_ends_there_are(form: str, newline: str) -> None:
    doors = form_named(form)
    text = doors.write({"SB": {"State_0": {"a": "State_1"}, "State_1": {}}})
    plain = doors.parse(text, "f")
    ended = doors.parse(text.replace("\n", newline), "f")
    for path in (("SB",), ("SB", "State_0"), ("SB", "State_0", "a"), ("SB", "State_1")):
        assert ended.place(path) == plain.place(path)
    mixed = doors.parse("\r" + text.replace("\n", "\r\n", 1), "f")
    assert mixed.place(("SB", "State_1")).line == plain.place(("SB", "State_1")).line + 1


def test_comments_around_an_arrow_go_along() -> None:
    text = (
        "{\n# NAME: SB\nState_0: [a // one\n// two\n-> // three\n// four\nState_0 // five\n"
        ', "b b"->// six\nState_0]}'
    )
    document = form_named("smsl").parse(text, "f.smsl")
    words = ["one", "two", "three", "four", "five", "six"]
    there = to(document, "yaml")
    back = to(there, "smsl")
    for found in (there, back, form_named("smsl").tidy(document)):
        assert found.values == document.values
        assert all(len(re.findall(rf"\b{word}\b", found.text)) == 1 for word in words)


def test_what_is_written_twice_is_not_thrown_away() -> None:
    text = '{"SB": {"S": {"a": "S", "a": "T"}, "T": {}}}'
    document = parse_json(text, "x.json")
    assert to(document, "json").text == text
    for form in ("smsl", "yaml"):
        with pytest.raises(ConvertError, match="written 2 times") as caught:
            convert(document, form, "x")
        assert str(caught.value.place) == "x.json:1:25"
        assert caught.value.advice
