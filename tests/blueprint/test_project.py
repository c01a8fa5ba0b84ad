"""A file may import blueprints of its own project, and no other file on the disk."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from smsl_studio.blueprint import imports as importing
from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.imports import MOST
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.project import project_of
from smsl_studio.blueprint.reading import read_blueprint, read_gathered, salvage
from smsl_studio.blueprint.relocation import relocated
from smsl_studio.blueprint.revision import imported_anew, with_document
from smsl_studio.errors import ConvertError
from smsl_studio.inspection.inspect import inspect
from smsl_studio.smsl.files import content_of, parse_bytes, read_document
from smsl_studio.smsl.forms import form_named

SECRET = "root:$6$topsecret:19000:0"
SUB = '{"B": {"State0": {"p": "State1"}, "State1": {}}}'


@pytest.fixture
def inner(tmp_path: Path) -> Path:
    """A folder that is no project; outside of it stands what nobody may see."""
    (tmp_path / "secret").write_text(SECRET)
    (tmp_path / "secret.json").write_text(f'{{"{SECRET}": {{}}}}')
    (tmp_path / "sub.json").write_text(SUB)
    folder = tmp_path / "inner"
    (folder / "parts").mkdir(parents=True)
    (folder / "parts" / "sub.json").write_text(SUB)
    return folder


def imports(folder: Path, *names: Any) -> Blueprint:
    """The blueprint of a file in a folder that imports these names."""
    file = folder / "base.json"
    file.write_text(json.dumps({"_imports": names, "A": {"State0": {}}}, indent=1))
    return read_blueprint(read_document(file))


def told(blueprint: Blueprint) -> list[str]:
    """What inspection says about the imports, with places and advice; nothing may give a secret."""
    found = inspect(blueprint, ["R08"])
    assert all(one.advice for one in found)
    text = "\n".join(f"{one.place} {one.message} {one.advice}" for one in found)
    assert "topsecret" not in text
    assert "topsecret" not in repr(list(blueprint.branches))
    digests(blueprint)
    return [one.message for one in found]


OUT = "the import leads out of the project"
NOT_FROM_HERE = "the import is not named from the folder of this file"
NO_SUFFIX = "the import has no suffix of a blueprint"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("../secret.json", OUT),
        ("parts/../../secret.json", OUT),
        ("./.././secret.json", OUT),
        ("../inner/../secret.json", OUT),
        ("../inner-not/x.json", OUT),
        ("../secret", NO_SUFFIX),
        ("/etc/shadow", NOT_FROM_HERE),
        ("/etc/shadow.json", NOT_FROM_HERE),
        ("//etc/shadow.json", NOT_FROM_HERE),
        ("C:/x.json", NOT_FROM_HERE),
        ("c:x.json", NOT_FROM_HERE),
        ("..\\secret.json", NOT_FROM_HERE),
        ("\\\\server\\share\\x.json", NOT_FROM_HERE),
        ("parts\\sub.json", NOT_FROM_HERE),
        ("store:0123456789", "the import names no digest of the store"),
        ("parts", NO_SUFFIX),
        (".json", NO_SUFFIX),
        ("parts/sub.json.", NO_SUFFIX),
        ("sub.toml", NO_SUFFIX),
        ("parts/sub.json\0", "is no name of a file"),
        ("x" * 4097, "is no name of a file"),
        ("x" * 3000 + ".json", "cannot be read: File name too long"),
        ("~/x.json", "cannot be read: No such file"),
        ("gone.json", "cannot be read: No such file"),
        ("parts/sub.json/x.json", "cannot be read: Not a directory"),
    ],
)
def test_names_that_lead_elsewhere_are_refused(inner: Path, name: str, words: str) -> None:
    blueprint = imports(inner, name)
    (said,) = told(blueprint)
    assert words in said
    assert len(said) < 600
    (finding,) = inspect(blueprint, ["R08"])
    assert (finding.place.file, finding.place.line) == (str(inner / "base.json"), 3)


def named_pipe(path: Path) -> None:
    os.mkfifo(path)


def listener(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as heard:
        heard.bind(str(path))


def folder_like_a_file(path: Path) -> None:
    path.mkdir()


def to(target: str) -> Callable[[Path], None]:
    return lambda path: path.symlink_to(target)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (named_pipe, "cannot be read: it is no ordinary file"),
        (listener, "cannot be read: it is no ordinary file"),
        (folder_like_a_file, "cannot be read: Is a directory"),
        (to("/dev/zero"), OUT),
        (to("/proc/kmsg"), OUT),
        (to("/dev/fd/0"), OUT),
        (to("../secret.json"), OUT),
        (to("../secret"), OUT),
        (to("x.json"), "cannot be read: it is no ordinary file"),
        (to("parts/note.txt"), "the import leads to a file of another kind"),
        (to("base.json"), "leads back to a file it comes from"),
    ],
)
def test_what_is_no_ordinary_file_of_the_project_is_not_opened(
    inner: Path, make: Callable[[Path], None], words: str
) -> None:
    (inner / "parts" / "note.txt").write_text(SUB)
    make(inner / "x.json")
    (said,) = told(imports(inner, "x.json"))
    assert words in said


def test_a_link_to_a_folder_outside_leads_out(inner: Path) -> None:
    (inner / "up").symlink_to("..")
    (said,) = told(imports(inner, "up/secret.json"))
    assert OUT in said
    assert told(imports(inner, "up/inner/parts/sub.json")) == [], "links are resolved first"


def test_links_within_a_project_are_followed(inner: Path) -> None:
    (inner / "other.json").symlink_to("parts/sub.json")
    (inner / "OTHER.JSON").symlink_to("parts/sub.json")
    for name in ("other.json", "OTHER.JSON", "parts/../other.json"):
        blueprint = imports(inner, name)
        assert told(blueprint) == []
        assert list(blueprint.branches) == ["A", "B"]


@pytest.mark.parametrize("text", [SECRET, '{"B": "' + SECRET, f'{{"B": "{SECRET}"}}', "\udcff"])
@pytest.mark.parametrize("suffix", ["json", "smsl", "yaml", "yml"])
def test_a_faulty_import_is_told_by_its_place_alone(inner: Path, text: str, suffix: str) -> None:
    file = inner / f"x.{suffix}"
    file.write_text(f"\n{text}", errors="surrogateescape")
    blueprint = imports(inner, file.name)
    if suffix in ("yaml", "yml") and text == SECRET:
        assert len(told(blueprint)) == 1
    (said,) = told(blueprint)
    assert f"the import is no blueprint: {file}:" in said
    assert "open that file by itself" in inspect(blueprint, ["R08"])[0].advice


# --- the project ----------------------------------------------------------------------------------


@pytest.mark.parametrize("mark", [".git", "smsl.toml"])
@pytest.mark.parametrize("make", [Path.mkdir, Path.touch])
def test_a_project_is_the_nearest_folder_above_that_says_so(
    inner: Path, mark: str, make: Callable[[Path], None]
) -> None:
    top = inner.parent
    assert project_of(str(inner / "base.json")) == str(inner)
    assert OUT in told(imports(inner, "../sub.json"))[0]
    make(top / mark)
    assert project_of(str(inner / "base.json")) == str(top)
    assert told(imports(inner, "../sub.json")) == []
    assert OUT in told(imports(inner, "../../secret.json"))[0]
    make(inner / mark)
    assert OUT in told(imports(inner, "../sub.json"))[0]


def test_all_files_of_a_blueprint_belong_to_the_project_of_the_first(inner: Path) -> None:
    (inner / "parts" / "up.json").write_text('{"_imports": ["../low.json"], "C": {}}')
    (inner / "low.json").write_text('{"_imports": ["../sub.json"], "D": {}}')
    (said,) = told(imports(inner, "parts/up.json"))
    assert said == f"{OUT} (base.json > up.json > low.json > sub.json)"
    alone = read_blueprint(read_document(inner / "parts" / "up.json"))
    assert OUT in told(alone)[0]


def test_standard_input_stands_in_the_current_folder(
    inner: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(inner)
    for names, branches in ((["parts/sub.json"], ["A", "B"]), (["../sub.json"], ["A"])):
        raw = json.dumps({"_imports": names, "A": {}}).encode()
        blueprint = read_blueprint(parse_bytes(raw, "<stdin>"))
        assert list(blueprint.branches) == branches
        told(blueprint)


def test_where_the_current_folder_is_gone_nothing_is_imported(
    inner: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    gone = inner / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    blueprint = read_blueprint(parse_bytes(b'{"_imports": ["a.json"], "A": {}}', "<stdin>"))
    assert len(told(blueprint)) == 1


def test_a_file_under_the_name_of_a_link_looks_beside_the_link(inner: Path) -> None:
    imports(inner, "parts/sub.json")
    other = inner.parent / "other"
    other.mkdir()
    (other / "base.json").symlink_to(inner / "base.json")
    blueprint = read_blueprint(read_document(other / "base.json"))
    assert "No such file" in told(blueprint)[0]


# --- many, and meanwhile --------------------------------------------------------------------------


def test_hundreds_of_refused_imports_end(inner: Path) -> None:
    faults = imports(inner, *[f"../{n}.json" for n in range(3000)]).import_faults
    assert len(faults) == MOST + 1
    assert faults[-1].sentence == f"more than {MOST} imports fail"
    assert len(imports(inner, *["../secret.json"] * 3000).import_faults) == 1


def test_a_diamond_is_read_once(inner: Path) -> None:
    parts = inner / "parts"
    for name in "lr":
        (parts / f"{name}.json").write_text(f'{{"_imports": ["sub.json"], "{name}": {{}}}}')
    blueprint = imports(inner, "parts/l.json", "parts/r.json")
    assert list(blueprint.branches) == ["A", "l", "B", "r"]
    assert told(blueprint) == []


@pytest.mark.parametrize("what", ["folder", "file"])
def test_a_link_that_is_put_there_between_look_and_opening_is_not_followed(
    inner: Path, monkeypatch: pytest.MonkeyPatch, what: str
) -> None:
    parts = inner / "parts"

    def exchanged(path: str, inside: str) -> Any:
        if what == "folder":
            parts.rename(inner / "away")
            parts.symlink_to("..")
        else:
            (parts / "sub.json").unlink()
            (parts / "sub.json").symlink_to(inner.parent / "sub.json")
        return content_of(path, inside)

    monkeypatch.setattr(importing, "content_of", exchanged)
    (said,) = told(imports(inner, "parts/sub.json"))
    assert "cannot be read: " in said


def test_what_was_gathered_is_gathered_again_without_the_disk(inner: Path) -> None:
    (inner / "parts" / "more.json").write_text('{"_imports": ["sub.json"], "C": {}}')
    before = imports(inner, "parts/more.json", "parts/sub.json", "gone.json")
    documents = [form_named(d.form).parse(d.text, d.file) for d in before.documents]
    (inner / "gone.json").write_text('{"NEW": {}}')
    (inner / "parts" / "sub.json").write_text('{"OTHER": {}}')
    (inner / "parts" / "more.json").unlink()
    after = read_gathered(documents)
    assert list(after.branches) == list(before.branches) == ["A", "C", "B"]
    assert [after.home(name).file for name in after.branches] == [
        before.home(name).file for name in before.branches
    ]
    assert read_gathered(documents[:1]).branches.keys() == {"A"}


def test_what_appears_is_imported_only_where_it_may_be(inner: Path) -> None:
    before = imports(inner, "parts/sub.json", "late.json", "../sub.json")
    late = inner / "late.json"
    late.symlink_to(inner.parent / "secret.json")
    assert list(imported_anew(before).branches) == ["A", "B"]
    late.unlink()
    late.write_text('{"C": {}}')
    after = imported_anew(before)
    assert list(after.branches) == ["A", "B", "C"]
    assert after.documents[1] is before.documents[1]
    assert len(told(after)) == 1


def test_texts_in_memory_and_broken_ones_are_not_above_it(inner: Path) -> None:
    blueprint = imports(inner, "parts/sub.json")
    document = blueprint.document
    text = document.text.replace("parts/sub.json", "../sub.json")
    fresh = form_named("json").parse(text, document.file)
    known = read_document(inner.parent / "sub.json")
    for after in (
        with_document(blueprint, fresh),
        salvage(fresh),
        read_blueprint(fresh, opened=[known]),
    ):
        assert OUT in told(after)[0]


# --- another folder -------------------------------------------------------------------------------


def test_an_import_that_another_folder_could_not_have_is_told_before(inner: Path) -> None:
    document = imports(inner, "parts/sub.json", "/etc/x.json", 5).document
    with pytest.raises(ConvertError, match=r"cannot import parts/sub\.json: from there") as caught:
        relocated(document, inner.parent / "elsewhere" / "a.json")
    assert "smsl.toml" in caught.value.advice
    assert caught.value.place == document.place(("_imports", "0"))
    (inner.parent / "smsl.toml").touch()
    (inner.parent / "elsewhere").mkdir()
    moved = relocated(document, inner.parent / "elsewhere" / "a.json")
    assert moved.values["_imports"] == ["../inner/parts/sub.json", "/etc/x.json", 5]
