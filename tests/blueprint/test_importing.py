"""A sub-SB may live in another file."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.writing import values_of
from smsl_studio.errors import EditRefused
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.files import read_document

BASE: dict[str, Any] = {
    "_imports": ["parts/sub.json"],
    "A": {"HEADER": {"SUB_SBS": {"B": 0}}, "State0": {"o": "State1"}, "State1": {}},
}
SUB: dict[str, Any] = {"B": {"State0": {"p": "State1"}, "State1": {}}}


def put(folder: Path, **files: Any) -> None:
    (folder / "parts").mkdir(exist_ok=True)
    for name, values in files.items():
        path = folder / (f"{name}.json" if name == "base" else f"parts/{name}.json")
        path.write_text(json.dumps(values, indent=1))


def base(folder: Path) -> Blueprint:
    return read_blueprint(read_document(folder / "base.json"))


def test_imported_sbs_belong_to_the_blueprint_and_stand_in_their_file(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub=SUB)
    blueprint = base(tmp_path)
    assert list(blueprint.branches) == ["A", "B"]
    assert blueprint.roots == ("A",)
    assert blueprint.import_faults == ()
    place = blueprint.place(Address("B", "State0", "p"))
    assert (Path(place.file).name, place.line) == ("sub.json", 4)
    assert values_of(blueprint) == BASE
    put(tmp_path, sub={"B": {"State0": {}, "State1": {}}})
    assert base(tmp_path) != blueprint, "what is imported is part of the meaning"


def test_imports_are_followed_and_a_file_on_two_ways_is_read_once(tmp_path: Path) -> None:
    both = {**BASE, "_imports": ["parts/sub.json", "parts/more.json"]}
    put(tmp_path, base=both, sub=SUB, more={"_imports": ["sub.json", "deep.json"], "C": {}})
    put(tmp_path, deep={"D": {}})
    assert list(base(tmp_path).branches) == ["A", "B", "C", "D"]
    assert base(tmp_path).import_faults == ()


@pytest.mark.parametrize(
    ("imports", "sub", "words", "chain"),
    [
        (["parts/sub.json"], {"_imports": ["../base.json"]}, "leads back", "base sub base"),
        (["base.json"], {}, "leads back", "base base"),
        (["parts/gone.json"], {}, "cannot be read", "base gone"),
        (["parts/sub.json"], {"_imports": ["gone.json"]}, "cannot be read", "base sub gone"),
        (["parts/sub.json"], {"B": 5}, "'B' is a number", "base sub"),
        (["parts/sub.json"], {"A": {}}, "brings A, which is there", "base sub"),
        (["nul\0"], {}, "cannot be read", "base nul\0"),
        ([5], {}, "the name of a file", "base"),
        ("parts/sub.json", {}, "no list of files", "base"),
    ],
)
def test_an_import_that_fails_is_a_fault_with_its_chain(
    tmp_path: Path, imports: Any, sub: Any, words: str, chain: str
) -> None:
    put(tmp_path, base={**BASE, "_imports": imports}, sub=sub)
    blueprint = base(tmp_path)
    assert list(blueprint["A"].table) == ["State0", "State1"]
    (fault,) = blueprint.import_faults
    assert words in fault.sentence
    assert " ".join(Path(name).stem for name in fault.chain) == chain
    (finding,) = inspect(blueprint, ["R08"])
    assert f"({' > '.join(fault.chain)})" in finding.message
    assert finding.place == blueprint.document.place(fault.path)
    assert finding.place.line == (2 if imports == "parts/sub.json" else 3)


def test_an_imported_sb_is_edited_in_its_own_file(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub=SUB)
    blueprint = base(tmp_path)
    changes: list[Callable[[], Blueprint]] = [
        lambda: edit.add_state(blueprint, "B", "State2"),
        lambda: edit.rename(blueprint, Address("B"), "C"),
        lambda: edit.rename(blueprint, Address("B", "State0"), "State9"),
        lambda: edit.delete(blueprint, [Address("B")]),
        lambda: edit.delete(blueprint, [Address("B", "State0", "p")]),
        lambda: edit.reorder(blueprint, Address("B"), 0),
        lambda: edit.set_header(blueprint, "B", "INITIAL", "State0"),
        lambda: edit.set_layout(blueprint, "B", {"State0": (0, 0)}),
    ]
    for change in changes:
        with pytest.raises(EditRefused, match="B is imported from"):
            change()
    with pytest.raises(EditRefused, match="already a State Branch 'B'"):
        edit.add_branch(blueprint, "B")
    renamed = edit.rename(blueprint, Address("A"), "A2")
    assert list(renamed.branches) == ["A2", "B"]
    assert renamed["B"] is blueprint["B"]
    detached = edit.detach_sub(renamed, "A2", "B")
    assert edit.attach_sub(detached, "A2", 0, "B") == renamed
