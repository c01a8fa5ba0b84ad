"""The rows and words of the continuum, computed from the levels of a blueprint alone."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.studio.document.files.fresh import empty_blueprint
from smsl_studio.studio.features.people.continuum_view import ContinuumView, continuum_view
from tests.stories.person import sample


def _blueprint() -> Blueprint:
    return sample("three-roots.json")


def _view(before: Mapping[str, str]) -> ContinuumView:
    blueprint = _blueprint()
    return continuum_view(blueprint, Levels(blueprint, before))


def _words(before: Mapping[str, str]) -> list[str]:
    return [row.words for row in _view(before).rows]


def test_without_a_declaration_everything_is_automatic_and_a_person_may_step_in() -> None:
    view = _view({})
    edges = sum(branch.edge_count for branch in _blueprint())
    assert [row.name for row in view.rows] == ["Operations", "Facts", "Inspection", "Supervision"]
    assert [row.words for row in view.rows] == [
        f"{edges} automatic", "7 automatic", "rules alone", "human may step in",
    ]  # fmt: skip
    assert view.words == "mostly automatic"
    assert all(row.low == row.high for row in view.rows)


def test_a_band_reaches_from_the_most_human_to_the_most_automatic() -> None:
    row = _view({"TOOLPLAN/ChooseEntry": "human", "ROBOT/SwitchOn": "shared"}).rows[0]
    assert (row.low, row.high) == (0.0, 1.0)
    assert 0.8 < row.position < 1.0
    assert row.words.startswith("2 of ")
    assert row.words.endswith(" human")
    shared = _view({"ROBOT/SwitchOn": "shared"}).rows[0]
    assert (shared.low, shared.high) == (0.5, 1.0)
    assert shared.words.endswith(" shared")


def test_the_two_layers_say_what_they_mean() -> None:
    assert _words({"inspection": "human", "supervision": "human"})[2:] == [
        "a person accepts",
        "human leads",
    ]
    assert _words({"inspection": "shared", "supervision": "automatic"})[2:] == [
        "a person, if need be",
        "agent decides",
    ]


@pytest.mark.parametrize(("level", "words"), [("human", "human"), ("automatic", "automatic")])
def test_a_procedure_with_one_level_throughout_says_so(level: str, words: str) -> None:
    blueprint = _blueprint()
    before = {"inspection": level, "supervision": level}
    for branch in blueprint:
        for edge in branch.edges():
            before[str(edge.address)] = level
        for digit in range(branch.num_facts):
            if digit not in branch.subs:
                before[f"{branch.name}/{digit}"] = level
    view = continuum_view(blueprint, Levels(blueprint, before))
    assert view.words == words
    assert view.position == (0.0 if level == "human" else 1.0)


def test_a_blueprint_without_states_has_nothing_to_count() -> None:
    empty = empty_blueprint()
    view = continuum_view(empty, Levels(empty))
    assert [row.words for row in view.rows[:2]] == ["none", "none"]
