"""Heads of logs: who may sign one, and that the right key makes no impossible story true."""

from __future__ import annotations

from pathlib import Path
from random import Random

from benches.forged import heads_believed
from tests.front.forged_heads import (
    RIGHT,
    SIGNERS,
    headed,
    is_believed_by_replay,
    known_keys,
)
from tests.front.told_runs import ToldRun, told_runs
from tests.runlog.impossible import Story

RUNS = range(16)
"""Of 1,000, which ``benches/forged.py`` has."""


def test_only_the_right_key_is_believed_and_only_of_a_possible_story(tmp_path: Path) -> None:
    counts = heads_believed(told_runs(RUNS, tmp_path), Random("heads"))
    assert counts["wrong"] == counts["apart"] == 0
    for key in SIGNERS:
        assert counts[f"made {key}"] > 40
        if key != RIGHT:
            assert counts[f"believed {key}"] == 0
    assert len(RUNS) <= counts[f"believed {RIGHT}"] < counts[f"made {RIGHT}"]


def test_an_odd_cost_hides_no_wrong_signature(tmp_path: Path) -> None:
    """What only the general rules find odd is a note, and the signature is asked all the same."""
    told = ((Story.of(run.raw), run.blueprint) for run in told_runs(RUNS, tmp_path))
    story, blueprint = next(one for one in told if one[0].at("route_planned"))
    story.events[story.at("route_planned")[0]]["cost"] += 1.0
    with known_keys():
        for key, signer in SIGNERS.items():
            one = ToldRun(headed(story.raw(), signer), blueprint)
            assert is_believed_by_replay(one) == (key == RIGHT), key
