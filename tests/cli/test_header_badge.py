"""The words of the approval badge stand in the header of a log."""

from __future__ import annotations

import json
from typing import Any

import pytest

from tests.cli.people import Desk
from tests.runlog.impossible import Story


def _header(desk: Desk, *more: str) -> dict[str, Any]:
    """The header of a run's log."""
    log = desk.folder / "run.jsonl"
    log.unlink(missing_ok=True)
    desk.shell("run", desk.file, "--world", "table", "--log", str(log), *more)
    return dict(json.loads(log.read_bytes().splitlines()[0]))


def test_a_run_that_asks_for_no_approval_verifies_nothing(desk: Desk) -> None:
    header = _header(desk)
    assert header["badge"] == "Uninspected"
    assert list(header)[-2:] == ["badge", "chain"], "what is new stands behind what was there"
    assert desk.approve("ada").status == 0
    assert _header(desk)["badge"] == "Not verified"


def test_a_run_under_a_policy_tells_the_words_of_its_answer(desk: Desk) -> None:
    policy = desk.folder / "policy.toml"
    policy.write_text("persons = 1\n", "utf-8")
    assert _header(desk, "--policy", str(policy))["badge"] == "Uninspected"
    assert desk.approve("ada").status == 0
    assert _header(desk, "--policy", str(policy))["badge"] == "Approved by 1"
    policy.write_text("persons = 2\n", "utf-8")
    assert _header(desk, "--policy", str(policy))["badge"] == "Signature missing"


@pytest.mark.parametrize(("value", "status"), [("Uninspected", 0), (7, 1)])
def test_it_is_a_text_and_may_be_absent(desk: Desk, value: object, status: int) -> None:
    _header(desk)
    log = desk.folder / "run.jsonl"
    story = Story.of(log.read_bytes())
    story.header["badge"] = value
    log.write_bytes(story.raw())
    assert desk.shell("replay", str(log), "--verify").status == status
    del story.header["badge"]
    log.write_bytes(story.raw())
    assert desk.shell("replay", str(log), "--verify").status == 0
