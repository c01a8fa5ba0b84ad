"""Blueprints as networkx graphs, and back: equal, also through GraphML, and after a change."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import networkx
import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import UsageError
from smsl_studio.smsl.json_form import parse_json
from tests.counts import share_of
from tests.dispatch.generated import blueprint_values
from tests.stories.person import SAMPLES

XML = "{http://graphml.graphdrawing.org/xmlns}"


def blueprint(values: dict[str, Any]) -> Blueprint:
    return read_blueprint(parse_json(json.dumps(values, indent=1), "file.json"))


@pytest.mark.parametrize("sample", sorted(SAMPLES.glob("*.json")), ids=lambda path: path.stem)
def test_samples_come_back_equal_through_graphml(sample: Path, tmp_path: Path) -> None:
    whole = smsl.read(sample)
    graph = smsl.multidigraph(whole)
    assert smsl.from_multidigraph(graph) == whole
    networkx.write_graphml(graph, tmp_path / "file.graphml")
    again: Any = networkx.read_graphml(tmp_path / "file.graphml", force_multigraph=True)
    assert smsl.from_multidigraph(again) == whole
    assert smsl.digest(smsl.from_multidigraph(again)) == smsl.digest(whole)


def test_a_plain_reader_of_graphml_finds_the_same(tmp_path: Path) -> None:
    whole = smsl.read(SAMPLES / "three-levels.json")
    networkx.write_graphml(smsl.multidigraph(whole), tmp_path / "file.graphml")
    root = ElementTree.parse(tmp_path / "file.graphml").getroot()
    names = {key.get("id"): key.get("attr.name") for key in root.iter(f"{XML}key")}

    def values(element: ElementTree.Element) -> dict[str | None, str | None]:
        return {names[one.get("key")]: one.text for one in element.iter(f"{XML}data")}

    nodes = {one.get("id"): values(one) for one in root.iter(f"{XML}node")}
    assert {name: row["facts"] for name, row in nodes.items()} == {
        f"{branch.name}/{state}": " ".join(branch.facts(state))
        for branch in whole
        for state in branch.table
    }
    edges = [(one.get("source"), one.get("id"), one.get("target"), values(one)["kind"])
             for one in root.iter(f"{XML}edge")]  # fmt: skip
    assert sorted(edge[:3] for edge in edges if edge[3] == "operation") == sorted(
        (f"{branch.name}/{state}", operation, f"{branch.name}/{target}")
        for branch in whole
        for state, table in branch.table.items()
        for operation, target in table.items()
    )


@pytest.mark.parametrize("seed", range(share_of(30)))
def test_random_blueprints_come_back_equal(seed: int) -> None:
    whole = blueprint(blueprint_values(seed))
    graph = smsl.multidigraph(whole)
    assert smsl.from_multidigraph(graph) == whole
    operations = [row for *_, row in graph.edges(data=True) if row["kind"] == "operation"]
    assert len(operations) == whole.operation_count


def test_an_sb_alone_can_be_measured() -> None:
    branch = smsl.read(SAMPLES / "hanoi-corrected.json")["SB1"]
    graph = smsl.multidigraph(branch)
    route = smsl.plan_route(branch, "State_aaa", "State_ccc")
    assert route is not None
    assert networkx.shortest_path(graph, "State_aaa", "State_ccc") == list(route.states)
    assert graph.nodes["State_aab"]["facts"] == "a a b"
    assert [name for name, row in graph.nodes(data=True) if row["initial"]] == ["State_aaa"]


def test_sub_sbs_are_linked_by_edges_of_their_own_kind() -> None:
    graph = smsl.multidigraph(smsl.read(SAMPLES / "hfsm.json"))
    links = [(a, b) for a, b, row in graph.edges(data=True) if row["kind"] == "sub"]
    assert links == [("SB1/State110", "SB2/State1"), ("SB1/State111", "SB2/State1")]


def test_a_changed_graph_is_a_changed_blueprint() -> None:
    graph = smsl.multidigraph(smsl.read(SAMPLES / "hfsm.json"))
    graph.add_node("SB1/State101", branch="SB1", state="State101")
    graph.add_edge("SB1/State100", "SB1/State101", "Operation100C")
    found = smsl.from_multidigraph(graph)
    assert found["SB1"].table["State100"]["Operation100C"] == "State101"
    assert list(found["SB1"].table)[-1] == "State101"


def test_what_is_no_blueprint_is_refused() -> None:
    graph = smsl.multidigraph(smsl.read(SAMPLES / "hfsm.json"))
    graph.add_edge("SB1/State100", "SB2/State1", "jump")
    with pytest.raises(UsageError, match="to another SB"):
        smsl.from_multidigraph(graph)
    with pytest.raises(UsageError, match="has no SB"):
        smsl.from_multidigraph(networkx.MultiDiGraph([("a", "b")]))
    odd: Any = networkx.MultiDiGraph(SB1="{")
    odd.add_node("a", branch="SB1")
    with pytest.raises(UsageError, match="no JSON object"):
        smsl.from_multidigraph(odd)


def test_the_page_does_what_it_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = (SAMPLES.parent / "docs" / "networkx.md").read_text(encoding="utf-8")
    blocks = [block.partition("```")[0] for block in page.split("```python\n")[1:]]
    code = "\n".join(blocks).replace("samples/", f"{SAMPLES}/")
    exec(code.replace('"changed.json"', repr(str(tmp_path / "changed.json"))), {})
    out = capsys.readouterr().out.splitlines()
    assert out[:3] == ["7", "7", "True"]
    assert out[-1] == "1 change: 1 removed."
    assert smsl.read(tmp_path / "changed.json")["SB1"].edge_count == 77
