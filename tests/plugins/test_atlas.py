"""The atlas of faults predicts without physics; benches/atlas.py runs its cells."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from benches.atlas import HELD, RECOVERED, UNDISTURBED, Cell, _kept, edges_of, foreseen, page
from smsl_studio.blueprint.address import Address
from smsl_studio.front.inputs import read
from smsl_studio.shipped import samples_dir
from tests.plugins.faulted import WITH_FAILURES


@pytest.mark.parametrize(
    ("edge", "fault", "end", "facts"),
    [
        ("State_aaa/Op_1b", "gripper_opens", RECOVERED, "xaa"),
        ("State_aaa/Op_1b", "slippery", HELD, "xaa"),
        ("State_caa/Op_2b", "blocked_peg", HELD, "cha"),
        ("State_aaa/Op_1b", "tower_carried", RECOVERED, "bba"),
        ("State_baa/Op_1a", "tower_carried", UNDISTURBED, "aaa"),
        ("State_aaa/Op_1c", "wrong_order", RECOVERED, "cax"),
        ("State_aaa/Op_1c", "seized_joint", HELD, "aaa"),
        ("State_aaa/Op_1c", "disk_off_board", HELD, "?aa"),
        ("State_aaa/Op_1c", "weak_grip", HELD, "aaa"),
    ],
)
def test_what_a_fault_leads_to_is_known_from_the_blueprint(
    edge: str, fault: str, end: str, facts: str
) -> None:
    told = foreseen(Address("SB1", *edge.split("/")), fault)
    assert (told.end, told.facts) == (end, facts)


def test_all_operations_but_the_recoveries_have_a_row() -> None:
    assert len(edges_of(read(samples_dir() / WITH_FAILURES))) == 78


def test_a_cell_that_ends_otherwise_than_predicted_says_why(tmp_path: Path) -> None:
    good = Cell("SB1/State_aaa/Op_1b", "slippery", HELD, "xaa", HELD, "xaa", "It held.", (), 1.0)
    odd = Cell("SB1/State_aaa/Op_1c", "slippery", RECOVERED, "xaa", HELD, "?aa", "Why.", (), 1.0)
    text = page([good, odd])
    assert "| aaa Op_1b | H |" in text
    assert "| aaa Op_1c | R→H 1 |" in text
    assert "1. `slippery`, 1 cells: predicted recovered, held." in text
    assert "- aaa Op_1c: facts ?aa, predicted xaa: Why." in text
    keep = tmp_path / "atlas.jsonl"
    keep.write_text("\n".join(json.dumps({"number": n, **asdict(one)}) for n, one in
                              enumerate((good, odd))) + "\n{cut", "utf-8")  # fmt: skip
    assert dict(_kept(keep)) == {0: good, 1: odd}
