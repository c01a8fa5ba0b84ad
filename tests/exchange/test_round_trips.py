"""Forms that hold a whole blueprint give it back."""

from __future__ import annotations

import json
from pathlib import Path
from shutil import copytree

import pytest

import smsl_studio as smsl
from smsl_studio.shipped import samples_dir
from tests.blueprint.values import read
from tests.cli.shell import Shell, make_shell
from tests.counts import share_of
from tests.exchange.again import WHOLE, random_blueprint, read_text, text_of
from tests.hostile_names import BLUEPRINT

SAMPLES = sorted(samples_dir().glob("*.json"))
ODD = {
    "A b\r": {
        "HEADER": {"INITIAL": 5, "X": 1, "_z": 2, "SUB_SBS": [{"B": 0}]},
        " ": {"\t": "\r\n", "\u0001": "nowhere", "</data>": " ", "]]>": " ", "{x}": " "},
        "\r\n": {"x.y": " "},
        "e.f": {"x_y": "e_f", "x y": "e f"},
        "e_f": {"_c": 1},
        "e f": {},
    },
    "B": {},
    "状態": {"HEADER": {}, "الحالة": {"Übergang 🧠": "الحالة", "__proto__": "الحالة"}},
}


@pytest.fixture
def shell(capsys: pytest.CaptureFixture[str]) -> Shell:
    return make_shell(capsys)


@pytest.mark.parametrize("suffix", WHOLE)
@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_a_sample_behaves_as_before(shell: Shell, path: Path, suffix: str, tmp_path: Path) -> None:
    copytree(samples_dir(), tmp_path, dirs_exist_ok=True)  # some run others
    there, back = tmp_path / f"there{suffix}", tmp_path / "back.json"
    assert shell("convert", str(path), "-o", str(there)).status == 0
    answer = shell("convert", str(there), "-o", str(back), "--format", "json")
    assert (answer.status, answer.json["findings"]) == (0, [])
    assert shell("diff", "--behaviour", str(path), str(back)).status == 0
    before, after = smsl.digest(smsl.read(path)), smsl.digest(smsl.read(back))
    assert (before.behaviour, before.meaning) == (after.behaviour, after.meaning)


@pytest.mark.parametrize("suffix", WHOLE)
def test_random_blueprints_mean_the_same(suffix: str) -> None:
    for seed in range(share_of(50)):
        blueprint = random_blueprint(seed)
        again, findings = read_text(text_of(blueprint, suffix), f"x{suffix}")
        assert again == blueprint, seed
        assert findings == [], seed


@pytest.mark.parametrize("suffix", WHOLE)
@pytest.mark.parametrize(
    "values",
    [BLUEPRINT, ODD, {}, {"A": {}}, {"A": {"HEADER": {}}}, {"_x": [1], "A": {"s": {}}}],
    ids=["hostile", "odd", "empty", "no-states", "no-header", "one-state"],
)
def test_no_name_and_no_field_is_lost(suffix: str, values: dict[str, object]) -> None:
    blueprint = read(values)
    again, findings = read_text(text_of(blueprint, suffix), f"x{suffix}")
    assert again == blueprint
    assert again.document.values == blueprint.document.values
    assert findings == []


@pytest.mark.parametrize("suffix", WHOLE)
def test_equal_blueprints_give_equal_bytes(suffix: str) -> None:
    assert text_of(random_blueprint(7), suffix) == text_of(random_blueprint(7), suffix)


def test_another_program_may_change_states_and_operations() -> None:
    blueprint = smsl.read(samples_dir() / "hfsm.json")
    scxml = text_of(blueprint, ".scxml")
    line = next(one for one in scxml.splitlines() if 'smsl:name="Operation110B"' in one)
    without, findings = read_text(scxml.replace(line, ""), "x.scxml")
    assert "Operation110B" not in without["SB1"].table["State110"]
    assert findings == []
    moved, _ = read_text(
        scxml.replace('initial="SB1_State000"', 'initial="SB1_State100"'), "x.scxml"
    )
    assert moved["SB1"].initial == "State100"
    machine = json.loads(text_of(blueprint, ".xstate.json"))
    machine["states"]["SB1"]["states"]["State000"]["on"]["SB1.new"] = "State111"
    more, _ = read_text(json.dumps(machine), "x.xstate.json")
    assert more["SB1"].table["State000"]["SB1.new"] == "State111"
    graphml = text_of(blueprint, ".graphml")
    fewer, _ = read_text(
        graphml.replace('source="n0" target="n1"', 'source="n0" target="n2"'), "x.graphml"
    )
    assert fewer["SB1"].table["State000"]["Operation000"] == "State110"


def test_what_an_engine_does_not_do_is_told() -> None:
    blueprint = smsl.read(samples_dir() / "registration-digitization.json")
    told = smsl.exported(blueprint, "x.xstate.json").findings
    assert ("subs", "REGISTRATION/1") in [(one.kind, one.address) for one in told]


def test_imported_branches_are_written_into_the_file(shell: Shell, tmp_path: Path) -> None:
    (tmp_path / "smsl.toml").touch()
    hazard = {"name": "h", "facts": {"B/0": "1"}}
    states: dict[str, dict[str, str]] = {"State0": {}, "State1": {}}
    sub = {"_hazards": [hazard], "B": states}
    (tmp_path / "sub.json").write_text(json.dumps(sub), "utf-8")
    base = {"_imports": ["sub.json"], "A": {"HEADER": {"SUB_SBS": {"B": 0}}, **states}}
    source = tmp_path / "a.json"
    source.write_text(json.dumps(base), "utf-8")
    for suffix in WHOLE:
        there = tmp_path / f"a{suffix}"
        answer = shell("convert", str(source), "-o", str(there))
        assert "The SBs of imported files are written into this one." in answer.err
        found = smsl.imported(there).blueprint
        assert list(found.branches) == ["A", "B"]
        assert [one.name for one in found.hazards] == ["h"]
        assert smsl.read(source).behaviour == found.behaviour
