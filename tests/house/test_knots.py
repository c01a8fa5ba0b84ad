"""No modules or folders import each other in a cycle."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.house.knots import folders_of, knot, modules_below

ROOT = Path(__file__).parents[2]
PACKAGE = "smsl_studio"


def test_no_modules_are_tied() -> None:
    modules = modules_below(ROOT, PACKAGE)
    assert len(modules) > 500
    assert knot(modules) == []


def test_no_folders_are_tied() -> None:
    folders = folders_of(modules_below(ROOT, PACKAGE))
    assert len(folders) > 40
    assert knot(folders) == []


def plant(root: Path, **files: str) -> None:
    for name, source in files.items():
        path = root / "top" / f"{name.replace('__', '/')}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(source, "utf-8")


@pytest.mark.parametrize(
    "back",
    [
        "from top.a import x",
        "from top import a",
        "import top.a",
        "def f():\n    from top.a import x",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from top.a import X",
    ],
)
def test_a_planted_knot_of_modules_is_seen(tmp_path: Path, back: str) -> None:
    plant(tmp_path, a="from top.b import y", b="from top.c import z", c=back)
    assert set(knot(modules_below(tmp_path, "top"))) == {"top.a", "top.b", "top.c"}


def test_a_folder_and_one_inside_it_are_two(tmp_path: Path) -> None:
    plant(tmp_path, r__a="from top.r.deep.b import y", r__c="", r__deep__b="from top.r.c import z")
    modules = modules_below(tmp_path, "top")
    assert knot(modules) == []
    assert set(knot(folders_of(modules))) == {"top.r", "top.r.deep"}


def test_what_looks_one_way_is_no_knot(tmp_path: Path) -> None:
    plant(
        tmp_path, a="from top.inner.b import y", inner__b="from top.other.c import z", other__c=""
    )
    modules = modules_below(tmp_path, "top")
    assert (knot(modules), knot(folders_of(modules))) == ([], [])
