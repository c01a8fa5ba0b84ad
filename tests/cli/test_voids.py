"""What voids an approval, and what does not."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

import smsl_studio as smsl
from smsl_studio.inspection.approval import rule_code
from tests.approval import DOOR, written_policy
from tests.cli.people import Desk
from tests.cli.test_refusals import code_changed

Values = dict[str, Any]

WHOLE: Values = {
    "_imports": ["part.json"],
    "_hazards": [{"name": "Locked open", "facts": {"DOOR/0": "0", "DOOR/1": "1"}}],
    "_properties": [{"name": "Opens", "reachable": "DOOR/0 = 1"}],
    "_levels": {"supervision": "human"},
    "DOOR": {
        "HEADER": {"INITIAL": "State_00", "ACTIVATING": "State_11", "NUM_FACTS": 2},
        "State_00": {"open": "State_10"},
        "State_10": {"close": "State_00", "lock": "State_11"},
        "State_11": {"unlock": "State_10"},
        "_operations": {"open": {"title": "Open it", "cost": 2, "timeout": 5}},
        "_layout": {"State_00": [0, 0], "State_10": [90, 0]},
        "_notes": {"1": {"at": [0, 0], "text": "mind the step"}},
    },
}
PART: Values = {"PART": {**DOOR["DOOR"]}}


def edit(change: Callable[[Values], object]) -> Callable[[Desk], str]:
    def write(desk: Desk) -> str:
        values = deepcopy(WHOLE)
        change(values)
        return desk.write(values)

    return write


def in_part(desk: Desk) -> str:
    desk.write({"PART": {**PART["PART"], "State_1": {"shut": "State_0"}}}, "part.json")
    return desk.file


def as_yaml(desk: Desk) -> str:
    file = str(desk.folder / "door.yaml")
    smsl.convert(smsl.read(desk.file), file)
    Path(f"{file}.record.json").write_bytes(desk.record.read_bytes())
    return file


def renamed(desk: Desk) -> str:
    file = str(desk.folder / "gate.json")
    Path(file).write_bytes(Path(desk.file).read_bytes())
    Path(f"{file}.record.json").write_bytes(desk.record.read_bytes())
    return file


def comment(desk: Desk) -> str:
    file = str(desk.folder / "door.smsl")
    smsl.convert(smsl.read(desk.file), file)
    Path(file).write_text(f"// a comment\n{Path(file).read_text()}")
    Path(f"{file}.record.json").write_bytes(desk.record.read_bytes())
    return file


def turned(values: Values) -> None:
    door = values["DOOR"]
    values["DOOR"] = {key: door[key] for key in reversed(door)}


VOIDS: dict[str, Callable[[Desk], str]] = {
    "operation": edit(lambda v: v["DOOR"]["State_10"].pop("close")),
    "target": edit(lambda v: v["DOOR"]["State_10"].update(close="State_10")),
    "time-out": edit(lambda v: v["DOOR"]["_operations"]["open"].update(timeout=6)),
    "title": edit(lambda v: v["DOOR"]["_operations"]["open"].update(title="Open")),
    "cost": edit(lambda v: v["DOOR"]["_operations"]["open"].update(cost=3)),
    "hazard": edit(lambda v: v.pop("_hazards")),
    "property": edit(lambda v: v["_properties"][0].update(why="so")),
    "level": edit(lambda v: v["_levels"].update(supervision="automatic")),
    "imported file": in_part,
}
KEEPS: dict[str, Callable[[Desk], str]] = {
    "nothing": lambda desk: desk.file,
    "place": edit(lambda v: v["DOOR"]["_layout"].update(State_00=[7, 7])),
    "note": edit(lambda v: v["DOOR"]["_notes"]["1"].update(text="mind the gap")),
    "comment": comment,
    "form": as_yaml,
    "key order": edit(turned),
    "file name": renamed,
}


@pytest.fixture
def approved(desk: Desk) -> Desk:
    desk.write(PART, "part.json")
    desk.write(WHOLE)
    found = desk("check", desk.file, "--format", "json").json["files"][0]["findings"]
    assert {one["severity"] for one in found} <= {"W", "I"}, found
    more = [
        word
        for one in found
        if one["severity"] == "W"
        for word in ("--disposition", f"{one['rule']}@{one['address']}=it is known")
    ]
    answer = desk.approve("ada", *more)
    assert answer.status == 0, answer.err
    return desk


@pytest.mark.parametrize("what", VOIDS)
def test_a_change_of_meaning_voids_an_approval(approved: Desk, what: str) -> None:
    file = VOIDS[what](approved)
    answer = approved("verify", file, "--format", "json")
    assert answer.status == 1
    assert "digest_differs" in [one["code"] for one in answer.json["refusals"]]


@pytest.mark.parametrize("what", KEEPS)
def test_what_means_nothing_voids_no_approval(approved: Desk, what: str) -> None:
    file = KEEPS[what](approved)
    answer = approved("verify", file, "--format", "json")
    assert (answer.status, answer.json["refusals"]) == (0, [])


def test_other_rules_void_it_where_the_policy_says_so(
    approved: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(rule_code, "FRONT", ())
    assert approved.verify().status == 0
    strict = written_policy(approved.folder, "rules_unchanged = true")
    assert "rules_changed" in approved.codes("--policy", strict)


def test_other_library_code_voids_it_in_the_worlds_whose_code_was_signed(
    desk: Desk, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = code_changed(desk, monkeypatch)
    assert "code_changed" in desk.codes(*words)
    assert desk.codes() == []


def test_the_page_has_the_same_table() -> None:
    """Each kind of change that is tried here has its row, and each row is tried here."""
    page = (Path(__file__).parents[2] / "docs" / "approval.md").read_text("utf-8")
    section = page.partition("## What voids an approval")[2].partition("\n## ")[0]
    cells = [line.split("|")[1:3] for line in section.splitlines() if line.startswith("| ")]
    told = {what.strip(): voids.strip() for what, voids in cells[1:]}
    wanted = dict.fromkeys(VOIDS, "yes") | {what: "no" for what in KEEPS if what != "nothing"}
    wanted |= {
        "library code": "yes, in the worlds whose code was signed",
        "rule code": "yes, where the policy says `rules_unchanged = true`",
    }
    assert told == wanted
