"""Known defects of the reference reader (pysmsl 0.1.1), which this reader does not have.

One test for each of its known defects, named after it; what it does there stands in the first
line, what is asserted is what ours does instead.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.errors import Place, ReadError
from smsl_studio.inspection.rules.finding import Finding, Severity
from smsl_studio.smsl.forms import form_named
from tests.cli.shell import make_shell

Write = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write a text, bytes or values into a file of that name."""

    def write(written: Any, name: str = "blueprint.json") -> Path:
        file = tmp_path / name
        if isinstance(written, bytes):
            file.write_bytes(written)
        else:
            text = written if isinstance(written, str) else json.dumps(written, indent=1)
            file.write_text(text, encoding="utf-8")
        return file

    return write


def found(blueprint: Blueprint, rule: str) -> list[Finding]:
    """The errors of one rule; each has a place in the text and an advice."""
    findings = [one for one in smsl.inspect(blueprint, [rule]) if one.severity is Severity.ERROR]
    assert all(one.place.line >= 1 and one.advice for one in findings)
    return findings


def refusal(file: Path) -> ReadError:
    with pytest.raises(ReadError) as caught:
        smsl.read(file)
    assert caught.value.advice
    return caught.value


# --- accepted in silence ---------------------------------------------------------------------


def test_dangling_target(write: Write) -> None:
    """A node is invented."""
    blueprint = smsl.read(write('{"SB": {\n"S0": {"o": "S1", "p": "S9"},\n"S1": {}}}'))
    assert list(blueprint["SB"].states) == ["S0", "S1"]
    (finding,) = found(blueprint, "R02")
    assert str(finding.address) == "SB/S0/p"
    assert finding.place.line == 2


def test_initial_that_does_not_exist(write: Write) -> None:
    """It becomes the initial state."""
    blueprint = smsl.read(write({"SB": {"HEADER": {"INITIAL": "S9"}, "S0": {"o": "S0"}}}))
    assert list(blueprint["SB"].states) == ["S0"]
    assert ["S9" in one.message for one in found(blueprint, "R03")] == [True]


def test_activating_that_does_not_exist(write: Write) -> None:
    """It becomes the activating state."""
    blueprint = smsl.read(write({"SB": {"HEADER": {"ACTIVATING": "S9"}, "S0": {"o": "S0"}}}))
    assert list(blueprint["SB"].states) == ["S0"]
    assert ["S9" in one.message for one in found(blueprint, "R03")] == [True]


@pytest.mark.parametrize("number", [0, -1, 7, 2.5, "3", True])
def test_any_num_facts(write: Write, number: object) -> None:
    """Whatever stands there is taken."""
    header = {"NUM_FACTS": number}
    blueprint = smsl.read(write({"SB": {"HEADER": header, "State_00": {"o": "State_00"}}}))
    assert found(blueprint, "R05")


@pytest.mark.parametrize("digit", [17, -1, "x"])
def test_sub_digit_that_does_not_exist(write: Write, digit: object) -> None:
    """A digit of 17, or of "x", is kept as it is."""
    header = {"SUB_SBS": {"B": digit}}
    blueprint = smsl.read(write({"A": {"HEADER": header, "S0": {"o": "S0"}}, "B": {"S0": {}}}))
    (finding,) = found(blueprint, "R07")
    assert str(finding.address) == "A"
    assert str(digit) in finding.message


def test_two_subs_on_one_digit(write: Write) -> None:
    """Both are."""
    header = {"SUB_SBS": {"B": 0, "C": 0}}
    values = {"A": {"HEADER": header, "S0": {"o": "S1"}, "S1": {}}}
    sub = {"S0": {"o": "S1"}, "S1": {"p": "S0"}}
    blueprint = smsl.read(write({**values, "B": sub, "C": sub}))
    assert blueprint["A"].subs == {0: "B"}
    (finding,) = found(blueprint, "R07")
    assert "B" in finding.message
    assert "C" in finding.message


def test_keys_written_twice(write: Write) -> None:
    """The last one wins, and nobody is told."""
    text = '{"SB": {"S0": {"o": "S0"},\n "S1": {},\n "S0": {"o": "S1"}}}'
    file = write(text)
    blueprint = smsl.read(file)
    assert blueprint["SB"].table == {"S0": {"o": "S1"}, "S1": {}}
    assert blueprint.document.text == text
    (finding,) = found(blueprint, "R01")
    assert finding.place == Place(str(file), 3, 2)
    assert "line 1, column 9" in finding.message


def test_comment_inside_a_state(write: Write) -> None:
    """It becomes an edge."""
    blueprint = smsl.read(write({"SB": {"S0": {"_comment": "why", "o": "S0"}}}))
    assert blueprint.operation_count == 1
    assert list(blueprint["SB"].states["S0"].operations) == ["o"]
    assert blueprint["SB"].state_fields == {"S0": {"_comment": "why"}}


def test_yaml(write: Write) -> None:
    """It loads to None."""
    listed = "SB1: [\n  HEADER: [INITIAL: S0],\n  S0: [on: S1],\n  S1: []\n]\n"
    mapped = "SB1:\n  HEADER: {INITIAL: S0}\n  S0: {on: S1}\n  S1: {}\n"
    expected = {"SB1": {"HEADER": {"INITIAL": "S0"}, "S0": {"on": "S1"}, "S1": {}}}
    plain = smsl.read(write(expected))
    for text in (listed, mapped):
        assert smsl.read(write(text, "blueprint.yaml")) == plain


