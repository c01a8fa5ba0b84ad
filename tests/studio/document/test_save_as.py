"""Saving under another name: the form follows the name; imports and comments are kept."""

from __future__ import annotations

from pathlib import Path

import pytest

from smsl_studio.errors import ConvertError
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.forms import form_named, form_of
from smsl_studio.studio.document.save_as import leaves_comments, moved

JSON, OTHER = Path("/x/a.json"), Path("/x/b.json")


def document(text: str, file: str = "/x/a.json") -> Document:
    return form_named(form_of(file, text)).parse(text, file)


def test_under_a_name_of_the_same_form_the_text_stays() -> None:
    given = document('{"SB1":   {"State_0": {}}}')
    found = moved(given, OTHER)
    assert (found.document.text, found.document.file, found.anew) == (
        given.text,
        "/x/b.json",
        False,
    )


@pytest.mark.parametrize("suffix", ["smsl", "yaml"])
def test_under_a_name_of_another_form_it_means_the_same(suffix: str) -> None:
    given = document('{"_imports": ["b.json"], "SB1": {"State_0": {"on": "12:30"}, "12:30": {}}}')
    found = moved(given, Path(f"/x/a.{suffix}"))
    assert found.anew
    assert found.document.form == suffix
    assert found.document.values == given.values


def test_an_unknown_suffix_keeps_the_form() -> None:
    assert moved(document("{}"), Path("/x/a.txt")).document.form == "json"


@pytest.mark.parametrize(
    ("old", "new", "name", "found"),
    [
        ("x", "x/y", "b.json", "../b.json"),
        ("x", ".", "b.json", "x/b.json"),
        ("x", "z", "../b.json", "../b.json"),
        ("x", "z", "/abs/b.json", "/abs/b.json"),
        ("x", "x", "./b.json", "./b.json"),
    ],
)
def test_imports_are_named_from_the_new_folder(
    tmp_path: Path, old: str, new: str, name: str, found: str
) -> None:
    (tmp_path / "smsl.toml").touch()
    given = document(f'{{"_imports": ["{name}", 3]}}', f"{tmp_path / old}/a.json")
    target = tmp_path / new / "a.json"
    assert moved(given, target).document.values["_imports"] == [found, 3]


def test_a_text_that_does_not_read_goes_on_in_its_own_form_alone() -> None:
    given = document("{}")
    assert moved(given, OTHER, whole=False).document.file == "/x/b.json"
    with pytest.raises(ConvertError, match="cannot be read cannot be saved as YAML"):
        moved(given, Path("/x/a.yaml"), whole=False)


@pytest.mark.parametrize(
    ("file", "text", "there"),
    [
        ("a.smsl", "// hi\n{\n# NAME: A\n}\n", True),
        ("a.smsl", '{\n# NAME: A\n"//": [ ]\n}\n', False),
        ("a.smsl", '# _url: "http://x"\n{\n# NAME: A\n}\n', False),
        ("a.yaml", "A: {}  # hi\n", True),
        ("a.yaml", "'#': {'a': {}}\nB#: {}\n", False),
        ("a.json", "{}", False),
    ],
)
def test_comments_are_seen_where_there_are_some(file: str, text: str, there: bool) -> None:
    given = document(text, file)
    other = Path("b.json" if not file.endswith("json") else "b.smsl")
    assert leaves_comments(given, other) is there
    assert not leaves_comments(given, Path(f"b.{file[-4:]}"))
