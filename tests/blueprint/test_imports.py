"""A sub-SB may live in another file."""

from __future__ import annotations

import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint import editing as edit
from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.revision import with_document
from smsl_studio.blueprint.writing import values_of
from smsl_studio.errors import EditRefused, ReadError, UsageError
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import read_document
from smsl_studio.smsl.forms import form_named

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
    ("imports", "sub", "words", "chain", "where"),
    [
        (["parts/sub.json"], {"_imports": ["../base.json"]}, "leads back", "base sub base", "sub"),
        (["base.json"], {}, "leads back", "base base", "base"),
        (["parts/gone.json"], {}, "cannot be read", "base gone", "base"),
        (["parts/sub.json"], {"_imports": ["gone.json"]}, "cannot be read", "base sub gone", "sub"),
        (["parts/sub.json"], {"B": 5}, "sub.json:2:2", "base sub", "base"),
        (["parts/sub.json"], {"A": {}}, "brings A, which is there", "base sub", "base"),
        (["nul\0"], {}, "no name of a file", "base nul\0", "base"),
        ([5], {}, "the name of a file", "base", "base"),
        ("parts/sub.json", {}, "no list of files", "base", "base"),
    ],
)
def test_an_import_that_fails_is_a_fault_with_its_chain(
    tmp_path: Path, imports: Any, sub: Any, words: str, chain: str, where: str
) -> None:
    put(tmp_path, base={**BASE, "_imports": imports}, sub=sub)
    blueprint = base(tmp_path)
    assert list(blueprint["A"].table) == ["State0", "State1"]
    (fault,) = blueprint.import_faults
    assert words in fault.sentence
    assert " ".join(Path(name).stem for name in fault.chain) == chain
    (finding,) = inspect(blueprint, ["R08"])
    assert f"({' > '.join(fault.chain)})" in finding.message
    home = Path(finding.place.file).stem
    assert (finding.place, home) == (fault.place, where)


def test_a_failing_import_is_shown_where_it_is_written(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub={**SUB, "_imports": ["more.json"]}, more={"_imports": [5]})
    (finding,) = inspect(base(tmp_path), ["R08"])
    assert (Path(finding.place.file).name, finding.place.line) == ("more.json", 3)
    assert finding.message == "an import is the name of a file (base.json > sub.json > more.json)"


