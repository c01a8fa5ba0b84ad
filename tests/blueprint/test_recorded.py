"""The content of a record gives the digests, and the blueprint that it was made of."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.blueprint.comparison import compare
from smsl_studio.blueprint.digests import content_of, digests, digests_of
from smsl_studio.blueprint.recorded import blueprint_of_content
from smsl_studio.errors import ReadError
from smsl_studio.front.inputs import read
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.strict_json import read_strictly
from smsl_studio.shipped import samples_dir
from tests.inspection.intact import intact_files
from tests.inspection.intact import read as read_intact

SAMPLES = sorted(path.name for path in samples_dir().glob("*.json"))


@pytest.mark.parametrize("name", SAMPLES)
def test_a_sample_comes_back_from_its_content(name: str) -> None:
    blueprint = read(samples_dir() / name)
    content = read_strictly(canonical(content_of(blueprint)), "it")
    assert digests_of(content) == digests(blueprint)
    again = blueprint_of_content(content, "the record")
    assert content_of(again) == content_of(blueprint)
    assert compare(again, again).changes == ()


def test_intact_files_come_back_too() -> None:
    for values in intact_files().values():
        blueprint = read_intact(values)
        content = content_of(blueprint)
        assert digests_of(content) == digests(blueprint)
        again = blueprint_of_content(content, "the record")
        assert digests(again).behaviour == digests(blueprint).behaviour
        assert digests(again).meaning == digests(blueprint).meaning


def test_imported_files_stand_in_the_content(tmp_path: Path) -> None:
    (tmp_path / "part.json").write_text('{"PART": {"State_0": {"a": "State_1"}, "State_1": {}}}')
    whole = tmp_path / "whole.json"
    whole.write_text('{"_imports": ["part.json"], "DOOR": {"State_0": {}, "State_1": {}}}')
    blueprint = read(whole)
    assert digests_of(content_of(blueprint)) == digests(blueprint)
    again = blueprint_of_content(content_of(blueprint), "the record")
    assert sorted(again.branches) == ["DOOR", "PART"]


def test_what_is_no_content_is_refused() -> None:
    for content in ({}, {"behaviour": 1, "meaning": [], "imported": [], "missing": []}):
        with pytest.raises(ReadError):
            blueprint_of_content(content, "the record")
