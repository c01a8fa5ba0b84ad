"""``check --explain``: elements in the notation of the paper."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from smsl_studio.blueprint.notation import notation_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.cli import main
from smsl_studio.errors import AddressError
from smsl_studio.smsl.json_form import parse_json

TEXT = json.dumps(
    {
        "Base": {
            "HEADER": {"NUM_FACTS": 3, "SUB_SBS": {"Sub": 1}},
            "_facts": {
                "0": {"sources": {"force_clamp": "N", "the gap": "mm"},
                      "predicate": {"0": "force_clamp < 1 N", "1": "'the gap' < 2 mm"}},
                "2": {"sensors": ["eye"]},
            },
            "State_000": {"a": "State_100"},
            "State_100": {"b": "State_110"},
            "State_110": {"c": "State_000"},
        },
        "Sub": {"_facts": {"0": {"sources": {"x": "N"}, "predicate": {"1": "x > 1 mm"}}},
                "State_0": {"up": "State_1"}, "State_1": {"down": "State_0"}},
    }
)  # fmt: skip


@pytest.mark.parametrize(
    ("address", "lines"),
    [
        ("Base/0", ("f_1 = λs. F(sense(force_clamp, 'the gap', s))", "F = 0 if force_clamp < 1 N",
                    "F = 1 if 'the gap' < 2 mm")),
        ("Base/1", ("f_2 = λs. C_State_1(s_Sub)",)),
        ("Base/2", ("f_3 = λs. sense(eye, s)",)),
        ("Sub/0", ("f_1 is unknown: the predicate of 1 cannot be read: character 5: 1 mm is "
                   "compared with a measure in N",)),
        ("Base/State_100", ("C_State_100 = λs. [f_1(s) = 1 ∧ f_2(s) = 0 ∧ f_3(s) = 0]",)),
        ("Sub/State_0/up", ("up = λs. C_State_0(s) → C_State_1(s)",
                            "C_State_0 = λs. [f_1(s) = 0]", "C_State_1 = λs. [f_1(s) = 1]")),
    ],
)  # fmt: skip
def test_each_element_has_its_notation(address: str, lines: tuple[str, ...]) -> None:
    assert notation_of(read_blueprint(parse_json(TEXT, "x.json")), address) == lines


def test_the_command_writes_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "x.json"
    file.write_text(TEXT, encoding="utf-8")
    main(["check", str(file), "--explain", "Base/1"])
    assert capsys.readouterr().out.splitlines()[-1] == "f_2 = λs. C_State_1(s_Sub)"
    main(["check", str(file), "--explain", "Base/1", "--format", "json"])
    told = json.loads(capsys.readouterr().out)["files"][0]["explained"]
    assert told == ["f_2 = λs. C_State_1(s_Sub)"]
    assert main(["check", str(file), "--explain", "Base/9"]) == 2
    assert "there is no fact Base/9" in capsys.readouterr().err


@pytest.mark.parametrize("address", ["Base/3", "Nobody", "Base/State_9", "Base/State_000/z", ""])
def test_nothing_stands_there(address: str) -> None:
    with pytest.raises(AddressError):
        notation_of(read_blueprint(parse_json(TEXT, "x.json")), address)