def test_only_ordinary_files_are_imported_and_not_without_end(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.json")
    (tmp_path / "folder.json").mkdir()
    put(tmp_path, base={**BASE, "_imports": ["pipe.json", "/dev/zero", "folder.json"]})
    assert [fault.sentence for fault in base(tmp_path).import_faults] == [
        "the import cannot be read: it is no ordinary file",
        "the import is not named from the folder of this file",
        "the import cannot be read: Is a directory",
    ]
    many = {f"f{n}": {"_imports": [f"f{n + 1}.json"], f"B{n}": {}} for n in range(600)}
    put(tmp_path, base={**BASE, "_imports": ["parts/f0.json"]}, **many)
    (fault,) = base(tmp_path).import_faults
    assert "more than 500 imports" in fault.sentence
    put(tmp_path, base={**BASE, "_imports": ["gone.json"] * 20001})
    faults = base(tmp_path).import_faults
    assert [fault.path[1] for fault in faults] == ["0", "20000"]


def test_files_of_all_three_forms_belong_together(tmp_path: Path) -> None:
    put(tmp_path, base={**BASE, "_imports": ["parts/b.smsl", "parts/c.yaml"]})
    native, yaml = tmp_path / "parts" / "b.smsl", tmp_path / "parts" / "c.yaml"
    text = (
        "// the sub\n{ # NAME: B\n  # SUB_SBS: (C: 0)\n"
        "  State0: [p -> State1] // up\n  State1: []\n}\n"
    )
    native.write_text(text)
    yaml.write_text("C:\n  State0: {q: State1}  # on\n  State1: {}\n")
    blueprint = base(tmp_path)
    assert [one.form for one in blueprint.documents] == ["json", "smsl", "yaml"]
    assert blueprint.bases == {"B": (("A", 0),), "C": (("B", 0),)}
    after = edit.rename(edit.rename(blueprint, Address("C"), "C2"), Address("B", "State1"), "on")
    assert after.document is blueprint.document
    renamed = text.replace("C:", "C2:").replace("-> State1", "-> on").replace("State1:", "on:")
    assert after.documents[1].text == renamed
    assert "# on" in after.documents[2].text
    must_agree(after)
    assert edit.rename(edit.rename(after, Address("C2"), "C"), Address("B", "on"), "State1") == (
        blueprint
    )


def changes_of_b(blueprint: Blueprint) -> list[Blueprint]:
    """Edits that concern nothing but what stands in the file of B."""
    return [
        edit.add_state(blueprint, "B", "State2", (3, 4)),
        edit.add_operation(blueprint, "B", "State1", "q", "State0"),
        edit.rename(blueprint, Address("B", "State0"), "State9"),
        edit.rename(blueprint, Address("B", "State0", "p"), "q"),
        edit.retarget(blueprint, Address("B", "State0", "p"), "State0"),
        edit.reorder(blueprint, Address("B", "State0"), 1),
        edit.reorder(blueprint, Address("C"), 0),
        edit.delete(blueprint, [Address("B", "State0", "p")]),
        edit.delete(blueprint, [Address("C")]),
        edit.set_header(blueprint, "B", "INITIAL", "State0"),
        edit.set_layout(blueprint, "B", {"State0": (0, 0)}),
        edit.set_note(blueprint, "B", "_states", "State0", {"title": "off"}),
        edit.attach_sub(blueprint, "B", 0, "C"),
        edit.add_branch(blueprint, "D", blueprint.home("B").file),
        edit.set_hazards(blueprint, [{"name": "h", "facts": {}}], blueprint.home("B").file),
    ]


def test_an_imported_sb_is_edited_in_the_file_it_stands_in(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub={**SUB, "C": {}})
    blueprint = base(tmp_path)
    for after in changes_of_b(blueprint):
        assert after.document is blueprint.document
        assert after["A"] is blueprint["A"]
        assert after.documents[1].text != blueprint.documents[1].text
        must_agree(after)
    put(tmp_path, sub={})
    added = edit.add_state(blueprint, "A", "State2")
    assert added.documents[1] is blueprint.documents[1], "what is in memory is not read again"
    assert added["B"] is blueprint["B"]


def must_agree(blueprint: Blueprint) -> None:
    """Whether the texts of a blueprint, read from nothing, have the meaning that it has."""
    opened = [form_named(one.form).parse(one.text, one.file) for one in blueprint.documents]
    again = read_blueprint(opened[0], opened=opened[1:])
    assert again == blueprint
    assert list(again.branches) == list(blueprint.branches)
    assert [one.file for one in again.documents] == [one.file for one in blueprint.documents]
    for branch in blueprint:
        assert again.home(branch.name).text == blueprint.home(branch.name).text
        assert again[branch.name].fields == branch.fields


def test_every_file_that_names_an_sb_follows_its_new_name(tmp_path: Path) -> None:
    needs = {"_operations": {"p": {"requires": {"B/0": "1", "A/0": "0"}}}}
    hazard = {"_hazards": [{"name": "both", "facts": {"B/0": "1", "C/0": "1"}}]}
    put(
        tmp_path,
        base={**BASE, "_imports": ["parts/sub.json", "parts/more.json", "parts/other.json"]},
        sub=SUB,
        more={**hazard, "C": {"State0": {"p": "State0"}, **needs}},
        other={"D": {"HEADER": {"SUB_SBS": [{"B": 0}]}, "State0": {}}},
    )
    blueprint = base(tmp_path)
    after = edit.rename(blueprint, Address("B"), "B2")
    assert [one.text.count('"B2') for one in after.documents] == [1, 1, 2, 1]
    assert not any('"B"' in one.text or '"B/' in one.text for one in after.documents)
    assert after.bases == {"B2": (("A", 0), ("D", 0))}
    must_agree(after)
    assert edit.rename(after, Address("B2"), "B") == blueprint
    named = edit.rename(blueprint, Address("A"), "A2")
    same = [a is b for a, b in zip(named.documents, blueprint.documents, strict=True)]
    assert same == [False, True, False, True], "D and B name no A"
    with pytest.raises(EditRefused, match="p of C requires the fact B/0"):
        edit.delete(blueprint, [Address("B")])
    freed = edit.set_note(blueprint, "C", "_operations", "p", None)
    with pytest.raises(EditRefused, match="the hazard 'both' names the fact B/0"):
        edit.delete(freed, [Address("B")])
    safe = edit.set_hazards(freed, [], blueprint.home("C").file)
    gone = edit.delete(safe, [Address("B")])
    assert gone.bases == {}
    must_agree(gone)


def test_a_hazard_of_an_imported_file_counts(tmp_path: Path) -> None:
    hazards = [{"name": "both", "facts": {"B/0": "1", "X/0": "1"}}, 7]
    put(tmp_path, base=BASE, sub={**SUB, "_hazards": hazards})
    blueprint = base(tmp_path)
    assert [hazard.name for hazard in blueprint.hazards] == ["both"]
    assert blueprint.meaning["hazards"] == ["7", hazards[0]]
    assert blueprint.hazards_of(blueprint.document) == ()
    found = inspect(blueprint, ["R29"])
    places = [(Path(one.place.file).name, one.place.line) for one in found]
    assert places == [("sub.json", 13), ("sub.json", 16)]
    put(tmp_path, sub=SUB)
    assert base(tmp_path) != blueprint


def test_names_and_files_that_are_not_free_are_refused(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub={**SUB, "A": {}})
    blueprint = base(tmp_path)
    with pytest.raises(EditRefused, match="already a State Branch 'B'"):
        edit.add_branch(blueprint, "B")
    with pytest.raises(EditRefused, match="already a State Branch 'B'"):
        edit.rename(blueprint, Address("A"), "B")
    with pytest.raises(EditRefused, match="is no file of this blueprint"):
        edit.add_branch(blueprint, "C", "elsewhere.json")
    renamed = edit.rename(blueprint, Address("A"), "A2")
    assert list(renamed.branches) == ["A2", "B", "A"], "the A of the other file is hidden no more"
    assert renamed.import_faults == ()
    with pytest.raises(EditRefused, match="already"):
        edit.rename(renamed, Address("A2"), "A")


def test_a_key_doubled_in_an_imported_file_is_found_and_mended_there(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub=SUB)
    doubled = tmp_path / "parts" / "sub.json"
    doubled.write_text('{"B": {"State0": {"p": "x", "p": "State1"}, "State1": {}}}')
    blueprint = base(tmp_path)
    (finding,) = inspect(blueprint, ["R01"])
    assert finding.place.file == str(doubled)
    assert finding.fix is not None
    mended = finding.fix.apply(blueprint)
    assert mended.document is blueprint.document
    assert mended.documents[1].text == '{"B": {"State0": {"p": "State1"}, "State1": {}}}'
    assert inspect(mended, ["R01"]) == ()
    with pytest.raises(EditRefused, match="p is written 2 times"):
        edit.delete(blueprint, [Address("B", "State0", "p")])


# --- one text after another --------------------------------------------------------------------


def parsed(blueprint: Blueprint, index: int, text: str) -> Document:
    document = blueprint.documents[index]
    return form_named(document.form).parse(text, document.file)


def test_a_typed_text_takes_the_place_of_one_document(tmp_path: Path) -> None:
    put(tmp_path, base=BASE, sub={**SUB, "C": {}})
    blueprint = base(tmp_path)
    text = blueprint.documents[1].text
    after = with_document(blueprint, parsed(blueprint, 1, text.replace('"p"', '"typed"')))
    assert list(after["B"].table["State0"]) == ["typed"]
    assert after.document is blueprint.document
    assert after["A"] is blueprint["A"]
    assert after["C"] is blueprint["C"], "what stands as before is not read again"
    assert with_document(blueprint, parsed(blueprint, 1, text)) is blueprint
    other = with_document(blueprint, parsed(blueprint, 0, blueprint.document.text + "\n"))
    assert other["A"] is blueprint["A"]
    assert other.documents[1] is blueprint.documents[1]
    with pytest.raises(ReadError, match="'B' is a number"):
        with_document(blueprint, parsed(blueprint, 1, '{"B": 5}'))
    with pytest.raises(UsageError, match="no file of this blueprint"):
        with_document(blueprint, replace(blueprint.document, file="other.json"))


def test_imports_that_are_typed_are_followed_and_what_is_open_is_not_read_again(
    tmp_path: Path,
) -> None:
    put(tmp_path, base=BASE, sub=SUB, more={"_imports": ["sub.json"], "C": {}})
    blueprint = edit.add_state(base(tmp_path), "B", "State7")
    put(tmp_path, sub={"B": 5})
    text = blueprint.document.text.replace("parts/sub", "parts/more")
    after = with_document(blueprint, parsed(blueprint, 0, text))
    assert list(after.branches) == ["A", "C", "B"]
    assert after["B"] is blueprint["B"]
    assert after.documents[2] is blueprint.documents[1]
    back = with_document(after, blueprint.document)
    assert back == blueprint


@pytest.mark.parametrize("text", ['{"B": 5}', "{", ""])
def test_a_file_that_could_not_be_imported_may_be_mended(tmp_path: Path, text: str) -> None:
    put(tmp_path, base=BASE)
    file = tmp_path / "parts" / "sub.json"
    file.write_text(text)
    blueprint = base(tmp_path)
    assert list(blueprint.branches) == ["A"]
    mended = with_document(blueprint, form_named("json").parse(json.dumps(SUB), str(file)))
    assert list(mended.branches) == ["A", "B"]
    assert mended.import_faults == ()
    must_agree(mended)


def test_a_file_may_be_reached_under_several_names(tmp_path: Path) -> None:
    (tmp_path / "link.json").symlink_to(tmp_path / "parts" / "sub.json")
    imports = ["parts/../link.json", "parts/sub.json", "./parts/../parts/sub.json"]
    put(tmp_path, base={**BASE, "_imports": imports}, sub=SUB)
    blueprint = base(tmp_path)
    assert blueprint.import_faults == ()
    assert [one.file for one in blueprint.documents[1:]] == [str(tmp_path / "link.json")]
