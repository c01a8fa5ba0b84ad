"""Rules for the repository: sizes of files and functions, names, the changelog, the lock file."""

from __future__ import annotations

import re
import tomllib
from importlib.metadata import version
from pathlib import Path

from tests.house.survey import survey

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
LOCK = (ROOT / "requirements.lock").read_text("utf-8")
TOPS = ("smsl_studio", "plugins", "benches")
CODE = [path for top in TOPS for path in (ROOT / top).rglob("*.py")]

LONGEST = 400
LONG = 300


def lines(path: Path) -> int:
    return len(path.read_text("utf-8").splitlines())


def test_files_are_short() -> None:
    sizes = {str(path.relative_to(ROOT)): lines(path) for path in CODE}
    assert {name: size for name, size in sizes.items() if size > LONGEST} == {}
    assert sum(size > LONG for size in sizes.values()) <= len(sizes) // 10


def test_no_file_has_a_name_that_says_nothing() -> None:
    nothing = {"util", "utils", "helper", "helpers", "common", "misc", "manager", "managers"}
    assert [path for path in CODE if nothing & set(path.parts) or path.stem in nothing] == []


def test_no_class_is_a_manager() -> None:
    named = [
        (one.path.name, name)
        for top in TOPS
        for one in survey(ROOT / top)
        for name in one.classes
        if re.search(r"(Manager|Helper|Singleton)$", name)
    ]
    assert named == []


def test_nothing_is_put_off() -> None:
    mark = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XXX)\b")
    assert [path for path in CODE if mark.search(path.read_text("utf-8"))] == []


def test_the_version_stands_in_the_changelog() -> None:
    assert f"## [{PROJECT['project']['version']}]" in (ROOT / "CHANGELOG.md").read_text("utf-8")
    assert version("smsl-studio") == PROJECT["project"]["version"]


def test_the_lock_holds_every_dependency_by_hash_and_names_no_host() -> None:
    extras = PROJECT["project"]["optional-dependencies"]
    asked = [*PROJECT["project"]["dependencies"], *extras["dev"], *extras["bench"]]
    written = (re.split(r"[^A-Za-z0-9_.-]", item, maxsplit=1)[0].lower() for item in asked)
    names = {re.sub(r"[-_.]+", "-", name) for name in written}
    locked = re.findall(r"^([a-z0-9._-]+)==", LOCK, re.MULTILINE)
    assert names <= set(locked)
    hashed = re.findall(r"^[a-z0-9._-]+==[^\n]*\\\n    --hash=sha256:", LOCK, re.MULTILINE)
    assert len(hashed) == len(locked)
    assert "://" not in LOCK


def test_pyside_stays_below_the_version_that_loses_references() -> None:
    (pin,) = re.findall(r"^pyside6-essentials==(\d+)\.(\d+)", LOCK, re.MULTILINE)
    assert tuple(map(int, pin)) < (6, 12)


def test_no_item_of_a_layout_is_asked_for() -> None:
    """PySide keeps such an item after its widget is gone, and takes another object at the same
    place of the memory for it: a filter of events failed, or the process died."""
    asked = re.compile(r"\.itemAt(Position)?\(")
    assert [path for path in CODE if asked.search(path.read_text("utf-8"))] == []


def test_the_architecture_page_shows_the_real_rooms() -> None:
    page = (ROOT / "docs/architecture.md").read_text("utf-8")
    shown = set(re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE))
    package = ROOT / "smsl_studio"
    rooms = {path.parent.name for path in package.glob("*/__init__.py")}
    rooms |= {path.stem for path in package.glob("[a-z]*.py")}
    assert rooms == shown


def test_what_the_pages_point_at_is_there() -> None:
    for page in [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md"), *ROOT.glob("*/README.md")]:
        for target in re.findall(r"\]\(([^)#]+)", page.read_text("utf-8")):
            if "://" not in target:
                assert (page.parent / target).exists(), f"{page.relative_to(ROOT)}: {target}"
