"""Campaigns: the same result for any number of workers, kept on the way, told with intervals."""

from __future__ import annotations

import json
from html.parser import HTMLParser
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import UsageError, WorldError
from smsl_studio.front.campaign_faults import CampaignRequest, injections_of
from smsl_studio.front.campaign_page import campaign_page
from smsl_studio.front.campaign_runs import CampaignRun, request_of
from smsl_studio.front.campaigns import BLOCK, wilson
from smsl_studio.front.runs import run_request
from smsl_studio.runlog.events import OperationEnded, OperationStarted
from smsl_studio.shipped import samples_dir
from smsl_studio.stop import Stopped
from tests.plugin_folder import LAMP, write_plugin

SMALL = samples_dir() / "hanoi-2.json"


def asked(**more: object) -> CampaignRequest:
    values = {"blueprint": smsl.read(SMALL), "seeds": 3, **more}
    return CampaignRequest(**values)  # type: ignore[arg-type]


def test_without_faults_there_is_one_row() -> None:
    done = smsl.campaign(asked())
    (row,) = done.rows
    assert (row.fault, row.edge, row.runs, row.reached, row.held) == (None, None, 3, 3, 0)
    assert (done.runs, done.reached) == (3, 3)


def test_each_fault_is_injected_in_each_edge_of_the_route() -> None:
    done = smsl.campaign(asked(seeds=2, faults=("fail", "hang")))
    assert [(row.fault, row.edge) for row in done.rows] == [
        (fault, edge)
        for fault in ("fail", "hang")
        for edge in ("SB1/State_aa/Op_1b", "SB1/State_ba/Op_2c", "SB1/State_bc/Op_1c")
    ]
    assert all(row.recovered == row.reached == 2 for row in done.rows)


def test_all_edges_have_a_run_that_begins_there() -> None:
    done = smsl.campaign(asked(seeds=1, faults=("fail",), edges="all"))
    assert [row.edge for row in done.rows] == [
        str(edge.address) for edge in smsl.read(SMALL)["SB1"].edges()
    ]
    assert all(row.recovered for row in done.rows)


def test_faults_that_need_more_words_are_left_out_of_all_and_refused_by_name() -> None:
    done = smsl.campaign(asked(seeds=1, faults=("all",)))
    assert "set" in done.left_out
    assert {row.fault for row in done.rows} & set(done.left_out) == set()
    with pytest.raises(UsageError, match="the fault set needs fact, value"):
        smsl.campaign(asked(faults=("set",)))
    with pytest.raises(UsageError, match="has no fault 'fial'"):
        smsl.campaign(asked(faults=("fial",)))


def test_two_workers_give_the_same_result() -> None:
    one, two = (smsl.campaign(asked(faults=("fail",), workers=n)) for n in (1, 2))
    assert one == two


def test_what_was_done_is_taken_over(tmp_path: Path) -> None:
    part = tmp_path / "out.json.part"
    whole = smsl.campaign(asked(faults=("fail",)))

    def stop(done: int, _every: int) -> None:
        if done == 4:
            raise Stopped

    with pytest.raises(Stopped):
        smsl.campaign(asked(faults=("fail",), part=part), stop)
    lines = part.read_text().splitlines()
    assert len(lines) == 4
    # A line that was cut by a kill is left out, and one with another verdict is believed as it is.
    part.write_text("\n".join([*lines[:3], lines[3][:40], "[1]", '{"key": 3}']) + "\n")
    assert smsl.campaign(asked(faults=("fail",), part=part, resume=True)) == whole
    assert len(part.read_text().splitlines()) == 6 + whole.runs - 3


def test_a_line_of_another_blueprint_is_not_taken_over(tmp_path: Path) -> None:
    part = tmp_path / "out.json.part"
    smsl.campaign(asked(part=part))
    before = part.read_text()
    other = tmp_path / "hanoi-2.json"
    values = json.loads(SMALL.read_text())
    values["SB1"]["State_aa"]["Op_1b"] = "State_ca"
    other.write_text(json.dumps(values))
    smsl.campaign(CampaignRequest(smsl.read(other), seeds=3, part=part, resume=True))
    assert len(part.read_text().splitlines()) == 2 * len(before.splitlines())


def test_intervals_are_wilsons() -> None:
    """Figures of R. G. Newcombe, 1998, table I, without continuity correction."""
    for reached, runs, low, high in (
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ):
        found = wilson(reached, runs)
        assert found == pytest.approx((low, high), abs=0.00006)


