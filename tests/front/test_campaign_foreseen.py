"""What the blueprint foresees of a fault, and cells that end otherwise."""

from __future__ import annotations

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.front.campaign_foreseen import CampaignForesight, finding_of
from smsl_studio.front.campaign_rates import proposals
from smsl_studio.front.campaign_runs import Injection, RunVerdict
from smsl_studio.front.campaign_tally import CampaignTally
from smsl_studio.shipped import samples_dir

HANOI = smsl.read(samples_dir() / "hanoi-2.json")
EDGE = Address("SB1", "State_aa", "Op_1b")


def test_another_way_is_foreseen_where_there_is_one() -> None:
    told = CampaignForesight(HANOI)
    assert told.look(str(EDGE)) == "reached", "the ring goes to the other peg first"
    one_way = CampaignForesight(HANOI, goals=("SB1/State_ba",))
    assert one_way.look(str(EDGE)) == "reached"
    assert told.look("SB1/State_nowhere/Op_1b") == "", "nothing can be foreseen of it"
    tower = smsl.read(samples_dir() / "femoroplasty.json")
    ends = {
        CampaignForesight(tower).look(str(edge.address))
        for branch in tower
        for edge in branch.edges()
    }
    assert "held" in ends


def test_a_cell_differs_when_most_of_its_runs_ended_otherwise() -> None:
    tally, told = CampaignTally(), CampaignForesight(HANOI)
    tally.begin([Injection("slip", EDGE)], 3)
    (cell,) = tally.cells
    assert told.look(cell.edge) == "reached"
    held, reached = (RunVerdict(ok, False, why, "0" * 64) for ok, why in (
        (False, "held"), (True, "goal_reached")))  # fmt: skip
    tally.hear(0, 0, held)
    assert not told.differs(cell), "not all runs are done"
    tally.hear(0, 1, held)
    tally.hear(0, 2, reached)
    assert told.differs(cell)
    words = finding_of(cell, "reached", "hanoi")
    assert words.startswith("Campaign in the world hanoi: slip in Op_1b. Foreseen: reached")
    assert words.endswith("Seen: 1 reached, 2 held of 3 runs.")


def test_runs_that_were_refused_say_nothing_of_a_fault() -> None:
    tally, told = CampaignTally(), CampaignForesight(HANOI)
    tally.begin([Injection("slip", EDGE)], 2)
    (cell,) = tally.cells
    assert told.look(cell.edge) == "reached"
    tally.hear(0, 0, RunVerdict(False, False, "refused", "0" * 64))
    assert tally.of_edge(cell.edge).nothing == "no run began"
    tally.hear(0, 1, RunVerdict(False, False, "refused", "0" * 64))
    assert not told.differs(cell)
    assert cell.counts == {"reached": 0, "refused": 2, "held": 0, "failed": 0}
    tally.begin([Injection("slip", EDGE)], 2)
    (cell,) = tally.cells
    tally.hear(0, 0, RunVerdict(False, False, "refused", "0" * 64))
    tally.hear(0, 1, RunVerdict(True, False, "goal_reached", "0" * 64))
    share = tally.of_fault("slip")
    assert (share.reached, share.runs, share.refused) == (1, 1, 1)
    assert not told.differs(cell)
    assert proposals(HANOI, tally)[0].risk == "low"
