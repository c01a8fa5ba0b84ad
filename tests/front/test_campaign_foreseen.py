"""What is foreseen of a fault, and cells that end otherwise."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import smsl_studio as smsl
from smsl_studio.blueprint.address import Address
from smsl_studio.front.campaign_faults import CampaignRequest, arguments_of
from smsl_studio.front.campaign_foreseen import CampaignForesight, finding_of
from smsl_studio.front.campaign_rates import proposals
from smsl_studio.front.campaign_runs import Injection, RunVerdict
from smsl_studio.front.campaign_tally import CampaignTally
from smsl_studio.front.fault_foresight import FaultForesight
from smsl_studio.front.hosts import known_world
from smsl_studio.library.fault_effect import FaultEffect
from smsl_studio.shipped import samples_dir
from tests.cases import case

HANOI = smsl.read(samples_dir() / "hanoi-2.json")
EDGE = Address("SB1", "State_aa", "Op_1b")
SLIP = Injection("slip", EDGE)


def told(ok: bool, why: str) -> RunVerdict:
    return RunVerdict(ok, False, why, "0" * 64)


def look(request: CampaignRequest, edge: Address) -> str:
    found = CampaignForesight(request).look(Injection("fail", edge))
    return found.end if found is not None else ""


def test_another_way_is_foreseen_where_there_is_one() -> None:
    request = CampaignRequest(HANOI)
    assert look(request, EDGE) == "reached", "the ring goes to the other peg first"
    assert look(replace(request, goals=("SB1/State_ba",)), EDGE) == "reached"
    assert look(request, Address("SB1", "State_nowhere", "Op_1b")) == ""
    assert CampaignForesight(request).look(None) is None
    tower = smsl.read(samples_dir() / "femoroplasty.json")
    ends = {
        look(CampaignRequest(tower), edge.address) for branch in tower for edge in branch.edges()
    }
    assert "held" in ends


def test_the_effect_of_a_fault_decides_where_a_run_goes_on() -> None:
    """The plugin says what a fault does to the facts, and what stays impossible."""
    loaded = known_world("hanoi")
    assert loaded is not None
    faults = dict(loaded.faults_of("hanoi"))
    arguments = arguments_of(HANOI, "hanoi", loaded)

    def seen(effect: Any, adopts: bool = False) -> tuple[str, str] | None:
        faults["odd"] = replace(faults["slippery"], effect=effect)
        found = FaultForesight(HANOI, faults, arguments, adopts=adopts).look("odd", EDGE)
        return (found.end, found.why) if found is not None else None

    arm = FaultEffect({}, ({},), "the arm cannot move")
    other = "the facts afterwards are those of State_ca, and a run holds then"
    for effect, adopts, expected in (
        (FaultEffect(), False, ("reached", "if it fails, another way leads to the goal")),
        (FaultEffect({0: "b"}), False, ("reached", "it changes nothing")),
        (FaultEffect({0: "x"}), True, ("held", "no state has the facts afterwards")),
        (FaultEffect({0: None}), True, ("held", "no state has the facts afterwards")),
        (FaultEffect({0: "c"}), False, ("held", other)),
        (FaultEffect({0: "c"}), True, ("reached", "if it fails, another way leads to the goal")),
        (FaultEffect({0: "b"}, ({"disk": 2},), "stuck"), False, ("held", "stuck")),
        (FaultEffect({}, ({"disk": 2, "peg": "b"},)), False,
         ("reached", "if it fails, another way leads to the goal")),
        (arm, False, ("held", "the arm cannot move")),
        (FaultEffect({7: "x"}), False, None),
        ("no effect", False, None),
    ):  # fmt: skip
        with case("effect", effect, adopts):
            assert seen(lambda facts, given, effect=effect: effect, adopts) == expected

    def breaks(facts: tuple[str, ...], given: object) -> FaultEffect:
        raise SystemExit(3)

    assert seen(breaks) is None
    assert seen(lambda facts, given: FaultEffect({0: given["peg"]})) == (
        "reached", "it changes nothing",
    )  # fmt: skip


def test_a_cell_differs_when_most_of_its_runs_ended_otherwise() -> None:
    tally = CampaignTally()
    tally.begin([SLIP], 3)
    (cell,) = tally.cells
    end = CampaignForesight(CampaignRequest(HANOI)).look(SLIP)
    assert end is not None
    assert end.end == "reached"
    tally.hear(0, 0, told(False, "held"))
    tally.hear(0, 1, told(False, "held"))
    tally.hear(0, 2, told(True, "goal_reached"))
    assert not cell.differs, "nothing was foreseen"
    tally.foresee(0, end)
    assert cell.differs
    cell.seeds = 4
    assert not cell.differs, "not all runs are done"
    words = finding_of(cell, "hanoi")
    assert words.startswith(
        "Campaign in the world hanoi: slip in Op_1b. Foreseen: reached, because"
    )
    assert words.endswith("Seen: 1 reached, 2 held of 3 runs.")


def test_runs_that_were_refused_say_nothing_of_a_fault() -> None:
    tally = CampaignTally()
    end = CampaignForesight(CampaignRequest(HANOI)).look(SLIP)
    assert end is not None
    tally.begin([SLIP], 2)
    tally.foresee(0, end)
    (cell,) = tally.cells
    tally.hear(0, 0, told(False, "refused"))
    assert tally.of_edge(cell.edge).nothing == "no run began"
    tally.hear(0, 1, told(False, "refused"))
    assert not cell.differs
    assert cell.counts == {"reached": 0, "refused": 2, "held": 0, "failed": 0}
    tally.begin([SLIP], 2)
    tally.foresee(0, end)
    (cell,) = tally.cells
    tally.hear(0, 0, told(False, "refused"))
    tally.hear(0, 1, told(True, "goal_reached"))
    share = tally.of_fault("slip")
    assert (share.reached, share.runs, share.refused) == (1, 1, 1)
    assert not cell.differs
    assert proposals(HANOI, tally)[0].risk == "low"
