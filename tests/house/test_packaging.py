"""The files that a distribution installs besides the wheel are well formed and fit together."""

from __future__ import annotations

import configparser
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from smsl_studio.smsl.forms import SUFFIXES

ROOT = Path(__file__).parents[2]
PACKAGING, RESOURCES = ROOT / "packaging", ROOT / "resources"
MIME = "{http://www.freedesktop.org/standards/shared-mime-info}"
TYPE = "text/x-smsl"


def mime_type() -> ElementTree.Element:
    (found,) = ElementTree.parse(PACKAGING / "smsl-studio.xml").getroot()
    return found


def desktop_entry() -> configparser.SectionProxy:
    parser = configparser.ConfigParser(interpolation=None, delimiters=("=",))
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    parser.read_string((PACKAGING / "smsl-studio.desktop").read_text("utf-8"))
    return parser["Desktop Entry"]


def test_the_native_suffix_has_a_type_of_its_own() -> None:
    kind = mime_type()
    assert kind.tag == f"{MIME}mime-type"
    assert kind.get("type") == TYPE
    globs = {one.get("pattern") for one in kind.findall(f"{MIME}glob")}
    assert globs == {f"*{suffix}" for suffix, form in SUFFIXES.items() if form == "smsl"}
    assert kind.find(f"{MIME}comment") is not None
    parent = kind.find(f"{MIME}sub-class-of")
    assert parent is not None
    assert parent.get("type") == "text/plain", "every editor may open it"


def test_the_menu_entry_opens_every_form() -> None:
    entry = desktop_entry()
    types = entry["MimeType"].split(";")
    assert types == [TYPE, "application/json", "application/yaml", ""]
    assert entry["Exec"] == "smsl-studio open %F"
    assert {"Name", "Comment", "Categories", "Terminal", "Type"} <= set(entry)


def icons() -> set[str]:
    icon = mime_type().find(f"{MIME}icon")
    assert icon is not None
    return {str(icon.get("name")), desktop_entry()["Icon"]}


def test_a_type_has_the_icon_that_its_name_asks_for() -> None:
    assert icons() == {TYPE.replace("/", "-"), "smsl-studio"}


@pytest.mark.parametrize("name", ["smsl-studio", "text-x-smsl"])
def test_an_icon_is_a_square_picture_that_needs_nothing_else(name: str) -> None:
    assert name in icons()
    text = (RESOURCES / f"{name}.svg").read_text("utf-8")
    root = ElementTree.fromstring(text)
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.get("viewBox") == "0 0 64 64"
    assert len(root) > 1
    assert not re.search(r"href|<script|<style|<text", text)


def test_the_page_installs_every_file() -> None:
    page = (PACKAGING / "README.md").read_text("utf-8")
    shipped = [f"packaging/{path.name}" for path in PACKAGING.glob("smsl-studio.*")]
    for file in [*shipped, *(f"resources/{name}.svg" for name in icons())]:
        assert f"install -Dm644 {file} " in page
        assert (ROOT / file).exists()
