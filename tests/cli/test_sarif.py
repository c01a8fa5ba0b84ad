"""``check --format sarif``: held against the schema that OASIS published.

``sarif-2.1.0.json`` is that schema as it ships in the npm package @microsoft/sarif-multitool-linux
5.7.0 (MIT licence), unchanged.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest
from jsonschema import Draft202012Validator

from smsl_studio.shipped import samples_dir
from tests.cli.shell import Answer, Shell, sample

SCHEMA = json.loads((Path(__file__).parent / "sarif-2.1.0.json").read_text())
VALIDATOR = Draft202012Validator(SCHEMA)
WIDE = '{"SB1": {"State_0": {"Öffne 🦾": "State_9"}}}'


def run_of(answer: Answer) -> Any:
    """The one run of a log that meets the schema."""
    assert [error.message for error in VALIDATOR.iter_errors(answer.json)] == []
    (run,) = answer.json["runs"]
    return run


@pytest.mark.parametrize(
    "name",
    sorted(path.name for path in samples_dir().iterdir() if path.suffix in (".json", ".smsl")),
)
def test_a_sample_has_the_findings_of_json(shell: Shell, name: str) -> None:
    file = str(samples_dir() / name)
    plain = shell("check", file, "--format", "json")
    answer = shell("check", file, "--format", "sarif")
    run = run_of(answer)
    assert answer.status == plain.status
    assert run["invocations"] == [{"executionSuccessful": True, "toolExecutionNotifications": []}]
    found = [
        (
            result["ruleId"],
            result["level"],
            result["locations"][0]["logicalLocations"][0]["fullyQualifiedName"],
            result["locations"][0]["physicalLocation"]["region"],
        )
        for result in run["results"]
    ]
    levels = {"E": "error", "W": "warning", "I": "note"}
    assert found == [
        (
            finding["rule"],
            levels[finding["severity"]],
            finding["address"],
            {"startLine": finding["line"], "startColumn": finding["column"]},
        )
        for finding in plain.json["files"][0]["findings"]
    ]


def test_a_result_names_its_rule_file_words_and_fix(shell: Shell) -> None:
    run = run_of(shell("check", sample("hanoi"), "--rule", "R15", "--format", "sarif"))
    first = run["results"][0]
    rule = run["tool"]["driver"]["rules"][first["ruleIndex"]]
    assert (rule["id"], rule["shortDescription"]["text"]) == ("R15", "A mislabelled operation")
    uri = first["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    assert unquote(urlsplit(uri).path) == sample("hanoi")
    assert first["message"]["text"] == (
        "moves fact 1 to b; did you mean Op_1b?; fix: Rename to Op_1b"
    )
    assert first["partialFingerprints"] == {"ruleAndAddress/v1": "R15 SB1/State_cbb/Op_1c"}


def test_a_relative_name_stays_relative_and_is_a_uri(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a b").mkdir()
    file = Path("a b") / "c:#%41ö.json"
    file.write_text(WIDE)
    run = run_of(shell("check", str(file), "--rule", "R02", "--format", "sarif"))
    (place,) = (result["locations"][0]["physicalLocation"] for result in run["results"])
    uri = place["artifactLocation"]["uri"]
    assert uri == "a%20b/c%3A%23%2541%C3%B6.json"
    # Columns count characters: the arm is one, in UTF-16 it would be two.
    assert run["columnKind"] == "unicodeCodePoints"
    assert WIDE[place["region"]["startColumn"] - 1 :].startswith('"Öffne')


def test_further_places_are_related_locations(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "two.json"
    file.write_text('{"SB1": {"State_0": {"A": "State_9"}, "State_1": {"B": "State_9"}}}')
    run = run_of(shell("check", str(file), "--rule", "R02", "--format", "sarif"))
    (result,) = run["results"]
    names = [
        place["logicalLocations"][0]["fullyQualifiedName"]
        for place in (*result["locations"], *result["relatedLocations"])
    ]
    assert names == ["SB1/State_0/A", "SB1/State_1/B"]


def test_a_file_that_cannot_be_read_is_a_notification(shell: Shell, tmp_path: Path) -> None:
    bad, gone = tmp_path / "bad.json", tmp_path / "gone.json"
    bad.write_text('{"SB1": {\n    "State_0": 3}}')
    answer = shell("check", str(bad), sample("hfsm"), str(gone), "--format", "sarif")
    assert answer.status == 2
    run = run_of(answer)
    (invocation,) = run["invocations"]
    assert invocation["executionSuccessful"] is False
    first, second = invocation["toolExecutionNotifications"]
    assert first["message"]["text"].startswith("'State_0' is a number, not a state; ")
    region = first["locations"][0]["physicalLocation"]["region"]
    assert region == {"startLine": 2, "startColumn": 5}
    assert "No such file" in second["message"]["text"]
    assert answer.err.startswith(f"{bad}:2:5: ")


def test_standard_input_has_no_file(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    import io
    import sys

    monkeypatch.setattr(sys, "stdin", io.StringIO(WIDE))
    run = run_of(shell("check", "-", "--rule", "R02", "--format", "sarif"))
    (result,) = run["results"]
    assert "physicalLocation" not in result["locations"][0]
