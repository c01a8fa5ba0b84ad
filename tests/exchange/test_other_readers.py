"""What is written is read by the programs that it is for."""

from __future__ import annotations

import csv
import io
import shutil
import subprocess
from pathlib import Path
from xml.etree.ElementTree import Element

import networkx
import pytest
import xmlschema
from defusedxml.ElementTree import fromstring

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.table import WRITTEN
from smsl_studio.shipped import samples_dir
from tests.blueprint.values import read
from tests.exchange.again import WHOLE, random_blueprint, text_of
from tests.hostile_names import BLUEPRINT

SCHEMA = Path(__file__).parent / "scxml-written.xsd"
STUDIO = "{urn:smsl-studio:blueprint:1}"


def some_blueprints() -> list[Blueprint]:
    """Samples, random ones and one with hostile names."""
    samples = [smsl.read(path) for path in sorted(samples_dir().glob("*.json"))]
    return [*samples, *(random_blueprint(seed) for seed in range(12)), read(BLUEPRINT)]


def test_scxml_has_the_elements_and_ids_of_the_recommendation() -> None:
    """The schema has the part of SCXML 1.0 that is written; the W3C's own is in no package."""
    schema = xmlschema.XMLSchema11(SCHEMA)
    for blueprint in some_blueprints():
        schema.validate(text_of(blueprint, ".scxml"))
    broken = text_of(smsl.read(samples_dir() / "hfsm.json"), ".scxml")
    assert not schema.is_valid(broken.replace('target="SB1_State100"', 'target="nowhere"'))
    assert not schema.is_valid(broken.replace('version="1.0" datamodel', 'version="2" datamodel'))


def test_networkx_reads_graphml() -> None:
    for blueprint in some_blueprints():
        graph = networkx.parse_graphml(text_of(blueprint, ".graphml"), force_multigraph=True)
        edges = [row for _, _, row in graph.edges(data=True)]
        ways = [row for row in edges if row["kind"] == "operation"]
        assert graph.number_of_nodes() == blueprint.state_count
        dangling = sum(
            edge.target not in branch.table for branch in blueprint for edge in branch.edges()
        )
        assert len(ways) == blueprint.operation_count - dangling
        assert all(type(row["cost"]) is float for row in ways)


@pytest.mark.parametrize("number", range(4))
def test_graphviz_reads_dot(number: int, tmp_path: Path) -> None:
    dot = shutil.which("dot")
    assert dot, "./dev setup installs graphviz"
    for at, blueprint in enumerate(some_blueprints()[number::4]):
        file = tmp_path / f"{at}.dot"
        file.write_text(text_of(blueprint, ".dot"), "utf-8")
        done = subprocess.run([dot, "-Tcanon", str(file)], capture_output=True, check=False)
        assert (done.returncode, done.stderr) == (0, b"")


def test_a_behaviour_tree_is_one_of_version_4() -> None:
    for blueprint in some_blueprints():
        root = fromstring(text_of(blueprint, ".btcpp.xml"))
        assert root.tag == "root"
        assert root.get("BTCPP_format") == "4"
        trees = root.findall("BehaviorTree")
        ids = [tree.get("ID") for tree in trees]
        assert len(ids) == len(set(ids)) == len(blueprint)
        assert root.get("main_tree_to_execute") in ids
        (model,) = root.findall("TreeNodesModel")
        offered = {one.get("ID"): one for one in model}
        for tree in trees:
            (top,) = tree
            assert top.tag == "ReactiveFallback"
            _one_child_or_more(top)
            for leaf in tree.iter():
                if leaf.tag == "SubTree":
                    assert leaf.get("ID") in ids
                elif leaf.tag in ("Action", "Condition"):
                    _has_the_ports_of(leaf, offered[leaf.get("ID")])


def _one_child_or_more(node: Element) -> None:
    for one in node.iter():
        assert one.tag in {
            *("ReactiveFallback", "Sequence", "Fallback", "SubTree", "Action", "Condition")
        }
        if one.tag in ("Sequence", "Fallback"):
            assert len(one) > 0


def _has_the_ports_of(leaf: Element, model: Element) -> None:
    assert leaf.tag == model.tag
    ports = {port.get("name") for port in model}
    assert set(leaf.keys()) - {"ID", "name"} == ports
    assert not any("{" in (leaf.get(str(port)) or "") for port in ports)


def test_a_rise_runs_the_tree_of_its_sub_before() -> None:
    text = text_of(smsl.read(samples_dir() / "hfsm.json"), ".btcpp.xml")
    (above,) = [
        one
        for one in fromstring(text).iter("Sequence")
        if [leaf.get("ID") for leaf in one] == ["SB2", "Operation100A"]
    ]
    assert above[0].tag == "SubTree"


def test_a_table_has_a_row_for_each_operation() -> None:
    hostile = read({"A": {"=1+1": {"@op": "=1+1"}, "s": {}}})
    made = smsl.exported(hostile, "x.csv")
    rows = list(csv.DictReader(io.StringIO(made.text)))
    assert [row["state"] for row in rows] == ["'=1+1", "s"]
    assert {one.kind for one in made.findings} == {"formula"}
    for blueprint in some_blueprints():
        rows = list(csv.DictReader(io.StringIO(text_of(blueprint, ".csv"))))
        assert sum(bool(row["operation"]) for row in rows) == blueprint.operation_count


def test_plantuml_gets_no_character_that_means_something() -> None:
    for blueprint in some_blueprints():
        text = text_of(blueprint, ".puml")
        assert text.startswith("@startuml\n")
        assert text.endswith("@enduml\n")
        assert not any(line.lstrip().startswith(("!", "'", "<")) for line in text.splitlines())
        assert text.count("-->") == blueprint.operation_count + sum(
            branch.initial in branch.table for branch in blueprint
        )
        assert "%" not in text
        assert text.count('"') == 2 * text.count('state "')


def test_everything_that_is_left_out_is_told() -> None:
    blueprint = smsl.read(samples_dir() / "registration-drilling.json")
    told = {(one.kind, one.address) for one in smsl.exported(blueprint, "x.puml").findings}
    for key in ("hazards", "properties"):
        assert (key, f"_{key}") in told
    for branch in blueprint:
        for key in branch.fields:
            assert (key.strip("_"), branch.name) in told


@pytest.mark.parametrize("suffix", [one for one in WRITTEN if one not in WHOLE])
def test_every_field_is_in_a_form_or_told(suffix: str) -> None:
    names = {"_facts", "_states", "_operations", "_layout", "_notes", "_other"}
    fields: dict[str, dict[str, str]] = {name: {} for name in names}
    blueprint = read({"_levels": {}, "A": {**fields, "State0": {"_x": 1, "a": "State0"}}})
    told = {(one.kind, one.address) for one in smsl.exported(blueprint, f"x{suffix}").findings}
    assert told >= {(name.strip("_"), "A") for name in names}
    assert told >= {("levels", "_levels"), ("field", "A/State0")}
