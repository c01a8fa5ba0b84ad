"""Previews: what is predicted is what happens, and a difference is told."""

from __future__ import annotations

from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import AddressError, UsageError
from smsl_studio.runlog.events import EdgeSwept
from smsl_studio.shipped import plugins_dir, samples_dir

HANOI = samples_dir() / "hanoi-corrected.json"


@pytest.mark.parametrize("name", ["hanoi-2", "registration-digitization", "three-levels"])
def test_every_edge_agrees_where_a_sweep_passes(name: str) -> None:
    blueprint = smsl.read(samples_dir() / f"{name}.json")
    swept = [one for one in smsl.sweep(blueprint) if isinstance(one, EdgeSwept)]
    told = {one.address: smsl.preview(blueprint, one.address).agrees for one in swept}
    assert told == {one.address: one.passed for one in swept}


def test_the_misprint_of_the_paper_is_predicted_by_physics() -> None:
    blueprint = smsl.read(samples_dir() / "hanoi.json")
    told = smsl.preview(blueprint, "SB1/State_cbb/Op_1c", "hanoi")
    assert (told.agrees, told.share) == (False, 0.0)
    assert (told.after["SB1/0"], told.declared["SB1/0"]) == ("c", "b")


def test_the_route_is_looked_at_ahead() -> None:
    told = smsl.preview(smsl.read(HANOI), "SB1/State_aaa/Op_1c", ahead=4)
    assert [one.edge for one in (told, *told.then)] == [
        "SB1/State_aaa/Op_1c",
        "SB1/State_caa/Op_2b",
        "SB1/State_cba/Op_1b",
        "SB1/State_bba/Op_3c",
    ]
    assert all(one.agrees for one in told.then)
    assert told.then[-1].before == told.then[-2].after


def test_repeats_have_seeds_of_their_own() -> None:
    """A stack of two pieces, each time jittered anew."""
    blueprint = smsl.read(plugins_dir() / "chess" / "chess.json")
    edge = "SB1/State_dB1B/move-star-chess-to-block-1"
    told = smsl.preview(blueprint, edge, "chess", repeats=3)
    assert (told.after["SB1/0"], told.share) == ("1T", 1.0)


def test_it_begins_where_a_log_ended(tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    blueprint = smsl.read(HANOI)
    smsl.run(blueprint, log=log)
    told = smsl.preview(blueprint, "SB1/State_ccc/Op_1a", log=log)
    assert (told.before["SB1/0"], told.after["SB1/0"]) == ("c", "a")
    with pytest.raises(UsageError, match="does not leave the start: SB1 is in State_ccc"):
        smsl.preview(blueprint, "SB1/State_aaa/Op_1b", log=log)


def test_a_hazard_that_would_be_met_is_named() -> None:
    blueprint = smsl.read(samples_dir() / "hanoi-hazard.json")
    told = [smsl.preview(blueprint, edge.address) for edge in blueprint["SB1"].edges()]
    named = {one.hazard for one in told if one.hazard}
    assert len(named) == 1


@pytest.mark.parametrize(
    ("edge", "more", "error"),
    [
        ("SB1/State_aaa", {}, UsageError),
        ("SB1/State_aaa/Op_9z", {}, AddressError),
        ("SB1/State_aaa/Op_1b", {"start": "SB1/State_ccc"}, UsageError),
        ("SB1/State_aaa/Op_1b", {"repeats": 0}, UsageError),
        ("SB1/State_aaa/Op_1b", {"ahead": 0}, UsageError),
    ],
)
def test_what_cannot_be_asked_is_refused(
    edge: str, more: dict[str, object], error: type[Exception]
) -> None:
    with pytest.raises(error):
        smsl.preview(smsl.read(HANOI), edge, **more)  # type: ignore[arg-type]


def test_a_log_of_several_roots_gives_the_states_of_all(tmp_path: Path) -> None:
    """Each commit names only the SBs that moved."""
    log = tmp_path / "run.jsonl"
    blueprint = smsl.read(samples_dir() / "three-roots.json")
    done = smsl.run(blueprint, log=log)
    assert done.reason == "goal_reached"
    told = smsl.preview(blueprint, "ROBOT/State11/Retract", log=log)
    assert {key: value for key, value in told.before.items() if key.startswith("REG")} == {
        "REGISTRATION/0": "1",
        "REGISTRATION/2": "1",
    }


def test_a_log_of_another_blueprint_is_refused(tmp_path: Path) -> None:
    log = tmp_path / "run.jsonl"
    smsl.run(smsl.read(samples_dir() / "hanoi-2.json"), log=log)
    with pytest.raises(UsageError, match="the log of another blueprint"):
        smsl.preview(smsl.read(HANOI), "SB1/State_aaa/Op_1b", log=log)