def test_cycle_of_sub_sbs(write: Write) -> None:
    """The machine is empty."""
    states = {"S0": {"o": "S1"}, "S1": {"p": "S0"}}
    values = {
        "A": {"HEADER": {"SUB_SBS": {"B": 0}}, **states},
        "B": {"HEADER": {"SUB_SBS": {"A": 0}}, **states},
    }
    blueprint = smsl.read(write(values))
    assert [branch.name for branch in blueprint] == ["A", "B"]
    messages = [one.message for one in found(blueprint, "R08")]
    assert messages
    assert all("A" in message and "B" in message for message in messages)


def test_third_level_listed_below_the_second(write: Write) -> None:
    """A > B > C in that order loses C."""
    states = {"S0": {"o": "S1"}, "S1": {"p": "S0"}}
    values = {
        "A": {"HEADER": {"SUB_SBS": {"B": 0}}, **states},
        "B": {"HEADER": {"SUB_SBS": {"C": 0}}, **states},
        "C": states,
    }
    blueprint = smsl.read(write(values))
    assert blueprint.roots == ("A",)
    assert blueprint.bases == {"B": (("A", 0),), "C": (("B", 0),)}
    assert not found(blueprint, "R07")


# --- a crash without a place ------------------------------------------------------------------


def test_sub_sbs_as_an_empty_list(write: Write) -> None:
    """AttributeError."""
    blueprint = smsl.read(write({"SB": {"HEADER": {"SUB_SBS": []}, "S0": {"o": "S0"}}}))
    assert blueprint["SB"].subs == {}
    assert not found(blueprint, "R07")


def test_no_header(write: Write) -> None:
    """KeyError."""
    blueprint = smsl.read(write({"SB": {"S0": {"o": "S1"}, "S1": {}}}))
    assert (blueprint["SB"].initial, blueprint["SB"].activating) == ("S0", "S1")


def test_sb_without_states(write: Write) -> None:
    """IndexError."""
    blueprint = smsl.read(write({"SB": {"HEADER": {}}}))
    assert len(blueprint["SB"].states) == 0
    assert [str(one.address) for one in found(blueprint, "R03")] == ["SB"]


def test_version_at_file_level(write: Write) -> None:
    """TypeError."""
    error = refusal(write('{"version": 1,\n "SB": {"S0": {}}}'))
    assert error.place is not None
    assert (error.place.line, error.place.column) == (1, 2)
    assert error.sentence == "'version' is a number, not a State Branch"
    assert "start the name with _" in error.advice


def test_target_that_is_a_number(write: Write) -> None:
    """AttributeError."""
    error = refusal(write('{"SB": {\n "S0": {"o": 1}}}'))
    assert error.place is not None
    assert (error.place.line, error.place.column) == (2, 9)
    assert "the target of 'o' is a number" in error.sentence


def test_utf_8_bom(write: Write) -> None:
    """JSONDecodeError."""
    raw = b'\xef\xbb\xbf{"SB": {"S0": {"o": "S0"}}}\r\n'
    blueprint = smsl.read(write(raw))
    assert blueprint.operation_count == 1
    assert blueprint.document.encoded() == raw


def test_suffix_in_capitals(write: Write) -> None:
    """The file is not supported."""
    values = {"SB": {"S0": {"o": "S0"}}}
    plain = smsl.read(write(values))
    assert smsl.read(write(values, "blueprint.JSON")) == plain
    text = "SB:\n  S0: {o: S0}\n"
    assert smsl.read(write(text, "blueprint.YAML")) == plain


def test_one_sub_sb_in_two_bases(write: Write) -> None:
    """KeyError."""
    states = {"S0": {"o": "S1"}, "S1": {"p": "S0"}}
    base = {"HEADER": {"SUB_SBS": {"C": 0}}, **states}
    blueprint = smsl.read(write({"A": base, "B": base, "C": states}))
    assert blueprint.bases == {"C": (("A", 0), ("B", 0))}
    assert not found(blueprint, "R07")
    notes = [one for one in smsl.inspect(blueprint, ["R07"]) if one.severity is Severity.NOTE]
    assert ["C" in one.message for one in notes] == [True]


def test_unknown_sub_sb(write: Write) -> None:
    """KeyError."""
    values = {"A": {"HEADER": {"SUB_SBS": {"SubX": 0}}, "S0": {"o": "S0"}}, "Sub1": {"S0": {}}}
    (finding,) = found(smsl.read(write(values)), "R07")
    assert "SubX" in finding.message


@pytest.mark.parametrize("form", ["json", "smsl", "yaml"])
def test_no_writer(write: Write, form: str) -> None:
    """It writes no form at all."""
    values = {
        "A": {"HEADER": {"SUB_SBS": {"B": 0}}, "_note": "n", "S 0": {"o-1": "S1"}, "S1": {}},
        "B": {"S0": {"on": "S1", "_why": [1, None]}, "S1": {"off": "S0"}},
    }
    plain = smsl.read(write(values))
    text = form_named(form).write(values)
    again = smsl.read(write(text, f"written.{form}"))
    assert again == plain
    assert values_of(again) == values


def test_every_crash_is_a_line_and_an_advice(
    write: Write, capsys: pytest.CaptureFixture[str]
) -> None:
    """A traceback ends the program."""
    files = [
        str(write('{"version": 1}', "version.json")),
        str(write('{"SB": {"S0": {"o": 1}}}', "number.json")),
        str(write('{"SB": {"S0": {"o": "S0" "p": "S0"}}}', "comma.json")),
    ]
    answer = make_shell(capsys)("check", *files)
    assert answer.status == 2
    lines = answer.err.splitlines()
    assert [line.split(":")[0] for line in lines[::2]] == files
    assert all(lines[1::2])
