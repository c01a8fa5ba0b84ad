"""From elements to their lines and back, exactly, and in a broken text."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.forms import form_named
from smsl_studio.studio.features.draw.source.elements import Elements, LineRange
from smsl_studio.studio.features.draw.source.sheet import TextSheet

SAMPLES = Path(__file__).parents[5] / "samples"
NAMES = ("hfsm.json", "hanoi.json", "registration.json")


def sample(name: str) -> Blueprint:
    return read_blueprint(read_document(SAMPLES / name))


def elements(blueprint: Blueprint, more: str = "") -> Elements:
    """Those of a blueprint's text; with something before it, it is no longer the document's."""
    return Elements(TextSheet(more + blueprint.document.text), blueprint.document)


@pytest.mark.parametrize("more", ["", "%\n"], ids=["read", "broken"])
def test_every_element_is_found_where_it_is_written(more: str) -> None:
    for name in NAMES:
        blueprint = sample(name)
        found = elements(blueprint, more)
        for branch in blueprint:
            for edge in list(branch.edges())[:: 7 if more else 1]:
                place = blueprint.place(edge.address)
                line = place.line - 1 + bool(more)
                assert found.address_at(line, place.column - 1) == edge.address
                assert found.lines_of(edge.address) == LineRange(line, line)


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_states_and_sbs_are_found_in_every_form_the_same_way_when_it_breaks(form: str) -> None:
    values = sample("hfsm.json").document.values
    text = form_named(form).write(values)
    blueprint = read_blueprint(form_named(form).parse(text, f"a.{form}"))
    read, broken = elements(blueprint), elements(blueprint, "%\n")
    for branch in blueprint:
        for state, operations in branch.table.items():
            addresses = [Address(branch.name), Address(branch.name, state)]
            addresses += [Address(branch.name, state, name) for name in operations]
            for address in addresses:
                exact, seen = read.lines_of(address), broken.lines_of(address)
                assert exact is not None
                assert seen is not None
                assert seen.first == exact.first + 1


def test_headers_and_notes_belong_to_their_sb() -> None:
    blueprint = sample("hfsm.json")
    found = elements(blueprint)
    lines = blueprint.document.text.splitlines()
    for word, address in (('NUM_FACTS": 3', Address("SB1")), ('"_comments"', None)):
        at = next(n for n, line in enumerate(lines) if word in line)
        assert found.address_at(at, lines[at].index('"') + 1) == address
    assert found.lines_of(Address("SB1", "Gone")) is None
    assert elements(blueprint, "{").lines_of(Address("SB1", "Gone")) is None


def test_line_ends_and_a_bom_change_no_line() -> None:
    text = '\ufeff{\r\n "SB1": {\r\n  "State0": {"Op": "State0"}\r\n }\r\n}\r\n'
    blueprint = read_blueprint(form_named("json").parse(text, "a.json"))
    found = elements(blueprint)
    assert found.address_at(2, 14) == Address("SB1", "State0", "Op")
    assert found.address_at(0, 0) is None
    assert found.lines_of(Address("SB1", "State0")) == LineRange(2, 2)


def test_names_lead_to_what_they_stand_for() -> None:
    blueprint = sample("hfsm.json")
    found = elements(blueprint)
    for word, address in (
        ('"Operation000": "State100"', Address("SB1", "State100")),
        ('"INITIAL": "State000"', Address("SB1", "State000")),
        ('"SB2": 1', Address("SB2")),
    ):
        lines = blueprint.document.text.splitlines()
        at = next(n for n, line in enumerate(lines) if word in line)
        column = lines[at].index(address.state or address.branch) + 1
        assert found.definition(at, column) == address
    assert found.definition(0, 0) is None
