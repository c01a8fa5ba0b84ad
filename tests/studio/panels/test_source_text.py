"""Between text and elements: lines of an address, the address at a place, and patches."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given
from hypothesis import strategies as st

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.json_form import parse_json
from smsl_studio.studio.panels.source_text import Lines, SourceText, patches

SAMPLES = Path(__file__).parents[3] / "samples"
TEXTS = st.text(st.sampled_from('ab\n{}"é𝛼'), max_size=60)


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(SAMPLES / name))


def patched(old: str, new: str) -> str:
    text = old
    for start, end, part in patches(old, new):
        text = text[:start] + part + text[end:]
    return text


@given(TEXTS, TEXTS)
def test_patches_turn_one_text_into_the_other(old: str, new: str) -> None:
    assert patched(old, new) == new


def test_only_the_lines_that_differ_are_patched() -> None:
    old = "\n".join(f"line {n}" for n in range(1000))
    new = old.replace("line 7\n", "other\n").replace("line 900\n", "another\n")
    assert sum(len(part) for _, _, part in patches(old, new)) < 20
    assert patched(old, new) == new


def test_every_element_is_found_where_it_is_written() -> None:
    for name in ("hfsm.json", "hanoi.json", "registration.json"):
        blueprint = sample(name)
        source = SourceText(blueprint)
        for branch in blueprint:
            for edge in branch.edges():
                place = blueprint.place(edge.address)
                assert source.address_at(place.line - 1, place.column - 1) == edge.address
                lines = source.lines_of(edge.address)
                assert lines == Lines(place.line - 1, place.line - 1)


def test_headers_and_notes_belong_to_their_sb() -> None:
    source = SourceText(sample("hfsm.json"))
    lines = sample("hfsm.json").document.text.splitlines()
    for word, address in (('NUM_FACTS": 3', Address("SB1")), ('"_comments"', None)):
        at = next(n for n, line in enumerate(lines) if word in line)
        assert source.address_at(at, lines[at].index('"') + 1) == address
    assert source.lines_of(Address("SB1", "Gone")) is None


def test_line_ends_and_a_bom_change_no_line() -> None:
    text = '\ufeff{\r\n "SB1": {\r\n  "State0": {"Op": "State0"}\r\n }\r\n}\r\n'
    blueprint = read_blueprint(parse_json(text, "a.json"))
    source = SourceText(blueprint)
    assert source.shown.split("\n")[2] == '  "State0": {"Op": "State0"}'
    assert source.address_at(2, 14) == Address("SB1", "State0", "Op")
    assert source.address_at(0, 0) is None
