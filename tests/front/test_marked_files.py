"""Texts with conflict markers, merged by what they mean."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint.merge import choose, open_conflicts
from smsl_studio.blueprint.merge.two_sided import merge_without_base
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import ReadError
from smsl_studio.front.marked_files import merge_marked
from tests.blueprint.merge.random_merges import sides
from tests.blueprint.merge.sides import things
from tests.blueprint.merge.test_choice import chosen
from tests.blueprint.merge.test_merge import BASE, changed, without_s2
from tests.blueprint.values import read
from tests.counts import share_of

OURS, THEIRS = changed(("A|S0|go", "S0")), changed(("A|S0|go", "S2"), ("B|X1|down", "X0"))


def marked(tmp_path: Path, style: str, *values: Any) -> str:
    """The text that git writes when it merges base, ours and theirs line by line."""
    names = []
    for name, value in zip(("base", "ours", "theirs"), values, strict=True):
        (tmp_path / name).write_text(json.dumps(value, indent=1) + "\n")
        names.append(name)
    base, ours, theirs = names
    done = subprocess.run(
        ["git", "merge-file", "-p", *([style] if style else []), ours, base, theirs],
        cwd=tmp_path, capture_output=True, check=False, text=True,
    )  # fmt: skip
    assert "<<<<<<<" in done.stdout
    return done.stdout


def test_with_a_base_only_what_both_changed_is_a_conflict(tmp_path: Path) -> None:
    text = marked(tmp_path, "--diff3", BASE, OURS, THEIRS)
    done = merge_marked(text, "plan.json")
    (one,) = done.merge.conflicts
    assert (one.path, one.base, one.ours, one.theirs) == (("A", "S0", "go"), "S1", "S0", "S2")
    assert done.merge.blueprint["B"].table["X1"] == {"down": "X0"}
    assert done.merge.blueprint.document.file == "plan.json"


def test_without_a_base_every_difference_is_a_conflict(tmp_path: Path) -> None:
    text = marked(tmp_path, "", BASE, OURS, THEIRS)
    done = merge_marked(text, "plan.json")
    assert {one.path for one in done.merge.conflicts} == {("A", "S0", "go")}
    assert not done.merge.conflicts[0].base_known
    assert done.sides.base is None
    assert open_conflicts(done.merge.blueprint) == done.merge.conflicts


def test_a_version_that_is_no_blueprint_is_named(tmp_path: Path) -> None:
    text = marked(tmp_path, "", BASE, OURS, THEIRS).replace('"go": "S2"', '"go" "S2"')
    with pytest.raises(ReadError, match="theirs cannot be read, line"):
        merge_marked(text, "plan.json")


@pytest.mark.parametrize("side", ["ours", "theirs"])
def test_random_versions_without_a_base_can_be_chosen_whole(side: str) -> None:
    for number in range(share_of(60)):
        _, ours, theirs = sides(number, renames=True)
        done = merge_without_base(ours, theirs)
        wanted: Blueprint = ours if side == "ours" else theirs
        assert things(done.blueprint) == things(ours), number
        assert things(chosen(done.blueprint, side)) == things(wanted), number  # type: ignore[arg-type]


def test_a_state_that_one_side_lacks_is_one_conflict_with_all_that_belongs_to_it() -> None:
    done = merge_without_base(read(without_s2()), read(BASE))
    (one,) = done.conflicts
    assert one.path == ("A", "S2")
    after = choose(done.blueprint, one, "theirs")
    assert things(after) == things(read(BASE))