def test_it_ends_early_on_whole_blocks_of_seeds() -> None:
    done = smsl.campaign(asked(seeds=1_000, until=0.3))
    assert done.runs % BLOCK == 0
    assert done.runs < 100
    assert done.runs == smsl.campaign(asked(seeds=done.runs)).runs
    assert done.digest == smsl.campaign(asked(seeds=done.runs)).digest


@pytest.mark.parametrize("more", [{"seeds": 0}, {"workers": 0}, {"seeds": 10_000_000}])
def test_numbers_that_do_not_fit_are_refused(more: dict[str, int]) -> None:
    with pytest.raises(UsageError):
        smsl.campaign(asked(**more))


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        assert not {name for name, _ in attrs} & {"src", "href", "onclick"}


def test_the_page_has_no_script_even_with_a_hostile_name(tmp_path: Path) -> None:
    file = tmp_path / "<script>alert(1)<.json"
    file.write_bytes(SMALL.read_bytes())
    request = CampaignRequest(smsl.read(file), seeds=1)
    page, tags = campaign_page(request, smsl.campaign(request)), _Tags()
    tags.feed(page)
    assert "script" not in tags.tags
    assert "1 of 1 runs" in page


@pytest.mark.parametrize("edges", ["route", "all"])
def test_a_fault_of_the_table_spoils_the_operation_of_its_row(edges: str) -> None:
    """With sub-SBs, operations of several SBs run one after the other."""
    blueprint = smsl.read(samples_dir() / "three-levels.json")
    request = CampaignRequest(blueprint, faults=("fail",), edges=edges)
    for injection in injections_of(request):
        done = run_request(request_of(blueprint, CampaignRun("table", 0, injection)))
        failed = [
            event.address
            for event in done.events
            if isinstance(event, OperationEnded) and event.outcome == "failed"
        ]
        # An operation that only moves its sub-SBs has no function; theirs are spoiled then.
        started = [e.address for e in done.events if isinstance(e, OperationStarted) and e.function]
        assert injection is not None
        if str(injection.edge) in started:
            assert failed[:1] == [str(injection.edge)]


HOSTILE = (
    "[" * 200_000,
    json.dumps({"key": "KEY", "reached": True, "recovered": True, "reason": "x", "sha256": "é"}),
    json.dumps(
        {"key": "KEY", "reached": False, "recovered": True, "reason": "held", "sha256": "a" * 64}
    ),
    json.dumps({"key": "KEY", "reached": True, "recovered": False, "reason": "held",
                "sha256": "a" * 64}),
    json.dumps({"key": ["KEY"], "reached": True}),
)  # fmt: skip


def test_a_hostile_part_is_not_believed(tmp_path: Path) -> None:
    part = tmp_path / "out.json.part"
    whole = smsl.campaign(asked(part=part))
    keys = [json.loads(line)["key"] for line in part.read_text().splitlines()]
    part.write_text("\n".join(line.replace("KEY", keys[0]) for line in HOSTILE) + "\n")
    assert smsl.campaign(asked(part=part, resume=True)) == whole


ENDING = """
import os


def register(library):
    @library.world("lamp", engine="table")
    def build(world, blueprint, seed):
        os._exit(3)
"""


def test_a_plugin_that_ends_its_process_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "plugins"
    write_plugin(folder, "lamp", ENDING)
    file = tmp_path / "lamp.json"
    file.write_text(json.dumps(LAMP))
    monkeypatch.setenv("SMSL_PLUGIN_PATH", str(folder))
    with pytest.raises(WorldError, match="a worker of the campaign died"):
        smsl.campaign(CampaignRequest(smsl.read(file), "lamp"))


@pytest.mark.parametrize("workers", [1, 2])
def test_an_unknown_world_or_robot_is_refused_by_name(workers: int) -> None:
    with pytest.raises(WorldError, match="there is no world 'hanio'"):
        smsl.campaign(asked(world="hanio", workers=workers))
    with pytest.raises(UsageError, match="the world 'hanoi' has no robot 'kuka'"):
        smsl.campaign(asked(world="hanoi", robot="kuka", workers=workers))
    with pytest.raises(UsageError, match="the world 'table' has no choice of robots"):
        smsl.campaign(asked(robot="panda", workers=workers))
