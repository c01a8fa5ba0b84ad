"""DOT and Mermaid have every state and operation once, and a name never means anything there."""

from __future__ import annotations

import itertools
import json
from collections import Counter
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.legible import one_line
from smsl_studio.picture.dot import as_dot
from smsl_studio.picture.mermaid import as_mermaid
from smsl_studio.picture.part import PicturePart, chosen_part, whole_part
from smsl_studio.picture.picture import Picture
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json
from tests.hostile_names import BLUEPRINT, hidden
from tests.picture.diagrams import Diagram, read_dot, read_mermaid

FORMS: dict[str, Callable[[str], Diagram]] = {"dot": read_dot, "mermaid": read_mermaid}
HARD = st.text(st.sampled_from('ab"\\#;:&<>%{}[]|\n\t -\u202e\u00e9\u4e2d'), min_size=1, max_size=6)


def of(values: Any) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values), "test.json"))


def parts_of(blueprint: Blueprint) -> list[PicturePart]:
    return [whole_part(Picture(blueprint, name)) for name in blueprint.branches]


def read(form: str, parts: list[PicturePart]) -> Diagram:
    text = (as_dot if form == "dot" else as_mermaid)(parts)
    assert not hidden(text)
    return FORMS[form](text)


def shows_all(found: Diagram, blueprint: Blueprint) -> None:
    states = Counter(one_line(state) for branch in blueprint for state in branch.table)
    wanted = Counter(
        (one_line(state), one_line(target), one_line(operation).strip())
        for branch in blueprint
        for state, operations in branch.table.items()
        for operation, target in operations.items()
    )
    arrows = Counter(
        (found.nodes[a], found.nodes[b], words.strip()) for a, b, words in found.arrows
    )
    assert arrows == wanted
    missing = Counter(found.nodes.values()) - states
    targets = {target for _, target, _ in wanted} | set(states)
    assert not states - Counter(found.nodes.values())
    assert set(missing) <= targets


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", ["hanoi", "hfsm", "three-roots", "registration-people"])
def test_a_sample_has_every_state_and_operation(form: str, name: str) -> None:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    found = read(form, parts_of(blueprint))
    shows_all(found, blueprint)
    several = len(blueprint.branches) > 1
    assert found.groups == (list(blueprint.branches) if several else [])


@pytest.mark.parametrize("form", FORMS)
def test_hostile_names_are_text(form: str) -> None:
    blueprint = of(BLUEPRINT)
    shows_all(read(form, parts_of(blueprint)), blueprint)


@given(st.lists(HARD, min_size=2, max_size=4, unique=True), HARD)
def test_any_names_are_text(names: list[str], operation: str) -> None:
    table = {name: {operation: target} for name, target in itertools.pairwise(names)}
    values = {"SB": table | {names[-1]: {}}, 'S"\\': {"a": {"b": "nowhere"}}}
    blueprint = of(values)
    for form in FORMS:
        shows_all(read(form, parts_of(blueprint)), blueprint)


def test_names_that_look_alike_are_different_nodes() -> None:
    blueprint = of({"SB": {"a\u200b": {"x": "a\\u200b"}, "a\\u200b": {"y": "a\u200b"}}})
    found = read("dot", parts_of(blueprint))
    assert len(found.nodes) == 2
    (first, second, _), (third, fourth, _) = found.arrows
    assert (first, second) == (fourth, third)
    assert first != second


@pytest.mark.parametrize("form", FORMS)
def test_a_selection_is_its_states_and_what_lies_between(form: str) -> None:
    blueprint = smsl.read(samples_dir() / "hanoi.json")
    picture = Picture(blueprint, "SB1")
    chosen = [Address("SB1", "State_aaa"), Address("SB1", "State_baa"), Address("SB1", "State_ccc"),
              Address("SB1", "State_bbb", "Op_1c"), Address("SB1", "gone"),
              Address("SB2", "State_aba")]  # fmt: skip
    found = read(form, [chosen_part(picture, chosen)])
    assert sorted(found.nodes.values()) == [
        "State_aaa", "State_baa", "State_bbb", "State_cbb", "State_ccc"]  # fmt: skip
    assert sorted(words for _, _, words in found.arrows) == ["Op_1a", "Op_1b", "Op_1c"]


def test_initial_and_activating_are_marked() -> None:
    parts = parts_of(smsl.read(samples_dir() / "hanoi.json"))
    assert '"State_aaa" [label="State_aaa", style="rounded,bold"];' in as_dot(parts)
    assert '"State_ccc" [label="State_ccc", peripheries=2];' in as_dot(parts)
    mermaid = as_mermaid(parts)
    initial = next(line for line in mermaid.splitlines() if "State_aaa" in line).split()[-1]
    assert f"[*] --> {initial}\n" in mermaid
    activating = next(line for line in mermaid.splitlines() if "State_ccc" in line).split()[-1]
    assert f"class {activating} activating\n" in mermaid
