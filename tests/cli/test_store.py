"""``store``: what was inspected is kept by content, imported by it, and revoked by it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.editing import rename
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import EditRefused
from smsl_studio.smsl.files import read_document
from tests.approval import written_policy
from tests.cli.people import Desk

PART = {
    "SUB": {
        "_facts": {"0": {"name": "Needle threaded"}},
        "_operations": {"thread": {"title": "Thread the needle"}, "cut": {"title": "Cut it"}},
        "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
        "State_0": {"thread": "State_1"},
        "State_1": {"cut": "State_0"},
    }
}


def base(digest: str) -> dict[str, Any]:
    """A blueprint that imports a part from the store."""
    return {
        "_imports": [f"store:{digest}"],
        "BASE": {
            "HEADER": {
                "INITIAL": "State_00",
                "ACTIVATING": "State_11",
                "NUM_FACTS": 2,
                "SUB_SBS": {"SUB": 0},
            },
            "State_00": {"ready": "State_10"},
            "State_10": {"unready": "State_00", "sew": "State_11"},
            "State_11": {"undo": "State_10"},
        },
    }


def added(desk: Desk, file: str, *more: str) -> dict[str, Any]:
    answer = desk("store", "add", file, *more, "--format", "json")
    assert answer.status == 0, answer.err
    return dict(answer.json["added"])


def stored(desk: Desk, *words: str) -> list[tuple[str, str]]:
    verb = ("find", *words) if words else ("list",)
    found = desk("store", *verb, "--format", "json").json["stored"]
    return [(one["title"], one["mark"]) for one in found]


def test_what_is_added_is_found_by_facts_operations_and_titles(desk: Desk) -> None:
    part = desk.write(PART, "part.json")
    assert stored(desk) == []
    entry = added(desk, part, "--world", "table", "--seeds", "2", "--by", "Ada")
    (file,) = desk("digest", part, "--format", "json").json["files"]
    assert entry["digest"] == f"sha256:{file['closure']}"
    (sweep,) = entry["verified"]
    assert (sweep["world"], sweep["seeds"], sweep["by"]) == ("table", 2, "Ada")
    assert sweep["source"] == entry["digest"]
    assert [(one["operation"], one["edges"], one["passed"]) for one in sweep["operations"]] == [
        ("thread", 2, 2),
        ("cut", 2, 2),
    ]
    added(desk, desk.file)
    for words in (["needle THREADED"], ["thread the"], ["cut"], ["part"], ["sub", "cut it"]):
        assert stored(desk, *words) == [("part", "Uninspected")], words
    assert desk("store", "find", "no such word").status == 1
    assert [title for title, _ in stored(desk)] == ["door", "part"]
    shown = desk("store", "show", entry["digest"], "--format", "json").json
    assert shown["operations"] == ["thread", "cut", "Thread the needle", "Cut it"]
    assert desk("store", "show", "sha256:" + 64 * "0").status == 2


def test_an_error_keeps_a_blueprint_out(desk: Desk) -> None:
    wrong = desk.write({"SB": {"State_0": {"a": "State_9"}}}, "wrong.json")
    answer = desk("store", "add", wrong)
    assert (answer.status, answer.out) == (1, "")
    assert "R02" in answer.err
    assert stored(desk) == []


def test_a_part_of_the_store_is_imported_by_its_content(desk: Desk, home: Path) -> None:
    digest = added(desk, desk.write(PART, "part.json"))["digest"].removeprefix("sha256:")
    (desk.folder / "part.json").unlink()
    for name in (digest, f"sha256:{digest}"):
        file = desk.write(base(name), "base.json")
        assert desk("check", file).status == 0
    assert desk("run", file, "--world", "table").status == 0
    blueprint = read_blueprint(read_document(file))
    with pytest.raises(EditRefused, match="stands in your store"):
        rename(blueprint, Address("SUB", "State_0", "thread"), "sew")
    for name in ("0" * 64, "../../part.json", digest[:-1], f"{digest}/../x"):
        answer = desk("check", desk.write(base(name), "base.json"))
        assert answer.status == 1, name
        assert "R08" in answer.out
    (kept,) = home.rglob("part.json")
    kept.chmod(0o600)
    kept.write_text(kept.read_text().replace("State_1", "State_2"), "utf-8")
    answer = desk("check", desk.write(base(digest), "base.json"))
    assert "holds something else under this digest" in answer.out
    assert stored(desk) == [("part", "Not what was stored")]


def test_the_digests_do_not_depend_on_where_a_part_stands(desk: Desk) -> None:
    digest = added(desk, desk.write(PART, "part.json"))["digest"].removeprefix("sha256:")
    theirs = desk.write(base(digest), "base.json")
    mine = desk.write({**base(""), "_imports": ["part.json"]}, "mine.json")
    both = [digests(read_blueprint(read_document(one))) for one in (theirs, mine)]
    assert both[0] == both[1]


def test_a_revoked_part_is_told_and_voids_what_covers_it(desk: Desk) -> None:
    part = desk.write(PART, "part.json")
    assert desk("approve", part, "--key", "ada").status == 0
    digest = added(desk, part)["digest"]
    desk.write(base(digest.removeprefix("sha256:")))
    relied = f"store:{digest.removeprefix('sha256:')}"
    assert desk.approve("ada", "--relies-on", relied).status == 0
    assert desk.verify().status == 0
    added(desk, desk.file)
    assert stored(desk) == [("door", "Approved by 1"), ("part", "Approved by 1")]
    found = desk("store", "dependants", digest, "--format", "json").json["dependants"]
    files = {Path(one["file"]).name for one in found}
    assert {(one["kind"]) for one in found} == {"blueprint", "record"}
    assert files == {"door.json", "part.json"}
    assert desk("store", "revoke", digest, "--key", "ada", "--why", "a wrong needle").status == 0
    assert stored(desk) == [("door", "Revoked"), ("part", "Revoked")]
    assert "sub_not_covered" in desk.codes()
    assert "record_revoked" in desk.codes()
    _, end = desk.run("--policy", written_policy(desk.folder, "persons = 1\n"))
    assert end["reason"] == "refused"


def test_a_procedure_needs_a_record_of_its_own_and_a_revoked_one_refuses(desk: Desk) -> None:
    part = desk.write(PART, "part.json")
    digest = added(desk, part)["digest"].removeprefix("sha256:")
    run = {"binding": {"blueprint": f"store:{digest}", "goal": "SUB/State_1"}}
    desk.write(
        {
            "WARD": {
                "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
                "_operations": {"prepare": run},
                "State_0": {"prepare": "State_1"},
                "State_1": {"again": "State_0"},
            }
        }
    )
    assert desk.approve("ada").status == 0
    assert desk.codes() == ["sub_not_covered"]
    assert desk("approve", part, "--key", "ada").status == 0
    assert desk("store", "add", f"{part}.record.json").status == 0
    assert desk.codes() == []
    policy = written_policy(desk.folder, "persons = 1\n")
    assert desk.run("--policy", policy)[1]["reason"] == "goal_reached"
    added(desk, desk.file)
    found = desk("store", "dependants", digest, "--format", "json").json["dependants"]
    assert {Path(one["file"]).name for one in found} == {"door.json", "part.json"}
    assert desk("store", "revoke", digest, "--key", "ada", "--why", "a wrong needle").status == 0
    assert desk.codes() == ["sub_not_covered"]
    _, end = desk.run("--policy", policy)
    assert end["refusals"][0]["code"] == "sub_not_covered"
    assert stored(desk) == [("door", "Revoked"), ("part", "Revoked")]


def test_a_revoked_part_of_a_part_is_told_and_marked(desk: Desk) -> None:
    part = added(desk, desk.write(PART, "part.json"))["digest"].removeprefix("sha256:")
    middle = added(desk, desk.write(base(part), "middle.json"))["digest"].removeprefix("sha256:")
    run = {"binding": {"blueprint": f"store:{middle}", "goal": "BASE/State_11"}}
    outer = {
        "WARD": {
            "HEADER": {"INITIAL": "State_0", "ACTIVATING": "State_1", "NUM_FACTS": 1},
            "_operations": {"prepare": run},
            "State_0": {"prepare": "State_1"},
            "State_1": {"again": "State_0"},
        }
    }
    added(desk, desk.write(outer))
    found = desk("store", "dependants", part, "--format", "json").json["dependants"]
    assert {one["file"] for one in found} == {"middle.json", "door.json"}
    assert {mark for _, mark in stored(desk)} == {"Uninspected"}
    assert desk("store", "revoke", part, "--key", "ada", "--why", "a wrong needle").status == 0
    assert {mark for _, mark in stored(desk)} == {"Revoked"}


def test_a_record_is_added_with_the_blueprint_beside_it(desk: Desk, tmp_path: Path) -> None:
    part = desk.write(PART, "part.json")
    assert desk("approve", part, "--key", "ada").status == 0
    answer = desk("store", "add", f"{part}.record.json", "--format", "json")
    assert len(answer.json["records"]) == 1
    assert stored(desk) == [("part", "Approved by 1")]
    forged = json.loads((tmp_path / "part.json.record.json").read_text())
    forged["records"][0]["signatures"][0]["sig"] = "A" * 86 + "=="
    other = tmp_path / "forged.json.record.json"
    other.write_text(json.dumps(forged), "utf-8")
    assert desk("store", "add", str(other)).status == 1


@pytest.mark.parametrize(
    "words",
    [
        ("add",),
        ("list", "x"),
        ("show", "x"),
        ("dependants", "x"),
        ("dependants",),
        ("add", "no such file"),
        ("add", "door.json", "--seeds", "0", "--world", "table"),
    ],
)
def test_wrong_words_are_refused(desk: Desk, words: tuple[str, ...]) -> None:
    answer = desk("store", *(desk.file if one == "door.json" else one for one in words))
    assert (answer.status, answer.out) == (2, "")
    assert "Traceback" not in answer.err
