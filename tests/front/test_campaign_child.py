"""The campaign of the window: its process, its table, and what it proposes for the blueprint."""

from __future__ import annotations

import json
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused, StudioError, UsageError, WorldError
from smsl_studio.front import campaign_child
from smsl_studio.front.campaign_child import CampaignChild, CampaignEnd
from smsl_studio.front.campaign_faults import CampaignRequest
from smsl_studio.front.campaign_rates import proposals, with_rates
from smsl_studio.front.campaign_runs import RunVerdict
from smsl_studio.front.campaign_tally import FAILED, KINDS, REFUSED, CampaignTally, share_of
from smsl_studio.front.campaigns import campaign
from smsl_studio.front.fault_foresight import HELD, REACHED
from smsl_studio.front.logs import verify
from smsl_studio.smsl.json_form import parse_json

DRAWN = {
    "SB": {
        "_operations": {"State_a/Go": {"cost": 2, "title": "Go"}},
        "State_a": {"Go": "State_b"},
        "State_b": {"On": "State_c"},
        "State_c": {},
    }
}


@pytest.fixture
def request_(tmp_path: Path) -> CampaignRequest:
    file = tmp_path / "way.json"
    file.write_text(json.dumps(DRAWN), "utf-8")
    return CampaignRequest(smsl.read(file), seeds=4, faults=("fail", "hang"))


def followed(child: CampaignChild) -> tuple[CampaignTally, CampaignEnd]:
    tally = CampaignTally()
    with closing(child):
        return tally, child.follow(tally)


def test_the_process_tells_what_the_campaign_gives(request_: CampaignRequest) -> None:
    tally, end = followed(CampaignChild(request_))
    done = campaign(request_)
    assert tally.result(end.digest) == done
    assert tally.faults == ("fail", "hang")
    assert tally.edges == ("SB/State_a/Go", "SB/State_b/On")
    assert tally.done == tally.every == 16


def test_what_is_drawn_and_not_saved_counts(request_: CampaignRequest, tmp_path: Path) -> None:
    text = json.dumps(DRAWN).replace("On", "Onward")
    drawn = read_blueprint(parse_json(text, str(tmp_path / "way.json")))
    tally, _ = followed(CampaignChild(replace(request_, blueprint=drawn, seeds=1)))
    assert tally.edges[1] == "SB/State_b/Onward"


def test_a_blueprint_without_a_file_is_refused() -> None:
    drawn = read_blueprint(parse_json(json.dumps(DRAWN), "nowhere.json"))
    with pytest.raises(UsageError, match="workers need a blueprint in a file"):
        CampaignChild(CampaignRequest(drawn))


def test_what_was_done_before_is_not_run_again(request_: CampaignRequest, tmp_path: Path) -> None:
    kept = replace(request_, part=tmp_path / "kept.jsonl", resume=True)
    _, first = followed(CampaignChild(kept))
    lines = (tmp_path / "kept.jsonl").read_text("ascii")
    _, second = followed(CampaignChild(kept))
    assert first.digest == second.digest
    assert (tmp_path / "kept.jsonl").read_text("ascii") == lines


def test_one_run_is_recorded_and_is_that_very_run(
    request_: CampaignRequest, tmp_path: Path
) -> None:
    tally, _ = followed(CampaignChild(request_))
    cell, log = tally.cells[3], tmp_path / "run.jsonl"
    again, _ = followed(CampaignChild(request_, request_.run(2, cell.injection), log))
    assert again.cells[0].verdicts[0] == cell.verdicts[2]
    assert verify(log).doubt is None


def test_a_refusal_comes_with_its_sentence(request_: CampaignRequest) -> None:
    with pytest.raises(UsageError, match="the world 'table' has no fault 'fial'"):
        followed(CampaignChild(replace(request_, faults=("fial",))))


def test_starts_goals_and_supervisors_reach_the_runs(request_: CampaignRequest) -> None:
    short = replace(request_, faults=(), goals=("SB/State_b",))
    assert campaign(short).digest != campaign(replace(request_, faults=())).digest
    vetoed = campaign(replace(request_, faults=(), seeds=1, agents=("limit:risk=0.0",)))
    assert (vetoed.reached, vetoed.rows[0].held) == (0, 1)
    started = campaign(replace(request_, faults=("fail",), starts=("SB/State_b",)))
    assert [row.edge for row in started.rows] == ["SB/State_b/On"]


