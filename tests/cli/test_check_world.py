"""``check --world``: what a world has for a blueprint, and no look at plugins without it."""

from __future__ import annotations

import pytest

from smsl_studio.front import equipment
from tests.cli.shell import Shell, sample

RULES = ("--rule", "R24", "--rule", "R25", "--rule", "R26")


def test_a_world_that_has_everything_adds_nothing(shell: Shell) -> None:
    answer = shell("check", sample("hanoi-corrected"), "--world", "hanoi", *RULES)
    assert answer.status == 0
    assert answer.out.splitlines()[-1].endswith("0 errors, 0 warnings, 0 notes")


def test_operations_without_a_function_make_the_answer_no(shell: Shell) -> None:
    answer = shell("check", sample("hfsm"), "--world", "hanoi", *RULES, "--format", "json")
    found = answer.json["files"][0]["findings"]
    assert answer.status == 1
    assert ("R24", "E", "SB1/State000/Operation000") in {
        (one["rule"], one["severity"], one["address"]) for one in found
    }
    assert {one["rule"] for one in found} == {"R24", "R25"}
    assert [one["line"] for one in found] == sorted(one["line"] for one in found)


def test_without_a_world_no_plugin_is_looked_at(
    shell: Shell, monkeypatch: pytest.MonkeyPatch
) -> None:
    def describe() -> None:
        raise AssertionError("plugins were looked at")

    monkeypatch.setattr(equipment, "describe", describe)
    assert shell("check", sample("hfsm"), *RULES).status == 0
    assert shell("check", sample("hfsm"), "--world", "table", *RULES).status == 0
