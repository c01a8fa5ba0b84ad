"""Hanoi generated from the rules of the game, compared with the paper's blueprint and with
arithmetic."""

from __future__ import annotations

import json

import pytest

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import UsageError
from smsl_studio.generate.rules import hanoi, hanoi_failures, level_values
from smsl_studio.inspection.inspect import inspect
from smsl_studio.inspection.rules.finding import Severity
from smsl_studio.shipped import samples_dir
from smsl_studio.smsl.json_form import parse_json


def sample(name: str) -> Blueprint:
    return read_blueprint(parse_json((samples_dir() / name).read_text("utf-8"), name))


@pytest.mark.parametrize(
    ("disks", "name"), [(2, "hanoi-2.json"), (3, "hanoi-corrected.json"), (4, "hanoi-4.json")]
)
def test_the_rules_give_the_sample(disks: int, name: str) -> None:
    assert hanoi(disks) == sample(name)


@pytest.mark.parametrize("name", ["hanoi-2.json", "hanoi-4.json"])
def test_the_generated_samples_are_written_as_the_rules_write_them(name: str) -> None:
    disks = int(name[6])
    assert (samples_dir() / name).read_text("utf-8") == hanoi(disks).document.text


def test_the_paper_prints_two_edges_that_the_rules_do_not_give() -> None:
    ruled = {(e.source, e.name, e.target) for e in hanoi(3)["SB1"].edges()}
    printed = {(e.source, e.name, e.target) for e in sample("hanoi.json")["SB1"].edges()}
    assert {edge[:2] for edge in printed - ruled} == {
        ("State_cbb", "Op_1c"),
        ("State_cbc", "Op_2b"),
    }


@pytest.mark.parametrize("disks", [1, 2, 3, 4, 5])
def test_the_game_has_as_many_states_and_moves_as_it_must(disks: int) -> None:
    branch = hanoi(disks)["SB1"]
    assert len(branch.table) == 3**disks
    assert branch.edge_count == 3 * (3**disks - 1)  # 3 in each state, 2 in the three corners
    assert branch.initial == f"State_{'a' * disks}"
    assert branch.activating == f"State_{'c' * disks}"
    assert branch.num_facts == disks


def test_every_move_can_be_taken_back() -> None:
    branch = hanoi(4)["SB1"]
    assert all(edge.source in branch.table[edge.target].values() for edge in branch.edges())


@pytest.mark.parametrize("disks", [0, -1, 13])
def test_a_number_of_disks_that_makes_no_sense_is_refused(disks: int) -> None:
    with pytest.raises(UsageError):
        hanoi(disks)


def test_levels_of_switches_expand_each_other_and_are_without_error() -> None:
    values = level_values((3, 3, 2))
    blueprint = read_blueprint(parse_json(json.dumps(values), "levels.json"))
    assert blueprint.roots == ("Level1",)
    assert blueprint.bases == {"Level2": (("Level1", 1),), "Level3": (("Level2", 1),)}
    assert blueprint.operation_count == 3 * 8 + 3 * 8 + 2 * 4
    assert not [one for one in inspect(blueprint) if one.severity is Severity.ERROR]
    assert sum(map(len, level_values()["Level1"].values())) == 12 * 2**12 + 1


def test_hanoi_with_failures_is_the_game_and_a_way_back_for_every_lost_disk() -> None:
    written = (samples_dir() / "hanoi-failures.json").read_text("utf-8")
    assert written == hanoi_failures(3).document.text
    branch, game = hanoi_failures(3)["SB1"], hanoi(3)["SB1"]
    assert all(dict(branch.table[state]) == dict(game.table[state]) for state in game.table)
    for state in branch.table.keys() - game.table.keys():
        facts = branch.facts(state)
        (lost,) = [disk for disk, value in enumerate(facts) if value in "hx"]
        for operation, target in branch.table[state].items():
            assert target in game.table
            assert operation == f"Op_recover{lost + 1}{branch.facts(target)[lost]}"
        smaller = set(facts[:lost])
        assert len(branch.table[state]) == 3 - len(smaller)
