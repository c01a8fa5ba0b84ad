"""Files of other programs, and the blueprint that each of them becomes."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import smsl_studio as smsl
from smsl_studio.errors import ReadError, UsageError
from smsl_studio.exchange.table import FORMS
from smsl_studio.shipped import samples_dir
from tests.cli.shell import make_shell
from tests.exchange import foreign
from tests.exchange.again import read_text

PAGE = Path(__file__).parents[2] / "docs/exchange.md"


def told(findings: object) -> set[str]:
    return {one.kind for one in findings}  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("file", "text", "values", "kinds"),
    [
        ("x.scxml", foreign.SCXML, foreign.SCXML_VALUES,
         {"datamodel", "script", "onentry", "cond", "event", "name", "history"}),
        ("x.xstate.json", json.dumps(foreign.XSTATE), foreign.XSTATE_VALUES,
         {"context", "actions", "guard", "entry", "name"}),
        ("x.graphml", foreign.GRAPHML, foreign.GRAPHML_VALUES,
         {"undirected", "group", "hyperedge", "name"}),
    ],
    ids=["scxml", "xstate", "graphml"],
)  # fmt: skip
def test_a_chart_becomes_branches(file: str, text: str, values: object, kinds: set[str]) -> None:
    blueprint, findings = read_text(text, file)
    assert _plain(blueprint.document.values) == _plain(values)
    assert told(findings) - {"history"} == kinds - {"history"}
    assert all(one.line > 0 for one in findings)


def _plain(values: object) -> object:
    """Values without empty headers, in which INITIAL and ACTIVATING are the defaults."""
    text = json.dumps(values).replace('"HEADER": {}, ', "")
    return json.loads(text.replace('"HEADER": {"INITIAL": "red"}, ', ""))


def test_history_is_entered_as_for_the_first_time() -> None:
    text = foreign.SCXML.replace('event="start" target="work"', 'event="start" target="again"')
    blueprint, findings = read_text(text, "x.scxml")
    assert blueprint["Drill"].table["idle"] == {"start": "turn"}
    assert "history" in told(findings)


def test_regions_become_branches_and_inner_ones_are_not_coupled() -> None:
    text = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0"><parallel id="p">
      <state id="A"><state id="a1"><transition event="go" target="a2"/></state>
        <state id="a2"/></state>
      <state id="B"><parallel id="q"><state id="C"><state id="c"/></state><state id="D"/></parallel>
        <state id="b"/></state></parallel></scxml>"""
    blueprint, findings = read_text(text, "x.scxml")
    assert list(blueprint.branches) == ["A", "B", "C", "D"]
    assert list(blueprint["B"].table) == ["q", "b"]
    assert "parallel" in told(findings)


def test_a_behavior_of_flexbe_is_read_and_not_run(tmp_path: Path) -> None:
    package = tmp_path / "bone_behaviors"
    (package / "manifest").mkdir(parents=True)
    inside = package / "src" / "bone_behaviors"
    inside.mkdir(parents=True)
    (inside / "bone_drill_sm.py").write_text(foreign.FLEXBE, "utf-8")
    manifest = package / "manifest" / "bone_drill.xml"
    manifest.write_text(foreign.MANIFEST, "utf-8")
    made, findings = smsl.imported(inside / "bone_drill_sm.py")
    assert _plain(made.document.values) == _plain(foreign.FLEXBE_VALUES)
    assert told(findings) == {
        *("code", "behavior", "container", "concurrent", "autonomy", "remapping", "transition"),
        "activating",
    }
    by_manifest, more = smsl.imported(manifest)
    assert by_manifest == made
    assert told(more) - told(findings) == {"param"}


def test_a_machine_of_rafcon_is_read_from_its_folder(tmp_path: Path) -> None:
    foreign.write_rafcon(tmp_path / "drill")
    made, findings = smsl.imported(tmp_path / "drill")
    assert _plain(made.document.values) == _plain(foreign.RAFCON_VALUES)
    assert told(findings) == {"library", "concurrent", "data_flows", "script.py", "outcome"}
    again, _ = smsl.imported(tmp_path / "drill" / "statemachine.json")
    assert again == made
    alone, _ = smsl.imported(tmp_path / "drill" / "Work_INNER" / "Turn_TURN" / "core_data.json")
    assert list(alone["Turn"].table) == ["Turn", "preempted", "aborted", "done"]


REFUSED = [
    ("x.scxml", "<graphml/>", "is 'graphml' and not 'scxml'"),
    ("x.scxml", '<scxml><state id="a"/><state id="a"/></scxml>', "two states have the id 'a'"),
    ("x.scxml", "<scxml>", "no well formed XML: no element found"),
    ("x.scxml", "", "no well formed XML: no element found"),
    ("x.graphml", "<graphml/>", "it holds no graph"),
    ("x.graphml", '<graphml><graph><edge source="a" target="b"/></graph></graphml>',
     "the source 'a' is no node"),
    ("x.graphml", "<graphml><graph><node/></graph></graphml>", "a node needs an id"),
    ("x.xstate.json", "[]", "it is no JSON object"),
    ("x.xstate.json", "{}", "a machine of XState has 'states'"),
    ("x.xstate.json", '{"states": {"a": 5}}', "a state of a machine is a map"),
    ("x.py", "def f(:", "no valid Python"),
    ("x.py", "x = 1", "no class with a method 'create'"),
    ("x.py", "class A:\n def create(self):\n  return 5", "returns no container"),
    ("x.xml", "<a/>", "no manifest of FlexBE"),
    ("x.xml", '<behavior><executable package_path="../../etc.passwd"/></behavior>', "no name of a"),
    ("x.xml", '<behavior><executable package_path="no.such_sm"/></behavior>', "is not there"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "text", "words"), REFUSED)
def test_what_cannot_be_read_is_told_with_its_place(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, name: str, text: str, words: str
) -> None:
    file = tmp_path / name
    file.write_text(text, "utf-8")
    answer = make_shell(capsys)("convert", str(file), "-o", str(tmp_path / "out.json"))
    assert (answer.status, answer.out) == (2, "")
    assert re.match(rf"{re.escape(str(file))}:\d+:\d+: ", answer.err)
    assert words in answer.err
    assert len(answer.err.splitlines()) == 2
    assert not (tmp_path / "out.json").exists()


def test_an_unknown_form_names_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="none of another program's form"):
        smsl.imported(tmp_path / "x.txt")
    with pytest.raises(UsageError, match="none of another program's form"):
        smsl.exported(smsl.read(samples_dir() / "hfsm.json"), "x.py")
    with pytest.raises(ReadError, match="cannot be read"):
        smsl.imported(tmp_path / "no.scxml")


def test_the_page_has_a_row_for_every_form() -> None:
    page = PAGE.read_text("utf-8")
    for one in FORMS:
        name = f"`{one.suffix}`" if one.suffix.startswith(".") else one.suffix
        said = tuple("yes" if yes else "no" for yes in (one.written, one.read))
        assert f"| {name} | {one.words} | {said[0]} | {said[1]} |" in page


def test_a_file_is_never_replaced_by_what_is_made_of_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "x.scxml"
    file.write_text(foreign.SCXML, "utf-8")
    assert make_shell(capsys)("convert", str(file), "-o", str(file)).status == 2
    assert file.read_text("utf-8") == foreign.SCXML
