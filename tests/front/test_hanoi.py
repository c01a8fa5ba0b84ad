"""Hanoi in physics, through the front door: solved, repeated, swept."""

from __future__ import annotations

import smsl_studio as smsl
from smsl_studio.blueprint import editing
from smsl_studio.blueprint.address import Address
from smsl_studio.runlog.events import Committed, EdgeSwept, StateChecked, SweepFinished
from smsl_studio.shipped import samples_dir


def _sample(name: str) -> str:
    return str(samples_dir() / f"{name}.json")


def test_the_tower_is_moved_the_same_way_in_both_hosts() -> None:
    blueprint = smsl.read(_sample("hanoi-corrected"))
    here, there = (
        smsl.run(blueprint, "hanoi", "State_ccc", "State_aaa", seed=0, host=host)
        for host in ("local", "process")
    )
    assert here == there
    assert here.reason == "goal_reached"
    assert sum(isinstance(event, Committed) for event in here.events) == 7
    checks = [event for event in here.events if isinstance(event, StateChecked)]
    assert [check.result for check in checks] == ["true"] * 8


def test_two_disks_too() -> None:
    run = smsl.run(smsl.read(_sample("hanoi-2")), "hanoi", seed=4)
    assert run.reason == "goal_reached"


def test_a_sweep_of_the_papers_file_finds_its_two_misprints() -> None:
    """A sweep of the misprints and of each tenth operation; the bench ``physics`` sweeps all 78."""
    whole = smsl.read(_sample("hanoi"))
    every = [edge.address for branch in whole for edge in branch.edges()]
    odd = {Address("SB1", "State_cbb", "Op_1c"), Address("SB1", "State_cbc", "Op_2b")}
    others = [edge for at, edge in enumerate(every) if at % 10 and edge not in odd]
    *edges, last = smsl.sweep(editing.delete(whole, others), "hanoi")
    assert isinstance(last, SweepFinished)
    assert (last.edges, last.passed) == (9, 7)
    assert last.failed == ("SB1/State_cbb/Op_1c", "SB1/State_cbc/Op_2b")
    wrong = [e for e in edges if isinstance(e, EdgeSwept) and not e.passed]
    assert [(e.source, e.target) for e in wrong] == [("true", "false")] * 2
    assert all(e.sentence for e in wrong)