ROWS = b'{"rows": [null], "seeds": 1}\n'
RUN = b'"reached": true, "recovered": false, "reason": "goal_reached", "sha256": "'
RUN += b"0" * 64 + b'"}\n'
LIES = (
    b"", b"nonsense\n", b"[]\n", b'{"what": 1}\n', b'{"end": {"paused": 1}}\n', ROWS,
    b'{"rows": []}\n', b'{"rows": [7], "seeds": 1}\n', b'{"rows": [null], "seeds": 0}\n',
    b'{"rows": [null], "seeds": true}\n', b'{"row": 0, "seed": 0, ' + RUN,
    ROWS + b'{"foreseen": ["won", "it"], "of": 0}\n',
    ROWS + b'{"foreseen": ["held", "it"], "of": 1}\n',
    ROWS + b'{"row": 1, "seed": 0, ' + RUN, ROWS + b'{"row": 0, "seed": -1, ' + RUN,
)  # fmt: skip


@pytest.mark.parametrize("said", LIES, ids=range(len(LIES)))
def test_no_lie_of_the_process_is_believed(
    said: bytes, request_: CampaignRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    liar = tmp_path / "liar.py"
    liar.write_text(f"import sys\nsys.stdout.buffer.write({said!r})\n", "utf-8")
    monkeypatch.setattr(campaign_child, "CODE", f"exec(open({str(liar)!r}).read())")
    with pytest.raises(WorldError, match="the process of the campaign died, or said"):
        followed(CampaignChild(request_))


def verdict(reason: str, recovered: bool = False) -> RunVerdict:
    reached = reason == "goal_reached"
    return RunVerdict(reached, recovered, reason, "0" * 64)


def test_a_tally_counts_each_run_once(request_: CampaignRequest) -> None:
    tally = CampaignTally()
    tally.begin([None], 4)
    for seed, reason in enumerate(("goal_reached", "held", "no_route", "failed")):
        tally.hear(0, seed, verdict(reason))
        tally.hear(0, seed, verdict("goal_reached"))
    (cell,) = tally.cells
    assert cell.counts == {REACHED: 1, REFUSED: 0, HELD: 2, FAILED: 1}
    assert (tally.faults, tally.edges, tally.done) == (("",), ("",), 4)
    share = share_of(tally.cells)
    assert (share.reached, share.runs) == (1, 4)
    assert share.low < 0.25 < share.high
    assert (share_of([]).low, share_of([]).high) == (0.0, 1.0)
    assert proposals(request_.blueprint, tally) == ()


def test_measured_rates_are_proposed_and_written(request_: CampaignRequest) -> None:
    tally, _ = followed(CampaignChild(replace(request_, seeds=1)))
    go, on = tally.edges
    cells = {(one.edge, one.fault): one for one in tally.cells}
    for fault, told in (("fail", ("goal_reached", "held", "held")), ("hang", ("held",) * 3)):
        cells[go, fault].verdicts = {}
        cells[go, fault].counts = dict.fromkeys(KINDS, 0)
        cells[go, fault].recovered = 0
        for seed, reason in enumerate(told):
            tally.hear(cells[go, fault].row, seed, verdict(reason))
    first, second = proposals(request_.blueprint, tally)
    assert (str(first.address), first.share.reached, first.share.runs) == (go, 1, 6)
    # One of six went smoothly, so it costs 2 and five sixths of 2 more.
    assert (first.cost_before, first.cost) == (2.0, 3.67)
    assert (first.risk_before, first.risk) == ("", "high")
    assert (str(second.address), second.risk) == (on, "high")
    after = with_rates(request_.blueprint, [first])
    note = after["SB"].operation_note("State_a", "Go")
    assert (note.cost, note.risk, note.title) == (3.67, "high", "Go")
    assert after["SB"].operation_note("State_b", "On").risk is None
    again = proposals(after, tally)[0]
    assert (again.cost_before, again.risk_before) == (3.67, "high")


def test_an_entry_that_is_no_map_is_not_written(tmp_path: Path) -> None:
    values = {"SB": {**DRAWN["SB"], "_operations": {"State_a/Go": 7}}}
    file = tmp_path / "odd.json"
    file.write_text(json.dumps(values), "utf-8")
    request = CampaignRequest(smsl.read(file), faults=("fail",))
    tally, _ = followed(CampaignChild(request))
    with pytest.raises(StudioError, match="is no map") as told:
        with_rates(request.blueprint, proposals(request.blueprint, tally))
    assert isinstance(told.value, EditRefused)
